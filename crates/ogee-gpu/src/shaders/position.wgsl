// Second pass of the paper: the point of the surface at each pixel's parameters.

@fragment
fn fragment(@builtin(position) at: vec4<f32>) -> @location(0) vec4<u32> {
    let packed = textureLoad(parameters, vec2<u32>(at.xy), 0);
    if packed.w == 0u {
        discard;
    }
    let place = unpack_place(packed);
    let square = load_square(place.square);
    let sample = surface_at(square.face, parameters_of(square, place.st));
    return vec4<u32>(bitcast<vec3<u32>>(sample.jet.position), packed.w);
}
