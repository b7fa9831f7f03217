//! Curvature-continuous parts: G2 caps around irregular vertices, bicubic faces elsewhere, each of the coarsest level that will
//! do.
//!
//! Where a vertex can have no cap its faces are smoothed by PCCM, which leaves their far sides as they are, and a note says so.

use std::collections::{BTreeMap, BTreeSet};

use super::cap_deviation::{self, Fan};
use super::part::{LevelFaces, Node, NodeKind};
use super::regularity::Regularity;
use super::source::{Source, told};
use super::{ConvertError, DEEPEST_LEVEL, Options, Packing, PlacedChart};
use crate::g2_caps::{self, PlacedCap, Tiling, Uncapped};
use crate::math::{Grid, Vec3, par};
use crate::mesh::{FaceId, HalfedgeId, Note, VertexId};
use crate::nurbs::{KnotVector, NurbsSurface};
use crate::patch::Adaptive;
use crate::pccm::{self, Cells, Chart, CornerClass, Layer, Placed, inserted, pack, unpacked, view};

/// Length of `du x dv`, relative to the greatest of a cap, below which a cap counts as folded.
const NEARLY_SINGULAR: f64 = 1e-3;

/// A cage in bicubic faces and caps.
pub(super) struct Curvature<'a> {
    source: &'a Source,
    tiling: Tiling,
    /// What takes the place of the faces around irregular vertices, caps first.
    fans: Vec<Fan>,
    nodes: Vec<Node>,
    broken: Vec<(usize, HalfedgeId)>,
    notes: Vec<Note>,
    memory: u64,
}

impl<'a> Curvature<'a> {
    /// Caps on the coarsest levels on which they are near enough to the limit surface.
    pub(super) fn new(source: &'a Source, options: &Options) -> Result<Curvature<'a>, ConvertError> {
        // What has no patch has no cap either.
        pccm::plan(source.cage(), Layer::Second, None).map_err(|error| told(error, &source.origins))?;
        let least = options.level.unwrap_or(0);
        // By the number that a vertex keeps on all levels.
        let mut levels: BTreeMap<u32, u32> = BTreeMap::new();
        loop {
            let level_of = |vertex: u32| levels.get(&vertex).copied().unwrap_or(least);
            let converted = Curvature::on_levels(source, level_of, options.memory)?;
            let Some(wanted) = options.max_deviation else { return Ok(converted) };
            let reached = converted.deviation();
            if reached < wanted {
                return Ok(converted);
            }
            let mut raised = false;
            for (fan, node) in converted.fans.iter().zip(&converted.nodes) {
                if node.deviation >= wanted {
                    let level = fan.level as u32;
                    if options.level.is_some() || level >= DEEPEST_LEVEL {
                        return Err(ConvertError::Deviation { wanted, reached, level });
                    }
                    levels.insert(fan.number, level + 1);
                    raised = true;
                }
            }
            if !raised {
                // Where nothing deviates a tolerance that is none cannot be met either.
                return Err(ConvertError::Deviation { wanted, reached, level: least });
            }
        }
    }

    fn on_levels(
        source: &'a Source,
        level_of: impl Fn(u32) -> u32,
        memory: Option<u64>,
    ) -> Result<Curvature<'a>, ConvertError> {
        let tiling =
            Tiling::new(&source.adaptive, level_of).map_err(|face| ConvertError::Irregular { face })?;
        let memory = check_memory(&tiling, memory)?;
        let mut fans = par::map(tiling.caps.len(), |cap| capped(&tiling.adaptive, &tiling.caps[cap]));
        let mut broken = Vec::new();
        let mut notes = Vec::new();
        for number in 0..tiling.adaptive.levels().len() {
            let sectors: Vec<&Uncapped> =
                tiling.uncapped.iter().filter(|sector| sector.level == number).collect();
            let smoothed = Smoothed::new(&tiling.adaptive, number, &sectors);
            broken.extend(smoothed.broken.into_iter().map(|h| (number, h)));
            fans.extend(smoothed.fans);
            for sector in sectors {
                notes.push(source.no_cap(&tiling.adaptive, sector));
            }
        }
        let deviations = cap_deviation::of_fans(&tiling.adaptive, &fans);
        let kinds = tiling.caps.iter().map(|cap| NodeKind::Cap(cap.site.class));
        let kinds = kinds.chain(std::iter::repeat(NodeKind::Smoothed));
        let regularity = par::map(tiling.caps.len(), |cap| Regularity::of(&fans[cap]));
        let mut nodes = Vec::with_capacity(fans.len());
        for (number, ((fan, kind), deviation)) in fans.iter().zip(kinds).zip(deviations).enumerate() {
            let place = source.place(tiling.adaptive.origin(fan.number));
            let regularity = regularity.get(number);
            if regularity.is_some_and(|found| found.folded || found.least < NEARLY_SINGULAR) {
                let message = format!(
                    "the cap around {place} folds or nearly does, as the cage does there: its normals agree, but solids with it may be refused; straighten the cage"
                );
                notes.push(Note { code: "folded_cap", message, place: Some(place) });
            }
            let (level, regularity) = (fan.level as u32, regularity.map(|found| found.least));
            nodes.push(Node { place, kind, level, deviation, regularity });
        }
        Ok(Curvature { source, nodes, fans, broken, notes, tiling, memory })
    }

