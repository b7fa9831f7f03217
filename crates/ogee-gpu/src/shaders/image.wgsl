// A picture on a light plane, at every scale: twins of `ogee_render::Light`.

struct LightColour {
    exists: bool,
    colour: vec3<f32>,
}

// Width, height and first texel of a scale.
fn scale_of(size: vec2<u32>, level: u32) -> vec3<u32> {
    var scale = vec3<u32>(size, 0u);
    for (var i = 0u; i < level; i++) {
        scale = vec3<u32>((scale.xy + 1u) / 2u, scale.z + scale.x * scale.y);
    }
    return scale;
}

fn light_texel(scale: vec3<u32>, x: u32, y: u32) -> vec3<f32> {
    return textureLoad(light_texels, texel(scale.z + y * scale.x + x), 0).xyz;
}

// Between the four nearest pixels of one scale.
fn level_at(size: vec2<u32>, level: u32, at: vec2<f32>) -> vec3<f32> {
    let scale = scale_of(size, level);
    let place = clamp(at * vec2<f32>(scale.xy) - 0.5, vec2<f32>(0.0), vec2<f32>(scale.xy - 1u));
    let first = vec2<u32>(place);
    let next = min(first + 1u, scale.xy - 1u);
    let part = place - vec2<f32>(first);
    let top = mix(light_texel(scale, first.x, first.y), light_texel(scale, next.x, first.y), part.x);
    let bottom = mix(light_texel(scale, first.x, next.y), light_texel(scale, next.x, next.y), part.x);
    return mix(top, bottom, part.y);
}

// The colour at a place of the plane, averaged over a spread.
fn image_at(size: vec2<u32>, at: vec2<f32>, half: f32, spread: f32) -> LightColour {
    let tall = half * f32(size.y) / f32(size.x);
    if !(abs(at.x) <= half && abs(at.y) <= tall) {
        return LightColour();
    }
    let st = vec2<f32>((at.x / half + 1.0) / 2.0, (1.0 - at.y / tall) / 2.0);
    let texels = spread / (2.0 * half) * f32(size.x);
    // The last scale is a single pixel.
    let last = 32u - countLeadingZeros(max(size.x, size.y) - 1u);
    let level = min(log2(max(texels, 1.0)), f32(last));
    let fine = u32(level);
    let coarse = min(fine + 1u, last);
    return LightColour(true, mix(level_at(size, fine, st), level_at(size, coarse, st), level - f32(fine)));
}
