// From the parameters of the polygon to those of the pixel: Newton's method on the projection.

// A step longer than this leaves the region in which Newton's method can be trusted.
const LONGEST = 0.15;

// Moves parameters of a face to where the middle of the pixel shows the surface, as far as the face goes.
fn exact(view: View, face: u32, parameters: vec4<f32>, middle: vec2<f32>, steps: u32) -> vec4<f32> {
    var q = parameters;
    for (var step = 0u; step < steps; step++) {
        let jet = surface_at(face, q).jet;
        let pixel = footprint(view, jet.position, mat2x3<f32>(jet.du, jet.dv));
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
