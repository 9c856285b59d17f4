//! Report of a failed step: its particle, and the largest terms.

use serde::{Deserialize, Serialize};
use sph_core::{StepError, Vect, fields};
use sph_neighbours::{TermShare, shares_at};
use sph_run::Trouble;
use sph_solver::Flow;

/// Wall distances beyond this many spacings are not reported.
const NEAR: f64 = 4.0;

/// The entry `failure` of `summary.json`. Numbers that are not finite are null.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Findings {
    /// The cause of the run's end.
    pub cause: Trouble,
    /// Roll-backs before the end.
    pub retries: u32,
    /// The step that failed last, s.
    pub dt: f64,
    /// Name of the limit that bound the step.
    pub limiter: String,
    /// The particle at fault, or the one with the largest acceleration where none is named.
    pub particle: Option<Suspect>,
    /// Terms that acted on it at the last good state, largest first.
    pub before: Vec<Share>,
    /// Terms that acted on it at the bad state, largest first; empty where they are not known.
    pub after: Vec<Share>,
    /// Remedies.
    pub advice: Vec<String>,
    /// Files that show the bad state, and the checkpoint of the last good one, relative to the run's folder.
    pub files: Vec<String>,
}

/// A particle, before and after it went wrong.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Suspect {
    /// Its number.
    pub number: u32,
    /// True if the failed step named it.
    pub named: bool,
    /// Its phase.
    pub phase: String,
    /// The body it came from.
    pub body: String,
    /// At the last good state, if there is one.
    pub before: Option<ParticleRecord>,
    /// At the bad state.
    pub after: Option<ParticleRecord>,
}

/// A particle at some time.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ParticleRecord {
    /// Time, s.
    pub time: f64,
    /// Position, m.
    pub position: Vec<Option<f64>>,
    /// Velocity, m/s.
    pub velocity: Vec<Option<f64>>,
    /// Density, kg/m³.
    pub density: Option<f64>,
    /// Pressure, Pa.
    pub pressure: Option<f64>,
    /// Distance to the nearest other particle over the spacing.
    pub nearest: Option<f64>,
    /// The wall that is near, and its distance over the spacing.
    pub wall: Option<(String, f64)>,
}

/// Action of a term on the particle.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Share {
    /// The term.
    pub term: String,
    /// The plugin of the scene that it comes from, as in `viscous-operator`; empty for gravity.
    pub kind: String,
    /// |a|, m/s².
    pub acceleration: Option<f64>,
    /// |a| of the walls' part, m/s².
    pub of_walls: Option<f64>,
    /// Rate of the density constant (or the density), kg/m³/s, where the term has one.
    pub density_rate: Option<f64>,
}

impl Findings {
    /// The largest share before it failed, or else after.
    pub fn largest(&self) -> Option<&Share> {
        self.before.first().or(self.after.first())
    }
}

fn finite(x: f64) -> Option<f64> {
    x.is_finite().then_some(x)
}

/// The index of the particle that a failed step names, or else of the one with the largest acceleration.
pub fn suspect<const D: usize>(flow: &Flow<D>, cause: &StepError) -> Option<(usize, bool)> {
    if let StepError::Bad { particle, .. } = cause {
        return Some((place_of(flow, *particle)?, true));
    }
    let acceleration = flow.world.free.get(fields::ACCELERATION).ok()?;
    // NaN is larger than any number.
    let size = |k: &usize| {
        let a = acceleration[*k].norm_squared();
        if a.is_nan() { f64::INFINITY } else { a }
    };
    let all = 0..acceleration.len();
    let worst = all.max_by(|a, b| size(a).total_cmp(&size(b)).then(b.cmp(a)));
    worst.map(|k| (k, false))
}

/// The present place of the particle of a number.
pub fn place_of<const D: usize>(flow: &Flow<D>, number: u32) -> Option<usize> {
    let identity = flow.world.free.get(fields::IDENTITY).ok()?;
    identity.iter().position(|i| *i == number)
}

/// Terms that act on a particle at the state of the last evaluation, largest first.
pub fn shares_on<const D: usize>(flow: &Flow<D>, particle: usize) -> Vec<Share> {
    let terms = shares_at(&flow.world, &flow.forces(), particle).unwrap_or_default();
    let kind = |term: &str| flow.kinds.iter().find(|(name, _)| name == term);
    let share = |term: &TermShare<D>| Share {
        term: term.name.clone(),
        kind: kind(&term.name).map_or(String::new(), |(_, kind)| kind.to_string()),
        acceleration: finite(term.rates.acceleration.norm()),
        of_walls: finite(term.of_walls.norm()),
        density_rate: finite(term.rates.scalar).filter(|r| *r != 0.0),
    };
    let mut shares: Vec<Share> = terms.iter().map(share).collect();
    let world = &flow.world;
    let volume_forces = [("gravity", &world.gravity), ("driving", &world.driving)];
    for (term, a) in volume_forces.into_iter().filter(|(_, a)| a.norm() > 0.0) {
        shares.push(Share {
            term: term.into(),
            acceleration: finite(a.norm()),
            of_walls: Some(0.0),
            ..Share::default()
        });
    }
    let size = |s: &Share| s.acceleration.unwrap_or(f64::INFINITY);
    shares.sort_by(|a, b| size(b).total_cmp(&size(a)));
    shares
}

