// The surface in textures, where shaders have no storage buffers: texel after texel, row after row.

@group(1) @binding(0) var faces: texture_2d<u32>;
@group(1) @binding(1) var nodes: texture_2d<u32>;
@group(1) @binding(2) var tails: texture_2d<u32>;
@group(1) @binding(3) var squares: texture_2d<u32>;
@group(1) @binding(4) var points_0: texture_2d<f32>;
@group(1) @binding(5) var points_1: texture_2d<f32>;
@group(1) @binding(6) var points_2: texture_2d<f32>;
@group(1) @binding(7) var points_3: texture_2d<f32>;

fn load_face(i: u32) -> Face {
    return unpack_face(textureLoad(faces, texel(i), 0));
}

fn load_node(i: u32) -> vec4<u32> {
    return textureLoad(nodes, texel(i), 0);
}

fn load_tail(i: u32) -> Tail {
    let a = textureLoad(tails, texel(3u * i), 0);
    let b = textureLoad(tails, texel(3u * i + 1u), 0);
    return unpack_tail(a, b, textureLoad(tails, texel(3u * i + 2u), 0));
}

fn load_square(i: u32) -> Square {
    let a = textureLoad(squares, texel(3u * i), 0);
    let b = textureLoad(squares, texel(3u * i + 1u), 0);
    return unpack_square(a, b, textureLoad(squares, texel(3u * i + 2u), 0));
}

// Four points of one texture, from a texel on.
fn row_of(points: texture_2d<f32>, first: u32) -> mat4x3<f32> {
    let at = texel(first);
    let a = textureLoad(points, at, 0).xyz;
    let b = textureLoad(points, at + vec2<u32>(1u, 0u), 0).xyz;
    let c = textureLoad(points, at + vec2<u32>(2u, 0u), 0).xyz;
    return mat4x3<f32>(a, b, c, textureLoad(points, at + vec2<u32>(3u, 0u), 0).xyz);
}

// Four control points, one in each column. A row of a net never lies in two parts, nor in two rows of texels.
fn load_row(first: u32) -> mat4x3<f32> {
    if PARTS == 1u {
        return row_of(points_0, first);
    }
    let i = first & ((1u << PART_SHIFT) - 1u);
    switch first >> PART_SHIFT {
        case 0u: { return row_of(points_0, i); }
        case 1u: { return row_of(points_1, i); }
        case 2u: { return row_of(points_2, i); }
        default: { return row_of(points_3, i); }
    }
}
