//! How well faces meet: four numbers at places along every joint, each side measured in its own face.
//!
//! | number | is |
//! | --- | --- |
//! | gap | the distance between the two points |
//! | angle | between the two normals, in degrees |
//! | curvature | the larger difference of principal curvatures, as a share of the largest of the four |
//! | kink | the angle between the two tangents of a reflection line, in degrees, 90 at most |
//!
//! On the exact limit of a cage all four vanish away from creases; on what stands for it they say how well it does.

use super::{Address, Field, Joint, Layout, NormalJet, Surface};
use crate::limit::{Derivatives, LimitJet, Samples};
use crate::math::{SurfaceJet, Vec3, par};
use crate::patch::Location;

/// Where along a joint it is measured, as shares of its length in parameters.
pub const FRACTIONS: [f64; 5] = [0.1, 0.3, 0.5, 0.7, 0.9];

/// What is measured over the joints of a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Continuity {
    /// Over joints that ought to be smooth.
    pub smooth: Joints,
    /// Over creases.
    pub sharp: Joints,
    /// Sides without a neighbour.
    pub border: usize,
}

/// The four numbers over some joints.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Joints {
    /// How many joints there are.
    pub count: usize,
    /// Between the two points, in the unit of the surface.
    pub gap: Metric,
    /// Between the two normals, in degrees.
    pub angle: Metric,
    /// Between principal curvatures, relative.
    pub curvature: Metric,
    /// Of reflection lines, in degrees.
    pub kink: Metric,
}

/// One number over some joints; zero where there is nothing to measure.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Metric {
    /// At how many places it exists.
    pub samples: usize,
    /// The largest.
    pub max: f64,
    /// What 95 % of the places do not exceed.
    pub p95: f64,
    /// The mean.
    pub mean: f64,
    /// The worst joints, each at its worst place, the worst first.
    pub worst: Vec<JointPlace>,
}

/// A place on a joint, seen from both faces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointPlace {
    /// What was measured.
    pub value: f64,
    /// The place in the one face.
    pub at: Address,
    /// The same place in the other.
    pub beside: Address,
    /// The point there.
    pub position: Vec3,
}

/// What [`Continuity`] is to be measured with.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gauge<'a> {
    /// Its level lines are those that kink.
    pub(super) field: &'a Field,
    /// The diagonal of the surface.
    pub(super) size: f64,
    /// Joints that bend by this or more, in degrees, count as creases; `None` where the layout knows its creases.
    pub(super) crease_angle: Option<f64>,
    /// How many of the worst joints are wanted.
    pub(super) worst: usize,
}

/// Joints that are held in memory at once.
const BLOCK: usize = 2048;

/// Lines have no direction where their field hardly changes, in lengths of the light plane for a length of the surface.
const STILL: f64 = 1e-6;

impl Continuity {
    /// Measures all joints, and says of each whether it is a crease. Eight bytes a number are kept until the end, for the
    /// 95 %.
    pub(super) fn new(surface: &dyn Surface, gauge: &Gauge<'_>) -> (Continuity, Vec<bool>) {
        let layout = surface.layout();
        let mut creases = Vec::with_capacity(layout.joints().len());
        let [mut smooth, mut sharp] = [0, 1].map(|_| Collector::default());
        let mut samples = Samples::default();
        let mut places = Vec::new();
        for (block, joints) in layout.joints().chunks(BLOCK).enumerate() {
            places.clear();
            places
                .extend(joints.iter().flat_map(|joint| FRACTIONS.map(|x| sides(layout, joint, x))).flatten());
            surface.evaluate(&places, Derivatives::Second, &mut samples);
            let measured: Vec<[Measured; 5]> = par::collect(joints.len(), |joint| {
                std::array::from_fn(|x| {
                    let first = 2 * (FRACTIONS.len() * joint + x);
                    Measured::new([first, first + 1].map(|i| jet(&samples, i)), gauge)
                })
            });
            for (k, (joint, measured)) in joints.iter().zip(measured).enumerate() {
                let bends = |limit| measured.iter().any(|m| m.angle.is_some_and(|angle| angle >= limit));
                let is_sharp = joint.is_sharp || gauge.crease_angle.is_some_and(bends);
                let collector = if is_sharp { &mut sharp } else { &mut smooth };
                collector.take(BLOCK * block + k, &measured, gauge.worst);
                creases.push(is_sharp);
            }
        }
        let place = |Worst { value, joint, fraction }: &Worst| {
            let [at, beside] = sides(layout, &layout.joints()[*joint], FRACTIONS[*fraction]);
            let mut point = Samples::default();
            surface.evaluate(&[at], Derivatives::None, &mut point);
            let [at, beside] = [at, beside].map(|place| surface.address(place));
            JointPlace { value: *value, at, beside, position: point.position[0] }
        };
        let [smooth, sharp] = [smooth, sharp].map(|collector| collector.finish(gauge.worst, place));
        (Continuity { smooth, sharp, border: layout.border().count() }, creases)
    }
}

