//! Remedies that a user has, by the failure.

use sph_core::{Contract, StepError};
use sph_multiphase::SurfaceEntry;
use sph_multiphase::diffusion::SmootherEntry;
use sph_scene::Scene;

use crate::Failure;
use crate::failure::findings::{Findings, Share};

/// Remedies of the plugins of a scene for their terms, by kind.
pub type Remedies = [(&'static str, String)];

/// Roll-backs from which a shorter step is no remedy.
const ENOUGH: u32 = 2;
/// Acceleration over gravity and driving that no flow at rest has.
const LARGE: f64 = 100.0;
/// Distance over the spacing below which two particles are too close.
const CLOSE: f64 = 0.3;

/// Remedies: against the quantity first, then against the largest term, then against the step.
pub fn remedies(scene: &Scene, failure: &Failure, told: &Remedies) -> Vec<String> {
    let (cause, found) = (&failure.cause, &failure.findings);
    let mut all = against_quantity(cause, found);
    if let StepError::Stage { stage, .. } = cause {
        let failed = told.iter().filter(|(name, _)| name == stage);
        all.extend(failed.map(|(_, what)| what.clone()));
    }
    let largest = found.largest();
    all.extend(largest.and_then(|share| against_term(scene, share, told)));
    all.extend(against_crowding(found));
    all.extend(against_step(scene, found));
    all
}

fn against_quantity(cause: &StepError, found: &Findings) -> Vec<String> {
    let StepError::Bad { quantity, .. } = cause else {
        return Vec::new();
    };
    match *quantity {
        "density" => vec![
            "particles are squeezed or torn apart: raise `speed_of_sound` of the phase to ten times the largest speed, or give \
             `velocity_scale`"
                .into(),
            format!(
                "if a splash folds or tears the surface, {} lets densities forget it, where they are sums; \
                 `numerics.density_bounds` may be too narrow",
                SurfaceEntry::KIND.advice()
            ),
        ],
        "position" => vec![
            "a particle left the domain: close the wall it went through, put an `[outlet.NAME]` where it leaves, or widen \
             `numerics.domain`"
                .into(),
        ],
        _ if found.largest().is_none() => {
            let smoother = SmootherEntry::KIND.advice();
            vec![format!("give the scene a smoother ({smoother})")]
        }
        _ => Vec::new(),
    }
}

/// The setting that tames the term.
fn against_term(scene: &Scene, share: &Share, told: &Remedies) -> Option<String> {
    let largest = format!("the largest term was `{}`", share.term);
    let size = |a: &Option<Vec<f64>>| a.iter().flatten().map(|x| x * x).sum::<f64>().sqrt();
    let driven = size(&scene.numerics.gravity) + size(&scene.numerics.driving);
    if let Some(a) = share.acceleration.filter(|a| *a <= LARGE * driven) {
        return Some(format!(
            "no term was large there ({largest}, {a:.1e} m/s²): look at how the particle came to where it was"
        ));
    }
    let walls = share.of_walls > share.acceleration.map(|a| 0.5 * a);
    if walls {
        return Some(format!(
            "{largest}, and most of it came from a wall: look whether particles start nearer to it than half a spacing, or \
             whether it moves faster than the fluid can follow"
        ));
    }
    let what = match share.kind.as_str() {
        "formulation" => match scene.choice("smoother") {
            None => format!(
                "give the scene a smoother ({}), or look whether bodies overlap or collide",
                SmootherEntry::KIND.advice()
            ),
            _ => "look whether bodies overlap or collide there".into(),
        },
        kind => told.iter().find(|(k, _)| *k == kind)?.1.clone(),
    };
    Some(format!("{largest}: {what}"))
}

/// Two particles in one place are no matter of steps.
fn against_crowding(found: &Findings) -> Option<String> {
    let particle = found.particle.as_ref()?;
    let record = particle.before.as_ref().or(particle.after.as_ref())?;
    let nearest = record.nearest.filter(|d| *d < CLOSE)?;
    Some(format!(
        "its nearest neighbour was {nearest:.2} spacings away: look whether bodies overlap at the start, or settle them \
         (`numerics.relax`)"
    ))
}

fn against_step(scene: &Scene, found: &Findings) -> Option<String> {
    Some(match found.retries {
        0 if scene.run.retries == 0 => {
            "`run.retries = 5` tries shorter steps before it gives up, and keeps the last good state".into()
        }
        0 => return None,
        n if n < ENOUGH => "lower `run.safety`".into(),
        n => format!(
            "{n} roll-backs, the last with Δt = {:.1e} s (bound `{}`), did not help: it is not the length of the step alone",
            found.dt, found.limiter
        ),
    })
}
