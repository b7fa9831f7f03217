// First pass: which square and parameters each pixel shows.

@fragment
fn fragment(in: Raster) -> @location(0) vec4<u32> {
    return pack_place(Place(in.square, in.st));
}
