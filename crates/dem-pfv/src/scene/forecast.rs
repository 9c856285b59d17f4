//! Lower bound of the run time, and a check that floors carry a grain, before the grains are prepared.

use std::f64::consts::PI;

use serde::Serialize;

use crate::grains::{Grain, GrainSystem, Setup};
use crate::scene::error::DemError;
use crate::scene::laws::Laws;
use crate::scene::names::planes;
use crate::scene::prepare::{POURED, from_file, volume};
use crate::scene::read::Loaded;
use crate::scene::tables::Scene;
use crate::scene::walls::setup;

/// Time of a grain in a step on one core, s: a round number, since run times are lower bounds.
const SECONDS: f64 = 1e-6;
/// Longer runs are remarked upon, days.
const LONG: f64 = 30.0;

/// Lower bound of steps and run time.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Cost {
    /// Grains.
    pub grains: usize,
    /// Step of grains with one contact each, s; those of a packing are shorter.
    pub step: f64,
    /// Steps of this length.
    pub steps: f64,
    /// Time of these steps on one core, s.
    pub seconds: f64,
}

/// Lower bound of steps and run time, and remarks.
///
/// # Errors
/// Files that cannot be read, steps too short to move the clock, floors that do not carry a single grain.
pub fn foreseen(loaded: &Loaded, count: Option<usize>) -> Result<(Cost, Vec<String>), DemError> {
    let scene = &loaded.scene;
    let (grains, [small, large]) = match &scene.start.file {
        Some(file) => {
            let grains = from_file(loaded, file)?;
            let ends = |[low, high]: [f64; 2], g: &Grain| [low.min(g.radius), high.max(g.radius)];
            let ends = grains.iter().fold([f64::INFINITY, 0.0], ends);
            (grains.len(), ends)
        }
        None => (count.unwrap_or(1), radii(scene)),
    };
    carried(loaded, large)?;
    let end = scene.run.end;
    let step = scene.run.safety * stable(scene, small)?;
    if end + step == end {
        let message = format!(
            "steps of {step:.1e} s, which grains of {small:.1e} m bear, do not move a clock that stands near {end} s: \
             take larger grains, or a smaller `modulus`"
        );
        return Err(DemError::at("run.end", message));
    }
    let steps = (end / step).ceil();
    let steps = scene
        .run
        .max_steps
        .map_or(steps, |most| steps.min(most as f64));
    let seconds = SECONDS * grains as f64 * steps;
    let days = seconds / 86400.0;
    let remark = format!(
        "the run takes at least {steps:.1e} steps of {step:.1e} s, some {days:.0} days on one core: take larger \
         grains, a smaller `modulus` or an earlier `run.end`"
    );
    let remarks = (days > LONG).then_some(remark).into_iter().collect();
    let cost = Cost {
        grains,
        step,
        steps,
        seconds,
    };
    Ok((cost, remarks))
}

/// Smallest and largest radius, m; grains that grow are taken to fill their box to the porosity that they grow to.
fn radii(scene: &Scene) -> [f64; 2] {
    let radii = scene.grains.radius.unwrap_or_default();
    let (Some(grown), Some(given)) = (&scene.start.grown, &scene.r#box) else {
        return radii;
    };
    let room: f64 = (0..3).map(|k| given.high[k] - given.low[k]).product();
    let solid = (1.0 - grown.porosity.unwrap_or(POURED)) * room;
    let mean = 0.5 * volume(&radii) * scene.grains.count.unwrap_or(1) as f64;
    radii.map(|r| r * (solid / mean).cbrt())
}

/// The largest stable step (s) of a grain that touches another of its radius (m); in a fluid a third of (4.20) at the
/// most, which is stable for narrow gradings. Source: Catalano 2012, Eq. (4.20).
fn stable(scene: &Scene, radius: f64) -> Result<f64, DemError> {
    let density = scene.grains.density;
    let setup = Setup {
        grains: vec![Grain::new([0.0; 3], radius, density)],
        laws: Laws::from_scene(scene)?.all,
        ..Setup::default()
    };
    let told = |e| DemError::at("grains", e);
    let contacts = GrainSystem::new(setup).map_err(told)?.critical_step();
    let drag = |viscosity: f64| PI * density * (2.0 * radius).powi(2) / (3600.0 * viscosity);
    let drag = scene
        .fluid
        .as_ref()
        .map_or(f64::INFINITY, |f| drag(f.given.viscosity));
    Ok(contacts.min(drag))
}

/// Refuses a plane that a single grain of this radius (m) sinks into too deep by its buoyant weight:
///
/// ```text
/// ∫ k_n dδ from 0 to the deepest overlap < |g · n| (ρ_s − ρ_f) 4/3 π R³
/// ```
fn carried(loaded: &Loaded, radius: f64) -> Result<(), DemError> {
    let scene = &loaded.scene;
    let setup = setup(loaded, Vec::new(), Laws::from_scene(scene)?)?;
    let fluid = scene.fluid.as_ref().map_or(0.0, |f| f.given.density);
    let mass = (scene.grains.density - fluid) * volume(&[radius]);
    let deepest = GrainSystem::DEEPEST * radius;
    for (wall, name) in setup.walls.iter().zip(planes(scene)) {
        let weight = -mass * setup.gravity.dot(&wall.normal);
        let law = &setup.laws[wall.law];
        let parts = 64;
        let depth = |k: i32| deepest * (f64::from(k) + 0.5) / f64::from(parts);
        let stiffness = |k| law.stiffness([radius, f64::INFINITY], depth(k)).normal;
        let mean = (0..parts).map(stiffness).sum::<f64>() / f64::from(parts);
        if weight > mean * deepest && !scene.wall.get(&name).is_some_and(|w| w.removed) {
            let message = format!(
                "a grain of {radius} m sinks into the wall `{name}` by more than {} of its radius under its weight of \
                 {weight:.3e} N: the contact law needs {:.1} times the `modulus`",
                GrainSystem::DEEPEST,
                weight / (mean * deepest)
            );
            return Err(DemError::at(law_of(scene, &name), message));
        }
    }
    Ok(())
}

/// The table with the contact law of a plane.
fn law_of(scene: &Scene, name: &str) -> String {
    let own = scene.wall.get(name).filter(|w| !w.contact.is_empty());
    let of_box = scene.r#box.as_ref().filter(|b| !b.contact.is_empty());
    match (own, of_box) {
        (Some(_), _) => format!("wall.{name}.contact"),
        (None, Some(_)) if crate::scene::names::BOX.contains(&name) => "box.contact".into(),
        _ => "grains.contact".into(),
    }
}
