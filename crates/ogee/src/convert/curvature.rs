//! Curvature-continuous parts: G2 caps around irregular vertices, bicubic faces elsewhere, each of the coarsest level that will
//! do.
//!
//! Where a vertex can have no cap its faces are smoothed by PCCM, which leaves their far sides as they are, and a note says so.

use std::collections::BTreeMap;

use super::cap_deviation::{self, Fan};
use super::part::{Node, NodeKind};
use super::source::Source;
use super::{ConvertError, DEEPEST_LEVEL, Options, Packing, PlacedChart};
use crate::g2_caps::{self, PlacedCap, Tiling, Uncapped};
use crate::math::{Grid, Vec3, par};
use crate::mesh::{FaceId, HalfedgeId, Note, VertexId};
use crate::nurbs::{KnotVector, NurbsSurface};
use crate::patch::{Adaptive, AdaptiveLevel, Neighbourhood, with_ring};
use crate::pccm::{self, Cells, Chart, CornerClass, Layer, Pieces, Placed, inserted, pack, unpacked, view};
use crate::rules::Level;

/// A cage in bicubic faces and caps.
pub(super) struct Curvature<'a> {
    source: &'a Source,
    tiling: Tiling,
    /// What takes the place of the faces around irregular vertices, caps first.
    fans: Vec<Fan>,
    nodes: Vec<Node>,
    broken: Vec<(usize, HalfedgeId)>,
    notes: Vec<Note>,
}

