//! A cage with lenses and poles made ready for methods that have no rule for them: another cage, and caps.

use std::cell::OnceCell;
use std::collections::BTreeMap;

use super::biquartic::{Biquartic, Entry};
use super::biquartic_cap::CapSite;
use super::cap::Cap;
use super::circles::PolarNeighbourhood;
use super::cover::{self, Covered};
use super::detect::{Detection, Lens, LensKind, LensPair, detect};
use super::error::{LensError, Obstacle};
use super::fan::{PolarNet, RadialRule};
use super::layout::LensNet;
use super::origins::Origins;
use super::pair_pole::pair_pole;
use super::polar::PolarCap;
use super::polar_energy::PolarOperator;
use super::polar_error::PolarError;
use super::polar_faces::PolarFaces;
use super::polar_sector::PolarVariant;
use super::remesh::{Averaging, Remesh, remesh};
use super::rework::Rework;

use crate::math::{Grid, Vec3};
use crate::mesh::{ControlMesh, FaceId, Topology, Valence, VertexId};
use crate::nurbs::FaceAddress;
use crate::rules::Level;

/// A construction for lenses, by the paper's figures.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// A polar cap where circles go around a pair or a pole, else [`Method::Merge`].
    #[default]
    Auto,
    /// None: the rule of every level stays, which is tangent-continuous.
    C1,
    /// Figure 10, then rings of bi-4 patches: curvature-continuous.
    C2,
    /// Rings of bi-4 patches straight from the net, raised in degree.
    DegreeRaise,
    /// Figure 11 left: the edges at the lens become one.
    Identify,
    /// Figure 11 right: the lens vertex is taken out.
    Remove,
    /// Figure 12: one step and means of its points.
    Merge,
    /// A polar cap for every pair and pole; a lens without a partner is refused.
    Polar,
}

impl Method {
    /// All of them.
    pub const ALL: [Method; 8] = [
        Method::Auto,
        Method::C1,
        Method::C2,
        Method::DegreeRaise,
        Method::Identify,
        Method::Remove,
        Method::Merge,
        Method::Polar,
    ];

    /// Its name on the command line and in reports.
    pub fn name(self) -> &'static str {
        match self {
            Method::Auto => "auto",
            Method::C1 => "c1",
            Method::C2 => "c2",
            Method::DegreeRaise => "degree-raise",
            Method::Identify => "identify",
            Method::Remove => "remove",
            Method::Merge => "merge",
            Method::Polar => "polar",
        }
    }

    /// The change of the cage that it is, if it is one.
    fn remesh(self, averaging: Averaging) -> Option<Remesh> {
        match self {
            Method::Identify => Some(Remesh::Identify),
            Method::Remove => Some(Remesh::RemoveCentre),
            Method::Merge => Some(Remesh::Merge(averaging)),
            Method::Auto | Method::C1 | Method::C2 | Method::DegreeRaise | Method::Polar => None,
        }
    }

    /// How it enters bi-4 rings, if it does.
    fn entry(self) -> Option<Entry> {
        match self {
            Method::C2 => Some(Entry::Refit),
            Method::DegreeRaise => Some(Entry::DegreeRaise),
            _ => None,
        }
    }
}

/// Choices of [`treat`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// The construction.
    pub method: Method,
    /// Which points figure 12 averages.
    pub averaging: Averaging,
    /// Degrees of polar caps.
    pub variant: PolarVariant,
    /// Rings of bi-4 patches before the hole in their midst is closed.
    pub rings: u32,
    /// How many faces a polar cap becomes.
    pub faces: PolarFaces,
}

impl Default for Options {
    fn default() -> Options {
        Options {
            method: Method::default(),
            averaging: Averaging::default(),
            variant: PolarVariant::default(),
            rings: 4,
            faces: PolarFaces::default(),
        }
    }
}

