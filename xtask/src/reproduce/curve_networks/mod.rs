//! A. Abbas and A. Nasri, Interpolating multiple intersecting curves using Catmull-Clark subdivision surfaces (2004), and their
//! generalised scheme: the figures, and the eigen-analysis that was left as further work.

mod body;
mod convergence;
mod eigenvalues;
mod examples;
mod forms;
mod maps;
mod picture;
mod polyhedron;
mod settling;

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::Result;
use ogee_render::Image;

use examples::{Example, figures};
use picture::{Drawing, pair};

/// Makes the figures and the page.
pub(crate) fn write(root: &Path) -> Result<Vec<String>> {
    let folder = root.join("docs/reproduce/curve-networks");
    fs::create_dir_all(&folder)?;
    let mut page = Page { folder, text: String::new(), log: Vec::new() };
    page.text += INTRODUCTION;
    page.text += ONE_POINT;
    for example in examples::through_one_point()? {
        page.example(&example)?;
    }
    page.text += "## On closed surfaces\n\n";
    for example in examples::on_closed_surfaces()? {
        page.example(&example)?;
    }
    page.text += "## Tangents in no plane, two meeting points, an end inside\n\n";
    for example in examples::other_networks()? {
        page.example(&example)?;
    }
    repair(&mut page)?;
    forms(&mut page)?;
    eigenvalues(&mut page)?;
    maps(&mut page)?;
    page.text += CONVERGENCE;
    writeln!(page.text, "{}", convergence::table()?)?;
    let path = root.join("docs/reproduce/curve-networks.md");
    fs::write(&path, page.text.trim_end().to_owned() + "\n")?;
    page.log.push(path.display().to_string());
    Ok(page.log)
}

const INTRODUCTION: &str = "\
# Networks of curves in a Catmull-Clark surface

Made by `cargo xtask reproduce curve-networks`, after A. Abbas and A. Nasri, *Interpolating multiple intersecting curves using
Catmull-Clark subdivision surfaces* (2004), and their generalised scheme. The method is on [its page](../methods/curve_network.md).

The papers' models are not published; here are others of the same kinds. On the left is the surface with its curves, on the right
stripes of an environment far away, mirrored in it. All figures are measured on the limit surface of the cage that was made:
the distance between it and the curves, and how far normals around a meeting point are from their mean. A port is an end of a curve at a
meeting point, or a place kept free for one. Curves go through the limits of the
vertices of their paths, with tangents in the surface's plane where they meet. They have no curvature there, and the open sheets, the domes and the
flattened balls were given shapes that have none there either.

";

const ONE_POINT: &str = "\
## Curves through one point

With twelve ports the faces around the point are narrow, and stripes are ragged there for some faces; they are smooth nearer to the point.

";

const REPAIR: &str = "\
## An irregular polyhedron

Triangles and quadrangles, and paths on it that know nothing of them. Repair puts quads along the paths and around the points where
they meet and end; the rest is split like any cage. Above: the polyhedron and the repaired cage, with the paths; below: the surface.

";

const FORMS: &str = "\
## The papers' own forms

Five curves leave the middle of a dome at uneven angles and with legs of uneven length. The curves are exact in all eight surfaces; the ring
around the meeting point differs. The table has the largest angle, in degrees, between normals on the rim of the ring of faces at a level, `2^-level` of a
face away, and their mean.

";

const EIGENVALUES: &str = "\
## Eigenvalues of a step

The first paper left them as further work. Around a point with M ports the matrix of a step has the eigenvalues 1; 1/2 and 1/8, M times each, which are
those of the curves; and one pair for each mode of the free spokes. Lines are the closed form, dots were found from the matrix by QR steps.

";

const MAPS: &str = "\
## Characteristic maps

Where all tangents lie in a plane, the surface near the meeting point is a map of that plane, and every ring half of the one around it. Below
are the slices of even configurations with lines of equal parameters, and the least Jacobian as a share of the mean. At t = 1/2 it
vanishes along free spokes, where lines run together; towards t = 0 it vanishes along the curves.

";

const CONVERGENCE: &str = "\
## How normals settle

Curves whose tangents lie in a plane, uneven ones but for the last column: the largest angle between that plane's normal and normals on the rim of the ring of a level, in degrees,
and in brackets the factor of one level. The eigen ring settles by 1/4. Free spokes that were lifted off the plane settle by twice the largest free
eigenvalue, in the long run, and at t = 1/2 with an even number of ports not at all.

";

fn repair(page: &mut Page) -> Result<()> {
    page.text += REPAIR;
    let (image, embedding, mesh) = examples::repair()?;
    let counts = format!(
        "From {} vertices and {} faces to {} and {}, {} of the vertices put in by repair; splits before that: {}.",
        mesh.points.len(),
        mesh.faces.len(),
        embedding.mesh.points.len(),
        embedding.mesh.faces.len(),
        embedding.inserted_vertices,
        embedding.splits
    );
    page.picture("repair", &image, "A polyhedron, repaired", &format!("{counts} {}", figures(&embedding)?))
}

fn forms(page: &mut Page) -> Result<()> {
    page.text += FORMS;
    let (image, table) = forms::compared()?;
    page.picture(
        "forms",
        &image,
        "Eight forms of one meeting point",
        "Lines mirrored around the meeting point.",
    )?;
    writeln!(page.text, "{table}")?;
    Ok(())
}

fn eigenvalues(page: &mut Page) -> Result<()> {
    page.text += EIGENVALUES;
    let (svg, apart) = eigenvalues::plot();
    page.plot(
        "eigenvalues",
        &svg,
        &format!("Eigenvalues against t; the two ways are at most {apart:.0e} apart."),
    )?;
    page.plot(
        "largest-free-eigenvalue",
        &eigenvalues::plot_of_largest(),
        "The largest free eigenvalue against t.",
    )?;
    writeln!(page.text, "{}", eigenvalues::table())?;
    Ok(())
}

fn maps(page: &mut Page) -> Result<()> {
    page.text += MAPS;
    page.plot("maps", &maps::plot()?, "Characteristic maps of even configurations.")?;
    let (svg, [half, found, t]) = maps::plot_of_fold(&maps::uneven(4))?;
    let caption = format!(
        "Four uneven curves. At t = 1/2 the map folds: its least Jacobian is {half:.3} of the mean. At t = {t:.4}, which the \
         search finds, it is {found:.3}."
    );
    page.plot("fold", &svg, &caption)
}

/// The page in the making.
struct Page {
    folder: PathBuf,
    text: String,
    log: Vec<String>,
}

impl Page {
    fn example(&mut self, example: &Example) -> Result<()> {
        let Example { name, title, embedding, shot } = example;
        let image = pair(&embedding.mesh, &Drawing::of(embedding), shot)?;
        self.picture(name, &image, title, &format!("{title}. {}", figures(embedding)?))
    }

    fn picture(&mut self, name: &str, image: &Image, title: &str, caption: &str) -> Result<()> {
        let mut bytes = Vec::new();
        image.write_png(&mut bytes)?;
        self.shown(&format!("{name}.png"), &bytes, title, caption)
    }

    fn plot(&mut self, name: &str, svg: &str, caption: &str) -> Result<()> {
        self.shown(&format!("{name}.svg"), svg.as_bytes(), caption, caption)
    }

    fn shown(&mut self, file: &str, bytes: &[u8], title: &str, caption: &str) -> Result<()> {
        let path = self.folder.join(file);
        fs::write(&path, bytes)?;
        write!(self.text, "![{title}](curve-networks/{file})\n\n*{caption}*\n\n")?;
        self.log.push(path.display().to_string());
        Ok(())
    }
}
