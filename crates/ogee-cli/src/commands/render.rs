//! `ogee render`: a picture of the exact surface.

use std::path::PathBuf;
use std::process::ExitCode;
use std::str::FromStr;
use std::sync::Arc;
use std::time::Instant;

use clap::Args;
use ogee::Vec3;
use ogee::quality::Surface;
use ogee_render::{
    Image, Light, MOST_PIXELS, Pattern, Picture, Quantity, Sampling, Scene, Style, comb, outline, render,
};
use serde::Serialize;

use crate::arguments::OutputArguments;
use crate::cage::{CageArguments, read_bytes};
use crate::curves::Curves;
use crate::error::{Failure, Finding};
use crate::names::{Format, formats};
use crate::report::{Console, Table, bytes};
use crate::subject::{Subject, or_part};
use crate::treatment::LensArguments;
use crate::view::{LightArguments, ViewArguments};

const EXAMPLES: &str = "\
Examples:
  ogee render cage.obj --style reflection -o lines.png       mirrored lines, exact at every pixel
  ogee render cage.obj --style mean --size 1200x900 -o h.png mean curvature, with its scale
  ogee render cage.obj --beside part.json --style zebra -o zebra.png  the limit and the patches of a part
  ogee render boat.json --curves --style reflection -o boat.png  the curves that ogee network laid, on the lines
  ogee render cage.obj --style error --sampling polygon:2 -o error.png
  ogee render wing.obj --lens c2 --style mean -o wing.png    with caps at lenses";

/// Draw the surface: shaded, mirrored lines, bands, curvature
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, mut_arg("cage", or_part))]
pub(crate) struct Render {
    #[command(flatten)]
    cage: CageArguments,
    #[command(flatten)]
    output: OutputArguments,
    /// The format of the picture, where its name does not tell
    #[arg(long, value_name = "FORMAT", value_parser = formats::<PictureFormat>())]
    output_format: Option<PictureFormat>,
    /// A second cage or part, drawn beside the first with the same camera, light and scale of colours
    #[arg(long, value_name = "CAGE|PART.json")]
    beside: Option<PathBuf>,
    #[command(flatten)]
    lenses: LensArguments,
    /// What to show
    #[arg(long, value_name = "STYLE", default_value = "shaded", value_parser = formats::<Look>())]
    style: Look,
    /// Draw the curves in the file of the cage, as ogee network writes them, and discs where they meet
    #[arg(long)]
    curves: bool,
    /// What is on the light plane: lines, lattice, circles, or a picture
    #[arg(long, value_name = "LIGHT|FILE.png", default_value = "lines")]
    light: String,
    /// What pixels are taken from: exact, polygon:LEVEL, or parameters:LEVEL
    #[arg(long, value_name = "SAMPLING", default_value = "exact")]
    sampling: Taken,
    /// What draws
    #[arg(long, value_name = "DEVICE", default_value = "auto", value_parser = formats::<Device>())]
    device: Device,
    /// Samples along each side of a pixel: more make outlines smoother
    #[arg(long, value_name = "N", default_value = "2", value_parser = clap::value_parser!(u32).range(1..=8))]
    samples: u32,
    /// Where the colours of a map of curvature end [default: where 95 % of the visible surface is]
    #[arg(long, value_name = "CURVATURE", value_parser = positive)]
    limit: Option<f64>,
    /// The axis of zebra stripes
    #[arg(long, value_name = "X,Y,Z", value_parser = crate::view::direction, allow_hyphen_values = true, default_value = "0,0,1")]
    axis: Vec3,
    #[command(flatten)]
    view: ViewArguments,
    #[command(flatten)]
    lights: LightArguments,
}

/// Of the diagonal: how long the hairs of combs are, where nine in ten are shorter.
const HAIRS: f64 = 0.04;

/// Styles by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Look {
    Shaded,
    Wireframe,
    Reflection,
    Highlight,
    Isophote,
    Zebra,
    Map(Quantity),
    Error,
    Combs,
}

impl Format for Look {
    const NAMES: &'static [(&'static str, Look)] = &[
        ("shaded", Look::Shaded),
        ("wireframe", Look::Wireframe),
        ("reflection", Look::Reflection),
        ("highlight", Look::Highlight),
        ("isophote", Look::Isophote),
        ("zebra", Look::Zebra),
        ("gauss", Look::Map(Quantity::Gauss)),
        ("mean", Look::Map(Quantity::Mean)),
        ("k1", Look::Map(Quantity::K1)),
        ("k2", Look::Map(Quantity::K2)),
        ("greatest", Look::Map(Quantity::Greatest)),
        ("gauss-sign", Look::Map(Quantity::GaussSign)),
        ("error", Look::Error),
        ("combs", Look::Combs),
    ];
    const ELSEWHERE: &'static [&'static str] = &[];
    const OPTION: &'static str = "--style";
}

