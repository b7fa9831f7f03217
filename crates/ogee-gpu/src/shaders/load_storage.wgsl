// The surface in storage buffers.

@group(1) @binding(0) var<storage, read> faces: array<vec4<u32>>;
@group(1) @binding(1) var<storage, read> nodes: array<vec4<u32>>;
@group(1) @binding(2) var<storage, read> tails: array<vec4<u32>>;
@group(1) @binding(3) var<storage, read> squares: array<vec4<u32>>;
@group(1) @binding(4) var<storage, read> points_0: array<vec4<f32>>;
@group(1) @binding(5) var<storage, read> points_1: array<vec4<f32>>;
@group(1) @binding(6) var<storage, read> points_2: array<vec4<f32>>;
@group(1) @binding(7) var<storage, read> points_3: array<vec4<f32>>;

fn load_face(i: u32) -> Face {
    return unpack_face(faces[i]);
}

fn load_node(i: u32) -> vec4<u32> {
    return nodes[i];
}

fn load_tail(i: u32) -> Tail {
    return unpack_tail(tails[3u * i], tails[3u * i + 1u], tails[3u * i + 2u]);
}

fn load_square(i: u32) -> Square {
    return unpack_square(squares[3u * i], squares[3u * i + 1u], squares[3u * i + 2u]);
}

// Four control points, one in each column. A row of a net never lies in two parts.
fn load_row(first: u32) -> mat4x3<f32> {
    if PARTS == 1u {
        return mat4x3<f32>(
            points_0[first].xyz,
            points_0[first + 1u].xyz,
            points_0[first + 2u].xyz,
            points_0[first + 3u].xyz,
        );
    }
    let i = first & ((1u << PART_SHIFT) - 1u);
    switch first >> PART_SHIFT {
        case 0u: {
            return mat4x3<f32>(points_0[i].xyz, points_0[i + 1u].xyz, points_0[i + 2u].xyz, points_0[i + 3u].xyz);
        }
        case 1u: {
            return mat4x3<f32>(points_1[i].xyz, points_1[i + 1u].xyz, points_1[i + 2u].xyz, points_1[i + 3u].xyz);
        }
        case 2u: {
            return mat4x3<f32>(points_2[i].xyz, points_2[i + 1u].xyz, points_2[i + 2u].xyz, points_2[i + 3u].xyz);
        }
        default: {
            return mat4x3<f32>(points_3[i].xyz, points_3[i + 1u].xyz, points_3[i + 2u].xyz, points_3[i + 3u].xyz);
        }
    }
}