impl<'a> Curvature<'a> {
    /// Caps on the coarsest levels on which they are near enough to the limit surface.
    pub(super) fn new(source: &'a Source, options: &Options) -> Result<Curvature<'a>, ConvertError> {
        let least = options.level.unwrap_or(0);
        // By the number that a vertex keeps on all levels.
        let mut levels: BTreeMap<u32, u32> = BTreeMap::new();
        loop {
            let converted =
                Curvature::on_levels(source, |vertex| levels.get(&vertex).copied().unwrap_or(least))?;
            let Some(wanted) = options.max_deviation else { return Ok(converted) };
            let reached = converted.deviation();
            if reached < wanted {
                return Ok(converted);
            }
            for (fan, node) in converted.fans.iter().zip(&converted.nodes) {
                if node.deviation >= wanted {
                    let level = fan.level as u32;
                    if options.level.is_some() || level >= DEEPEST_LEVEL {
                        return Err(ConvertError::Deviation { wanted, reached, level });
                    }
                    levels.insert(fan.number, level + 1);
                }
            }
        }
    }

    fn on_levels(source: &'a Source, level_of: impl Fn(u32) -> u32) -> Result<Curvature<'a>, ConvertError> {
        let tiling = Tiling::new(&source.adaptive_cage(), level_of)?;
        let mut fans = par::map(tiling.caps.len(), |cap| capped(&tiling.adaptive, &tiling.caps[cap]));
        let mut broken = Vec::new();
        let mut notes = Vec::new();
        for number in 0..tiling.adaptive.levels().len() {
            let sectors: Vec<&Uncapped> =
                tiling.uncapped.iter().filter(|sector| sector.level == number).collect();
            let smoothed = Smoothed::new(&tiling.adaptive, number, &sectors)?;
            broken.extend(smoothed.broken.into_iter().map(|h| (number, h)));
            fans.extend(smoothed.fans);
            for sector in sectors {
                notes.push(source.no_cap(&tiling.adaptive, sector));
            }
        }
        let deviations = cap_deviation::of_fans(&tiling.adaptive, &fans);
        let kinds = tiling.caps.iter().map(|cap| NodeKind::Cap(cap.site.class));
        let kinds = kinds.chain(std::iter::repeat(NodeKind::Smoothed));
        let nodes = fans.iter().zip(kinds).zip(deviations).map(|((fan, kind), deviation)| Node {
            place: source.place(tiling.adaptive.origin(fan.number)),
            kind,
            level: fan.level as u32,
            deviation,
        });
        Ok(Curvature { source, nodes: nodes.collect(), fans, broken, notes, tiling })
    }

    pub(super) fn deviation(&self) -> f64 {
        self.nodes.iter().map(|node| node.deviation).fold(0.0, f64::max)
    }

    pub(super) fn adaptive(&self) -> &Adaptive {
        &self.tiling.adaptive
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
        let around = Around::new(level, faces);
        let hidden = (0..around.faces.len()).filter(|&own| faces.binary_search(&around.faces[own]).is_err());
        let base = around.level.clone().with_hidden(hidden.map(|own| FaceId(own as u32)).collect());
        let charts = match packing {
            Packing::Unpacked => unpacked(&base),
            Packing::Packed => {
                let seams = self.source.seams(&self.tiling.adaptive, number);
                let seams: Vec<HalfedgeId> = seams.iter().filter_map(|&h| around.own(level, h)).collect();
                pack(&base, &vec![[CornerClass::Regular; 4]; around.faces.len()], &seams)
            }
        };
        let cells = Cells::new(&base, &base, 0);
        let surfaces = par::map(charts.len(), |chart| bicubic(&cells, &charts[chart], &around.points));
        let placed = |(chart, surface): (Chart, NurbsSurface)| {
            let quads =
                chart.quads.map(|placed| Placed { quad: around.faces[placed.quad as usize].0, ..*placed });
            PlacedChart { level: number, chart: Chart { quads }, surface }
        };
        charts.into_iter().zip(surfaces).map(placed).collect()
    }
}

/// Some faces of a level with all that touch them.
struct Around {
    level: Level,
    points: Vec<Vec3>,
    /// For each of its faces that of the whole level, in order.
    faces: Vec<FaceId>,
}

impl Around {
    fn new(whole: &AdaptiveLevel, faces: &[FaceId]) -> Around {
        let faces = with_ring(&whole.level, faces);
        let part = Neighbourhood::new(&whole.level, &faces);
        Around { points: part.take(&whole.points), level: part.level, faces }
    }

    /// The halfedge for one of the whole level, or for its twin.
    fn own(&self, whole: &AdaptiveLevel, h: HalfedgeId) -> Option<HalfedgeId> {
        let topology = whole.level.topology();
        [Some(h), topology.twin(h)].into_iter().flatten().find_map(|h| {
            let face = topology.face(h);
            let own = self.faces.binary_search(&face).ok()?;
            Some(HalfedgeId(self.level.topology().first(FaceId(own as u32)).0 + h.0 - topology.first(face).0))
        })
    }

    fn whole(&self, whole: &AdaptiveLevel, own: HalfedgeId) -> HalfedgeId {
        let topology = self.level.topology();
        let face = topology.face(own);
        let first = whole.level.topology().first(self.faces[face.index()]);
        HalfedgeId(first.0 + own.0 - topology.first(face).0)
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
    fn new(adaptive: &Adaptive, number: usize, sectors: &[&Uncapped]) -> Result<Smoothed, ConvertError> {
        if sectors.is_empty() {
            return Ok(Smoothed::default());
        }
        let whole = &adaptive.levels()[number];
        let topology = whole.level.topology();
        let in_fans = sectors.iter().flat_map(|sector| &sector.halfedges).map(|&h| topology.face(h));
        let mut faces: Vec<FaceId> = in_fans.collect();
        faces.sort_unstable();
        let around = Around::new(whole, &faces);
        let layer = Layer::Second;
        let level = pccm::least_level(&around.level, layer)?.level;
        let options = pccm::Options { layer, level, ..pccm::Options::default() };
        let patches = pccm::to_patches(&around.level, &around.points, &options)?;
        let pieces = Pieces::new(&around.level, &around.points, &patches, layer);
        let own_topology = around.level.topology();
        let surface = |&h: &HalfedgeId| {
            let own = around.own(whole, h)?;
            let (quad, turn) = (own_topology.face(own).0, own.0 % 4);
            Some(pieces.surface(&Chart { quads: Grid::from_fn(1, 1, |_, _| Placed { quad, turn }) }))
        };
        let fan = |sector: &&Uncapped| Fan {
            level: number,
            number: whole.vertices[topology.origin(sector.halfedges[0]).index()],
            halfedges: sector.halfedges.clone(),
            closed: false,
            surfaces: sector.halfedges.iter().filter_map(surface).collect(),
        };
        let apexes: Vec<VertexId> =
            sectors.iter().map(|sector| topology.origin(sector.halfedges[0])).collect();
        let broken = patches.broken.iter().map(|&own| around.whole(whole, own));
        let broken = broken.filter(|&h| apexes.contains(&topology.origin(h)));
        Ok(Smoothed { fans: sectors.iter().map(fan).collect(), broken: broken.collect() })
    }
}