/// Formats of pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum PictureFormat {
    Png,
}

impl Format for PictureFormat {
    const NAMES: &'static [(&'static str, PictureFormat)] = &[("png", PictureFormat::Png)];
    const ELSEWHERE: &'static [&'static str] = &[];
    const OPTION: &'static str = "--output-format";
}

/// What draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Device {
    Cpu,
    #[cfg(feature = "gpu")]
    Gpu,
    Auto,
}

impl Format for Device {
    const NAMES: &'static [(&'static str, Device)] = &[
        ("cpu", Device::Cpu),
        #[cfg(feature = "gpu")]
        ("gpu", Device::Gpu),
        ("auto", Device::Auto),
    ];
    const ELSEWHERE: &'static [&'static str] = &["gpu"];
    const OPTION: &'static str = "--device";
}

/// `--sampling`.
#[derive(Clone, Copy, Debug)]
struct Taken(Sampling);

impl FromStr for Taken {
    type Err = String;

    fn from_str(text: &str) -> Result<Taken, String> {
        let level = |text: &str| text.parse::<u32>().map_err(|_| format!("'{text}' is no level"));
        match text.split_once(':') {
            None if text == "exact" => Ok(Taken(Sampling::Exact)),
            Some(("polygon", text)) => Ok(Taken(Sampling::Polygon(level(text)?))),
            Some(("parameters", text)) => Ok(Taken(Sampling::Parameters(level(text)?))),
            _ => Err("it is exact, polygon:LEVEL or parameters:LEVEL".to_owned()),
        }
    }
}

fn positive(text: &str) -> Result<f64, String> {
    let number = text.parse::<f64>().ok().filter(|x| *x > 0.0 && x.is_finite());
    number.ok_or_else(|| format!("'{text}' is no number above 0"))
}

/// The report for programs.
#[derive(Serialize)]
struct Report<'a> {
    device: &'static str,
    adapter: Option<&'a str>,
    style: &'static str,
    size: [u32; 2],
    /// Pixels that show the surface, all samples counted.
    fragments: usize,
    samples: u32,
    /// Of the mesh that said what each pixel shows.
    level: u32,
    /// Where the colours of a map end.
    limit: Option<f64>,
    seconds: Seconds,
    file_bytes: u64,
    notes: &'a [Finding],
}

#[derive(Clone, Copy, Serialize)]
struct Seconds {
    read: f64,
    prepare: f64,
    upload: f64,
    ids: f64,
    position: f64,
    colour: f64,
    readback: f64,
    write: f64,
}

impl Render {
    pub(crate) fn run(&self, console: &Console) -> Result<ExitCode, Failure> {
        let destination = self.output.destination(console.json)?;
        let PictureFormat::Png =
            PictureFormat::of(self.output_format, &self.output.output).map_err(Failure::usage)?;
        let [width, height] = self.view.size.map(u64::from);
        if width * height * u64::from(self.samples).pow(2) > MOST_PIXELS {
            return Err(Failure::usage(format!(
                "--size {width}x{height} with {0} x {0} samples a pixel is too large; {MOST_PIXELS} samples are the most",
                self.samples
            )));
        }
        let image = self.image()?;
        let progress = console.progress();
        progress.step("reading");
        let (subject, curves) = self.read(&self.cage)?;
        let curves = curves.transpose()?;
        subject.check_rules(&self.cage)?;
        subject.check_lens(self.lenses.lens)?;
        destination.check()?;
        let other = match &self.beside {
            Some(file) => Some(self.read(&self.cage.for_file(file))?),
            None => None,
        };
        progress.step("drawing");
        let scene = subject.look(|surface| self.scene(&subject, surface, image))?;
        let Drawn { mut picture, device, adapter, upload, note } = self.draw(&subject, &scene)?;
        draw_curves(&subject, &scene, curves.as_ref(), &mut picture)?;
        let mut pixels = picture.reduced(self.samples).image();
        if let Some(limit) = picture.limit {
            pixels.add_legend(&scene.style, limit);
        }
        if let Some((other, curves)) = other {
            let mut second = self.draw(&other, &scene.beside(&picture))?.picture;
            // A part, and a cage with other curves or none, has those that its file has.
            let curves = match curves.transpose() {
                Err(failure) if failure.first().code == "no_curves" => None,
                curves => curves?,
            };
            draw_curves(&other, &scene, curves.as_ref(), &mut second)?;
            let mut second = second.reduced(self.samples).image();
            pixels.add_caption(&subject.file_name());
            second.add_caption(&other.file_name());
            pixels = pixels.beside(&second);
        }
        progress.step("writing");
        let start = Instant::now();
        let file_bytes = destination.write(|out| pixels.write_png(out))?;
        let write = start.elapsed().as_secs_f64();
        drop(progress);

        let mut notes = subject.notes();
        notes.extend(curves.into_iter().flat_map(|curves| curves.notes));
        notes.extend(note);
        let stages = picture.seconds;
        let report = Report {
            device,
            adapter: adapter.as_deref(),
            style: Look::NAMES.iter().find(|(_, look)| *look == self.style).map_or("", |(name, _)| name),
            size: self.view.size,
            fragments: picture.fragments,
            samples: self.samples,
            level: picture.level,
            limit: picture.limit,
            seconds: Seconds {
                read: subject.read_seconds,
                prepare: subject.prepare_seconds,
                upload,
                ids: stages.ids,
                position: stages.position,
                colour: stages.colour,
                readback: 0.0,
                write,
            },
            file_bytes,
            notes: &notes,
        };
        console.table(&format!("{} -> {}", subject.name, destination.name()), &table(&report), &notes);
        console.json(&report)?;
        Ok(ExitCode::SUCCESS)
    }

