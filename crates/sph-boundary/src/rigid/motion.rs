//! Prescribed motion of walls: rigid, or by a change of their shape.

use std::sync::Arc;

#[cfg(feature = "plugins")]
use sph_core::Vect;
use sph_core::bed::Bed;
use sph_core::course::{Course, Rotation, Stage, Translation};

use crate::Pose;
use crate::geometry::vector::{along, unit};
#[cfg(feature = "plugins")]
use crate::{Movement, RigidState};

/// Translations and a rotation between two times; at rest before and after.
#[derive(Clone, Debug, PartialEq)]
pub struct RigidMotion<const D: usize = 2> {
    /// Translations, added up.
    pub translations: Vec<Translation<D>>,
    /// Rotation.
    pub rotation: Option<Rotation<D>>,
    /// Bending of the wall; it counts its time from 0. It leaves the wall where translations and rotation put it, so
    /// have one or the other.
    pub bend: Option<Arc<Bend>>,
    /// Name of the wall whose bed of grains the wall follows, instead of all else.
    pub bed: Option<String>,
    /// Start, s; the courses count from here.
    pub start: f64,
    /// Stop, s.
    pub stop: f64,
}

impl<const D: usize> Default for RigidMotion<D> {
    fn default() -> Self {
        RigidMotion {
            translations: Vec::new(),
            rotation: None,
            bend: None,
            bed: None,
            start: 0.0,
            stop: f64::INFINITY,
        }
    }
}

impl<const D: usize> RigidMotion<D> {
    /// A constant velocity, m/s.
    pub fn steady(velocity: [f64; D]) -> Self {
        RigidMotion {
            translations: vec![Translation {
                along: velocity,
                course: Course::Steady { speed: 1.0 },
            }],
            ..Self::default()
        }
    }

    /// True if the wall ever moves.
    pub fn moves(&self) -> bool {
        let shifts = |t: &Translation<D>| t.course.moves() && t.along != [0.0; D];
        self.translations.iter().any(shifts)
            || self.rotation.as_ref().is_some_and(|r| r.course.moves())
            || self.bends()
    }

    /// True if the wall changes its shape.
    pub fn bends(&self) -> bool {
        self.bend.is_some() || self.bed.is_some()
    }

    /// The middle of the steepest interval of every table, s.
    pub fn steepest(&self) -> impl Iterator<Item = f64> {
        let all = self.translations.iter().map(|t| &t.course);
        let all = all.chain(self.rotation.iter().map(|r| &r.course));
        all.filter_map(|course| Some(self.start + course.steepest()?))
    }

    /// True if all its numbers are finite and its courses sound.
    pub fn is_sound(&self) -> bool {
        let finite = |v: &[f64]| v.iter().all(|x| x.is_finite());
        let sound = |t: &Translation<D>| t.course.is_sound() && finite(&t.along);
        let turns = |r: &Rotation<D>| {
            r.course.is_sound()
                && finite(&r.centre)
                && finite(&r.axis)
                && (D == 2 || r.axis != [0.0; 3])
        };
        self.translations.iter().all(sound)
            && self.rotation.iter().all(turns)
            && self.bend.iter().all(|b| D == 2 && b.is_sound())
            && self.start.is_finite()
            && !self.stop.is_nan()
    }

    fn elapsed(&self, time: f64) -> f64 {
        (time.min(self.stop) - self.start).max(0.0)
    }

    /// Position and orientation of the wall at a time, relative to the drawing.
    pub fn pose(&self, time: f64) -> Pose<D> {
        let t = self.elapsed(time);
        let turned = |r: &Rotation<D>| {
            let angle = r.course.at(t).value;
            Pose::turned_about(unit_axis(r), angle, r.centre)
        };
        let mut pose = self.rotation.as_ref().map(turned).unwrap_or_default();
        if self.bends() {
            pose.moment = time;
        }
        for shift in &self.translations {
            let way = shift.course.at(t).value;
            pose.translation = along(pose.translation, way, shift.along);
        }
        pose
    }

    /// From where a place of the wall was drawn to where it is in a pose, on its bed.
    pub(crate) fn map<'a>(
        &self,
        pose: &Pose<D>,
        bed: Option<&'a Bed>,
    ) -> impl Fn([f64; D]) -> [f64; D] + use<'a, D> {
        let (bend, rigid, moment) = (self.bend.clone(), pose.map(), pose.moment);
        move |mut x| {
            if let Some(bend) = &bend {
                x[D - 1] += bend.at(x[0], moment).value;
            }
            if let Some(bed) = bed {
                x[D - 1] += bed.lift_of(&x);
            }
            rigid(x)
        }
    }
}

#[cfg(feature = "plugins")]
impl<const D: usize> RigidMotion<D> {
    /// Place and movement of the wall at a time.
    pub fn state(&self, time: f64) -> RigidState<D> {
        let t = self.elapsed(time);
        let mut state = RigidState {
            pose: self.pose(time),
            ..RigidState::default()
        };
        if let Some(rotation) = &self.rotation {
            state.centre = rotation.centre;
        }
        if time < self.start || time >= self.stop {
            return state;
        }
        for shift in &self.translations {
            let (along, stage) = (Vect::from(shift.along), shift.course.at(t));
            state.velocity += along * stage.rate;
            state.acceleration += along * stage.acceleration;
        }
        if let Some(rotation) = &self.rotation {
            let stage = rotation.course.at(t);
            let axis = unit_axis(rotation);
            state.angular_velocity = axis.map(|e| e * stage.rate);
            state.angular_acceleration = axis.map(|e| e * stage.acceleration);
        }
        state
    }

