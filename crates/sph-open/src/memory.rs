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

    fn each(&mut self, visit: &mut impl FnMut(&mut f64)) {
        visit(&mut self.sum);
        visit(&mut self.lost);
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

    /// Calls a function with every value, in the order in which they are saved.
    fn each(&mut self, mut visit: impl FnMut(&mut f64)) {
        self.mass.iter_mut().for_each(&mut visit);
        for (pressure, velocity) in self.mean.iter_mut().chain(&mut self.arrived) {
            visit(pressure);
            velocity.iter_mut().for_each(&mut visit);
        }
        let slow = self.slow.iter_mut().chain(&mut self.current);
        slow.for_each(&mut visit);
        for t in &mut self.totals {
            for sum in [&mut t.entered, &mut t.left, &mut t.born, &mut t.died] {
                sum.each(&mut visit);
            }
        }
        for v in &mut self.volumes {
            v.asked.each(&mut visit);
            v.passed.each(&mut visit);
            let mut dry = v.dry.unwrap_or(NEVER);
            visit(&mut dry);
            v.dry = (dry >= 0.0).then_some(dry);
        }
        visit(&mut self.dt);
    }

    /// Number of values.
    pub fn count(&mut self) -> usize {
        let mut count = 0;
        self.each(|_| count += 1);
        count
    }

    /// All of it.
    pub fn numbers(&mut self, to: &mut Vec<f64>) {
        self.each(|x| to.push(*x));
    }

    /// Takes the values of [`numbers`](Self::numbers); returns whether it could.
    pub fn put_back(&mut self, from: &[f64]) -> bool {
        let fits = from.len() == self.count() && from.iter().all(|x| x.is_finite());
        if fits {
            let mut from = from.iter();
            self.each(|x| *x = *from.next().unwrap_or(x));
        }
        fits
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
        let error = sum.value() - 1e6 - 1e-5;
        assert!(error.abs() < 1e-9 * 1e-5 + 1.2e-10, "{error}");
    }
}
