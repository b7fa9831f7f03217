// What every pass is given beside the surface: the scene, the grids of the polygon, and what passes before it have written.

@group(0) @binding(0) var<uniform> picture: Picture;
// All scales of a picture on the light plane, one after the other.
@group(0) @binding(1) var light_texels: texture_2d<f32>;

@group(2) @binding(0) var grid_points: texture_2d<f32>;
@group(2) @binding(1) var grid_normals: texture_2d<f32>;
@group(2) @binding(2) var parameters: texture_2d<u32>;
@group(2) @binding(3) var positions: texture_2d<u32>;

// Where data lie in a texture.
fn texel(i: u32) -> vec2<u32> {
    return vec2<u32>(i % TEXTURE_WIDTH, i / TEXTURE_WIDTH);
}
