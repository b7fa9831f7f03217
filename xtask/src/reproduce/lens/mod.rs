//! Karciauskas and Peters, *Lens-shaped surfaces and C2 subdivision*: its figures, and how evenly curvature runs by each method.

mod bezier;
mod bicubic;
mod maps;
mod measure;
pub(super) mod methods;
mod nets;
mod sections;
pub(super) mod sheet;
mod table;

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::Result;

use nets::{Example, pair, single, tip};
use sheet::{Sheet, sheet};

/// Makes the figures and the page.
pub(crate) fn write(root: &Path) -> Result<Vec<String>> {
    let folder = root.join("docs/reproduce/lens");
    fs::create_dir_all(&folder)?;
    let mut page = Page { folder, text: INTRODUCTION.to_owned(), log: Vec::new() };
    sections(&mut page)?;
    page.text += RING;
    page.shown(
        "characteristic-ring.svg",
        maps::characteristic_ring().as_bytes(),
        "The w-plane and the characteristic ring",
    )?;
    page.text += CONFORMAL;
    page.shown("conformal-maps.svg", maps::conformal().as_bytes(), "Parameter lines of six conformal maps")?;
    page.text += COMPARISON;
    for (net, (example, words)) in [(single(), SINGLE), (pair(), PAIR), (tip(), TIP)].into_iter().enumerate()
    {
        compare(&mut page, net, &example, words)?;
    }
    let path = root.join("docs/reproduce/lens.md");
    fs::write(&path, page.text.trim_end().to_owned() + "\n")?;
    page.log.push(path.display().to_string());
    Ok(page.log)
}

const INTRODUCTION: &str = "\
# Lens-shaped surfaces and C2 subdivision

Made by `cargo xtask reproduce lens`, after K. Karciauskas and J. Peters, *Lens-shaped surfaces and C2 subdivision*. The methods are on
[their page](../methods/lens.md). The paper's models are not published; here are others of the same kinds.

";

const SECTIONS: &str = "\
## Catmull-Clark and the bi-3 rule (figure 1)

At a vertex of valence 2 Catmull and Clark's rule has the eigenvalues 1/4, 1/4 and -1/4: what is lifted at the vertex comes back in
the next ring with the other sign, and for the size of that ring as large as before, however near one looks. The bi-3 rule leaves
1/4 twice, which are the tangent plane. The net is the characteristic one, bent a little, with its vertex lifted; curves are the
section with its plane of symmetry, magnified about the end point.

";

const RING: &str = "\
## The characteristic ring (figures 4 and 5)

The net around a lens is an even function on the grid of the w-plane. Its characteristic map is w^2/4, which the rings below reach
without error; each has six patches and is a quarter as large as the one around it. Heavy lines are borders of patches.

";

const CONFORMAL: &str = "\
## Conformal maps (figures 13 and 14)

What parameter lines look like where they run as evenly as can be: around a lens, around a pair of lenses, around a pole and around
vertices of valence 3, 5 and 6.

";

const COMPARISON: &str = "\
## All methods compared (figures 16, 17 and 18)

Three nets, by every method. All pictures of a net have the same light and the same scale of colours.

Figures are the least and the greatest mean curvature, in the nets (a) and (b) as shares of that of the paraboloid the net lies on, at
the same place; and in brackets the root of the mean square, by area, of its gradient on the surface. They are taken at 17 x 17
places of every patch, borders included, weighted by the trapezoidal rule, on the rings 0 to 5 of a lens; by Catmull-Clark and by the
bi-3 rule they would grow further with every ring. Where figures 11 and 12 leave vertices of valence 3 the faces of six steps are
taken; there curvature grows too, but by a few percent a step. Polar caps are measured at the pole as well. Lower is better, but
that a small gradient can be bought by moving the surface: figure 11 left flattens a tip most.

\"First\" are the figures that stood when the methods were worked out, before this library had them; \"apart\" is the largest share by
which one of the three differs. Of that program's regions, samples and steps only an outline is known; the rest was chosen here by looking at
which choice comes nearest, so agreement is weaker evidence than it seems:

