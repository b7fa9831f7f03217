// One bicubic patch: position and derivatives from sixteen control points.

struct Jet {
    position: vec3<f32>,
    du: vec3<f32>,
    dv: vec3<f32>,
    duu: vec3<f32>,
    duv: vec3<f32>,
    dvv: vec3<f32>,
}

// The four uniform cubic B-splines over a cell.
fn splines(t: f32) -> vec4<f32> {
    let s = 1.0 - t;
    return vec4<f32>(s * s * s, (3.0 * t - 6.0) * t * t + 4.0, (3.0 * s - 6.0) * s * s + 4.0, t * t * t) / 6.0;
}

// Their derivatives.
fn spline_slopes(t: f32) -> vec4<f32> {
    let s = 1.0 - t;
    return vec4<f32>(-s * s, (3.0 * t - 4.0) * t, (4.0 - 3.0 * s) * s, t * t) / 2.0;
}

// Their second derivatives.
fn spline_bends(t: f32) -> vec4<f32> {
    return vec4<f32>(1.0 - t, 3.0 * t - 2.0, 1.0 - 3.0 * t, t);
}

// The patch of a net at parameters of its own.
fn bicubic(net: u32, at: vec2<f32>) -> Jet {
    let value_u = splines(at.x);
    let slope_u = spline_slopes(at.x);
    let bend_u = spline_bends(at.x);
    let value_v = splines(at.y);
    let slope_v = spline_slopes(at.y);
    let bend_v = spline_bends(at.y);
    var jet: Jet;
    for (var j = 0u; j < 4u; j++) {
        let row = load_row(NET_POINTS * net + 4u * j);
        let value = row * value_u;
        let slope = row * slope_u;
        jet.position += value_v[j] * value;
        jet.du += value_v[j] * slope;
        jet.dv += slope_v[j] * value;
        jet.duu += value_v[j] * (row * bend_u);
        jet.duv += slope_v[j] * slope;
        jet.dvv += bend_v[j] * value;
    }
    return jet;
}
