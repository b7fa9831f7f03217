//! Numbers of about 106 bits, as the unevaluated sum of two `f64`: Dekker (1971), with fused multiply-add.
#![allow(dead_code, unreachable_pub, reason = "each claim uses a part of it")]

use std::ops::{Add, Div, Mul, Neg, Sub};

/// What the reference computes with: these numbers, or plain ones to see what they are for.
pub trait Number:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// Exactly this.
    fn exact(value: f64) -> Self;
    /// Rounded.
    fn rounded(self) -> f64;
}

impl Number for f64 {
    fn exact(value: f64) -> f64 {
        value
    }
    fn rounded(self) -> f64 {
        self
    }
}

/// `high + low`, `low` at most half a unit in the last place of `high`.
#[derive(Clone, Copy, Debug)]
pub struct DoubleDouble {
    high: f64,
    low: f64,
}

/// The sum and what rounding took from it.
fn two_sum(a: f64, b: f64) -> DoubleDouble {
    let high = a + b;
    let part = high - a;
    DoubleDouble { high, low: (a - (high - part)) + (b - part) }
}

impl DoubleDouble {
    fn normal(high: f64, low: f64) -> DoubleDouble {
        let sum = high + low;
        DoubleDouble { high: sum, low: low - (sum - high) }
    }

    fn times(self, b: f64) -> DoubleDouble {
        let high = self.high * b;
        DoubleDouble::normal(high, self.high.mul_add(b, -high) + self.low * b)
    }
}

impl Number for DoubleDouble {
    fn exact(value: f64) -> DoubleDouble {
        DoubleDouble { high: value, low: 0.0 }
    }
    fn rounded(self) -> f64 {
        self.high
    }
}

impl Add for DoubleDouble {
    type Output = DoubleDouble;
    fn add(self, other: DoubleDouble) -> DoubleDouble {
        let (high, low) = (two_sum(self.high, other.high), two_sum(self.low, other.low));
        let sum = DoubleDouble::normal(high.high, high.low + low.high);
        DoubleDouble::normal(sum.high, sum.low + low.low)
    }
}

impl Neg for DoubleDouble {
    type Output = DoubleDouble;
    fn neg(self) -> DoubleDouble {
        DoubleDouble { high: -self.high, low: -self.low }
    }
}

impl Sub for DoubleDouble {
    type Output = DoubleDouble;
    fn sub(self, other: DoubleDouble) -> DoubleDouble {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = DoubleDouble;
    fn mul(self, other: DoubleDouble) -> DoubleDouble {
        let high = self.high * other.high;
        let error = self.high.mul_add(other.high, -high);
        DoubleDouble::normal(high, error + (self.high * other.low + self.low * other.high))
    }
}

impl Div for DoubleDouble {
    type Output = DoubleDouble;
    fn div(self, other: DoubleDouble) -> DoubleDouble {
        let first = self.high / other.high;
        let rest = self - other.times(first);
        let second = rest.high / other.high;
        let third = (rest - other.times(second)).high / other.high;
        DoubleDouble::normal(first, second) + DoubleDouble::exact(third)
    }
}

#[test]
fn has_a_hundred_bits() {
    let third = DoubleDouble::exact(1.0) / DoubleDouble::exact(3.0);
    let error = third + third + third - DoubleDouble::exact(1.0);
    assert!(error.rounded().abs() < 1e-31);
    // (1 + e)(1 - e) = 1 - e^2, of which plain numbers see nothing.
    let e = 1e-10_f64;
    let product = DoubleDouble { high: 1.0, low: e * 1e-10 } * DoubleDouble { high: 1.0, low: -e * 1e-10 };
    assert!((product - DoubleDouble::exact(1.0)).rounded().abs() < 1e-31);
    let (a, b) = (DoubleDouble::exact(1.0 + e), DoubleDouble::exact(1.0 - e));
    let difference = (a * b - DoubleDouble::exact(1.0)).rounded();
    let (above, below) = ((1.0 + e) - 1.0, (1.0 - e) - 1.0);
    assert!((difference - (above + below + above * below)).abs() < 1e-31);
    let quotient = a / b * b - a;
    assert!(quotient.rounded().abs() < 1e-31);
}
