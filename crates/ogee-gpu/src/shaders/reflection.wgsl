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
fn reflected_jet(view: View, jet: Jet, normal: vec3<f32>, bend: mat2x3<f32>) -> RayJet {
    let ray = direction(view, jet.position);
    return RayJet(
        ray.xyz - 2.0 * dot(ray.xyz, normal) * normal,
        swing(ray, normal, jet.du, bend[0]),
        swing(ray, normal, jet.dv, bend[1]),
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

fn hit_jet(light: PlaneLight, ray: u32, view: View, jet: Jet, normal: vec3<f32>) -> HitJet {
    let bend = normal_derivatives(jet);
    var way = RayJet(normal, bend[0], bend[1]);
    if ray == REFLECTED {
        way = reflected_jet(view, jet, normal, bend);
    }
    let plane = cross(light.axis_a, light.axis_b);
    let descent = dot(way.along, plane);
    let reach = dot(light.centre - jet.position, plane) / descent;
    let offset = jet.position + reach * way.along - light.centre;
    var hit: HitJet;
    hit.at = vec2<f32>(dot(offset, light.axis_a), dot(offset, light.axis_b));
    hit.exists = abs(descent) > GRAZING && reach > 0.0
        && abs(hit.at.x) <= light.half_a && abs(hit.at.y) <= light.half_b;
    hit.du = moved_hit(light, way.along, reach, jet.du, way.du);
    hit.dv = moved_hit(light, way.along, reach, jet.dv, way.dv);
    return hit;
}