/// A particle as it is now.
pub fn sighting<const D: usize>(flow: &Flow<D>, particle: usize) -> Option<ParticleRecord> {
    let world = &flow.world;
    let position = world.free.get(fields::POSITION).ok()?;
    let velocity = world.free.get(fields::VELOCITY).ok()?;
    let x = position.get(particle)?;
    let scalar = |field| finite(world.free.get(field).ok()?[particle]);
    let apart = |(k, y): (usize, &Vect<D>)| match k == particle {
        true => f64::INFINITY,
        false => world.domain.nearest_image(x - y).norm_squared(),
    };
    let nearest = position.iter().enumerate().map(apart);
    let nearest = nearest.fold(f64::INFINITY, f64::min).sqrt();
    let sane = x.iter().all(|c| c.is_finite()) && world.domain.contains(x);
    let wall = flow.walls.as_ref().filter(|_| sane).and_then(|walls| {
        let (distance, name) = walls.clearance(x, NEAR * world.spacing)?;
        Some((name.to_string(), distance / world.spacing))
    });
    let list = |v: &Vect<D>| v.iter().map(|c| finite(*c)).collect();
    Some(ParticleRecord {
        time: world.time,
        position: list(x),
        velocity: list(&velocity[particle]),
        density: scalar(fields::DENSITY),
        pressure: scalar(fields::PRESSURE),
        nearest: finite(nearest / world.spacing),
        wall,
    })
}

/// Report of a failed step.
pub fn trouble(cause: &StepError, time: f64, step: u64) -> Trouble {
    let bare = |quantity: &str, reason: String| Trouble {
        time,
        step,
        quantity: quantity.into(),
        reason,
        ..Trouble::default()
    };
    match cause {
        StepError::Bad {
            quantity,
            particle,
            position,
            value,
            reason,
        } => Trouble {
            particle: Some(*particle),
            position: match position.iter().all(|x| x.is_finite()) {
                true => position.clone(),
                false => Vec::new(),
            },
            value: finite(*value),
            ..bare(quantity, reason.clone())
        },
        StepError::Stage { stage, reason } => bare(stage, reason.clone()),
        StepError::Field(error) => bare("field", error.to_string()),
        other => bare("", other.to_string()),
    }
}

#[cfg(test)]
mod tests {
    use sph_core::System;

    use super::*;
    use crate::setup::assemble;

    const SCENE: &str = "title = \"t\"\ndimension = 2\nrun.end = 1\n\
         numerics = { spacing = 0.02, gravity = [0, -9.81], jitter = 0.2, velocity_noise = 0.1 }\n\
         smoother.brezzi-pitkaranta = {}\nviscous-operator.morris = {}\nwalls.usaw = {}\n\
         wall.tank = { polyline = [[0, 0.6], [0, 0], [0.4, 0], [0.4, 0.6]] }\n\
         phase.a = { density = 1000, velocity_scale = 2, rheology.newtonian = { viscosity = 1 } }\n\
         body.a = { phase = \"a\", box = [[0, 0], [0.4, 0.2]] }\n";

    #[test]
    fn the_shares_of_the_terms_add_up_to_the_acceleration() {
        let loaded = sph_scene::parse(SCENE, "t.toml", &[]).unwrap_or_else(|e| panic!("{e}"));
        let mut flow = assemble::<2>(&loaded.scene).unwrap().flow;
        flow.evaluate().unwrap();
        let acceleration = flow.world.free.get(fields::ACCELERATION).unwrap();
        let (mut worst, mut walls) = (0.0_f64, 0);
        for (k, whole) in acceleration.iter().enumerate() {
            let shares = shares_at(&flow.world, &flow.forces(), k).unwrap();
            assert_eq!(shares.len(), 3, "pressure, viscosity, smoother");
            let rates = shares.iter().map(|s| s.rates.acceleration);
            let sum = rates.fold(flow.world.gravity, |a, rate| a + rate);
            worst = worst.max((sum - whole).norm() / whole.norm());
            let touched = shares.iter().any(|s| s.of_walls.norm() > 0.0);
            let sees = !flow.world.walls.contacts.of_particle(k).is_empty();
            assert_eq!(touched, sees, "particle {k} has walls within reach");
            walls += usize::from(sees);
        }
        assert!(worst < 1e-12, "{worst:e} of the acceleration is missing");
        assert!((21..acceleration.len()).contains(&walls), "{walls}");
        let kinds: Vec<String> = shares_on(&flow, 0).into_iter().map(|s| s.kind).collect();
        for kind in ["formulation", "viscous-operator", "smoother", ""] {
            assert!(kinds.iter().any(|k| k == kind), "{kind}: {kinds:?}");
        }
    }

    #[test]
    fn values_that_are_not_finite_survive_a_file() {
        let cause = StepError::Bad {
            quantity: "position",
            particle: 7,
            position: vec![f64::NAN, 1.0],
            value: f64::NAN,
            reason: "not finite".into(),
        };
        let told = trouble(&cause, 0.5, 3);
        let text = serde_json::to_string(&told).unwrap();
        assert_eq!(serde_json::from_str::<Trouble>(&text).unwrap(), told);
        assert_eq!((told.particle, told.value), (Some(7), None));
    }
}
