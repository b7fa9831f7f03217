// Third pass of the paper: tangents, normal and colour, at positions that are known.

@fragment
fn fragment(@builtin(position) at: vec4<f32>) -> @location(0) vec4<u32> {
    let packed = textureLoad(parameters, vec2<u32>(at.xy), 0);
    if packed.w == 0u {
        discard;
    }
    let place = unpack_place(packed);
    let square = load_square(place.square);
    var sample = surface_at(square.face, parameters_of(square, place.st));
    sample.jet.position = bitcast<vec3<f32>>(textureLoad(positions, vec2<u32>(at.xy), 0).xyz);
    return pack_shade(shade(picture, place, place, surface_point(sample)));
}
