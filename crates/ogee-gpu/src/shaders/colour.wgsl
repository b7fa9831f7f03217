// Colours: linear while they are mixed, sRGB in pictures. Twins of `ogee_render::colour`.

fn decode(x: vec3<f32>) -> vec3<f32> {
    return select(pow((x + 0.055) / 1.055, vec3<f32>(2.4)), x / 12.92, x <= vec3<f32>(0.04045));
}

fn encode(colour: vec3<f32>) -> vec3<f32> {
    let x = clamp(colour, vec3<f32>(0.0), vec3<f32>(1.0));
    return select(1.055 * pow(x, vec3<f32>(1.0 / 2.4)) - 0.055, 12.92 * x, x <= vec3<f32>(0.0031308));
}

// The colour of a scale at x from 0 to 1; the ends beyond.
fn along(scale: array<vec3<f32>, 5>, x: f32) -> vec3<f32> {
    let place = 4.0 * clamp(x, 0.0, 1.0);
    let first = min(u32(place), 3u);
    var colours = scale;
    return decode(mix(colours[first], colours[first + 1u], place - f32(first)));
}
