// What a pixel shows in each style.

struct Shade {
    colour: vec3<f32>,
    // What maps are scaled by, whether a ray met the light, or the depth of what combs stand on.
    value: Value,
}

fn pack_shade(shade: Shade) -> vec4<u32> {
    let value = select(NO_VALUE, bitcast<u32>(shade.value.value), shade.value.exists);
    return vec4<u32>(bitcast<vec3<u32>>(shade.colour), value);
}

// How far the polygon's line is from the surface's, in pixels.
fn line_error(picture: Picture, place: Place, at: Point, pixel: Footprint) -> Value {
    let seen = hit_jet(picture.light, REFLECTED, picture.view, polygon_point(place.square, place.st.xy));
    let exact = hit_jet(picture.light, REFLECTED, picture.view, at);
    let distance = distance_to_zero(pixel, seen.at.x - exact.at.x, exact.du.x, exact.dv.x);
    return Value(seen.exists && exact.exists, distance);
}

// The colour of a point; `seen` is where the polygon shows it, `place` where it is.
fn shade(picture: Picture, seen: Place, place: Place, at: Point) -> Shade {
    let view = picture.view;
    let pixel = footprint(view, at.position, at.tangents);
    var value = Value(true, 0.0);
    var colour: vec3<f32>;
    switch STYLE {
        case SHADED: {
            colour = body(view, at.position, at.normal);
        }
        case WIREFRAME: {
            let square = load_square(place.square);
            colour = wire(view, place.st, square.size, square.sides, at, pixel);
        }
        case LIT: {
            value.exists = hit_jet(picture.light, RAY, view, at).exists;
            colour = lit(view, picture.light, RAY, picture.pattern, at, pixel);
        }
        case ISOPHOTE: {
            colour = isophote(view, picture.direction, picture.step, at, pixel);
        }
        case ZEBRA: {
            colour = zebra(view, picture.direction, picture.step, at, pixel);
        }
        case CURVATURE: {
            value = curvature(picture.quantity, at);
            colour = body_light(view, at.position, at.normal) * map(picture.quantity, value, picture.limit);
        }
        case ERROR: {
            value = line_error(picture, seen, at, pixel);
            colour = body_light(view, at.position, at.normal) * displacement(value, picture.limit);
        }
        default: {
            value.value = to_camera(view, at.position).z;
            colour = body(view, at.position, at.normal);
        }
    }
    return Shade(colour, value);
}
