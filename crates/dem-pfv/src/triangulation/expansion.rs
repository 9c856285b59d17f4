//! Exact sums and products: a number as a sum of doubles that do not overlap.
//!
//! Source: Shewchuk 1997, Adaptive precision floating-point arithmetic and fast robust geometric
//! predicates, §2. Zero terms are dropped, so that small numbers stay short.

use std::cmp::Ordering;

/// a + b = sum + error, exactly (Knuth).
pub fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let virtual_b = sum - a;
    let virtual_a = sum - virtual_b;
    (sum, (a - virtual_a) + (b - virtual_b))
}

/// a b = product + error, exactly.
pub fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    (product, a.mul_add(b, -product))
}

/// A sum of doubles in order of size, least first, none zero.
#[derive(Clone, Debug, Default)]
pub struct Expansion(Vec<f64>);

impl Expansion {
    /// One double.
    pub fn new(x: f64) -> Self {
        Self::from_pair((x, 0.0))
    }

    fn from_pair((high, low): (f64, f64)) -> Self {
        Self([low, high].into_iter().filter(|x| *x != 0.0).collect())
    }

    /// a − b.
    pub fn difference(a: f64, b: f64) -> Self {
        Self::from_pair(two_sum(a, -b))
    }

    /// a b.
    pub fn product(a: f64, b: f64) -> Self {
        Self::from_pair(two_product(a, b))
    }

    /// The sum of both (Shewchuk, fast expansion sum).
    pub fn plus(&self, other: &Self) -> Self {
        self.merged(other, 1.0)
    }

    /// The difference of both.
    pub fn minus(&self, other: &Self) -> Self {
        self.merged(other, -1.0)
    }

    fn merged(&self, other: &Self, sign: f64) -> Self {
        let (a, b) = (&self.0, &other.0);
        let mut sum = Vec::with_capacity(a.len() + b.len());
        let (mut i, mut j) = (0, 0);
        let mut carry = 0.0;
        while i < a.len() || j < b.len() {
            let from_a = j == b.len() || (i < a.len() && a[i].abs() < b[j].abs());
            let next = if from_a { a[i] } else { sign * b[j] };
            if from_a {
                i += 1;
            } else {
                j += 1;
            }
            let (high, low) = two_sum(carry, next);
            carry = high;
            if low != 0.0 {
                sum.push(low);
            }
        }
        if carry != 0.0 {
            sum.push(carry);
        }
        Self(sum)
    }

    /// The expansion times a double (Shewchuk, scale expansion).
    pub fn scaled(&self, factor: f64) -> Self {
        let mut result = Vec::with_capacity(2 * self.0.len());
        let mut carry = 0.0;
        let mut keep = |x: f64| {
            if x != 0.0 {
                result.push(x);
            }
        };
        for &term in &self.0 {
            let (product, error) = two_product(term, factor);
            let (sum, low) = two_sum(carry, error);
            keep(low);
            // product outweighs the sum: a fast two-sum would do.
            let (high, low) = two_sum(product, sum);
            keep(low);
            carry = high;
        }
        keep(carry);
        Self(result)
    }

    /// The product of both.
    pub fn times(&self, other: &Self) -> Self {
        let less = self.0.len() < other.0.len();
        let (long, short) = if less { (other, self) } else { (self, other) };
        let mut terms = short.0.iter();
        let Some(&first) = terms.next() else {
            return Self::default();
        };
        terms.fold(long.scaled(first), |sum, &t| sum.plus(&long.scaled(t)))
    }

    /// Its sign: that of its largest term.
    pub fn sign(&self) -> Ordering {
        self.0.last().map_or(Ordering::Equal, |x| x.total_cmp(&0.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// a / 2³⁰ as an exact integer over 2⁶⁰ and so on: sums and products against i128.
    #[test]
    fn sums_and_products_are_those_of_integers() {
        let mut random = sph_core::SplitMix(7);
        let mut draw = || (random.next() >> 24) as i64 - (1 << 39);
        for _ in 0..2000 {
            let (a, b, c, d) = (draw(), draw(), draw(), draw());
            let big = |x: i64| Expansion::new(x as f64);
            // a b − c d − (a b − c d rounded away by one): the sign needs all bits.
            let exact = i128::from(a) * i128::from(b) - i128::from(c) * i128::from(d);
            let mut sum = big(a).times(&big(b)).minus(&big(c).times(&big(d)));
            let mut rest = exact;
            while rest != 0 {
                let part = rest as f64;
                sum = sum.minus(&Expansion::new(part));
                rest -= part as i128;
            }
            assert_eq!(sum.sign(), Ordering::Equal, "{a} {b} {c} {d}");
            assert_eq!(sum.plus(&Expansion::new(1e-300)).sign(), Ordering::Greater);
        }
    }

    #[test]
    fn a_product_of_long_expansions_is_exact() {
        let tiny = Expansion::new(1e-40);
        let one = Expansion::new(1.0);
        // (1 + t)(1 − t) = 1 − t²
        let left = one.plus(&tiny).times(&one.minus(&tiny));
        let right = one.minus(&tiny.times(&tiny));
        assert_eq!(left.minus(&right).sign(), Ordering::Equal);
        assert_eq!(left.minus(&one).sign(), Ordering::Less);
    }
}
