// The surface of a face: down its tree to a bicubic patch.
//
// Parameters are passed as (u, v, 1 - u, 1 - v), each exact near its own zero: so a point may be as near to any corner as
// numbers go.

struct Sample {
    jet: Jet,
    // Unit normal; zero where there is none.
    normal: vec3<f32>,
    // An extraordinary vertex itself, where there are no derivatives.
    is_vertex: bool,
}

// 2^e, exactly.
fn power_of_two(e: i32) -> f32 {
    return bitcast<f32>(u32(127 + e) << 23u);
}

// Parameters in the frame of a corner, that corner at the origin.
fn to_corner(corner: u32, q: vec4<f32>) -> vec2<f32> {
    switch corner {
        case 0u: { return q.xy; }
        case 1u: { return q.yz; }
        case 2u: { return q.zw; }
        default: { return q.wx; }
    }
}

// The other way.
fn from_corner(corner: u32, at: vec2<f32>) -> vec2<f32> {
    switch corner {
        case 0u: { return at; }
        case 1u: { return vec2<f32>(1.0 - at.y, at.x); }
        case 2u: { return 1.0 - at; }
        default: { return vec2<f32>(at.y, 1.0 - at.x); }
    }
}

fn unit_normal(du: vec3<f32>, dv: vec3<f32>) -> vec3<f32> {
    let normal = cross(du, dv);
    let square = dot(normal, normal);
    return select(vec3<f32>(0.0), normal * inverseSqrt(square), square > 0.0);
}

// A chain: the exponent of the larger parameter says which step, the other bits which tile.
fn tail_sample(tail: Tail, q: vec4<f32>) -> Sample {
    let last = i32(tail.steps + STEPS_BEYOND);
    var at = to_corner(tail.corner, q);
    var larger = max(at.x, at.y);
    let is_vertex = larger < power_of_two(-last);
    if is_vertex {
        larger = power_of_two(-last);
        at = vec2<f32>(larger, larger);
    }
    let doublings = max(1, 127 - i32((bitcast<u32>(larger) >> 23u) & 255u));
    // Below the last step the surface is its own limit shape, shrunk about the corner.
    let beyond = max(0, doublings - i32(tail.steps));
    let scale = power_of_two(doublings);
    let grown = scale * at;
    let right = grown.x >= 1.0;
    let above = grown.y >= 1.0;
    let tile = select(select(0u, 2u, above), 1u, right && above);
    let inner = grown - select(vec2<f32>(0.0), vec2<f32>(1.0), vec2<bool>(right, above));
    let net = tail.first + 3u * u32(doublings - beyond - 1) + tile;
    let jet = bicubic(net, from_corner(tail.corner, inner));
    let shrunk = pow(tail.eigenvalue, f32(beyond));
    var sample: Sample;
    sample.jet = rescaled(Jet(jet.position, shrunk * jet.du, shrunk * jet.dv, shrunk * jet.duu, shrunk * jet.duv, shrunk * jet.dvv), scale);
    sample.jet.position = tail.limit + select(shrunk * jet.position, vec3<f32>(0.0), is_vertex);
    sample.normal = unit_normal(jet.du, jet.dv);
    if is_vertex {
        sample.normal = tail.normal;
    }
    sample.is_vertex = is_vertex;
    return sample;
}

// The surface at parameters of a face.
fn surface_at(number: u32, parameters: vec4<f32>) -> Sample {
    let face = load_face(number);
    var q = parameters;
    var node = face.root;
    var scale = 1.0;
    while node >> NODE_SHIFT == SPLIT {
        let children = load_node(node & ((1u << NODE_SHIFT) - 1u));
        let right = q.x >= 0.5;
        let above = q.y >= 0.5;
        node = children[select(select(0u, 1u, right), select(3u, 2u, right), above)];
        let low = vec4<f32>(2.0 * q.xy, 1.0 - 2.0 * q.xy);
        let high = vec4<f32>(1.0 - 2.0 * q.zw, 2.0 * q.zw);
        q = select(low, high, vec4<bool>(right, above, right, above));
        scale *= 2.0;
    }
    let index = node & ((1u << NODE_SHIFT) - 1u);
    var sample: Sample;
    if node >> NODE_SHIFT == TAIL {
        sample = tail_sample(load_tail(index), max(q, vec4<f32>(0.0)));
    } else {
        sample.jet = bicubic(index, q.xy);
        sample.normal = unit_normal(sample.jet.du, sample.jet.dv);
        sample.jet.position += face.origin;
    }
    sample.jet = rescaled(sample.jet, scale);
    return sample;
}
