//! Force and moment of the fluid on a wall.

use sph_core::Vect;

/// Force and moment of the fluid on one wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WallForce<const D: usize> {
    /// F = −Σ m a_w over the particles, a_w being the part of the acceleration that the wall contributes, N (N/m in two
    /// dimensions). The momentum of the fluid changes by the weight and −ΣF, to rounding.
    pub force: Vect<D>,
    /// −Σ r × m a_w about the origin, N m; only the last component in two dimensions.
    pub moment: [f64; 3],
    /// −Σ p_s S_s n_s over the wall's elements, N: the pressure integral; 0 without elements.
    pub pressure_force: Vect<D>,
    /// −Σ r_s × p_s S_s n_s over the wall's elements, N m.
    pub pressure_moment: [f64; 3],
    /// Depth of the fluid before the wall, m; 0 without fluid or without a mover that [asks for it](crate::DepthGauge).
    pub depth: f64,
}

impl<const D: usize> WallForce<D> {
    /// The same number for force and moment: NaN for a force that was not measured.
    pub(crate) fn repeat(number: f64) -> Self {
        WallForce {
            force: Vect::repeat(number),
            moment: [number; 3],
            pressure_force: Vect::repeat(number),
            pressure_moment: [number; 3],
            depth: 0.0,
        }
    }

    /// No force.
    pub fn zero() -> Self {
        Self::repeat(0.0)
    }

    /// A force on a wall at a place, N, and its moment about the origin, N m: the summands of
    /// [`from_sums`](Self::from_sums).
    pub fn parts(place: &Vect<D>, force: &Vect<D>) -> [f64; 6] {
        let mut both = [0.0; 6];
        both[..D].copy_from_slice(force.as_slice());
        both[3..].copy_from_slice(&cross(place, force));
        both
    }

    /// The force and the moment that [`parts`](Self::parts) add up to.
    pub fn from_sums(sums: [f64; 6]) -> Self {
        WallForce {
            force: Vect::from_fn(|k, _| sums[k]),
            moment: [sums[3], sums[4], sums[5]],
            ..Self::zero()
        }
    }

    /// All its numbers, for files.
    pub fn numbers(&self) -> Vec<f64> {
        let (force, pressure) = (self.force.iter(), self.pressure_force.iter());
        let both = force.chain(&self.moment).chain(pressure);
        let both = both.chain(&self.pressure_moment);
        both.chain([&self.depth]).copied().collect()
    }

    /// Number of [`numbers`](Self::numbers) of a force.
    pub const NUMBERS: usize = 2 * D + 7;

    /// From its numbers, of which there are [`NUMBERS`](Self::NUMBERS); zero where some are missing.
    pub fn from_numbers(numbers: &[f64]) -> Self {
        let at = |k: usize| numbers.get(k).copied().unwrap_or(0.0);
        WallForce {
            force: Vect::from_fn(|k, _| at(k)),
            moment: std::array::from_fn(|k| at(D + k)),
            pressure_force: Vect::from_fn(|k, _| at(D + 3 + k)),
            pressure_moment: std::array::from_fn(|k| at(2 * D + 3 + k)),
            depth: at(2 * D + 6),
        }
    }

    /// Adds the force and the moment of something else on the same wall.
    pub fn add(&mut self, other: &Self) {
        self.force += other.force;
        self.pressure_force += other.pressure_force;
        add_moment(&mut self.moment, other.moment);
        add_moment(&mut self.pressure_moment, other.pressure_moment);
        self.depth += other.depth;
    }
}

/// r × f; the third component alone in two dimensions.
pub fn cross<const D: usize>(r: &Vect<D>, f: &Vect<D>) -> [f64; 3] {
    let at = |v: &Vect<D>, k: usize| v.get(k).copied().unwrap_or(0.0);
    [
        at(r, 1) * at(f, 2) - at(r, 2) * at(f, 1),
        at(r, 2) * at(f, 0) - at(r, 0) * at(f, 2),
        at(r, 0) * at(f, 1) - at(r, 1) * at(f, 0),
    ]
}

fn add_moment(sum: &mut [f64; 3], more: [f64; 3]) {
    sum.iter_mut().zip(more).for_each(|(s, m)| *s += m);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_give_the_force_back() {
        let force = WallForce::<3> {
            force: Vect::<3>::new(1.0, 2.0, 3.0),
            moment: [4.0, 5.0, 6.0],
            pressure_force: Vect::<3>::new(7.0, 8.0, 9.0),
            pressure_moment: [10.0, 11.0, 12.0],
            depth: 13.0,
        };
        let numbers = force.numbers();
        assert_eq!(numbers.len(), WallForce::<3>::NUMBERS);
        assert_eq!(WallForce::from_numbers(&numbers), force);
    }
}