- Paraboloid, region and rings of (a) are what the outline says; the scale of the net, w^2/4, is the one of three tried (1/4, 1/2 and
  3/4) with the first least ratio, 1.04. Samples and weights are those, of some tried, that fit the first two rows.
- Six steps at valence 3, where a lens has rings 0 to 5: in (a) the greatest ratios of figure 11 are 1.98 and 2.14 after five steps, 2.02 and
  2.19 after six, and the latter are the first ones. With five steps rows of figures 11 and 12 are up to 5.7 % apart in (a) and 8.7 % in (b).
- The ellipse of (b) was not given. Of 675 tried (half axes from 1.80 to 3.00 and from 1.20 to 2.50, by 0.05) 37 leave all gradients within
  5 %, with half axes from 1.85 to 2.40 and from 2.05 to 2.35; the one taken is among these, a plain one and not the best. Ranges hardly
  depend on it, gradients do: seen by themselves, those of (b) are a fit.

";

const SINGLE: &str = "\
### (a) A lens on a paraboloid

The characteristic net w^2/4, lifted to z = -(x^2/4 + y^2)/20; measured where x^2 + y^2 < 9.

";

const PAIR: &str = "\
### (b) A pair of lenses on the same paraboloid

The characteristic net cos(w pi/4) of a pair with four edges between, lifted to the same paraboloid; measured inside the ellipse with
the half axes cosh 3/2 and sinh 3/2, whose foci are the lenses.

";

const TIP: &str = "\
### (c) A thin wing tip

A pair with four edges between closes the tip of a wing. Sections are ellipses, from the slit outwards with half chords of 0.33, 0.65,
0.89, 0.96, 0.80, 0.80 and half thicknesses of 0, 0.083, 0.15, 0.28, 0.26, 0.26, at 0, 0.08, 0.33, 1.13, 1.90, 2.70 below the tip;
measured to 1.5 below it. Mean curvature is given as it is, not as a share, and is negative, for normals that point out.

The first figures belong to another net, which is lost. This one is ours, and was shaped until its figures were of the same kind:
by a search over half axes and heights that looked at the first figures of all methods but the first two rows; the depth to which it is
measured was chosen after seeing them. So that they come near the first ones, and put the methods in the same order, proves
nothing but that there is such a wing: on others the order may differ. By Catmull-Clark and by the bi-3 rule curvature has no
bound; their figures are those that ring 5 ends with.

";

fn sections(page: &mut Page) -> Result<()> {
    page.text += SECTIONS;
    page.shown("sections.svg", sections::plot().as_bytes(), "Section curves and normal cones by both rules")?;
    let [plain, lens] = sections::cones(12);
    writeln!(
        page.text,
        "In ring 12 normals are within {plain:.1} degrees of their mean by Catmull-Clark, and within {lens:.2} by the bi-3 rule.\n"
    )?;
    Ok(())
}

fn compare(page: &mut Page, net: usize, example: &Example, words: &str) -> Result<()> {
    page.text += words;
    writeln!(page.text, "{}", table::table(example, net)?)?;
    for (kind, file, what) in [
        (Sheet::Lines, "lines", "lines of light on"),
        (Sheet::MeanCurvature, "curvature", "mean curvature of"),
    ] {
        let mut bytes = Vec::new();
        sheet(example, kind)?.write_png(&mut bytes)?;
        let caption = format!("({}) {what} {} by each method", example.letter, example.title);
        page.shown(&format!("{}-{file}.png", example.letter), &bytes, &caption)?;
    }
    Ok(())
}

/// The page in the making.
struct Page {
    folder: PathBuf,
    text: String,
    log: Vec<String>,
}

impl Page {
    fn shown(&mut self, file: &str, bytes: &[u8], caption: &str) -> Result<()> {
        let path = self.folder.join(file);
        fs::write(&path, bytes)?;
        write!(self.text, "![{caption}](lens/{file})\n\n*{caption}.*\n\n")?;
        self.log.push(path.display().to_string());
        Ok(())
    }
}
