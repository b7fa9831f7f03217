// The colour of a point: twins of `ogee_render::shade`.

// Light on a matt body, from 0 to 1.
fn matt(view: View, point: vec3<f32>, normal: vec3<f32>) -> f32 {
    let light = 0.62 * view.up - 0.38 * view.right - 0.69 * view.forward;
    let toward = select(normal, -normal, is_inside(view, point, normal));
    let wrapped = clamp(0.5 + 0.5 * dot(toward, light), 0.0, 1.0);
    return 0.12 + 0.88 * wrapped * wrapped;
}

// True where the inner side is seen.
fn is_inside(view: View, point: vec3<f32>, normal: vec3<f32>) -> bool {
    return dot(direction(view, point).xyz, normal) > 0.0;
}

// The matt body.
fn body(view: View, point: vec3<f32>, normal: vec3<f32>) -> vec3<f32> {
    return select(BODY, INSIDE, is_inside(view, point, normal)) * matt(view, point, normal);
}

// Glossy paint, of which `bright` shows a light of this colour.
fn paint(view: View, point: vec3<f32>, normal: vec3<f32>, light: vec3<f32>, bright: f32) -> vec3<f32> {
    let colour = select(PAINT, PAINT_INSIDE, is_inside(view, point, normal));
    return mix((0.35 + 1.3 * matt(view, point, normal)) * colour, light, bright);
}

// Light and dark bands with a touch of the body's shape.
fn bands(view: View, point: vec3<f32>, normal: vec3<f32>, bright: f32) -> vec3<f32> {
    return body_light(view, point, normal) * mix(DARK, LIGHT, bright);
}

// A pattern on the light plane as a point sees it.
fn lit(view: View, light: PlaneLight, ray: u32, pattern: Pattern, at: Point, pixel: Footprint) -> vec3<f32> {
    let hit = hit_jet(light, ray, view, at);
    if !hit.exists {
        return paint(view, at.position, at.normal, LIGHT, 0.0);
    }
    let wide = vec2<f32>(spread(pixel, hit.du.x, hit.dv.x), spread(pixel, hit.du.y, hit.dv.y));
    let place = hit.at / pattern.period;
    var colour = LIGHT;
    var bright = 0.0;
    switch PATTERN {
        case LINES: {
            bright = stripe(place.x + pattern.phase, wide.x / pattern.period, pattern.width);
        }
        case LATTICE: {
            bright = lattice(place, wide / pattern.period, pattern.width);
        }
        case CIRCLES: {
            bright = disc(place.x, place.y, max(wide.x, wide.y) / pattern.period, pattern.radius);
        }
        default: {
            let found = image_at(pattern.size, hit.at, pattern.half, max(wide.x, wide.y));
            if found.exists {
                colour = found.colour;
                bright = 0.92;
            }
        }
    }
    return paint(view, at.position, at.normal, colour, bright);
}

// Bands of equal angle, in degrees, between the normal and the light.
fn isophote(view: View, light: vec3<f32>, step: f32, at: Point, pixel: Footprint) -> vec3<f32> {
    let angle = atan2(length(cross(at.normal, light)), dot(at.normal, light));
    // The angle changes as the normal turns towards the light, and never faster than the normal.
    let sine = max(sin(angle), 1e-6);
    let most = vec2<f32>(length(at.turns[0]), length(at.turns[1]));
    let slope = clamp(-(light * at.turns) / sine, -most, most);
    let wide = select(0.0, spread(pixel, slope.x, slope.y), at.has_turns);
    let bright = stripe(degrees(angle) / step, degrees(wide) / step, 0.5);
    return bands(view, at.position, at.normal, bright);
}

// Stripes of an environment far away.
fn zebra(view: View, axis: vec3<f32>, count: f32, at: Point, pixel: Footprint) -> vec3<f32> {
    var bright = 0.5;
    if at.has_turns {
        let ray = reflected_jet(view, at);
        let sine = dot(ray.along, axis);
        let cosine = length(cross(ray.along, axis));
        let slope = 1.0 / max(cosine, 3e-5);
        let wide = spread(pixel, slope * dot(ray.du, axis), slope * dot(ray.dv, axis));
        bright = stripe(count / PI * atan2(sine, cosine), count / PI * wide, 0.5);
    }
    return bands(view, at.position, at.normal, bright);
}

struct Value {
    exists: bool,
    value: f32,
}

// The curvature that a map shows.
fn curvature(quantity: u32, at: Point) -> Value {
    let found = at.curvature;
    switch quantity {
        case GAUSS, GAUSS_SIGN: { return Value(found.exists, found.gauss); }
        case MEAN: { return Value(found.exists, found.mean); }
        case K1: { return Value(found.exists, found.k1); }
        case K2: { return Value(found.exists, found.k2); }
        default: { return Value(found.exists, max(abs(found.k1), abs(found.k2))); }
    }
}

// The colour of a curvature; `limit` is where colours end.
fn map(quantity: u32, value: Value, limit: f32) -> vec3<f32> {
    if !value.exists {
        return NOTHING;
    }
    let share = select(0.0, value.value / limit, limit > 0.0);
    switch quantity {
        case GREATEST: { return along(RISING, share); }
        // What is flat to a thousandth of the greatest is flat.
        case GAUSS_SIGN: { return along(DIVERGING, 0.5 + 0.5 * clamp(1e3 * share, -1.0, 1.0)); }
        default: { return along(DIVERGING, 0.5 + 0.5 * share); }
    }
}

// How bright a body is whose shape can still be seen below a map.
fn body_light(view: View, point: vec3<f32>, normal: vec3<f32>) -> f32 {
    return 0.55 + 0.45 * matt(view, point, normal);
}

// The edges of a square of parameters on the body: one bit for each side that is one, counter-clockwise from the one along
// the first parameter.
fn wire(view: View, st: vec4<f32>, size: vec2<f32>, sides: u32, at: Point, pixel: Footprint) -> vec3<f32> {
    var nearest = 1e30;
    let distances = vec4<f32>(
        distance_to_zero(pixel, size.y * st.y, 0.0, 1.0),
        distance_to_zero(pixel, size.x * st.z, 1.0, 0.0),
        distance_to_zero(pixel, size.y * st.w, 0.0, 1.0),
        distance_to_zero(pixel, size.x * st.x, 1.0, 0.0),
    );
    for (var side = 0u; side < 4u; side++) {
        if (sides >> side & 1u) != 0u {
            nearest = min(nearest, distances[side]);
        }
    }
    return mix(body(view, at.position, at.normal), EDGE, line(nearest, 1.3 * view.line_width));
}

// The colour of a displacement of lines, in pixels, up to `limit`.
fn displacement(pixels: Value, limit: f32) -> vec3<f32> {
    if !pixels.exists {
        return NOTHING;
    }
    return along(RISING, pixels.value / limit);
}
