//! Changes of gravity.

use sph_boundary::{Course, RigidMotion};
use sph_core::Vect;

/// Gravity over time, without what is steady of it.
pub struct VariableGravity<const D: usize> {
    /// Motion of the frame.
    pub frame: RigidMotion<D>,
    /// Addition to gravity.
    pub given: AddedGravity<D>,
}

/// Addition to gravity over time.
pub enum AddedGravity<const D: usize> {
    /// Nothing.
    None,
    /// a·r(t)·sin(2πt/T + φ): amplitude, m/s², and course of amplitude 1 with its value at time 0.
    Sine(Vect<D>, Course, f64),
    /// Times, s, and what is added then, m/s².
    Rows(Vec<(f64, Vect<D>)>),
}

impl<const D: usize> VariableGravity<D> {
    /// Addition to gravity at a time (s), m/s².
    pub fn at(&self, time: f64) -> Vect<D> {
        self.given.at(time) - self.frame.state(time).acceleration
    }
}

impl<const D: usize> AddedGravity<D> {
    fn at(&self, time: f64) -> Vect<D> {
        match self {
            AddedGravity::None => Vect::zeros(),
            AddedGravity::Sine(amplitude, course, first) => {
                amplitude * (course.at(time).value + first)
            }
            AddedGravity::Rows(rows) => {
                let after = rows.partition_point(|row| row.0 <= time);
                let before = &rows[after.saturating_sub(1)];
                match rows.get(after).filter(|_| after > 0) {
                    None => before.1,
                    Some(next) => {
                        let share = (time - before.0) / (next.0 - before.0);
                        before.1 + (next.1 - before.1) * share
                    }
                }
            }
        }
    }
}
