// The polygon: grids of points on the surface, a grid for each square.

struct Raster {
    @builtin(position) position: vec4<f32>,
    @location(0) st: vec4<f32>,
    @location(1) @interpolate(flat, either) square: u32,
}

@vertex
fn vertex(@location(0) position: vec3<f32>, @location(1) square: u32, @builtin(vertex_index) index: u32) -> Raster {
    let view = picture.view;
    let q = to_camera(view, position);
    // Nearer is greater: single precision has its digits where depths are close together.
    let reach = 2.0 * view.scale / view.size;
    var out: Raster;
    if view.is_parallel != 0u {
        out.position = vec4<f32>(reach * q.xy, (view.far - q.z) / (view.far - view.near), 1.0);
    } else {
        out.position = vec4<f32>(reach * q.xy, view.near, q.z);
    }
    let side = picture.cells + 1u;
    let corner = vec2<u32>(index % side, index / side % side);
    let cells = f32(picture.cells);
    out.st = vec4<f32>(vec2<f32>(corner) / cells, vec2<f32>(picture.cells - corner) / cells);
    out.square = square;
    return out;
}