/// A cage whose lenses and poles have been seen to.
#[derive(Clone, Debug)]
pub struct Treated {
    /// The cage. What caps stand for is gone from it; next to caps there are holes, since what lies outside them depends on their
    /// points.
    pub mesh: ControlMesh,
    /// What stands in the place of the faces that are gone, joined to edges of `mesh`.
    pub caps: Vec<Cap>,
    /// How often the cage was refined before.
    pub steps: u32,
    /// For each face of `mesh` the piece of the first cage that it is.
    pub addresses: Vec<FaceAddress>,
    /// For each vertex of `mesh` that of the first cage that it was, if it was one.
    pub vertices: Vec<Option<u32>>,
    /// What was done, by vertex.
    pub lenses: Vec<TreatedLens>,
    /// The pieces of the first cage for which the caps stand.
    pub(crate) covered: Vec<Covered>,
    /// The level of `mesh`.
    pub(crate) level: Level,
    /// Where its vertices come from.
    pub(crate) origins: Origins,
    /// The edges that were asked for, as far as they are left.
    pub(crate) edges: Vec<[u32; 2]>,
}

/// What was done with a lens or a pole.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TreatedLens {
    /// The vertex of the first cage.
    pub vertex: VertexId,
    /// The other lens of a pair.
    pub paired_with: Option<VertexId>,
    /// What was done, none of them [`Method::Auto`]; [`Method::C1`] where nothing was.
    pub method: Method,
    /// Why this and no other.
    pub reason: String,
}

impl TreatedLens {
    /// True if a cap has taken the place of what was around it.
    pub(crate) fn has_cap(&self) -> bool {
        matches!(self.method, Method::C2 | Method::DegreeRaise | Method::Polar)
    }
}

/// The most refinements that are taken to clear a neighbourhood.
const MOST_STEPS: u32 = 3;

/// A cage of its own, with its level and its history, costs some four times what a plain mesh does.
const COPIES: u64 = 4;

/// Sees to every lens and pole of a cage: re-meshes lenses, or puts caps in their place. Where a neighbourhood is too narrow the
/// whole cage is refined first, three times at most.
///
/// ```
/// use ogee::lens::{self, Method, treat};
/// use ogee::shapes;
///
/// let treated = treat(&shapes::lens(), &lens::Options::default())?;
/// assert!(treated.lenses.iter().all(|lens| lens.method == Method::Polar));
/// # Ok::<(), lens::LensError>(())
/// ```
///
/// # Errors
/// If the cage has defects, or something is in the way of a lens that does not give way: an edge that is sharp at the lens itself
/// say. Poles that cannot have a cap stay as they are.
pub fn treat(mesh: &ControlMesh, options: &Options) -> Result<Treated, LensError> {
    treat_following(mesh, options, &[], u64::MAX)
}

/// The same, following some edges.
pub(crate) fn treat_following(
    mesh: &ControlMesh,
    options: &Options,
    edges: &[[u32; 2]],
    memory: u64,
) -> Result<Treated, LensError> {
    let mut treatment = Treatment::new(mesh, options, edges);
    let level = loop {
        let level = Level::new(&treatment.work.mesh).map_err(LensError::Mesh)?;
        let found = detect(&level)?;
        treatment.poles.get_or_insert_with(|| found.poles.iter().map(|pole| pole.vertex).collect());
        if options.method == Method::C1 {
            treatment.leave_lenses(&found);
            treatment.leave_poles(&found);
            break level;
        }
        let choices = treatment.choices(&level, &found)?;
        if treatment.remesh(&choices)? || treatment.cap(&level, &found, &choices)? {
            continue;
        }
        if treatment.work.steps == 0 {
            treatment.leave_poles(&found);
        }
        let blocked: Vec<(VertexId, Obstacle)> = choices
            .iter()
            .filter_map(|choice| match choice.plan {
                Plan::Wait(obstacle) => Some((choice.lens.vertex, obstacle)),
                _ => None,
            })
            .collect();
        if blocked.is_empty() {
            break level;
        }
        if let Some(&(vertex, obstacle)) =
            blocked.iter().find(|(_, obstacle)| !treatment.refining_helps(&level, *obstacle))
        {
            return Err(treatment.blocked(vertex, obstacle));
        }
        level.check_depth(1, memory / COPIES)?;
        treatment.work.refine(&level);
    };
    Ok(treatment.finish(level))
}