    /// Velocity and acceleration of a point of the wall at its present position.
    pub fn movement(&self, point: [f64; D], time: f64) -> Movement<D> {
        let mut movement = self.state(time).movement(point);
        self.add_bending(&mut movement, point, time);
        movement
    }

    /// Adds the rate and the acceleration of the bend at a point of the wall.
    pub(crate) fn add_bending(&self, movement: &mut Movement<D>, point: [f64; D], time: f64) {
        if let Some(bend) = &self.bend {
            let bending = bend.at(point[0], time);
            movement.velocity[D - 1] += bending.rate;
            movement.acceleration[D - 1] += bending.acceleration;
        }
    }
}

fn unit_axis<const D: usize>(rotation: &Rotation<D>) -> [f64; 3] {
    match D {
        2 => [0.0, 0.0, 1.0],
        _ => unit(rotation.axis),
    }
}

/// A lift along y, linear between places along x and constant beyond the first and the last: a floor that follows the
/// level of a bed. In the plane only.
#[derive(Clone, Debug, PartialEq)]
pub struct Bend {
    /// Places along x where the wall is drawn, ascending, m.
    pub places: Vec<f64>,
    /// The lift at each place over time, m.
    pub lifts: Vec<Course>,
}

impl Bend {
    /// Lift (m), its rate and its acceleration at a place (m) and a time (s).
    #[must_use]
    pub fn at(&self, x: f64, time: f64) -> Stage {
        let after = self.places.partition_point(|p| *p <= x);
        let (next, before) = (after.min(self.places.len() - 1), after.saturating_sub(1));
        let here = self.lifts[before].at(time);
        if next == before {
            return here;
        }
        let there = self.lifts[next].at(time);
        let [from, to] = [self.places[before], self.places[next]];
        let share = ((x - from) / (to - from)).max(0.0);
        let between = |a: f64, b: f64| a + share * (b - a);
        Stage {
            value: between(here.value, there.value),
            rate: between(here.rate, there.rate),
            acceleration: between(here.acceleration, there.acceleration),
        }
    }

    /// True if it is one: as many lifts as places, which ascend.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        let places = &self.places;
        !places.is_empty()
            && places.len() == self.lifts.len()
            && places.iter().all(|x| x.is_finite())
            && places.windows(2).all(|p| p[0] < p[1])
            && self.lifts.iter().all(Course::is_sound)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check<const D: usize>(motion: &RigidMotion<D>, corner: [f64; D]) {
        assert!(motion.is_sound() && motion.moves());
        let at = |t: f64| Vect::from(motion.pose(t).map()(corner));
        for t in [0.2, 0.9, 1.7, 2.5] {
            let h = 1e-5;
            let now = motion.movement(at(t).into(), t);
            let rate = (at(t + h) - at(t - h)) / (2.0 * h);
            let velocity = |t: f64| motion.movement(at(t).into(), t).velocity;
            let second = (velocity(t + h) - velocity(t - h)) / (2.0 * h);
            let off = [rate - now.velocity, second - now.acceleration].map(|v| v.norm());
            assert!(off[0] < 1e-8 && off[1] < 1e-6, "t = {t}: {off:?} {now:?}");
        }
    }

    #[test]
    fn velocity_and_acceleration_are_those_of_the_pose() {
        let sine = Course::sine(0.4, 1.1, 0.3, 0.6);
        check(
            &RigidMotion::<2> {
                rotation: Some(Rotation {
                    centre: [0.1, 0.4],
                    axis: [0.0; 3],
                    course: Course::Steady { speed: 1.7 },
                }),
                start: 0.5,
                stop: 2.0,
                ..RigidMotion::steady([0.3, -0.2])
            },
            [0.9, -0.3],
        );
        check(
            &RigidMotion::<3> {
                translations: vec![Translation {
                    along: [0.0, 1.0, 1.0],
                    course: sine.clone(),
                }],
                rotation: Some(Rotation {
                    centre: [0.1, 0.4, -0.2],
                    axis: [1.0, -2.0, 0.5],
                    course: sine,
                }),
                start: 0.1,
                ..RigidMotion::default()
            },
            [0.9, -0.3, 0.2],
        );
    }

    #[test]
    fn a_lift_is_linear_between_places_and_keeps_what_it_has_beyond() {
        let lifts = [1.0, 3.0, -1.0].map(|speed| Course::Steady { speed });
        let bend = Bend {
            places: vec![1.0, 2.0, 4.0],
            lifts: lifts.into(),
        };
        assert!(bend.is_sound());
        let rates = [1.0, 1.0, 2.0, 3.0, 0.0, -1.0, -1.0];
        for (x, rate) in [0.0, 1.0, 1.5, 2.0, 3.5, 4.0, 9.0].into_iter().zip(rates) {
            let stage = bend.at(x, 0.5);
            assert_eq!([stage.value, stage.rate], [0.5 * rate, rate], "at {x} m");
        }
        let none = Bend {
            places: Vec::new(),
            lifts: Vec::new(),
        };
        assert!(!none.is_sound());
    }
}