/// A place on a joint in both its faces.
fn sides(layout: &Layout, joint: &Joint, x: f64) -> [Location; 2] {
    let [a, b] = joint.sides;
    let square = |number: u32| &layout.squares()[number as usize];
    [square(a.square).on_side(a.side, x), square(b.square).on_side(b.side, 1.0 - x)]
}

/// One sample of many.
pub(super) fn jet(samples: &Samples, i: usize) -> LimitJet {
    let Samples { position, du, dv, normal, duu, duv, dvv, flags } = samples;
    let jet =
        SurfaceJet { position: position[i], du: du[i], dv: dv[i], duu: duu[i], duv: duv[i], dvv: dvv[i] };
    LimitJet { jet, normal: normal[i], flags: flags[i] }
}

/// The four numbers at one place; `None` where one does not exist.
#[derive(Clone, Copy, Debug)]
struct Measured {
    gap: f64,
    angle: Option<f64>,
    curvature: Option<f64>,
    kink: Option<f64>,
}

impl Measured {
    fn new([a, b]: [LimitJet; 2], gauge: &Gauge<'_>) -> Measured {
        let is_regular = |point: &LimitJet| point.normal != Vec3::ZERO;
        let angle = (is_regular(&a) && is_regular(&b)).then(|| a.normal.angle(b.normal).to_degrees());
        let curvature = a.curvature().zip(b.curvature()).map(|(a, b)| {
            let gap = (a.k1 - b.k1).abs().max((a.k2 - b.k2).abs());
            // Flatter than a ball of the size of the whole, differences are no longer relative to rounding.
            let largest = [a.k1, a.k2, b.k1, b.k2].into_iter().fold(1.0 / gauge.size, |l, k| l.max(k.abs()));
            gap / largest
        });
        let kink = line_tangent(&a, gauge.field).zip(line_tangent(&b, gauge.field)).map(|(a, b)| {
            let angle = a.angle(b).to_degrees();
            angle.min(180.0 - angle)
        });
        Measured { gap: a.jet.position.distance(b.jet.position), angle, curvature, kink }
    }
}

/// The unit direction of the level line of a field.
fn line_tangent(point: &LimitJet, field: &Field) -> Option<Vec3> {
    let jet = &point.jet;
    let field = field.jet(&NormalJet::of(jet)?)?;
    let along = field.du * jet.dv - field.dv * jet.du;
    let is_moving = along.length() > STILL * jet.du.cross(jet.dv).length();
    along.normalized().filter(|_| is_moving)
}

/// What is measured joint after joint.
#[derive(Default)]
struct Collector {
    count: usize,
    gap: Values,
    angle: Values,
    curvature: Values,
    kink: Values,
}

impl Collector {
    fn take(&mut self, joint: usize, measured: &[Measured; 5], worst: usize) {
        self.count += 1;
        self.gap.take(joint, measured.map(|m| Some(m.gap)), worst);
        self.angle.take(joint, measured.map(|m| m.angle), worst);
        self.curvature.take(joint, measured.map(|m| m.curvature), worst);
        self.kink.take(joint, measured.map(|m| m.kink), worst);
    }

    fn finish(self, worst: usize, place: impl Fn(&Worst) -> JointPlace) -> Joints {
        let Collector { count, gap, angle, curvature, kink } = self;
        let [gap, angle, curvature, kink] =
            [gap, angle, curvature, kink].map(|values| values.finish(worst, &place));
        Joints { count, gap, angle, curvature, kink }
    }
}

/// The worst place of a joint.
struct Worst {
    value: f64,
    joint: usize,
    /// Which of [`FRACTIONS`].
    fraction: usize,
}

/// One of the four numbers, place after place.
#[derive(Default)]
struct Values {
    all: Vec<f64>,
    worst: Vec<Worst>,
}

impl Values {
    fn take(&mut self, joint: usize, values: [Option<f64>; 5], worst: usize) {
        let values = values.map(|value| value.filter(|x| x.is_finite()));
        self.all.extend(values.iter().flatten());
        let mut found: Option<Worst> = None;
        for (fraction, value) in values.into_iter().enumerate() {
            if let Some(value) = value.filter(|&x| found.as_ref().is_none_or(|found| x > found.value)) {
                found = Some(Worst { value, joint, fraction });
            }
        }
        self.worst.extend(found);
        if self.worst.len() > 4 * worst + BLOCK {
            self.keep(worst);
        }
    }

    /// Drops all but the worst; of equals the first stay.
    fn keep(&mut self, worst: usize) {
        self.worst.sort_by(|a, b| b.value.total_cmp(&a.value).then(a.joint.cmp(&b.joint)));
        self.worst.truncate(worst);
    }

    fn finish(mut self, worst: usize, place: impl Fn(&Worst) -> JointPlace) -> Metric {
        self.keep(worst);
        let samples = self.all.len();
        let mean = self.all.iter().sum::<f64>() / samples.max(1) as f64;
        let max = self.all.iter().copied().fold(0.0, f64::max);
        let rank = (0.95 * samples as f64).ceil() as usize;
        let p95 = match rank {
            0 => 0.0,
            _ => *self.all.select_nth_unstable_by(rank - 1, f64::total_cmp).1,
        };
        Metric { samples, max, p95, mean, worst: self.worst.iter().map(place).collect() }
    }
}