/// What is to become of a lens.
struct Choice<'a> {
    lens: &'a Lens,
    plan: Plan<'a>,
    reason: String,
}

enum Plan<'a> {
    Remesh(&'a LensNet, Remesh),
    Rings(&'a LensNet, Entry),
    Polar(&'a LensPair, &'a PolarNeighbourhood),
    /// Something is in the way for now.
    Wait(Obstacle),
}

impl Plan<'_> {
    /// The vertex that names the cap, if it is one: of a pair the first.
    fn cap_vertex(&self) -> Option<VertexId> {
        match self {
            Plan::Rings(net, _) => Some(net.centre()),
            Plan::Polar(pair, _) => Some(pair.ends()[0]),
            Plan::Remesh(..) | Plan::Wait(_) => None,
        }
    }

    /// The faces that a cap stands in for.
    fn disk(&self, topology: &Topology) -> Vec<FaceId> {
        match self {
            Plan::Rings(net, _) => net.disk(topology),
            Plan::Polar(_, circles) => circles.disk.clone(),
            Plan::Remesh(..) | Plan::Wait(_) => Vec::new(),
        }
    }

    /// True if the slits of two pairs have a vertex in common.
    fn crosses(&self, other: &Plan<'_>) -> bool {
        match (self, other) {
            (Plan::Polar(one, _), Plan::Polar(two, _)) => one.slit.iter().any(|v| two.slit.contains(v)),
            _ => false,
        }
    }
}

/// A treatment under way.
struct Treatment<'a> {
    options: &'a Options,
    mesh: &'a ControlMesh,
    /// The level of `mesh`, once it is asked for.
    first_level: OnceCell<Option<Level>>,
    work: Rework,
    covered: Vec<Covered>,
    lenses: Vec<TreatedLens>,
    /// Those of `mesh`, once they are known.
    poles: Option<Vec<VertexId>>,
}

