//! Exact arithmetic with fractions, modulo primes of 61 bits: an identity of integers that holds modulo primes whose product
//! exceeds both sides is true.
#![allow(unreachable_pub, reason = "shared by claims")]

/// The integers modulo a prime.
#[derive(Clone, Copy, Debug)]
pub struct Field(pub u64);

impl Field {
    pub fn add(self, a: u64, b: u64) -> u64 {
        (a + b) % self.0
    }

    pub fn sub(self, a: u64, b: u64) -> u64 {
        (a + self.0 - b) % self.0
    }

    pub fn mul(self, a: u64, b: u64) -> u64 {
        (u128::from(a) * u128::from(b) % u128::from(self.0)) as u64
    }

    pub fn pow(self, base: u64, mut exponent: u64) -> u64 {
        let (mut square, mut product) = (base, 1);
        while exponent > 0 {
            if exponent & 1 == 1 {
                product = self.mul(product, square);
            }
            square = self.mul(square, square);
            exponent >>= 1;
        }
        product
    }

    pub fn inverse(self, a: u64) -> u64 {
        assert!(a != 0, "zero has no inverse");
        self.pow(a, self.0 - 2)
    }

    pub fn integer(self, a: i128) -> u64 {
        a.rem_euclid(i128::from(self.0)) as u64
    }

    pub fn fraction(self, above: i128, below: i128) -> u64 {
        self.mul(self.integer(above), self.inverse(self.integer(below)))
    }

    pub fn dot(self, terms: impl Iterator<Item = (u64, u64)>) -> u64 {
        terms.fold(0, |sum, (a, b)| self.add(sum, self.mul(a, b)))
    }

    /// `x` with `matrix x = right`, several right sides at once.
    pub fn solve(self, mut matrix: Vec<Vec<u64>>, mut right: Vec<Vec<u64>>) -> Vec<Vec<u64>> {
        let size = matrix.len();
        for step in 0..size {
            let pivot = (step..size).find(|&i| matrix[i][step] != 0).expect("the matrix is regular");
            matrix.swap(step, pivot);
            right.swap(step, pivot);
            let inverse = self.inverse(matrix[step][step]);
            for x in matrix[step].iter_mut().chain(right[step].iter_mut()) {
                *x = self.mul(*x, inverse);
            }
            for i in (0..size).filter(|&i| i != step) {
                let factor = matrix[i][step];
                let (pivot_row, pivot_right) = (matrix[step].clone(), right[step].clone());
                for (x, p) in matrix[i].iter_mut().zip(pivot_row).chain(right[i].iter_mut().zip(pivot_right))
                {
                    *x = self.sub(*x, self.mul(factor, p));
                }
            }
        }
        right
    }

    /// Coefficients of `det(x - matrix)`, that of the highest power last: by Hessenberg's form.
    pub fn characteristic_polynomial(self, mut a: Vec<Vec<u64>>) -> Vec<u64> {
        let size = a.len();
        for k in 1..size.saturating_sub(1) {
            let Some(pivot) = (k..size).find(|&i| a[i][k - 1] != 0) else { continue };
            a.swap(k, pivot);
            a.iter_mut().for_each(|row| row.swap(k, pivot));
            let inverse = self.inverse(a[k][k - 1]);
            for i in k + 1..size {
                let factor = self.mul(a[i][k - 1], inverse);
                if factor == 0 {
                    continue;
                }
                let row = a[k].clone();
                for (x, p) in a[i].iter_mut().zip(row) {
                    *x = self.sub(*x, self.mul(factor, p));
                }
                for row in &mut a {
                    row[k] = self.add(row[k], self.mul(factor, row[i]));
                }
            }
        }
        let mut polynomials = vec![vec![1]];
        for k in 0..size {
            let mut next = vec![0; k + 2];
            for (d, &c) in polynomials[k].iter().enumerate() {
                next[d + 1] = self.add(next[d + 1], c);
                next[d] = self.sub(next[d], self.mul(a[k][k], c));
            }
            let mut below = 1;
            for i in (0..k).rev() {
                below = self.mul(below, a[i + 1][i]);
                let factor = self.mul(below, a[i][k]);
                for (d, &c) in polynomials[i].iter().enumerate() {
                    next[d] = self.sub(next[d], self.mul(factor, c));
                }
            }
            polynomials.push(next);
        }
        polynomials.swap_remove(size)
    }

    pub fn product(self, a: &[u64], b: &[u64]) -> Vec<u64> {
        let mut out = vec![0; a.len() + b.len() - 1];
        for (i, &x) in a.iter().enumerate() {
            for (j, &y) in b.iter().enumerate() {
                out[i + j] = self.add(out[i + j], self.mul(x, y));
            }
        }
        out
    }
}

/// The largest primes below `2^61`.
pub fn fields(count: usize) -> Vec<Field> {
    (0..1 << 61).rev().filter(|&n| is_prime(n)).take(count).map(Field).collect()
}

/// Miller and Rabin's test, with bases that leave no doubt below `2^64`.
fn is_prime(n: u64) -> bool {
    const BASES: [u64; 12] = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37];
    if BASES.iter().any(|&base| n.is_multiple_of(base)) {
        return BASES.contains(&n);
    }
    let field = Field(n);
    let shift = (n - 1).trailing_zeros();
    BASES.iter().all(|&base| {
        let mut x = field.pow(base, (n - 1) >> shift);
        x == 1
            || (0..shift).any(|_| {
                let found = x == n - 1;
                x = field.mul(x, x);
                found
            })
    })
}
