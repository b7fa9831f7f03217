// Where rays from the surface meet the light plane: twins of `ogee::quality`.

// Rays closer to parallel with the plane than this sine do not meet it.
const GRAZING = 1e-6;

// A ray and how it turns along u and v.
struct RayJet {
    along: vec3<f32>,
    du: vec3<f32>,
    dv: vec3<f32>,
}

fn swing(view: vec4<f32>, normal: vec3<f32>, tangent: vec3<f32>, turn: vec3<f32>) -> vec3<f32> {
    let sweep = view.w * (tangent - dot(view.xyz, tangent) * view.xyz);
    return sweep - 2.0 * ((dot(sweep, normal) + dot(view.xyz, turn)) * normal + dot(view.xyz, normal) * turn);
}

// The reflected ray and its derivatives.
fn reflected_jet(view: View, at: Point) -> RayJet {
    let ray = direction(view, at.position);
    return RayJet(
        ray.xyz - 2.0 * dot(ray.xyz, at.normal) * at.normal,
        swing(ray, at.normal, at.tangents[0], at.turns[0]),
        swing(ray, at.normal, at.tangents[1], at.turns[1]),
    );
}

// Where a ray meets the plane, and how that moves with the parameters.
struct HitJet {
    exists: bool,
    at: vec2<f32>,
    du: vec2<f32>,
    dv: vec2<f32>,
}

fn moved_hit(light: PlaneLight, ray: vec3<f32>, reach: f32, tangent: vec3<f32>, turn: vec3<f32>) -> vec2<f32> {
    let plane = cross(light.axis_a, light.axis_b);
    let moved = tangent + reach * turn;
    let in_plane = moved - dot(moved, plane) / dot(ray, plane) * ray;
    return vec2<f32>(dot(in_plane, light.axis_a), dot(in_plane, light.axis_b));
}

fn hit_jet(light: PlaneLight, ray: u32, view: View, at: Point) -> HitJet {
    var way = RayJet(at.normal, at.turns[0], at.turns[1]);
    if ray == REFLECTED {
        way = reflected_jet(view, at);
    }
    let plane = cross(light.axis_a, light.axis_b);
    let descent = dot(way.along, plane);
    let reach = dot(light.centre - at.position, plane) / descent;
    let offset = at.position + reach * way.along - light.centre;
    var hit: HitJet;
    hit.at = vec2<f32>(dot(offset, light.axis_a), dot(offset, light.axis_b));
    hit.exists = at.has_turns && abs(descent) > GRAZING && reach > 0.0
        && abs(hit.at.x) <= light.half_a && abs(hit.at.y) <= light.half_b;
    hit.du = moved_hit(light, way.along, reach, at.tangents[0], way.du);
    hit.dv = moved_hit(light, way.along, reach, at.tangents[1], way.dv);
    return hit;
}