impl<'m> Treatment<'m> {
    fn new(mesh: &'m ControlMesh, options: &'m Options, edges: &[[u32; 2]]) -> Treatment<'m> {
        Treatment {
            options,
            mesh,
            first_level: OnceCell::new(),
            work: Rework::new(mesh, edges),
            covered: Vec::new(),
            lenses: Vec::new(),
            poles: None,
        }
    }

    fn choices<'a>(&self, level: &Level, found: &'a Detection) -> Result<Vec<Choice<'a>>, LensError> {
        let guarded = self.guarded(level);
        let mut choices = Vec::with_capacity(found.lenses.len());
        for lens in &found.lenses {
            let mut choice = self.choice(level, found, lens)?;
            if let Plan::Remesh(net, _) = choice.plan
                && let Some(obstacle) = in_the_way(net, &guarded)
            {
                choice.plan = Plan::Wait(obstacle);
            }
            choices.push(choice);
        }
        if self.work.steps < MOST_STEPS {
            self.put_off_overlaps(level, &mut choices);
        }
        Ok(choices)
    }

    /// Caps that would replace the same faces wait for a finer cage, where all of them have room: which one comes first would
    /// depend on the numbering. Only slits that cross never part.
    fn put_off_overlaps(&self, level: &Level, choices: &mut [Choice<'_>]) {
        let mut owner: Vec<Option<usize>> = vec![None; level.topology().face_count()];
        let mut overlaps = BTreeMap::new();
        for (number, choice) in choices.iter().enumerate() {
            let Some(vertex) = choice.plan.cap_vertex() else { continue };
            for face in choice.plan.disk(level.topology()) {
                let other = &choices[*owner[face.index()].get_or_insert(number)];
                if let Some(beside) = other.plan.cap_vertex().filter(|&beside| beside != vertex)
                    && !choice.plan.crosses(&other.plan)
                {
                    overlaps.insert(vertex, beside);
                    overlaps.insert(beside, vertex);
                }
            }
        }
        for choice in choices {
            if let Some(vertex) = choice.plan.cap_vertex().and_then(|vertex| overlaps.get(&vertex)) {
                choice.plan = Plan::Wait(Obstacle::Cap { vertex: *vertex, layer: 2 });
            }
        }
    }

    fn choice<'a>(
        &self,
        level: &Level,
        found: &'a Detection,
        lens: &'a Lens,
    ) -> Result<Choice<'a>, LensError> {
        let Options { method, averaging, .. } = *self.options;
        let vertex = lens.vertex;
        let polar = || {
            let pair = found.pairs.iter().find(|pair| pair.ends().contains(&vertex))?;
            Some((pair, pair.neighbourhood.as_ref()))
        };
        let alone = match lens.kind {
            LensKind::Ambiguous => "two partners are equally near",
            LensKind::Single | LensKind::Paired { .. } => "no partner",
        };
        let from_net = |plan: &dyn Fn(&'a LensNet) -> Plan<'a>| match &lens.net {
            Ok(net) => plan(net),
            Err(obstacle) => Plan::Wait(*obstacle),
        };
        let asked = || "asked for".to_owned();
        let (plan, reason) = match (method, polar()) {
            (Method::Auto, Some((pair, Ok(circles)))) if self.has_tangent_plane(level, pair, circles) => {
                (Plan::Polar(pair, circles), "circles go around the pair".to_owned())
            }
            (Method::Auto, polar) => {
                let why = match polar {
                    None => alone.to_owned(),
                    Some((_, Ok(_))) => "the middle of the pair has no tangent plane".to_owned(),
                    Some((_, Err(obstacle))) => {
                        format!("no circles go around the pair: {}", self.told(*obstacle))
                    }
                };
                (from_net(&|net| Plan::Remesh(net, Remesh::Merge(averaging))), why)
            }
            (Method::Polar, Some((pair, Ok(circles)))) => (Plan::Polar(pair, circles), asked()),
            (Method::Polar, Some((_, Err(obstacle)))) => (Plan::Wait(*obstacle), String::new()),
            (Method::Polar, None) => {
                return Err(LensError::NoPartner { vertex: self.first(vertex), why: alone });
            }
            _ => match (method.remesh(averaging), method.entry()) {
                (Some(how), _) => (from_net(&|net| Plan::Remesh(net, how)), asked()),
                (None, entry) => {
                    let entry = entry.unwrap_or(Entry::Refit);
                    (from_net(&|net| Plan::Rings(net, entry)), asked())
                }
            },
        };
        Ok(Choice { lens, plan, reason })
    }

    /// By vertex: true if a cap's joint with the cage depends on it.
    fn guarded(&self, level: &Level) -> Vec<bool> {
        let topology = level.topology();
        let mut guarded = vec![false; topology.vertex_count()];
        for v in self.work.caps.iter().flat_map(Cap::cage_vertices) {
            for h in topology.ring(v) {
                for side in topology.halfedges(topology.face(h)) {
                    guarded[topology.origin(side).index()] = true;
                }
            }
        }
        guarded
    }

    /// Re-meshes what can be; true if there was something.
    fn remesh(&mut self, choices: &[Choice<'_>]) -> Result<bool, LensError> {
        let (mut vertices, mut how) = (Vec::new(), None);
        for choice in choices {
            if let Plan::Remesh(_, plan) = choice.plan {
                vertices.push(choice.lens.vertex);
                how = Some(plan);
                let method = match plan {
                    Remesh::Identify => Method::Identify,
                    Remesh::RemoveCentre => Method::Remove,
                    Remesh::Merge(_) => Method::Merge,
                };
                self.note(choice.lens, method, &choice.reason);
            }
        }
        let Some(how) = how else { return Ok(false) };
        self.work.adopt(remesh(&self.work.mesh, &vertices, how)?);
        Ok(true)
    }

    /// Puts caps where they can be; true if there was a place.
    fn cap(&mut self, level: &Level, found: &Detection, choices: &[Choice<'_>]) -> Result<bool, LensError> {
        let mut site = Site::new(level);
        for choice in choices {
            match choice.plan {
                Plan::Rings(net, entry) if site.takes(&net.disk(level.topology())) => {
                    site.replace(
                        net.faces(level.topology(), 1),
                        net.faces(level.topology(), 2),
                        self.rings(level, net, entry),
                    );
                    let method = if entry == Entry::Refit { Method::C2 } else { Method::DegreeRaise };
                    self.note(choice.lens, method, &choice.reason);
                }
                // Of a pair the first lens brings the cap for both.
                Plan::Polar(pair, circles) if choice.lens.vertex == pair.ends()[0] => {
                    if !site.takes(&circles.disk) {
                        continue;
                    }
                    let (slit, circle) = (self.points(&pair.slit), self.points(&circles.circles[0]));
                    let cap = pair_pole(&slit, &circle)
                        .and_then(|pole| self.polar(level, circles, pole))
                        .map_err(|error| error.at(self.first(pair.slit[0])))?;
                    site.replace_disk(circles, cap);
                    for end in pair.ends() {
                        if let Some(lens) = found.lens(end) {
                            self.note(lens, Method::Polar, &choice.reason);
                        }
                    }
                }
                _ => {}
            }
        }
        // One refinement later a fan of triangles is none.
        let has_poles = self.work.steps == 0 && self.caps_poles();
        for pole in found.poles.iter().filter(|_| has_poles) {
            let Ok(circles) = &pole.neighbourhood else { continue };
            let net = PolarNet {
                pole: self.work.mesh.points[pole.vertex.index()],
                circles: circles.circles.iter().map(|circle| self.points(circle)).collect(),
            };
            let Ok(cap) = net.limit(RadialRule::default()).and_then(|pole| self.polar(level, circles, pole))
            else {
                continue;
            };
            if site.takes(&circles.disk) {
                site.replace_disk(circles, cap);
                let reason = "a fan of triangles inside circles of quads".to_owned();
                self.lenses.push(TreatedLens {
                    vertex: self.first(pole.vertex),
                    paired_with: None,
                    method: Method::Polar,
                    reason,
                });
            }
        }
        if site.caps.is_empty() {
            return Ok(false);
        }
        self.work.cut(&site.inside, &site.support, site.caps);
        self.covered.extend(site.covered);
        Ok(true)
    }

    fn caps_poles(&self) -> bool {
        matches!(self.options.method, Method::Auto | Method::Polar)
    }

    fn polar(
        &self,
        level: &Level,
        circles: &PolarNeighbourhood,
        pole: Vec3,
    ) -> Result<(Cap, Vec<Covered>), PolarError> {
        let points = circles.circles.each_ref().map(|circle| self.points(circle));
        let operator = PolarOperator::new(circles.columns(), self.options.variant)?;
        let cap = PolarCap::with(&operator, points.each_ref().map(Vec::as_slice), pole)?;
        let columns = circles.columns();
        let replaced =
            Grid::from_fn(2, columns, |row, x| self.work.addresses[circles.disk[row * columns + x].index()]);
        let faces = cap.faces(&circles.circles[1], &replaced, self.options.faces)?;
        Ok((faces, cover::by_polar_cap(circles, cap, level.topology(), &self.work.pieces)))
    }

    fn rings(&self, level: &Level, net: &LensNet, entry: Entry) -> (Cap, Vec<Covered>) {
        let points = net.vertices.map(|v| self.work.mesh.points[v.index()]);
        let site = CapSite::new(net, level.topology(), |face| self.work.addresses[face.index()]);
        let surface = Biquartic::from_bicubic(&points, entry);
        let cap = surface.cap(self.options.rings, &site);
        (cap, cover::by_rings(net, &surface, level.topology(), &self.work.pieces))
    }

    fn has_tangent_plane(&self, level: &Level, pair: &LensPair, circles: &PolarNeighbourhood) -> bool {
        let pole = pair_pole(&self.points(&pair.slit), &self.points(&circles.circles[0]));
        pole.is_ok_and(|pole| self.polar(level, circles, pole).is_ok())
    }

    fn points(&self, vertices: &[VertexId]) -> Vec<Vec3> {
        vertices.iter().map(|v| self.work.mesh.points[v.index()]).collect()
    }

    /// The vertex of the first cage that a vertex is. Lenses and poles are never new.
    fn first(&self, v: VertexId) -> VertexId {
        self.work.vertices[v.index()].map_or(v, VertexId)
    }

    fn note(&mut self, lens: &Lens, method: Method, reason: &str) {
        let paired_with = match lens.kind {
            LensKind::Paired { partner, .. } => Some(self.first(partner)),
            LensKind::Single | LensKind::Ambiguous => None,
        };
        let (vertex, reason) = (self.first(lens.vertex), reason.to_owned());
        self.lenses.push(TreatedLens { vertex, paired_with, method, reason });
    }

    fn leave_lenses(&mut self, found: &Detection) {
        for lens in &found.lenses {
            self.note(lens, Method::C1, "asked for");
        }
    }

    /// Notes the poles of the first cage that are as they were, and why.
    fn leave_poles(&mut self, found: &Detection) {
        for vertex in self.poles.take().unwrap_or_default() {
            if self.lenses.iter().any(|lens| lens.vertex == vertex) {
                continue;
            }
            let pole = found.poles.iter().find(|pole| self.first(pole.vertex) == vertex);
            let reason = match pole.map(|pole| &pole.neighbourhood) {
                _ if self.options.method == Method::C1 => "asked for".to_owned(),
                _ if !self.caps_poles() => format!("{} is for lenses alone", self.options.method.name()),
                Some(Ok(_)) => "no tangent plane at the pole, or another cap is in the way".to_owned(),
                Some(Err(obstacle)) => self.told(*obstacle).to_string(),
                None => "what was done beside it is in the way".to_owned(),
            };
            self.lenses.push(TreatedLens { vertex, paired_with: None, method: Method::C1, reason });
        }
    }

    /// True if refinement gets an obstacle out of the way.
    fn refining_helps(&self, level: &Level, obstacle: Obstacle) -> bool {
        let left = MOST_STEPS - self.work.steps;
        let fades = |sharpness: f64| sharpness.is_finite() && sharpness.ceil() <= f64::from(left);
        let topology = level.topology();
        let faded = match obstacle {
            Obstacle::SharpEdge { a, b, .. } => {
                let edge = topology.ring(a).find(|&h| topology.target(h) == b);
                edge.is_some_and(|h| fades(level.edge_sharpness(h)))
            }
            Obstacle::SharpVertex { vertex, .. } => fades(level.vertex_sharpness(vertex)),
            _ => false,
        };
        faded || obstacle.refinements().is_some_and(|steps| steps <= left)
    }

    /// The error that a lens of the cage as it is now cannot be treated.
    fn blocked(&self, vertex: VertexId, obstacle: Obstacle) -> LensError {
        LensError::Blocked {
            vertex: self.first(vertex),
            obstacle: self.told(obstacle),
            refinements: self.work.steps,
        }
    }

    /// An obstacle in the cage as it is now, in terms of the first one.
    fn told(&self, obstacle: Obstacle) -> Obstacle {
        let origins = &self.work.origins;
        let first_level = self.first_level.get_or_init(|| Level::new(self.mesh).ok()).as_ref();
        let is_hidden = |face| first_level.is_some_and(|level| !level.is_visible(face));
        let on_boundary = |vertex| {
            first_level.is_some_and(|level| matches!(level.topology().valence(vertex), Valence::Boundary(_)))
        };
        let first_face = |face: FaceId| self.work.addresses[face.index()].face;
        match obstacle {
            Obstacle::NotAQuad { face, layer } => Obstacle::NotAQuad { face: first_face(face), layer },
            Obstacle::Meeting { face, layer } => Obstacle::Meeting { face: first_face(face), layer },
            Obstacle::HiddenFace { face, layer } if is_hidden(first_face(face)) => {
                Obstacle::HiddenFace { face: first_face(face), layer }
            }
            Obstacle::HiddenFace { face, layer } => {
                let corner = self.work.mesh.faces.iter().nth(face.index()).map_or(0, |corners| corners[0]);
                Obstacle::Cap { vertex: origins.nearest(VertexId(corner)), layer }
            }
            Obstacle::Boundary { vertex, layer } => {
                let vertex = origins.nearest(vertex);
                if on_boundary(vertex) {
                    Obstacle::Boundary { vertex, layer }
                } else {
                    Obstacle::Cap { vertex, layer }
                }
            }
            Obstacle::OtherLens { vertex, layer } => {
                Obstacle::OtherLens { vertex: origins.nearest(vertex), layer }
            }
            Obstacle::Extraordinary { vertex, valence, layer } => {
                Obstacle::Extraordinary { vertex: origins.nearest(vertex), valence, layer }
            }
            Obstacle::SharpEdge { a, b, layer } => {
                let [a, b] = origins.edge(a, b).unwrap_or([a, b].map(|v| origins.nearest(v)));
                Obstacle::SharpEdge { a, b, layer }
            }
            Obstacle::SharpVertex { vertex, layer } => {
                Obstacle::SharpVertex { vertex: origins.nearest(vertex), layer }
            }
            Obstacle::Cap { vertex, layer } => Obstacle::Cap { vertex: origins.nearest(vertex), layer },
        }
    }

    fn finish(mut self, level: Level) -> Treated {
        self.lenses.sort_by_key(|lens| lens.vertex);
        let Rework { mesh, addresses, caps, edges, vertices, origins, steps, .. } = self.work;
        let edges = edges.into_iter().flatten().collect();
        let Treatment { covered, lenses, .. } = self;
        Treated { mesh, level, origins, caps, covered, steps, addresses, vertices, lenses, edges }
    }
}

/// What keeps a lens from being re-meshed: a cap hangs on a vertex that would move. Two lenses with regular nets have none of
/// these vertices in common.
fn in_the_way(net: &LensNet, guarded: &[bool]) -> Option<Obstacle> {
    let vertex = net.vertices[..5].iter().copied().find(|v| guarded[v.index()])?;
    Some(Obstacle::Cap { vertex, layer: 2 })
}

/// Where caps come to stand.
struct Site {
    taken: Vec<bool>,
    inside: Vec<FaceId>,
    support: Vec<FaceId>,
    caps: Vec<Cap>,
    covered: Vec<Covered>,
}

impl Site {
    fn new(level: &Level) -> Site {
        let taken = vec![false; level.topology().face_count()];
        Site { taken, inside: Vec::new(), support: Vec::new(), caps: Vec::new(), covered: Vec::new() }
    }

    /// Takes these faces, unless one of them is taken already.
    fn takes(&mut self, disk: &[FaceId]) -> bool {
        if disk.iter().any(|face| self.taken[face.index()]) {
            return false;
        }
        disk.iter().for_each(|face| self.taken[face.index()] = true);
        true
    }

    fn replace(&mut self, inside: Vec<FaceId>, support: Vec<FaceId>, (cap, covered): (Cap, Vec<Covered>)) {
        self.inside.extend(inside);
        self.support.extend(support);
        self.caps.push(cap);
        self.covered.extend(covered);
    }

    fn replace_disk(&mut self, circles: &PolarNeighbourhood, cap: (Cap, Vec<Covered>)) {
        let (inside, support) = circles.disk.split_at(circles.columns());
        self.replace(inside.to_vec(), support.to_vec(), cap);
    }
}