    /// How many faces are of which level.
    pub(super) fn faces_by_level(&self) -> Vec<LevelFaces> {
        let adaptive = &self.tiling.adaptive;
        let levels = self.tiling.regular.iter().enumerate().map(|(number, regular)| {
            let fans = self.fans.iter().filter(|fan| fan.level == number);
            let faces = regular.len() + fans.map(|fan| fan.visible(adaptive).count()).sum::<usize>();
            LevelFaces { steps: number as u32, level: 0, faces }
        });
        levels.filter(|level| level.faces > 0).collect()
    }

    pub(super) fn deviation(&self) -> f64 {
        self.nodes.iter().map(|node| node.deviation).fold(0.0, f64::max)
    }

    pub(super) fn adaptive(&self) -> &Adaptive {
        &self.tiling.adaptive
    }

    pub(super) fn memory(&self) -> u64 {
        self.memory
    }

    pub(super) fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    pub(super) fn broken(&self) -> Vec<(usize, HalfedgeId)> {
        self.broken.clone()
    }

    pub(super) fn notes(&self) -> Vec<Note> {
        self.notes.clone()
    }

    /// By level, in the order of faces.
    pub(super) fn charts(&self, packing: Packing) -> Vec<PlacedChart> {
        let mut charts = Vec::new();
        for number in 0..self.tiling.adaptive.levels().len() {
            let mut own = self.regular_charts(number, packing);
            for fan in self.fans.iter().filter(|fan| fan.level == number) {
                own.extend(fan.charts(&self.tiling.adaptive));
            }
            own.sort_by_key(|placed| placed.chart.quads[(0, 0)].quad);
            charts.extend(own);
        }
        charts
    }

    fn regular_charts(&self, number: usize, packing: Packing) -> Vec<PlacedChart> {
        let level = &self.tiling.adaptive.levels()[number];
        let faces = &self.tiling.regular[number];
        if faces.is_empty() {
            return Vec::new();
        }
        let part = pccm::Part::new(&level.level, 0, faces);
        let (base, points) = (part.base(), part.points(&level.points));
        let charts = match packing {
            Packing::Unpacked => unpacked(base),
            Packing::Packed => {
                let seams = self.source.seams(&self.tiling.adaptive, number);
                let seams: Vec<HalfedgeId> = seams.into_iter().flat_map(|h| part.along(h)).collect();
                pack(base, &vec![[CornerClass::Regular; 4]; base.topology().face_count()], &seams)
            }
        };
        let cells = Cells::new(base, base, 0);
        let surfaces = par::map(charts.len(), |chart| bicubic(&cells, &charts[chart], &points));
        let placed = |(chart, surface): (Chart, NurbsSurface)| {
            let own = |placed: &Placed| Placed { quad: part.face(FaceId(placed.quad)).0, ..*placed };
            PlacedChart { level: number, chart: Chart { quads: chart.quads.map(own) }, surface }
        };
        charts.into_iter().zip(surfaces).map(placed).collect()
    }
}

/// A sector of a cap: its coefficients in some copies, and the refined mesh that it is measured against.
const BYTES_PER_SECTOR: u64 = 50_000;

/// A regular face, in the same copies.
const BYTES_PER_REGULAR: u64 = 4_000;

