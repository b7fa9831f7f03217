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

fn footprint(view: View, position: vec3<f32>, tangents: mat2x3<f32>) -> Footprint {
    let q = to_camera(view, position);
    let a = pixel_motion(view, q, turned(view, tangents[0]));
    let b = pixel_motion(view, q, turned(view, tangents[1]));
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
