//! G2 caps: their figures made again, and beside them those that stood when the method was worked out.

mod cages;
mod distance_table;
mod fan;
mod shape_table;
mod shapes;
mod sheet;
mod solid_table;
mod surface;

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::Result;
use ogee::Vec3;
use ogee::quality::PlaneLight;
use ogee_render::Image;

use fan::Fan;
use shapes::Shape;
use sheet::{Look, cage_sheet, fan_sheet};

/// Makes the figures and the page.
pub(crate) fn write(root: &Path) -> Result<Vec<String>> {
    let folder = root.join("docs/reproduce/g2-caps");
    fs::create_dir_all(&folder)?;
    let mut page = Page { folder, text: INTRODUCTION.to_owned(), log: Vec::new() };
    page.text += SOLIDS;
    writeln!(page.text, "{}", solid_table::table()?)?;
    // Each with the share of its cage's diagonal that fills a picture.
    let shown = [("corner of 7 cells", 0.98), ("jack of 7 cells", 0.7)];
    let cages = cages::cages();
    for (cage, share) in shown
        .into_iter()
        .filter_map(|(name, share)| Some((cages.iter().find(|cage| cage.name == name)?, share)))
    {
        let [least, greatest] = bounds(&cage.mesh.points);
        let size = least.distance(greatest);
        let from = Vec3::new(0.64, 0.5, 0.58);
        let look = Look {
            from,
            // Room for the legend below.
            at: 0.5 * (least + greatest) - Vec3::new(0.0, 0.0, 0.08 * size),
            height: share * size,
            light: lamps(0.5 * (least + greatest), from, size),
            period: size / 6.0,
            curvature: 6.0 / size,
        };
        let file = format!("{}.png", cage.name.replace(' ', "-"));
        let caption = format!("Highlight lines and mean curvature of the {} by each method", cage.name);
        page.shown(&file, &cage_sheet(&cage.mesh, &look)?, &caption)?;
    }
    page.text += SHAPE;
    for shape in Shape::ALL {
        writeln!(page.text, "- {}", shape.name())?;
    }
    writeln!(page.text, "\n{}", shape_table::table()?)?;
    page.text += EXAMPLE;
    writeln!(page.text, "{}", shape_table::example()?)?;
    for (valence, limit) in [(5, 0.3), (8, 0.5)] {
        let saddle = Fan::new(valence, |x, y| 0.3 * (x * x - y * y));
        let look = Look {
            from: Vec3::new(0.2, -0.6, 0.8),
            // Room for the legend below.
            at: Vec3::new(0.0, -0.25, 0.0),
            height: 3.3,
            light: ceiling(4.0, Vec3::new(0.8, 0.6, 0.0)),
            period: 0.35,
            curvature: limit,
        };
        let caption =
            format!("Highlight lines and mean curvature of the saddle at valence {valence} by each method");
        page.shown(&format!("saddle-{valence}.png"), &fan_sheet(&saddle, &look)?, &caption)?;
    }
    page.text += DISTANCE;
    writeln!(page.text, "{}", distance_table::table()?)?;
    page.text += DISTANCE_OF_SOLIDS;
    writeln!(page.text, "{}", distance_table::solids()?)?;
    let path = root.join("docs/reproduce/g2-caps.md");
    fs::write(&path, page.text.trim_end().to_owned() + "\n")?;
    page.log.push(path.display().to_string());
    Ok(page.log)
}

const INTRODUCTION: &str = "\
# G2 caps, measured

Made by `cargo xtask reproduce g2`. The construction is on [its page](../methods/g2_caps.md). \"First\" are the figures that stood when it was
worked out, before this library had it, by a program of its own; \"apart\" is the share by which one differs.

";

const SOLIDS: &str = "\
## Solids

Closed cages as solids, by the report of the conversion: faces and how many of them are sectors of caps, the largest angle
between normals over an edge, and the largest jump of normal curvature across an edge times the diagonal of the cage. First angles and jumps are
those that a CAD program found in the written file, at nine points an edge: like those measured here they are rounding, so only their order
says anything. The cages are ours; of the first ones the kind is known, and the shape of most is not.

";

const SHAPE: &str = "\
## Shape

How far curvature ranges over the faces at a vertex of valence n: greatest less least of mean and of Gauss curvature, divided by the same of the
cap of level 0. Geometric means over eight shapes, and in brackets the greatest share of mean curvature. The net is the natural
configuration, edges at the vertex of length one, with the heights of

";

const EXAMPLE: &str = "\
The limit surface is measured down to a 32nd of the faces: from valence 5 on its curvature has no bound. Of the first shapes only the kinds are known. Heights
were chosen among a few of each kind so that the rows of the limit surface come near the first ones; these are a fit, then, and those of
PCCM and of the cap of level 1, which were not looked at, are not.

The range of mean curvature on the saddle 0.3 (x^2 - y^2) at valence 8; the first figure of the limit is that of one halving more:

";

const DISTANCE: &str = "\
## Distance from the limit

The largest distance of a cap from the limit surface on the saddle 0.3 (x^2 - y^2), edges at the vertex of length one, by level:

";

const DISTANCE_OF_SOLIDS: &str = "\
Of the closed cages above, as a share of the diagonal; most caps are of level 1, the corner has one of level 0:

";

/// Lamps that face what is seen from a direction, by its size away.
fn lamps(middle: Vec3, from: Vec3, size: f64) -> PlaneLight {
    let from = from.normalized().unwrap_or_default();
    let right = Vec3::new(0.0, 0.0, 1.0).cross(from).normalized().unwrap_or_default();
    PlaneLight { centre: middle + size * from, axes: [right, from.cross(right)], half: [f64::INFINITY; 2] }
}

fn ceiling(height: f64, across: Vec3) -> PlaneLight {
    let axes = [across, Vec3::new(-across.y, across.x, 0.0)];
    PlaneLight { centre: Vec3::new(0.0, 0.0, height), axes, half: [f64::INFINITY; 2] }
}

fn bounds(points: &[Vec3]) -> [Vec3; 2] {
    let first = points.first().copied().unwrap_or_default();
    points.iter().fold([first; 2], |[least, greatest], &point| [least.min(point), greatest.max(point)])
}

/// The page in the making.
struct Page {
    folder: PathBuf,
    text: String,
    log: Vec<String>,
}

impl Page {
    fn shown(&mut self, file: &str, image: &Image, caption: &str) -> Result<()> {
        let path = self.folder.join(file);
        let mut bytes = Vec::new();
        image.write_png(&mut bytes)?;
        fs::write(&path, bytes)?;
        write!(self.text, "![{caption}](g2-caps/{file})\n\n*{caption}.*\n\n")?;
        self.log.push(path.display().to_string());
        Ok(())
    }
}
