// Points of the surface at listed places: position and normal.

struct Evaluated {
    @location(0) position: vec4<u32>,
    @location(1) normal: vec4<u32>,
}

@fragment
fn fragment(@builtin(position) at: vec4<f32>) -> Evaluated {
    let packed = textureLoad(parameters, vec2<u32>(at.xy), 0);
    if packed.w == 0u {
        discard;
    }
    // The number is that of the face here.
    let place = unpack_place(packed);
    let sample = surface_at(place.square, place.st);
    return Evaluated(
        vec4<u32>(bitcast<vec3<u32>>(sample.jet.position), COVERED),
        vec4<u32>(bitcast<vec3<u32>>(sample.normal), COVERED),
    );
}
