// All passes in one: the point that the middle of the pixel shows, and its colour. The surface has no holes then, whatever the
// polygon's level.

@fragment
fn fragment(in: Raster) -> @location(0) vec4<u32> {
    let place = Place(in.square, in.st);
    if POINTS == POLYGON {
        return pack_shade(shade(picture, place, place.st, polygon_point(place.square, place.st.xy)));
    }
    let square = load_square(place.square);
    let near = parameters_of(square, place.st);
    let found = exact(picture.view, square.face, near, in.position.xy, picture.newton);
    // Back to the square, for its edges.
    let corner = vec4<f32>(square.corner, 1.0 - square.corner - square.size);
    let st = (found.q - corner) / square.size.xyxy;
    return pack_shade(shade(picture, place, st, surface_point(found.sample)));
}
