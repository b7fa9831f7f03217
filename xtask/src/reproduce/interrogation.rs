//! Yasui and Kanai, Surface Quality Assessment of Subdivision Surfaces on Programmable Graphics Hardware: figures 6 to 9,
//! the experiment behind figures 7 and 8 in numbers, and tables 1 and 2, which `timing` makes.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::Result;
use ogee::quality::{LimitView, PlaneLight, Surface, bounding_box};
use ogee::{ControlMesh, FaceList, Level, LimitSurface, PatchTable, Vec3, shapes};
use ogee_render::{Camera, Image, Pattern, Sampling, Scene, Style, default_light, displacement, render};

use super::timing;
use crate::bench::report::Table;

/// Samples along each side of a pixel of a figure.
const SAMPLES: u32 = 2;

/// Makes the figures and the page.
pub(crate) fn write(root: &Path) -> Result<Vec<String>> {
    let folder = root.join("docs/reproduce/interrogation");
    fs::create_dir_all(&folder)?;
    let mut page = Page { folder, text: String::new(), log: Vec::new() };
    page.text += INTRODUCTION;
    let body = shapes::body();
    with_surface(&body, |surface| figures(&mut page, surface))?;
    let large = refined(&body, 2)?;
    with_surface(&large, |surface| figure_9(&mut page, surface))?;
    with_surface(&body, |surface| experiment(&mut page, surface))?;
    with_surface(&body, |surface| {
        page.log.extend(timing::tables(&mut page.text, surface)?);
        Ok(())
    })?;
    let path = root.join("docs/reproduce/interrogation.md");
    fs::write(&path, &page.text)?;
    page.log.push(path.display().to_string());
    Ok(page.log)
}

const INTRODUCTION: &str = "\
# Reflection lines on programmable graphics hardware

Figures 6 to 9 and tables 1 and 2 of Y. Yasui and T. Kanai, *Surface Quality Assessment of Subdivision Surfaces on
Programmable Graphics Hardware* (2004), made again by `cargo xtask-gpu reproduce interrogation`. The method is on
[its page](../methods/reflection_lines.md).

The paper's models are not published. Its place is taken by `ogee::shapes::body`: 124 quads, valences 3, 4 and 5, 8 long, 4 wide and 2
high. The light plane lies half a diagonal above it. \"Polygon\" is what is seen elsewhere: the cage refined some levels, vertices moved to the limit,
positions and limit normals interpolated between them. \"Surface\" is the limit surface itself at every pixel.

";

struct Page {
    folder: PathBuf,
    text: String,
    log: Vec<String>,
}

impl Page {
    /// Draws a scene into a file, and shows it on the page.
    fn picture(&mut self, surface: &dyn Surface, name: &str, scene: &Scene, caption: &str) -> Result<()> {
        let path = self.folder.join(format!("{name}.png"));
        save(&drawn(surface, scene)?, &path)?;
        write!(self.text, "![{caption}](interrogation/{name}.png)\n\n*{caption}*\n\n")?;
        self.log.push(path.display().to_string());
        Ok(())
    }
}

fn drawn(surface: &dyn Surface, scene: &Scene) -> Result<Image> {
    let large = Scene { size: scene.size.map(|side| side * SAMPLES), ..scene.clone() };
    let picture = render(surface, &large)?;
    let mut image = picture.reduced(SAMPLES).image();
    if let Some(limit) = picture.limit {
        image.add_legend(&scene.style, limit);
    }
    Ok(image)
}

fn save(image: &Image, path: &Path) -> Result<()> {
    let mut bytes = Vec::new();
    image.write_png(&mut bytes)?;
    Ok(fs::write(path, bytes)?)
}

