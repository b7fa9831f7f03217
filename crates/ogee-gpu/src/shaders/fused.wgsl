// All passes in one: the point that the middle of the pixel shows, and its colour. The surface has no holes then, whatever the
// polygon's level.

@fragment
fn fragment(in: Raster) -> @location(0) vec4<u32> {
    let place = Place(in.square, in.st);
    if POINTS == POLYGON {
        return pack_shade(shade(picture, place, place, polygon_point(place.square, place.st.xy)));
    }
    let found = exact(picture.view, place, in.position.xy, picture.newton);
    return pack_shade(shade(picture, place, found.place, surface_point(found.sample)));
}
