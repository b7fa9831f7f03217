// From the parameters of the polygon to those of the pixel: Newton's method on the projection. Twin of `ogee_render`'s.

// A step longer than this leaves the region in which it can be trusted.
const LONGEST = 0.15;

// Of a pixel: what is left then changes no colour by more than one of 255.
const DONE = 4e-3;

// A place and the surface there.
struct Found {
    place: Place,
    sample: Sample,
}

// The side that a step from a point on it would leave a square by; 4 if it stays inside.
fn leaving(st: vec4<f32>, along: vec2<f32>) -> u32 {
    if st.y <= 0.0 && along.y < 0.0 {
        return 0u;
    }
    if st.z <= 0.0 && along.x > 0.0 {
        return 1u;
    }
    if st.w <= 0.0 && along.y > 0.0 {
        return 2u;
    }
    return select(4u, 3u, st.x <= 0.0 && along.x < 0.0);
}

// The point at x from the start of a side, counter-clockwise; `rest` is 1 - x.
fn on_side(side: u32, x: f32, rest: f32) -> vec4<f32> {
    switch side {
        case 0u: { return vec4<f32>(x, 0.0, rest, 1.0); }
        case 1u: { return vec4<f32>(1.0, x, 0.0, rest); }
        case 2u: { return vec4<f32>(rest, 1.0, x, 0.0); }
        default: { return vec4<f32>(0.0, rest, 1.0, x); }
    }
}

fn limited(step: vec2<f32>) -> vec2<f32> {
    return clamp(step, vec2<f32>(-LONGEST), vec2<f32>(LONGEST));
}

// Where a step leads, to second order.
fn bent(jet: Jet, step: vec2<f32>) -> vec3<f32> {
    let slope = step.x * jet.du + step.y * jet.dv;
    let bend = 0.5 * (step.x * step.x * jet.duu + step.y * step.y * jet.dvv) + step.x * step.y * jet.duv;
    return jet.position + slope + bend;
}

// The point of the surface that the middle of the pixel shows; with no steps that at the place itself. A step goes to the side
// of a square at most, and the next one from there into the square beyond.
fn exact(view: View, start: Place, middle: vec2<f32>, steps: u32) -> Found {
    var found: Found;
    found.place = start;
    for (var step = 0u; step <= steps; step++) {
        let st = found.place.st;
        let square = load_square(found.place.square);
        // The surface is asked for in one place only: compilers copy what is called.
        found.sample = surface_at(square.face, parameters_of(square, st));
        let jet = found.sample.jet;
        let pixel = footprint(view, jet.position, mat2x3<f32>(square.size.x * jet.du, square.size.y * jet.dv));
        let missing = middle - pixel_of(view, to_camera(view, jet.position));
        var along = limited(missing.x * pixel.x + missing.y * pixel.y);
        // Where second derivatives say that this will not be enough, they say what is missing.
        let left = middle - pixel_of(view, to_camera(view, bent(jet, square.size * along)));
        if 2.0 * length(left) < length(missing) {
            along = limited(along + left.x * pixel.x + left.y * pixel.y);
        }
        // What is no number compares as false.
        if step == steps || !(length(missing) > DONE) || !(dot(along, along) >= 0.0) {
            break;
        }
        let side = leaving(st, along);
        var beyond = BORDER;
        if side < 4u {
            beyond = square.across[side];
        }
        if beyond == BORDER {
            found.place.st = clamp(st + vec4<f32>(along, -along), vec4<f32>(0.0), vec4<f32>(1.0));
        } else {
            // What comes first on this side comes last on the other.
            let ends = array<vec2<f32>, 4>(st.xz, st.yw, st.zx, st.wy);
            let end = ends[side];
            found.place = Place(beyond >> 2u, on_side(beyond & 3u, end.y, end.x));
        }
    }
    return found;
}
