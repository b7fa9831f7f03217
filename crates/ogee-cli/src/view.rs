//! Options of cameras and lights, shared by the commands that look at a surface.

use std::str::FromStr;

use clap::Args;
use ogee::Vec3;
use ogee::quality::PlaneLight;
use ogee_render::{Camera, THREE_QUARTER, default_light};

use crate::error::Failure;

/// Who looks, and how large the picture is.
#[derive(Debug, Args)]
#[command(next_help_heading = "View")]
pub(crate) struct ViewArguments {
    /// The eye [default: a three-quarter view that fits]
    #[arg(long, value_name = "X,Y,Z", value_parser = vector, allow_hyphen_values = true)]
    eye: Option<Vec3>,
    /// What is in the middle of the picture [default: the middle of the surface]
    #[arg(long = "at", value_name = "X,Y,Z", value_parser = vector, allow_hyphen_values = true)]
    target: Option<Vec3>,
    /// What points up in the picture [default: 0,0,1]
    #[arg(long, value_name = "X,Y,Z", value_parser = direction, allow_hyphen_values = true)]
    up: Option<Vec3>,
    /// The whole vertical angle of view in degrees
    #[arg(long, value_name = "DEGREES", value_parser = angle_of_view, default_value = "30")]
    fov: f64,
    /// Width and height of the picture in pixels
    #[arg(long, value_name = "WxH", value_parser = size, default_value = "700x700")]
    pub(crate) size: [u32; 2],
}

impl ViewArguments {
    /// The camera that shows a surface with these points as asked.
    pub(crate) fn camera(&self, points: &[Vec3]) -> Result<Camera, Failure> {
        let fit = |from| Camera::fit_from(from, points, self.fov, self.size);
        let usual = fit(THREE_QUARTER);
        let at = self.target.unwrap_or(usual.at);
        let fitted = self.eye.map_or(usual, |eye| fit(eye - at));
        // A target alone moves the view as it is.
        let eye = self.eye.unwrap_or(usual.eye + (at - usual.at));
        let camera = Camera { eye, at, up: self.up.unwrap_or(fitted.up), ..fitted };
        if eye == at {
            return Err(Failure::usage(format!("--eye and --at are the same point, {}", words(eye))));
        }
        match camera.view(self.size) {
            Some(_) => Ok(camera),
            None => Err(Failure::usage(format!(
                "--up {} points along the view from --eye {} to --at {}",
                words(camera.up),
                words(eye),
                words(at)
            ))),
        }
    }
}

/// Lights, and what is on them.
#[derive(Debug, Args)]
#[command(next_help_heading = "Light")]
pub(crate) struct LightArguments {
    /// The light plane: how far it is above the surface, and how long its sides are [default: half the diagonal of the
    /// surface, and without an end]
    #[arg(long, value_name = "HEIGHT[,SIZE]", allow_hyphen_values = true)]
    light_plane: Option<PlaneSize>,
    /// How many lines there are from side to side of the light plane, or over the diagonal of the surface if the plane
    /// has no end
    #[arg(long, value_name = "COUNT", value_parser = positive, default_value = "20")]
    lines: f64,
    /// The share of a period that is bright, between 0 and 1
    #[arg(long, value_name = "W", value_parser = share)]
    pub(crate) width: Option<f64>,
    /// Towards the light of isophotes
    #[arg(long, value_name = "X,Y,Z", value_parser = direction, allow_hyphen_values = true, default_value = "0,0,1")]
    pub(crate) light_direction: Vec3,
    /// From one isophote to the next, in degrees
    #[arg(long, value_name = "DEGREES", value_parser = step, default_value = "10")]
    pub(crate) step: f64,
}

/// What `--light-plane` says.
#[derive(Clone, Copy, Debug)]
struct PlaneSize {
    height: f64,
    side: f64,
}

impl FromStr for PlaneSize {
    type Err = String;

    fn from_str(text: &str) -> Result<PlaneSize, String> {
        let (height, side) = match text.split_once(',') {
            Some((height, side)) => (number(height)?, positive(side)?),
            None => (number(text)?, f64::INFINITY),
        };
        Ok(PlaneSize { height, side })
    }
}

impl LightArguments {
    /// The light plane above a surface with these bounds.
    pub(crate) fn plane(&self, bounds: [Vec3; 2]) -> PlaneLight {
        let usual = default_light(bounds);
        match self.light_plane {
            Some(PlaneSize { height, side }) => PlaneLight {
                centre: Vec3::new(usual.centre.x, usual.centre.y, bounds[1].z + height),
                half: [0.5 * side; 2],
                ..usual
            },
            None => usual,
        }
    }

    /// How many lines there are.
    pub(crate) fn count(&self) -> f64 {
        self.lines
    }

