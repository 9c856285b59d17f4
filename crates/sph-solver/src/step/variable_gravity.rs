//! Changes of gravity.

use sph_boundary::{Course, RigidMotion};
use sph_core::Vect;

/// Gravity over time, without its steady part.
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
    /// Times, s, and the acceleration that is added then, m/s².
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
                        before.1 + (next.1 - before.1) * ((time - before.0) / (next.0 - before.0))
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use sph_boundary::{Rotation, Translation};

    use super::*;

    const AT_REST: VariableGravity<2> = VariableGravity {
        frame: RigidMotion {
            translations: Vec::new(),
            rotation: None,
            bend: None,
            bed: None,
            start: 0.0,
            stop: f64::INFINITY,
        },
        given: AddedGravity::None,
    };

    /// The course is less its value at time 0, which `first` gives back.
    #[test]
    fn a_sine_is_that_of_its_phase_from_the_start() {
        let (period, phase) = (1.3, 0.7_f64);
        let course = Course::sine(1.0, period, phase, 0.0);
        let amplitude = Vect::<2>::new(3.0, -0.5);
        let swing = VariableGravity {
            given: AddedGravity::Sine(amplitude, course, phase.sin()),
            ..AT_REST
        };
        for t in [0.0, 0.2, 1.0, 7.7] {
            let exact = amplitude * (TAU * t / period + phase).sin();
            // The phase of 38 rad is known to 10⁻¹⁴.
            assert!((swing.at(t) - exact).norm() < 1e-13, "{t}");
        }
    }

    #[test]
    fn rows_are_joined_by_lines_and_kept_beyond_the_ends() {
        let row = |t, a| (t, Vect::<2>::new(a, -2.0 * a));
        let swing = VariableGravity {
            given: AddedGravity::Rows(vec![row(1.0, 2.0), row(3.0, 6.0), row(4.0, 0.0)]),
            ..AT_REST
        };
        for (t, a) in [
            (0.0, 2.0),
            (1.0, 2.0),
            (1.5, 3.0),
            (3.0, 6.0),
            (3.75, 1.5),
            (9.0, 0.0),
        ] {
            assert_eq!(swing.at(t), row(t, a).1, "at {t} s");
        }
    }

    /// d'Alembert: in a frame that accelerates by a, gravity is less by a. The centre of a steady turn does not
    /// accelerate.
    #[test]
    fn the_frame_takes_its_acceleration_from_gravity() {
        let (speed, over) = (2.0, 0.5);
        let mut swing = AT_REST;
        swing.frame.translations = vec![Translation {
            along: [0.6, 0.8],
            course: Course::Ramp { speed, over },
        }];
        let during = Vect::<2>::new(-0.6, -0.8) * (speed / over);
        assert!((swing.at(0.3) - during).norm() < 1e-14);
        assert_eq!(swing.at(0.6), Vect::<2>::zeros());
        swing.frame = RigidMotion {
            rotation: Some(Rotation {
                centre: [0.0; 2],
                axis: [0.0; 3],
                course: Course::Steady { speed: 5.0 },
            }),
            ..RigidMotion::default()
        };
        assert_eq!(swing.at(0.3), Vect::<2>::zeros());
    }
}
