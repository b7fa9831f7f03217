// The surface of a face: down its tree to a bicubic patch.
//
// Parameters are passed as (u, v, 1 - u, 1 - v), each exact near its own zero: so a point may be as near to any corner as
// numbers go.

struct Sample {
    jet: Jet,
    // Unit normal; zero where there is none.
    normal: vec3<f32>,
    // An extraordinary vertex itself, where there are no derivatives.
    is_vertex: bool,
}

// 2^e, exactly.
fn power_of_two(e: i32) -> f32 {
    return bitcast<f32>(u32(127 + e) << 23u);
}

// Parameters in the frame of a corner, that corner at the origin.
fn to_corner(corner: u32, q: vec4<f32>) -> vec2<f32> {
    switch corner {
        case 0u: { return q.xy; }
        case 1u: { return q.yz; }
        case 2u: { return q.zw; }
        default: { return q.wx; }
    }
}

// The other way.
fn from_corner(corner: u32, at: vec2<f32>) -> vec2<f32> {
    switch corner {
        case 0u: { return at; }
        case 1u: { return vec2<f32>(1.0 - at.y, at.x); }
        case 2u: { return 1.0 - at; }
        default: { return vec2<f32>(at.y, 1.0 - at.x); }
    }
}

fn unit_normal(du: vec3<f32>, dv: vec3<f32>) -> vec3<f32> {
    // Relative to the longer: down a chain that shrinks by a quarter in each step squares would leave the range of numbers.
    let longest = max(max(length(du), length(dv)), 1e-30);
    let normal = cross(du / longest, dv / longest);
    let square = dot(normal, normal);
    return select(vec3<f32>(0.0), normal * inverseSqrt(square), square > 0.0);
}

// Where in which net a place lies, and what becomes of the patch there.
struct Patch {
    net: u32,
    at: vec2<f32>,
    // What positions are relative to.
    origin: vec3<f32>,
    // By how much the patch is shrunk.
    shrunk: f32,
    // How often parameters were doubled.
    doublings: i32,
    // The normal where the place is an extraordinary vertex.
    normal: vec3<f32>,
    is_vertex: bool,
}

// A chain: the exponent of the larger parameter says which step, the other bits which tile.
fn tail_patch(tail: Tail, q: vec4<f32>) -> Patch {
    let last = i32(tail.steps + STEPS_BEYOND);
    var at = to_corner(tail.corner, q);
    var larger = max(at.x, at.y);
    let is_vertex = larger < power_of_two(-last);
    if is_vertex {
        larger = power_of_two(-last);
        at = vec2<f32>(larger, larger);
    }
    let doublings = max(1, 127 - i32((bitcast<u32>(larger) >> 23u) & 255u));
    // Below the last step the surface is its own limit shape, shrunk about the corner.
    let beyond = max(0, doublings - i32(tail.steps));
    let grown = power_of_two(doublings) * at;
    let right = grown.x >= 1.0;
    let above = grown.y >= 1.0;
    let tile = select(select(0u, 2u, above), 1u, right && above);
    let inner = grown - select(vec2<f32>(0.0), vec2<f32>(1.0), vec2<bool>(right, above));
    var found: Patch;
    found.net = tail.first + 3u * u32(doublings - beyond - 1) + tile;
    found.at = from_corner(tail.corner, inner);
    found.origin = tail.limit;
    found.shrunk = pow(tail.eigenvalue, f32(beyond));
    found.doublings = doublings;
    found.normal = tail.normal;
    found.is_vertex = is_vertex;
    return found;
}

// Down the tree of a face.
fn find(number: u32, parameters: vec4<f32>) -> Patch {
    let face = load_face(number);
    var q = parameters;
    var node = face.root;
    var depth = 0;
    while node >> NODE_SHIFT == SPLIT {
        let children = load_node(node & ((1u << NODE_SHIFT) - 1u));
        let right = q.x >= 0.5;
        let above = q.y >= 0.5;
        node = children[select(select(0u, 1u, right), select(3u, 2u, right), above)];
        let low = vec4<f32>(2.0 * q.xy, 1.0 - 2.0 * q.xy);
        let high = vec4<f32>(1.0 - 2.0 * q.zw, 2.0 * q.zw);
        q = select(low, high, vec4<bool>(right, above, right, above));
        depth++;
    }
    let index = node & ((1u << NODE_SHIFT) - 1u);
    var found = Patch(index, q.xy, face.origin, 1.0, 0, vec3<f32>(0.0), false);
    if node >> NODE_SHIFT == TAIL {
        found = tail_patch(load_tail(index), max(q, vec4<f32>(0.0)));
    }
    found.doublings += depth;
    return found;
}

// The surface at parameters of a face.
fn surface_at(number: u32, parameters: vec4<f32>) -> Sample {
    let found = find(number, parameters);
    let jet = bicubic(found.net, found.at);
    let first = found.shrunk * power_of_two(found.doublings);
    let second = first * power_of_two(found.doublings);
    let position = select(found.shrunk * jet.position, vec3<f32>(0.0), found.is_vertex);
    var sample: Sample;
    sample.jet = Jet(
        found.origin + position,
        first * jet.du,
        first * jet.dv,
        second * jet.duu,
        second * jet.duv,
        second * jet.dvv,
    );
    sample.normal = select(unit_normal(jet.du, jet.dv), found.normal, found.is_vertex);
    sample.is_vertex = found.is_vertex;
    return sample;
}
