// Where points are in the picture: twins of `ogee_render::View` and `ogee::quality::Viewer`.

// A vector in the frame of the camera: right, up, depth.
fn turned(view: View, vector: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(dot(vector, view.right), dot(vector, view.up), dot(vector, view.forward));
}

fn to_camera(view: View, point: vec3<f32>) -> vec3<f32> {
    return turned(view, point - view.eye);
}

// The pixel coordinates of a point in the frame of the camera.
fn pixel_of(view: View, q: vec3<f32>) -> vec2<f32> {
    let k = select(view.scale / q.z, view.scale, view.is_parallel != 0u);
    return vec2<f32>(0.5 * view.size.x + k * q.x, 0.5 * view.size.y - k * q.y);
}

// How the pixel of a point moves when the point moves along a tangent; both in the frame of the camera.
fn pixel_motion(view: View, q: vec3<f32>, w: vec3<f32>) -> vec2<f32> {
    if view.is_parallel != 0u {
        return view.scale * vec2<f32>(w.x, -w.y);
    }
    let k = view.scale / q.z;
    return k * vec2<f32>(w.x - q.x / q.z * w.z, q.y / q.z * w.z - w.y);
}

// The unit direction of view to a point, and one over the distance.
fn direction(view: View, point: vec3<f32>) -> vec4<f32> {
    if view.is_parallel != 0u {
        return vec4<f32>(view.forward, 0.0);
    }
    let ray = point - view.eye;
    let nearness = inverseSqrt(dot(ray, ray));
    return vec4<f32>(nearness * ray, nearness);
}

// A pixel in the parameters of the surface: how far u and v move along its two sides.
struct Footprint {
    x: vec2<f32>,
    y: vec2<f32>,
}

fn footprint(view: View, jet: Jet) -> Footprint {
    let q = to_camera(view, jet.position);
    let a = pixel_motion(view, q, turned(view, jet.du));
    let b = pixel_motion(view, q, turned(view, jet.dv));
    let determinant = a.x * b.y - b.x * a.y;
    return Footprint(vec2<f32>(b.y, -a.y) / determinant, vec2<f32>(-b.x, a.x) / determinant);
}

// How far a number with these derivatives moves along both sides of the pixel together.
fn spread(pixel: Footprint, du: f32, dv: f32) -> f32 {
    let along = vec2<f32>(du, dv);
    return abs(dot(pixel.x, along)) + abs(dot(pixel.y, along));
}

// How many pixels away a number with these derivatives is 0.
fn distance_to_zero(pixel: Footprint, value: f32, du: f32, dv: f32) -> f32 {
    let along = vec2<f32>(du, dv);
    return abs(value) / max(length(vec2<f32>(dot(pixel.x, along), dot(pixel.y, along))), 1e-30);
}

// A step longer than this leaves the region in which Newton's method can be trusted.
const LONGEST = 0.15;

// Moves parameters of a face to where the middle of the pixel shows the surface, as far as the face goes.
fn exact(view: View, face: u32, parameters: vec4<f32>, middle: vec2<f32>, steps: u32) -> vec4<f32> {
    var q = parameters;
    for (var step = 0u; step < steps; step++) {
        let jet = surface_at(face, q).jet;
        let pixel = footprint(view, jet);
        let missing = middle - pixel_of(view, to_camera(view, jet.position));
        let move_uv = missing.x * pixel.x + missing.y * pixel.y;
        // What is no number compares as false.
        if !(dot(move_uv, move_uv) < 1e30) {
            break;
        }
        let limited = clamp(move_uv, vec2<f32>(-LONGEST), vec2<f32>(LONGEST));
        q = clamp(q + vec4<f32>(limited, -limited), vec4<f32>(0.0), vec4<f32>(1.0));
    }
    return q;
}
