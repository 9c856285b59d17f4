//! Functions of time that prescribed motions follow.

use std::f64::consts::TAU;
use std::sync::Arc;

/// A displacement (m) or an angle (rad) over time, 0 at time 0.
#[derive(Clone, Debug, PartialEq)]
pub enum Course {
    /// s = v t.
    Steady {
        /// v, m/s or rad/s.
        speed: f64,
    },
    /// From rest to a speed with constant acceleration: s = v t²/(2T), from T on v (t − T/2).
    Ramp {
        /// v, m/s or rad/s.
        speed: f64,
        /// T, s.
        over: f64,
    },
    /// s = r(t) Σ a sin(ωt + φ) − r(0) Σ a sin φ, r rising smoothly (6x⁵ − 15x⁴ + 10x³) from 0 to 1.
    Sum {
        /// Shared by the pieces that a wall is drawn in.
        parts: Arc<[SinePart]>,
        /// Time in which r rises, s; 0 for r = 1 from the start.
        ramp: f64,
    },
    /// Values at instants less the first value, joined by the cubic whose slopes are those of the
    /// parabolas through three neighbouring values; at rest before the first and after the last.
    Table {
        /// Pairs of time, s, and value, ascending in time. Shared by the pieces that a wall is drawn in.
        rows: Arc<[[f64; 2]]>,
    },
}

/// One sine of a sum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SinePart {
    /// a, m or rad.
    pub amplitude: f64,
    /// ω, rad/s.
    pub frequency: f64,
    /// φ, rad.
    pub phase: f64,
}

/// Value, rate and second derivative of a course at one instant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Stage {
    /// s.
    pub value: f64,
    /// ds/dt.
    pub rate: f64,
    /// d²s/dt².
    pub acceleration: f64,
}

impl Stage {
    fn new(value: f64, rate: f64, acceleration: f64) -> Self {
        Stage {
            value,
            rate,
            acceleration,
        }
    }
}

/// A translation along a direction.
#[derive(Clone, Debug, PartialEq)]
pub struct Translation<const D: usize> {
    /// Displacement per unit of the course.
    pub along: [f64; D],
    /// The course, m where `along` is a unit vector.
    pub course: Course,
}

/// A rotation about a centre that is carried by the translations.
#[derive(Clone, Debug, PartialEq)]
pub struct Rotation<const D: usize> {
    /// Centre at time 0, m.
    pub centre: [f64; D],
    /// Axis, right-hand rule; ignored in two dimensions, where angles go counter-clockwise.
    pub axis: [f64; 3],
    /// The course, rad.
    pub course: Course,
}

impl Course {
    /// s = a [r(t) sin(2πt/T + φ) − r(0) sin φ] of an amplitude a, m or rad, a period T, s, a phase φ, rad, and the time in
    /// which r rises, s.
    pub fn sine(amplitude: f64, period: f64, phase: f64, ramp: f64) -> Self {
        let frequency = TAU / period;
        let part = SinePart {
            amplitude,
            frequency,
            phase,
        };
        let parts = [part].into();
        Self::Sum { parts, ramp }
    }

    /// True if it is a course at all: finite, with positive periods and ascending instants.
    pub fn is_sound(&self) -> bool {
        match self {
            Self::Steady { speed } => speed.is_finite(),
            Self::Ramp { speed, over } => speed.is_finite() && *over > 0.0 && over.is_finite(),
            Self::Sum { parts, ramp } => {
                let finite = |p: &SinePart| [p.amplitude, p.frequency, p.phase].map(f64::is_finite);
                let sound = |p: &SinePart| finite(p) == [true; 3] && p.frequency > 0.0;
                parts.iter().all(sound) && *ramp >= 0.0 && ramp.is_finite()
            }
            Self::Table { rows } => {
                rows.len() >= 2
                    && rows.iter().flatten().all(|x| x.is_finite())
                    && rows.windows(2).all(|w| w[0][0] < w[1][0])
            }
        }
    }

    /// True if it ever leaves 0.
    pub fn moves(&self) -> bool {
        match self {
            Self::Steady { speed } | Self::Ramp { speed, .. } => *speed != 0.0,
            Self::Sum { parts, .. } => parts.iter().any(|p| p.amplitude != 0.0),
            Self::Table { rows } => rows.windows(2).any(|w| w[0][1] != w[1][1]),
        }
    }

    /// The middle of the steepest interval of a table, s; none of other courses, which have no jumps.
    pub fn steepest(&self) -> Option<f64> {
        let Self::Table { rows } = self else {
            return None;
        };
        let slope = |w: &[[f64; 2]]| ((w[1][1] - w[0][1]) / (w[1][0] - w[0][0])).abs();
        let steepest = rows.windows(2).max_by(|a, b| slope(a).total_cmp(&slope(b)));
        steepest.map(|w| 0.5 * (w[0][0] + w[1][0]))
    }

    /// Value and derivatives at a time ≥ 0.
    pub fn at(&self, t: f64) -> Stage {
        match self {
            Self::Steady { speed } => Stage::new(speed * t, *speed, 0.0),
            Self::Ramp { speed, over } if t < *over => {
                Stage::new(0.5 * speed * t * t / over, speed * t / over, speed / over)
            }
            Self::Ramp { speed, over } => Stage::new(speed * (t - 0.5 * over), *speed, 0.0),
            Self::Sum { parts, ramp } => sines(parts, *ramp, t),
            Self::Table { rows } => along(rows, t),
        }
    }
}

