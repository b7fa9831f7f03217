// A place on the surface: a square and four parameters in it (s, t, 1 - s, 1 - t), each exact near its own zero.

struct Place {
    square: u32,
    st: vec4<f32>,
}

// Parameters of the face.
fn parameters_of(square: Square, st: vec4<f32>) -> vec4<f32> {
    let far = 1.0 - square.corner - square.size;
    return vec4<f32>(square.corner + square.size * st.xy, far + square.size * st.zw);
}

// A place in four numbers: of each parameter and its rest the smaller.
fn pack_place(place: Place) -> vec4<u32> {
    let is_far = place.st.zw < place.st.xy;
    let least = select(place.st.xy, place.st.zw, is_far);
    let flags = COVERED | select(0u, FAR_S, is_far.x) | select(0u, FAR_T, is_far.y);
    return vec4<u32>(bitcast<vec2<u32>>(least), place.square, flags);
}

fn unpack_place(packed: vec4<u32>) -> Place {
    let least = bitcast<vec2<f32>>(packed.xy);
    let is_far = vec2<bool>((packed.w & FAR_S) != 0u, (packed.w & FAR_T) != 0u);
    return Place(packed.z, vec4<f32>(select(least, 1.0 - least, is_far), select(1.0 - least, least, is_far)));
}
