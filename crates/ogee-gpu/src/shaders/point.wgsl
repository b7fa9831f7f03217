// A point of a pixel, and how it turns: twins of `ogee_render::shade::Point` and of how it is made.

struct Point {
    position: vec3<f32>,
    tangents: mat2x3<f32>,
    // Unit normal; zero where there is none.
    normal: vec3<f32>,
    // Derivatives of the normal, where there are any.
    turns: mat2x3<f32>,
    has_turns: bool,
    curvature: Curvature,
}

// A point of the surface itself.
fn surface_point(sample: Sample) -> Point {
    let frame = tangent_frame(sample.jet);
    var point: Point;
    point.position = sample.jet.position;
    point.tangents = mat2x3<f32>(sample.jet.du, sample.jet.dv);
    point.normal = sample.normal;
    point.has_turns = frame.exists && !sample.is_vertex;
    if point.has_turns {
        point.turns = normal_derivatives(frame);
        point.curvature = curvature_of(frame);
    }
    return point;
}

fn turned_normal(slope: vec3<f32>, normal: vec3<f32>, size: f32) -> vec3<f32> {
    return (slope - dot(normal, slope) * normal) / size;
}

// A point of the polygon: position and normal interpolated over its triangle.
fn polygon_point(square: u32, at: vec2<f32>) -> Point {
    let n = picture.cells;
    let scaled = at * f32(n);
    let cell = min(vec2<u32>(scaled), vec2<u32>(n - 1u));
    let inner = scaled - vec2<f32>(cell);
    let a = square * (n + 1u) * (n + 1u) + cell.x + (n + 1u) * cell.y;
    // The two triangles of a cell meet from its first corner to its third.
    let below = inner.x >= inner.y;
    let beside = select(a + n + 1u, a + 1u, below);
    let p0 = textureLoad(grid_points, texel(a), 0).xyz;
    let p1 = textureLoad(grid_points, texel(beside), 0).xyz;
    let p2 = textureLoad(grid_points, texel(a + n + 2u), 0).xyz;
    let n0 = textureLoad(grid_normals, texel(a), 0).xyz;
    let n1 = textureLoad(grid_normals, texel(beside), 0).xyz;
    let n2 = textureLoad(grid_normals, texel(a + n + 2u), 0).xyz;
    let du = select(p2 - p1, p1 - p0, below);
    let dv = select(p1 - p0, p2 - p1, below);
    let nu = select(n2 - n1, n1 - n0, below);
    let nv = select(n1 - n0, n2 - n1, below);
    let mean = n0 + inner.x * nu + inner.y * nv;
    let size = length(mean);
    let scale = f32(n);
    var point: Point;
    point.position = p0 + inner.x * du + inner.y * dv;
    point.tangents = mat2x3<f32>(scale * du, scale * dv);
    point.has_turns = size > 0.0;
    if point.has_turns {
        point.normal = mean / size;
        point.turns = mat2x3<f32>(
            scale * turned_normal(nu, point.normal, size),
            scale * turned_normal(nv, point.normal, size),
        );
    }
    return point;
}