    /// From one line on the plane to the next.
    pub(crate) fn period(&self, [lower, upper]: [Vec3; 2]) -> f64 {
        let side = self.light_plane.map_or(f64::INFINITY, |plane| plane.side);
        let whole = if side.is_finite() { side } else { upper.distance(lower) };
        whole / self.lines
    }
}

fn number(text: &str) -> Result<f64, String> {
    let number = text.trim().parse::<f64>().ok().filter(|number| number.is_finite());
    number.ok_or_else(|| format!("'{text}' is no number"))
}

/// A number above 0.
pub(crate) fn positive(text: &str) -> Result<f64, String> {
    number(text).and_then(|x| if x > 0.0 { Ok(x) } else { Err("it has to be above 0".to_owned()) })
}

fn share(text: &str) -> Result<f64, String> {
    let within = |x: &f64| (0.0..1.0).contains(x) && *x > 0.0;
    number(text).and_then(|x| within(&x).then_some(x).ok_or("it has to be between 0 and 1".to_owned()))
}

fn angle_of_view(text: &str) -> Result<f64, String> {
    let within = |x: &f64| (0.1..=170.0).contains(x);
    number(text).and_then(|x| within(&x).then_some(x).ok_or("it has to be from 0.1 to 170".to_owned()))
}

fn step(text: &str) -> Result<f64, String> {
    let within = |x: &f64| (0.01..=90.0).contains(x);
    number(text).and_then(|x| within(&x).then_some(x).ok_or("it has to be from 0.01 to 90".to_owned()))
}

fn vector(text: &str) -> Result<Vec3, String> {
    let numbers = text.split(',').map(number).collect::<Result<Vec<_>, _>>()?;
    match numbers[..] {
        [x, y, z] => Ok(Vec3::new(x, y, z)),
        _ => Err("three numbers with commas between them are wanted".to_owned()),
    }
}

/// A unit vector.
pub(crate) fn direction(text: &str) -> Result<Vec3, String> {
    vector(text)?.normalized().ok_or_else(|| "it has no direction".to_owned())
}

fn size(text: &str) -> Result<[u32; 2], String> {
    /// Pixels along a side; more are more than programs that show pictures take.
    const MOST: u32 = 16_384;
    let pixels = |text: &str| text.parse::<u32>().ok().filter(|n| (1..=MOST).contains(n));
    let both = text.split_once(['x', 'X']).and_then(|(w, h)| Some([pixels(w)?, pixels(h)?]));
    both.ok_or_else(|| format!("it has to look like 700x500, with numbers from 1 to {MOST}"))
}

fn words(point: Vec3) -> String {
    format!("{},{},{}", point.x, point.y, point.z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    #[derive(Parser)]
    struct Both {
        #[command(flatten)]
        view: ViewArguments,
        #[command(flatten)]
        light: LightArguments,
    }

    const BOUNDS: [Vec3; 2] = [Vec3::new(0.0, 0.0, 0.0), Vec3::new(4.0, 12.0, 3.0)];

    fn parse(options: &str) -> Result<Both, clap::Error> {
        Both::try_parse_from(["ogee"].into_iter().chain(options.split_whitespace()))
    }

    #[test]
    fn what_is_not_said_follows_from_the_surface() {
        let Both { view, light } = parse("").unwrap();
        let fit = |size| Camera::fit_from(THREE_QUARTER, &BOUNDS, 30.0, size);
        assert_eq!(view.camera(&BOUNDS).unwrap(), fit([700, 700]));
        assert_eq!((light.plane(BOUNDS), light.period(BOUNDS)), (default_light(BOUNDS), 13.0 / 20.0));
        let Both { view, light } = parse("--at 2,7,1.5 --light-plane 5,8 --lines 4 --size 300x200").unwrap();
        let (camera, fitted) = (view.camera(&BOUNDS).unwrap(), fit([300, 200]));
        assert!((camera.eye - fitted.eye - (camera.at - fitted.at)).length() < 1e-12);
        let plane = light.plane(BOUNDS);
        assert_eq!((plane.centre.z, plane.half, light.period(BOUNDS)), (8.0, [4.0; 2], 2.0));
        let from_above = parse("--eye 2,6,30 --at 2,6,1").unwrap().view.camera(&BOUNDS).unwrap();
        assert_eq!(from_above.up, Vec3::new(0.0, 1.0, 0.0));
    }

    #[test]
    fn views_of_nothing_are_refused() {
        for options in ["--eye 1,1,1 --at 1,1,1", "--eye 2,6,30 --at 2,6,1 --up 0,0,1"] {
            assert!(parse(options).unwrap().view.camera(&BOUNDS).is_err(), "{options}");
        }
        let wrong = [
            "--eye 1,2",
            "--eye 1,2,nan",
            "--up 0,0,0",
            "--fov 180",
            "--size 0x10",
            "--size 7",
            "--light-plane 1,0",
            "--lines 0",
            "--width 1",
            "--step 0",
        ];
        for options in wrong {
            assert!(parse(options).is_err(), "{options}");
        }
    }
}
