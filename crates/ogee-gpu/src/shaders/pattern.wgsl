// How much of a pixel is bright: twins of `ogee_render::pattern`.

// The bright part of all stripes before x.
fn bright_before(x: f32, width: f32) -> f32 {
    return floor(x) * width + min(fract(x), width);
}

fn stripe(x: f32, spread: f32, width: f32) -> f32 {
    let wide = clamp(spread, 1e-6, 1e2);
    // From the stripe at x, so that what is subtracted is small.
    let near = fract(x);
    let bright = bright_before(near + 0.5 * wide, width) - bright_before(near - 0.5 * wide, width);
    return clamp(bright / wide, 0.0, 1.0);
}

fn disc(x: f32, y: f32, spread: f32, radius: f32) -> f32 {
    let from_middle = length(vec2<f32>(fract(x), fract(y)) - 0.5);
    let near = clamp((radius - from_middle) / max(spread, 1e-9) + 0.5, 0.0, 1.0);
    // From a pixel of half a cell to one of a whole cell the single disc gives way to the average of many.
    let part = clamp(2.0 * spread - 1.0, 0.0, 1.0);
    return near + part * (PI * radius * radius - near);
}

fn lattice(at: vec2<f32>, spread: vec2<f32>, width: f32) -> f32 {
    let a = stripe(at.x, spread.x, width);
    let b = stripe(at.y, spread.y, width);
    return a + b - a * b;
}

fn line(distance: f32, width: f32) -> f32 {
    return clamp(0.5 * width + 0.5 - distance, 0.0, 1.0);
}