/// Asks whether all that is to be made of a tiling fits.
fn check_memory(tiling: &Tiling, allowed: Option<u64>) -> Result<u64, ConvertError> {
    let capped = tiling.caps.iter().map(|cap| cap.site.halfedges.len());
    let smoothed = tiling.uncapped.iter().map(|sector| sector.halfedges.len());
    let sectors = capped.chain(smoothed).sum::<usize>() as u64;
    let regular = tiling.regular.iter().map(Vec::len).sum::<usize>() as u64;
    let bytes = sectors * BYTES_PER_SECTOR + regular * BYTES_PER_REGULAR;
    match allowed {
        Some(allowed) if bytes > allowed => {
            Err(ConvertError::Memory { patches: sectors + regular, bytes, allowed })
        }
        _ => Ok(bytes),
    }
}

/// The surface of a chart of regular quads.
fn bicubic(cells: &Cells<'_>, chart: &Chart, points: &[Vec3]) -> NurbsSurface {
    let (width, height) = (chart.quads.rows(), chart.quads.cols());
    let nets = chart.quads.map(|placed| cells.layered_net(placed.quad, points));
    let net = Grid::from_fn(width + 3, height + 3, |i, j| {
        // Any quad whose net has the node; the nearest one has it at a node of its own.
        let (x, y) = (i.saturating_sub(1).min(width - 1), j.saturating_sub(1).min(height - 1));
        nets[(x, y)][view(chart.quads[(x, y)].turn as usize, i - x, j - y, 3)]
    });
    let knots = |count: usize| {
        let inner = (1..count).map(|knot| (knot as f64, 1));
        KnotVector::from_multiplicities(3, std::iter::once((0.0, 4)).chain(inner).chain([(count as f64, 4)]))
    };
    let (u, v) = (knots(width), knots(height));
    NurbsSurface { net: inserted(&u, &v, &net), u, v }
}

/// The surfaces of a cap.
fn capped(adaptive: &Adaptive, cap: &PlacedCap) -> Fan {
    let level = &adaptive.levels()[cap.level];
    let points = g2_caps::cap_points(&level.level, &level.points, &cap.site);
    let knots = g2_caps::knots();
    let surface = |net| NurbsSurface { u: knots.clone(), v: knots.clone(), net };
    let nets = g2_caps::weights(cap.site.class).map(|weights| g2_caps::nets(&weights, &points));
    Fan {
        level: cap.level,
        number: level.vertices[cap.vertex.index()],
        halfedges: cap.site.halfedges.clone(),
        closed: cap.site.class.is_closed(),
        surfaces: nets.into_iter().flatten().map(surface).collect(),
    }
}

/// Sectors of a level without caps, smoothed by PCCM.
#[derive(Default)]
struct Smoothed {
    fans: Vec<Fan>,
    broken: Vec<HalfedgeId>,
}

impl Smoothed {
    fn new(adaptive: &Adaptive, number: usize, sectors: &[&Uncapped]) -> Smoothed {
        if sectors.is_empty() {
            return Smoothed::default();
        }
        let whole = &adaptive.levels()[number];
        let topology = whole.level.topology();
        let in_fans = sectors.iter().flat_map(|sector| &sector.halfedges).map(|&h| topology.face(h));
        let mut faces: Vec<FaceId> = in_fans.collect();
        faces.sort_unstable();
        let part = pccm::Part::new(&whole.level, 0, &faces);
        let patches = pccm::Converted::new(part, &whole.points, &pccm::Options::default());
        let halfedges: Vec<HalfedgeId> =
            sectors.iter().flat_map(|sector| sector.halfedges.iter().copied()).collect();
        let mut surfaces = patches.seen_from(&halfedges).into_iter();
        let fan = |sector: &&Uncapped| Fan {
            level: number,
            number: whole.vertices[topology.origin(sector.halfedges[0]).index()],
            halfedges: sector.halfedges.clone(),
            closed: false,
            surfaces: surfaces.by_ref().take(sector.halfedges.len()).collect(),
        };
        let apexes: BTreeSet<VertexId> =
            sectors.iter().map(|sector| topology.origin(sector.halfedges[0])).collect();
        let broken = patches.broken().into_iter().filter(|&h| apexes.contains(&topology.origin(h)));
        Smoothed { fans: sectors.iter().map(fan).collect(), broken: broken.collect() }
    }
}