fn with_surface<T>(mesh: &ControlMesh, look: impl FnOnce(&LimitView<'_>) -> Result<T>) -> Result<T> {
    let level = Level::new(mesh)?;
    let table = PatchTable::new(&level);
    let surface = LimitSurface::new(&table, &mesh.points);
    look(&LimitView::new(&level, &surface))
}

/// The cage after some steps, as a cage.
fn refined(mesh: &ControlMesh, steps: u32) -> Result<ControlMesh> {
    let mut level = Level::new(mesh)?;
    let mut points = mesh.points.clone();
    for _ in 0..steps {
        (level, points) = level.refine_points(&points);
    }
    let topology = level.topology();
    let mut faces = FaceList::new();
    for face in (0..topology.face_count() as u32).map(ogee::FaceId) {
        let corners: Vec<u32> = topology.halfedges(face).map(|h| topology.origin(h).0).collect();
        faces.push(&corners);
    }
    Ok(ControlMesh::new(points, faces))
}

/// The whole body, and its bonnet four times as near.
fn cameras(surface: &dyn Surface, size: [u32; 2]) -> [(&'static str, Camera); 2] {
    let whole = Camera::fit(bounding_box(surface).unwrap_or_default(), size);
    let at = Vec3::new(-2.4, 0.3, 1.0);
    let close = Camera { eye: at + 0.25 * (whole.eye - whole.at), at, ..whole };
    [("whole", whole), ("close-up", close)]
}

fn light(surface: &dyn Surface) -> (PlaneLight, f64) {
    let [lower, upper] = bounding_box(surface).unwrap_or_default();
    (default_light([lower, upper]), upper.distance(lower) / 15.0)
}

fn stripes(light: PlaneLight, period: f64) -> Style {
    Style::Reflection { light, pattern: Pattern::Lines { period, width: 0.3, phase: 0.0 } }
}

fn figures(page: &mut Page, surface: &dyn Surface) -> Result<()> {
    let size = [560, 400];
    let (light, period) = light(surface);
    let [(_, whole), (_, close)] = cameras(surface, size);
    let exact = |camera: Camera, style: Style| Scene { camera, size, style, sampling: Sampling::Exact };
    page.text += "## Figure 6: other patterns\n\n";
    let lattice = Style::Reflection { light, pattern: Pattern::Lattice { period: 1.5 * period, width: 0.1 } };
    page.picture(surface, "figure-6a", &exact(whole, lattice), "Latticed reflection lines")?;
    let circles =
        Style::Reflection { light, pattern: Pattern::Circles { period: 1.5 * period, radius: 0.3 } };
    page.picture(
        surface,
        "figure-6b",
        &exact(whole, circles),
        "Circles: each is seen as about an ellipse along the principal directions",
    )?;
    for (number, camera, what) in [(7, whole, "the whole body"), (8, close, "its bonnet")] {
        writeln!(page.text, "## Figure {number}: {what}\n")?;
        for level in 1..=3 {
            let scene = Scene { sampling: Sampling::Polygon(level), ..exact(camera, stripes(light, period)) };
            let caption = format!("Polygon of level {level}");
            page.picture(surface, &format!("figure-{number}-polygon-{level}"), &scene, &caption)?;
        }
        let scene = exact(camera, stripes(light, period));
        page.picture(surface, &format!("figure-{number}-surface"), &scene, "The surface at every pixel")?;
    }
    // For the front page: lines of a mesh beside those of the surface.
    let both = [Sampling::Polygon(1), Sampling::Exact]
        .map(|sampling| drawn(surface, &Scene { sampling, ..exact(whole, stripes(light, period)) }));
    let [mesh, surface_itself] = both;
    let path = page.folder.join("../../figures/lines.png");
    save(&mesh?.beside(&surface_itself?), &path)?;
    page.log.push(path.display().to_string());
    let error = exact(whole, Style::Error { light, level: 2 });
    page.text += "Where the lines of the polygon of level 2 are off, and by how many pixels:\n\n";
    page.picture(surface, "figure-7-error", &error, "Displacement of the polygon's lines")
}

fn figure_9(page: &mut Page, surface: &dyn Surface) -> Result<()> {
    let size = [800, 500];
    let (light, period) = light(surface);
    let [(_, camera), _] = cameras(surface, size);
    let faces = surface.layout().squares().len();
    writeln!(page.text, "## Figure 9: a large body, {faces} faces\n")?;
    let scene = Scene { camera, size, style: stripes(light, period), sampling: Sampling::Exact };
    page.picture(surface, "figure-9", &scene, "The body refined twice, its points taken for a cage")
}

/// The experiment behind figures 7 and 8.
fn experiment(page: &mut Page, surface: &dyn Surface) -> Result<()> {
    let size = [560, 400];
    let (light, _) = light(surface);
    page.text += "## The experiment in numbers\n\n\
        Displacement of the lines in pixels: median / 95 % / 99 % of the visible pixels whose view is not steeper than a cosine of 0.2, 560 x 400. \"Parameters\" \
        is the surface at the parameters that the polygon has in the pixel; the parameter offset is how far that point is from its pixel, and Newton's method, one and two steps, \
        takes it away. What is gained by exact points depends on what is looked at: least on nearly flat regions seen from very near, where a ratio of 3.5 was seen.\n\n";
    let columns = [
        "view",
        "level",
        "polygon",
        "parameters",
        "ratio of medians",
        "parameter offset",
        "after Newton (medians)",
    ];
    let mut table = Table::new(&columns);
    for (name, camera) in cameras(surface, size) {
        for level in 1..=3 {
            let d = displacement(surface, &camera, size, &light, level)?;
            let spread = |s: ogee_render::Spread| format!("{:.3} / {:.2} / {:.2}", s.median, s.p95, s.p99);
            table.row(&[
                name.to_owned(),
                level.to_string(),
                spread(d.polygon),
                spread(d.parameters),
                format!("{:.1}", d.polygon.median / d.parameters.median),
                spread(d.offset),
                format!("{:.0e}, {:.0e}", d.newton[0], d.newton[1]),
            ]);
        }
    }
    writeln!(page.text, "{table}")?;
    Ok(())
}

/// A view in which the surface covers all pixels.
pub(super) fn covering(surface: &dyn Surface, side: u32) -> Scene {
    let (light, period) = light(surface);
    let size = [side, side];
    let [_, (_, close)] = cameras(surface, size);
    // Straight onto the bonnet and the cabin.
    let at = Vec3::new(0.0, 0.0, 1.0);
    let camera = Camera { eye: Vec3::new(-0.6, -0.4, 6.4), at, up: Vec3::new(0.0, 1.0, 0.0), ..close };
    Scene { camera, size, style: stripes(light, period), sampling: Sampling::Exact }
}