    /// A cage or a part, and the curves in the same file if they are asked for.
    fn read(&self, file: &CageArguments) -> Result<(Subject, Option<Result<Curves, Failure>>), Failure> {
        let (name, format, bytes) = file.load()?;
        let subject = Subject::parse(file, name, format, &bytes, self.lenses.lens)?;
        let curves = self.curves.then(|| Curves::read(&subject, format, &bytes));
        Ok((subject, curves))
    }

    fn scene(
        &self,
        subject: &Subject,
        surface: &dyn Surface,
        image: Option<Arc<Light>>,
    ) -> Result<Scene, Failure> {
        let bounds = subject.bounds(surface)?;
        let mut shown = outline(surface);
        if self.style == Look::Combs {
            shown.extend(comb::tips(surface, HAIRS));
        }
        let camera = self.view.camera(&shown)?;
        let size = self.view.size.map(|side| side * self.samples);
        Ok(Scene { camera, size, style: self.style(bounds, image), sampling: self.sampling.0 })
    }

    #[cfg(not(feature = "gpu"))]
    fn draw(&self, subject: &Subject, scene: &Scene) -> Result<Drawn, Failure> {
        let why = (self.device == Device::Auto).then(|| "this build draws on the CPU".to_owned());
        on_cpu(subject, scene, why)
    }

    #[cfg(feature = "gpu")]
    fn draw(&self, subject: &Subject, scene: &Scene) -> Result<Drawn, Failure> {
        use crate::gpu::{Unfit, draw};
        if self.device == Device::Cpu {
            return on_cpu(subject, scene, None);
        }
        let is_wanted = self.device == Device::Gpu;
        match draw(subject, scene, is_wanted) {
            Ok((picture, adapter, upload)) => {
                Ok(Drawn { picture, device: "gpu", adapter: Some(adapter), upload, note: None })
            }
            Err(Unfit::Device(ogee_gpu::GpuError::Scene(error))) => {
                Err(subject.failure(error.code(), error.to_string()))
            }
            Err(Unfit::Device(error)) if is_wanted => Err(subject.failure(error.code(), error.to_string())),
            Err(Unfit::Patches) if is_wanted => {
                let message = "patches of a part are drawn on the CPU; say --device cpu";
                Err(subject.failure("patches_on_gpu", message))
            }
            Err(unfit) => {
                let why = match unfit {
                    Unfit::Caps => {
                        "drawn on the CPU: no graphics adapter knows the caps of --lens".to_owned()
                    }
                    Unfit::Patches => "patches of a part are drawn on the CPU".to_owned(),
                    Unfit::Software(name) => {
                        format!("drawn on the CPU: the graphics adapter {name} is software")
                    }
                    Unfit::Device(error) => format!("drawn on the CPU: {error}"),
                };
                on_cpu(subject, scene, Some(why))
            }
        }
    }

