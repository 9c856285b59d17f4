//! Memory of faces from step to step, as plain numbers: in checkpoints, and taken back with a step that fails.

use sph_core::Vect;

/// A sum without the rounding of its many small parts (Neumaier 1974).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Sum {
    sum: f64,
    lost: f64,
}

impl Sum {
    pub fn add(&mut self, x: f64) {
        let next = self.sum + x;
        self.lost += match self.sum.abs() >= x.abs() {
            true => (self.sum - next) + x,
            false => (x - next) + self.sum,
        };
        self.sum = next;
    }

    pub fn value(&self) -> f64 {
        self.sum + self.lost
    }
}

/// Mass of a phase that has passed a face, kg.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Totals {
    pub entered: Sum,
    pub left: Sum,
    /// Mass of the particles that were born at the face and that died there.
    pub born: Sum,
    pub died: Sum,
}

/// Volumes at the reference density, m³, into the fluid.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Volumes {
    pub asked: Sum,
    pub passed: Sum,
    /// When no fluid was before it first, s.
    pub dry: Option<f64>,
}

impl Volumes {
    /// The requested and the passed volume, m³.
    pub fn volumes(&self) -> [f64; 2] {
        [self.asked, self.passed].map(|sum| sum.value())
    }
}

/// The memory of all faces.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Memory<const D: usize> {
    /// Mass at every port of every phase, kg, phases innermost.
    pub mass: Vec<f64>,
    /// Running means of pressures, Pa, and velocities, m/s.
    pub mean: Vec<(f64, Vect<D>)>,
    /// Pressures, Pa, and velocities, m/s, in front of the elements, as late as they arrive at the face.
    pub arrived: Vec<(f64, Vect<D>)>,
    /// Slow pressures of the elements, Pa: those to which rows have arranged themselves.
    pub slow: Vec<f64>,
    /// Slow normal velocities with which fluid passes the elements, m/s.
    pub current: Vec<f64>,
    /// By face and phase.
    pub totals: Vec<Totals>,
    /// By face.
    pub volumes: Vec<Volumes>,
    /// The last step, s; 0 before the first.
    pub dt: f64,
}

const PER_TOTAL: usize = 8;
const PER_FACE: usize = 5;
/// In the place of a time that has not come.
const NEVER: f64 = -1.0;

impl<const D: usize> Memory<D> {
    pub fn new(ports: usize, phases: usize, faces: usize) -> Self {
        Memory {
            mass: vec![0.0; ports * phases],
            mean: vec![(0.0, Vect::zeros()); ports],
            arrived: vec![(0.0, Vect::zeros()); ports],
            slow: vec![0.0; ports],
            current: vec![0.0; ports],
            totals: vec![Totals::default(); faces * phases],
            volumes: vec![Volumes::default(); faces],
            dt: 0.0,
        }
    }

    /// Number of values.
    pub fn count(&self) -> usize {
        let of_faces = PER_TOTAL * self.totals.len() + PER_FACE * self.volumes.len();
        self.mass.len() + (2 * (D + 1) + 2) * self.mean.len() + of_faces + 1
    }

    /// All of it.
    pub fn numbers(&self, to: &mut Vec<f64>) {
        to.extend(&self.mass);
        for (pressure, velocity) in self.mean.iter().chain(&self.arrived) {
            to.push(*pressure);
            to.extend(velocity.iter());
        }
        to.extend(&self.slow);
        to.extend(&self.current);
        for t in &self.totals {
            for sum in [t.entered, t.left, t.born, t.died] {
                to.extend([sum.sum, sum.lost]);
            }
        }
        for v in &self.volumes {
            for sum in [v.asked, v.passed] {
                to.extend([sum.sum, sum.lost]);
            }
            to.push(v.dry.unwrap_or(NEVER));
        }
        to.push(self.dt);
    }

    /// Takes the values of [`numbers`](Self::numbers); returns whether it could.
    pub fn put_back(&mut self, from: &[f64]) -> bool {
        if from.len() != self.count() || from.iter().any(|x| !x.is_finite()) {
            return false;
        }
        let (mass, rest) = from.split_at(self.mass.len());
        let (mean, rest) = rest.split_at((D + 1) * self.mean.len());
        let (arrived, rest) = rest.split_at((D + 1) * self.arrived.len());
        let (slow, rest) = rest.split_at(self.slow.len());
        self.mass.copy_from_slice(mass);
        self.slow.copy_from_slice(slow);
        let (current, rest) = rest.split_at(self.current.len());
        self.current.copy_from_slice(current);
        let both = |to: &mut [(f64, Vect<D>)], from: &[f64]| {
            let all = to.iter_mut().zip(from.chunks_exact(D + 1));
            all.for_each(|(to, from)| *to = (from[0], Vect::from_column_slice(&from[1..])));
        };
        both(&mut self.mean, mean);
        both(&mut self.arrived, arrived);
        let sum = |n: &[f64], k: usize| Sum {
            sum: n[k],
            lost: n[k + 1],
        };
        let (totals, rest) = rest.split_at(PER_TOTAL * self.totals.len());
        for (t, n) in self.totals.iter_mut().zip(totals.chunks_exact(PER_TOTAL)) {
            *t = Totals {
                entered: sum(n, 0),
                left: sum(n, 2),
                born: sum(n, 4),
                died: sum(n, 6),
            };
        }
        for (v, n) in self.volumes.iter_mut().zip(rest.chunks_exact(PER_FACE)) {
            *v = Volumes {
                asked: sum(n, 0),
                passed: sum(n, 2),
                dry: (n[4] >= 0.0).then_some(n[4]),
            };
        }
        self.dt = from[from.len() - 1];
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_memory_comes_back_from_its_numbers() {
        let mut memory = Memory::<2>::new(2, 2, 1);
        memory.mass = vec![1.0, 2.0, 3.0, 4.0];
        memory.mean[1] = (12.0, Vect::<2>::new(5.0, 6.0));
        memory.arrived[0] = (9.0, Vect::<2>::new(10.0, 11.0));
        memory.slow[1] = 12.5;
        memory.current[0] = 13.0;
        memory.totals[1].left.add(7.0);
        memory.volumes[0].passed.add(14.0);
        memory.volumes[0].dry = Some(15.0);
        memory.dt = 8.0;
        let mut numbers = Vec::new();
        memory.numbers(&mut numbers);
        assert_eq!(numbers.len(), memory.count());
        let mut other = Memory::new(2, 2, 1);
        assert!(other.put_back(&numbers));
        assert_eq!(other, memory);
        assert!(!other.put_back(&numbers[1..]));
    }

    #[test]
    fn a_sum_of_a_million_small_parts_does_not_round() {
        let mut sum = Sum::default();
        sum.add(1e6);
        (0..1_000_000).for_each(|_| sum.add(1e-11));
        assert!(
            (sum.value() - 1e6 - 1e-5).abs() < 1e-9 * 1e-5 + 1.2e-10,
            "{}",
            sum.value() - 1e6
        );
    }
}
