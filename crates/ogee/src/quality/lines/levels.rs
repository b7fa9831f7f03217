//! `Levels`: the values whose lines are wanted.

use super::LinesError;

/// The values whose lines are wanted.
#[derive(Clone, Debug, PartialEq)]
pub enum Levels {
    /// `first + j period` for every whole `j`, which is the index of its lines.
    Every {
        /// The value of index 0.
        first: f64,
        /// From one value to the next, above 0.
        period: f64,
    },
    /// These, rising; the index of a line is the place of its value in the list.
    Listed(Vec<f64>),
}

/// Indices beyond this cannot be told apart by their values.
const FARTHEST: f64 = 1e12;

impl Levels {
    /// Refuses what is no set of values.
    pub(super) fn check(&self) -> Result<(), LinesError> {
        match self {
            Levels::Every { first, period } => {
                let is_sound = first.is_finite() && *period > 0.0 && period.is_finite();
                is_sound.then_some(()).ok_or(LinesError::Period { period: *period })
            }
            Levels::Listed(values) => {
                let is_sound = values.iter().all(|value| value.is_finite())
                    && values.windows(2).all(|pair| pair[0] < pair[1])
                    && !values.is_empty();
                is_sound.then_some(()).ok_or(LinesError::Listed)
            }
        }
    }

    /// All values less a little.
    pub(super) fn lowered(&self, by: f64) -> Levels {
        match self {
            Levels::Every { first, period } => Levels::Every { first: first - by, period: *period },
            Levels::Listed(values) => Levels::Listed(values.iter().map(|value| value - by).collect()),
        }
    }

    /// The value of an index.
    #[inline]
    pub(super) fn value(&self, index: i64) -> f64 {
        match self {
            Levels::Every { first, period } => first + index as f64 * period,
            Levels::Listed(values) => values[index as usize],
        }
    }

    /// How many values there may be in `[low, high]`, give or take one at either end. Quick, and never too large to say.
    pub(super) fn count(&self, low: f64, high: f64) -> f64 {
        match self {
            Levels::Every { period, .. } => (high - low) / period,
            Levels::Listed(values) => values.len() as f64,
        }
    }

    /// The indices of all values in `(low, high]`: those that a rise from `low` to `high` meets, as what is at the value
    /// counts as above it. Empty where values are too far out to be told apart.
    pub(super) fn between(&self, low: f64, high: f64) -> std::ops::Range<i64> {
        match self {
            Levels::Every { first, period } => {
                // Rounding may be wrong by one: the values themselves decide.
                let above = |x: f64| {
                    let mut index = ((x - first) / period).floor() as i64;
                    while self.value(index) > x {
                        index -= 1;
                    }
                    while self.value(index + 1) <= x {
                        index += 1;
                    }
                    index + 1
                };
                let is_near = |x: f64| ((x - first) / period).abs() < FARTHEST;
                if is_near(low) && is_near(high) { above(low)..above(high) } else { 0..0 }
            }
            Levels::Listed(values) => {
                let above = |x: f64| values.partition_point(|&value| value <= x) as i64;
                above(low)..above(high)
            }
        }
    }

    /// The least distance between neighbours of which one is in `[low, high]`; infinite for a single value.
    pub(super) fn spacing(&self, low: f64, high: f64) -> f64 {
        match self {
            Levels::Every { period, .. } => *period,
            Levels::Listed(values) => {
                let start = values.partition_point(|&value| value < low).saturating_sub(1);
                let end = (values.partition_point(|&value| value <= high) + 1).min(values.len());
                values[start..end].windows(2).map(|pair| pair[1] - pair[0]).fold(f64::INFINITY, f64::min)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_met_between_two_values_has_one_end_open() {
        let every = Levels::Every { first: 0.125, period: 0.25 };
        assert_eq!(every.between(0.125, 0.625), 1..3);
        assert_eq!(every.between(0.0, 0.125), 0..1);
        assert_eq!(every.between(-0.875, -0.4), -3..-2);
        assert!(every.between(0.13, 0.3).is_empty());
        assert!(every.between(0.0, 1e300).is_empty());
        let listed = Levels::Listed(vec![-1.0, 0.5, 0.75]);
        assert_eq!(listed.between(-1.0, 0.5), 1..2);
        assert_eq!(listed.between(-9.0, 9.0), 0..3);
        assert_eq!((listed.spacing(0.6, 0.7), listed.spacing(-2.0, -1.5)), (0.25, f64::INFINITY));
    }

    #[test]
    fn senseless_values_are_refused() {
        for period in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(Levels::Every { first: 0.0, period }.check().is_err());
        }
        assert!(Levels::Every { first: f64::NAN, period: 1.0 }.check().is_err());
        for values in [vec![], vec![1.0, 0.0], vec![0.0, 0.0], vec![f64::NAN]] {
            assert!(Levels::Listed(values).check().is_err());
        }
    }
}
