// From the parameters of the polygon to those of the pixel: Newton's method on the projection.

// A step longer than this leaves the region in which it can be trusted.
const LONGEST = 0.15;

// A point of a face and its parameters.
struct Found {
    q: vec4<f32>,
    sample: Sample,
}

// The point of a face that the middle of the pixel shows, as far as the face goes; with no steps that at the parameters.
fn exact(view: View, face: u32, parameters: vec4<f32>, middle: vec2<f32>, steps: u32) -> Found {
    var found: Found;
    found.q = parameters;
    for (var step = 0u; step <= steps; step++) {
        // The surface is asked for in one place only: compilers copy what is called.
        found.sample = surface_at(face, found.q);
        let jet = found.sample.jet;
        let pixel = footprint(view, jet.position, mat2x3<f32>(jet.du, jet.dv));
        let missing = middle - pixel_of(view, to_camera(view, jet.position));
        let move_uv = missing.x * pixel.x + missing.y * pixel.y;
        // What is no number compares as false.
        if step == steps || !(dot(move_uv, move_uv) < 1e30) {
            break;
        }
        let limited = clamp(move_uv, vec2<f32>(-LONGEST), vec2<f32>(LONGEST));
        found.q = clamp(found.q + vec4<f32>(limited, -limited), vec4<f32>(0.0), vec4<f32>(1.0));
    }
    return found;
}