/// A sum of sines that rises smoothly, less its value at the start.
fn sines(parts: &[SinePart], ramp: f64, t: f64) -> Stage {
    let [r, dr, ddr] = rise(t, ramp);
    let [first, ..] = rise(0.0, ramp);
    let mut stage = Stage::default();
    for part in parts {
        let (a, omega) = (part.amplitude, part.frequency);
        let (sine, cosine) = (omega * t + part.phase).sin_cos();
        stage.value += a * (r * sine - first * part.phase.sin());
        stage.rate += a * (dr * sine + r * omega * cosine);
        stage.acceleration +=
            a * (ddr * sine + 2.0 * dr * omega * cosine - r * omega * omega * sine);
    }
    stage
}

fn rise(t: f64, over: f64) -> [f64; 3] {
    if t >= over {
        return [1.0, 0.0, 0.0];
    }
    let x = t / over;
    [
        x * x * x * (10.0 + x * (6.0 * x - 15.0)),
        30.0 * x * x * (1.0 - x) * (1.0 - x) / over,
        60.0 * x * (1.0 - x) * (1.0 - 2.0 * x) / (over * over),
    ]
}

fn along(rows: &[[f64; 2]], t: f64) -> Stage {
    let (Some(first), Some(last)) = (rows.first(), rows.last()) else {
        return Stage::default();
    };
    if t <= first[0] {
        return Stage::default();
    }
    if t >= last[0] {
        return Stage::new(last[1] - first[1], 0.0, 0.0);
    }
    let k = rows.partition_point(|row| row[0] <= t) - 1;
    let ([t0, s0], [t1, s1]) = (rows[k], rows[k + 1]);
    let (dt, x) = (t1 - t0, (t - t0) / (t1 - t0));
    let (m0, m1) = (slope(rows, k) * dt, slope(rows, k + 1) * dt);
    // s0 + m0 x + b x² + a x³ with the given slopes at both ends.
    let rise = s1 - s0;
    let b = 3.0 * rise - 2.0 * m0 - m1;
    let a = m0 + m1 - 2.0 * rise;
    let value = s0 - first[1] + x * (m0 + x * (b + x * a));
    let rate = (m0 + x * (2.0 * b + x * 3.0 * a)) / dt;
    Stage::new(value, rate, (2.0 * b + 6.0 * a * x) / (dt * dt))
}

/// Slope of the parabola through a row and its neighbours; 0 at both ends, where the rest begins.
fn slope(rows: &[[f64; 2]], k: usize) -> f64 {
    if k == 0 || k + 1 == rows.len() {
        return 0.0;
    }
    let [before, here, after] = [rows[k - 1], rows[k], rows[k + 1]];
    let (h0, h1) = (here[0] - before[0], after[0] - here[0]);
    let (d0, d1) = ((here[1] - before[1]) / h0, (after[1] - here[1]) / h1);
    (d0 * h1 + d1 * h0) / (h0 + h1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivatives_are_those_of_the_value() {
        let rows = [[0.0, 0.0], [0.3, 0.1], [0.5, 0.4], [1.2, 0.2], [2.0, 0.9]].into();
        let courses = [
            Course::Steady { speed: 0.7 },
            Course::Ramp {
                speed: -1.3,
                over: 0.8,
            },
            Course::sine(0.2, 1.3, 0.4, 1.1),
            Course::Sum {
                parts: [[0.1, 4.0, 0.3], [0.05, 9.0, -1.0]]
                    .map(|[amplitude, frequency, phase]| SinePart {
                        amplitude,
                        frequency,
                        phase,
                    })
                    .into(),
                ramp: 0.9,
            },
            Course::Table { rows },
        ];
        for course in &courses {
            assert!(course.is_sound() && course.moves());
            for t in [0.11, 0.41, 0.77, 0.95, 1.5, 1.93] {
                let h = 1e-5;
                let [before, here, after] = [t - h, t, t + h].map(|t| course.at(t));
                let rate = (after.value - before.value) / (2.0 * h);
                let acceleration = (after.rate - before.rate) / (2.0 * h);
                assert!((rate - here.rate).abs() < 1e-8, "{course:?} at {t}");
                assert!(
                    (acceleration - here.acceleration).abs() < 1e-6,
                    "{course:?} at {t}: {acceleration} {}",
                    here.acceleration
                );
            }
        }
    }

    #[test]
    fn courses_start_from_zero_and_tables_end_at_rest() {
        let sine = Course::sine(2.0, 1.0, 1.0, 0.0);
        assert_eq!(sine.at(0.0).value, 0.0);
        let table = Course::Table {
            rows: [[0.5, 0.0], [1.0, 3.0]].into(),
        };
        assert_eq!(table.at(0.2), Stage::default());
        assert_eq!(table.at(7.0).value, 3.0);
        assert_eq!(table.at(7.0).rate, 0.0);
        // A cubic is met exactly at its instants, a parabola everywhere between inner rows.
        let parabola: Arc<[_]> = (0..6).map(|k| k as f64).map(|t| [t, t * t]).collect();
        let table = Course::Table { rows: parabola };
        assert!((table.at(2.25).value - 2.25 * 2.25).abs() < 1e-14);
    }

    #[test]
    fn unsound_courses_are_told() {
        let table = |rows: Vec<[f64; 2]>| Course::Table { rows: rows.into() };
        assert!(!table(vec![[0.0, 0.0]]).is_sound());
        assert!(!table(vec![[0.0, 0.0], [0.0, 1.0]]).is_sound());
        assert!(
            !Course::Ramp {
                speed: 1.0,
                over: 0.0
            }
            .is_sound()
        );
        assert!(!Course::Steady { speed: f64::NAN }.is_sound());
    }
}
