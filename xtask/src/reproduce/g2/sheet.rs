//! Sheets: one fan or one cage by every method, in the same light and on the same scale of colours.

use anyhow::{Context, Result};
use ogee::convert::{self, Options, Packing, to_part};
use ogee::nurbs::{FaceAddress, NurbsSurface};
use ogee::pccm::{self, to_patches};
use ogee::quality::{LimitView, PatchView, PlaneLight, Surface};
use ogee::{ControlMesh, FaceId, Grid, Level, LimitSurface, PatchTable, Vec3};
use ogee_render::{Camera, Image, Pattern, Projection, Quantity, Sampling, Scene, Style, render};

use super::fan::Fan;
use super::surface::{Method, caps};
use crate::reproduce::lens::methods::collect;
use crate::reproduce::lens::sheet::{TILE, tiled};

/// Samples along each side of a pixel.
const SAMPLES: u32 = 3;

/// Halvings of the limit surface that are drawn.
const DRAWN: usize = 12;

/// What is seen: from where, how much of the model, and which lines.
pub(super) struct Look {
    pub(super) from: Vec3,
    pub(super) at: Vec3,
    pub(super) height: f64,
    pub(super) light: PlaneLight,
    /// From one line of light to the next.
    pub(super) period: f64,
    /// The mean curvature where colours end.
    pub(super) curvature: f64,
}

impl Look {
    fn styles(&self) -> [Style; 2] {
        let pattern = Pattern::Lines { period: self.period, width: 0.5, phase: 0.0 };
        let map = Style::Curvature { quantity: Quantity::Mean, limit: Some(self.curvature) };
        [Style::Highlight { light: self.light, pattern }, map]
    }

    fn scene(&self, style: Style) -> Result<Scene> {
        let eye =
            self.at + 100.0 * self.height * self.from.normalized().context("a direction to look from")?;
        let projection = Projection::Parallel { height: self.height };
        let camera = Camera { eye, at: self.at, up: Vec3::new(0.0, 0.0, 1.0), projection };
        Ok(Scene { camera, size: [TILE * SAMPLES; 2], style, sampling: Sampling::Exact })
    }
}

/// Lines of light above, mean curvature below; surfaces side by side.
fn sheet(look: &Look, surfaces: &[(String, &dyn Surface)]) -> Result<Image> {
    let mut tiles = Vec::new();
    for style in look.styles() {
        let scene = look.scene(style)?;
        for (number, (name, surface)) in surfaces.iter().enumerate() {
            let mut tile = render(*surface, &scene)?.reduced(SAMPLES).image();
            tile.add_caption(name);
            if number + 1 == surfaces.len() {
                tile.add_legend(&scene.style, look.curvature);
            }
            tiles.push(tile);
        }
    }
    Ok(tiled(&tiles, surfaces.len()))
}

/// A fan by all methods: only the faces at its vertex.
pub(super) fn fan_sheet(fan: &Fan, look: &Look) -> Result<Image> {
    let methods = [Method::Limit, Method::Pccm, Method::Cap(1), Method::Cap(0)];
    let views: Vec<(String, PatchView)> = methods
        .into_iter()
        .map(|method| Ok((method.name(), view(patches(fan, method)?)?)))
        .collect::<Result<_>>()?;
    let surfaces: Vec<(String, &dyn Surface)> =
        views.iter().map(|(name, view)| (name.clone(), view as &dyn Surface)).collect();
    sheet(look, &surfaces)
}

fn view(patches: Vec<NurbsSurface>) -> Result<PatchView> {
    let address = FaceAddress::whole(FaceId(0));
    let patches = patches.into_iter().map(|patch| (patch, Grid::from_fn(1, 1, |_, _| address)));
    Ok(PatchView::new(patches.collect())?)
}

/// The surface over the faces at the vertex as patches.
fn patches(fan: &Fan, method: Method) -> Result<Vec<NurbsSurface>> {
    let limit = |steps: usize| -> Result<Vec<NurbsSurface>> {
        let level = Level::new(&fan.mesh)?;
        let table = PatchTable::new(&level);
        let surface = LimitSurface::new(&table, &fan.mesh.points);
        let mut patches = Vec::new();
        for face in 0..fan.valence {
            collect(&surface.face_piece(face, 0.25_f64.powi(steps as i32)), steps, &mut patches);
        }
        Ok(patches)
    };
    match method {
        Method::Limit => limit(DRAWN),
        Method::Pccm => {
            let patches = to_patches(&Level::new(&fan.mesh)?, &fan.mesh.points, &pccm::Options::default())?;
            let own = patches.nets.into_iter().take(fan.valence);
            let surface = |net| NurbsSurface { u: patches.knots.clone(), v: patches.knots.clone(), net };
            Ok(own.map(surface).collect())
        }
        Method::Cap(0) => caps(fan, 0),
        Method::Cap(level) => Ok([limit(level as usize)?, caps(fan, level)?].concat()),
    }
}

/// A closed cage as its limit and as parts.
pub(super) fn cage_sheet(mesh: &ControlMesh, look: &Look) -> Result<Image> {
    let level = Level::new(mesh)?;
    let table = PatchTable::new(&level);
    let limit = LimitSurface::new(&table, &mesh.points);
    let limit = LimitView::new(&level, &limit);
    let part = |method| -> Result<PatchView> {
        let part = to_part(mesh, &Options { method, packing: Packing::Unpacked, ..Options::default() })?;
        let faces = part.bodies.iter().flat_map(|body| body.shells()).flat_map(|shell| &shell.faces);
        Ok(PatchView::new(faces.map(|face| (face.surface.clone(), face.quads.clone())).collect())?)
    };
    let (pccm, g2) = (part(convert::Method::Pccm)?, part(convert::Method::G2)?);
    let surfaces: [(String, &dyn Surface); 3] =
        [("limit".to_owned(), &limit), ("PCCM".to_owned(), &pccm), ("G2 caps".to_owned(), &g2)];
    sheet(look, &surfaces)
}
