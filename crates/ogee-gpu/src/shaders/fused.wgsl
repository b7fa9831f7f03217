// Second and third pass in one: the point that the middle of the pixel shows, and its colour. The surface has no holes then,
// whatever the polygon's level.

@fragment
fn fragment(@builtin(position) at: vec4<f32>) -> @location(0) vec4<u32> {
    let packed = textureLoad(parameters, vec2<u32>(at.xy), 0);
    if packed.w == 0u {
        discard;
    }
    let place = unpack_place(packed);
    if POINTS == POLYGON {
        return pack_shade(shade(picture, place, place, polygon_point(place.square, place.st.xy)));
    }
    let found = exact(picture.view, place, at.xy, picture.newton);
    return pack_shade(shade(picture, place, found.place, surface_point(found.sample)));
}
