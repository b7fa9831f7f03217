// How the surface bends: twins of `SurfaceJet`.

const PI = 3.141592653589793;

// Sines of the angle between tangents below this are rounding.
const PARALLEL = 1e-6;

// An orthonormal basis of the tangent plane, and how the surface bends in it.
struct TangentFrame {
    exists: bool,
    t1: vec3<f32>,
    t2: vec3<f32>,
    // Of du and of dv.
    lengths: vec2<f32>,
    cosine: f32,
    sine: f32,
    // The second fundamental form on the unit vectors of du and dv.
    uu: f32,
    uv: f32,
    vv: f32,
}

fn tangent_frame(jet: Jet) -> TangentFrame {
    var frame: TangentFrame;
    frame.lengths = vec2<f32>(length(jet.du), length(jet.dv));
    frame.t1 = jet.du / frame.lengths.x;
    let d2 = jet.dv / frame.lengths.y;
    let normal = cross(frame.t1, d2);
    frame.sine = length(normal);
    frame.cosine = dot(frame.t1, d2);
    frame.exists = frame.sine > PARALLEL;
    if !frame.exists {
        return frame;
    }
    let n = normal / frame.sine;
    frame.uu = dot(jet.duu / frame.lengths.x / frame.lengths.x, n);
    frame.uv = dot(jet.duv / frame.lengths.x / frame.lengths.y, n);
    frame.vv = dot(jet.dvv / frame.lengths.y / frame.lengths.y, n);
    frame.t2 = cross(n, frame.t1);
    return frame;
}

// The second fundamental form in the orthonormal basis: on the first vector, on both, on the second.
fn bending(frame: TangentFrame) -> vec3<f32> {
    let mixed = (frame.uv - frame.cosine * frame.uu) / frame.sine;
    let across = ((frame.vv - frame.cosine * frame.uv) / frame.sine - frame.cosine * mixed) / frame.sine;
    return vec3<f32>(frame.uu, mixed, across);
}

// Derivatives along u and v of the unit normal.
fn normal_derivatives(f: TangentFrame) -> mat2x3<f32> {
    // The normal turns against the direction in which the surface bends.
    let du = f.uu * f.t1 + (f.uv - f.cosine * f.uu) / f.sine * f.t2;
    let dv = f.uv * f.t1 + (f.vv - f.cosine * f.uv) / f.sine * f.t2;
    return mat2x3<f32>(-f.lengths.x * du, -f.lengths.y * dv);
}

struct Curvature {
    exists: bool,
    gauss: f32,
    mean: f32,
    k1: f32,
    k2: f32,
}

fn curvature_of(frame: TangentFrame) -> Curvature {
    let b = bending(frame);
    let mean = 0.5 * (b.x + b.z);
    let radius = length(vec2<f32>(0.5 * (b.x - b.z), b.y));
    let gauss = b.x * b.z - b.y * b.y;
    // The larger one by addition, so that nothing cancels; the other one from the product of both.
    let large = mean + select(-radius, radius, mean >= 0.0);
    let small = select(gauss / large, 0.0, large == 0.0);
    return Curvature(true, gauss, mean, max(large, small), min(large, small));
}