    /// The picture on the light plane, if there is one.
    fn image(&self) -> Result<Option<Arc<Light>>, Failure> {
        if ["lines", "lattice", "circles"].contains(&self.light.as_str()) {
            return Ok(None);
        }
        if !is_png(self.light.as_ref()) {
            return Err(Failure::usage(format!(
                "--light {}: it is lines, lattice, circles or the name of a .png",
                self.light
            )));
        }
        let (name, bytes) = read_bytes(self.light.as_ref())?;
        let image = Image::read_png(&bytes).map_err(|error| {
            Failure::refused(vec![Finding::in_file("bad_image", error.to_string(), &name)], 0)
        })?;
        Ok(Some(Arc::new(Light::new(&image))))
    }

    fn style(&self, bounds: [Vec3; 2], image: Option<Arc<Light>>) -> Style {
        let light = self.lights.plane(bounds);
        let period = self.lights.period(bounds);
        let width = |usual: f64| self.lights.width.unwrap_or(usual);
        let pattern = || match (&image, self.light.as_str()) {
            (Some(image), _) => {
                let half =
                    if light.half[0].is_finite() { light.half[0] } else { bounds[0].distance(bounds[1]) };
                Pattern::Image { image: image.clone(), half }
            }
            (None, "lattice") => Pattern::Lattice { period, width: width(0.1) },
            (None, "circles") => Pattern::Circles { period, radius: width(0.6) / 2.0 },
            (None, _) => Pattern::Lines { period, width: width(0.3), phase: 0.0 },
        };
        match self.style {
            Look::Shaded => Style::Shaded,
            Look::Wireframe => Style::Wireframe,
            Look::Reflection => Style::Reflection { light, pattern: pattern() },
            Look::Highlight => Style::Highlight { light, pattern: pattern() },
            Look::Isophote => Style::Isophote { light: self.lights.light_direction, step: self.lights.step },
            Look::Zebra => Style::Zebra { axis: self.axis, count: self.lights.count() },
            Look::Map(quantity) => Style::Curvature { quantity, limit: self.limit },
            Look::Error => {
                let level = match self.sampling.0 {
                    Sampling::Polygon(level) | Sampling::Parameters(level) => level,
                    Sampling::Exact => 2,
                };
                Style::Error { light, level }
            }
            Look::Combs => Style::Combs { share: HAIRS },
        }
    }
}

/// A picture, and what drew it.
struct Drawn {
    picture: Picture,
    device: &'static str,
    adapter: Option<String>,
    /// How long opening a device and sending the surface took.
    upload: f64,
    note: Option<Finding>,
}

/// Draws on the CPU; `why` tells those who did not ask for it.
fn on_cpu(subject: &Subject, scene: &Scene, why: Option<String>) -> Result<Drawn, Failure> {
    let picture = subject.look(|surface| render(surface, scene));
    let picture = picture.map_err(|error| subject.failure(error.code(), error.to_string()))?;
    let note = why.map(|why| Finding::in_file("drawn_on_cpu", why, &subject.name));
    Ok(Drawn { picture, device: "cpu", adapter: None, upload: 0.0, note })
}

/// Draws curves over the picture of a scene, whatever drew that.
fn draw_curves(
    subject: &Subject,
    scene: &Scene,
    curves: Option<&Curves>,
    picture: &mut Picture,
) -> Result<(), Failure> {
    let Some((curves, view)) = curves.zip(scene.camera.view(scene.size)) else { return Ok(()) };
    let strokes = curves.strokes(view.line_width());
    let drawn = subject.look(|surface| picture.draw(surface, &scene.camera, &strokes));
    drawn.map_err(|error| subject.failure(error.code(), error.to_string()))
}

fn is_png(path: &std::path::Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("png"))
}

fn table(report: &Report<'_>) -> Table {
    let mut table = Table::default();
    table.row("style", report.style);
    let [width, height] = report.size;
    table.row("picture", format!("{width} x {height}, {0} x {0} samples a pixel", report.samples));
    table.row("fragments", report.fragments.to_string());
    if let Some(limit) = report.limit {
        table.row("colours end at", format!("{limit:.4e}"));
    }
    let Seconds { read, prepare, ids, position, colour, write, .. } = report.seconds;
    let total = read + prepare + ids + position + colour + write;
    let parts = format!(
        "read {read:.3}, prepare {prepare:.3}, ids {ids:.3}, points {position:.3}, colours {colour:.3}, write {write:.3}"
    );
    table.row("seconds", format!("{total:.3} ({parts})"));
    table.row("device", report.device);
    table.row("file", bytes(report.file_bytes));
    table
}
