//! What a person can change, by what went wrong.

use sph_core::StepError;
use sph_scene::Scene;

use crate::failure::findings::{Findings, Share, Sighting};

/// Roll-backs from which a shorter step is no remedy.
const ENOUGH: u32 = 2;
/// Acceleration over gravity and driving that no flow at rest has.
const LARGE: f64 = 100.0;
/// Distance over the spacing below which two particles are too close.
const CLOSE: f64 = 0.3;

/// What to try: what helps against the quantity first, then against the largest term, then against the step.
pub fn remedies(scene: &Scene, cause: &StepError, found: &Findings) -> Vec<String> {
    let mut all = against_quantity(cause, found);
    all.extend(found.largest().and_then(|share| against_term(scene, share)));
    all.extend(against_crowding(found));
    all.extend(against_step(scene, found));
    all
}

fn seen(found: &Findings) -> Option<&Sighting> {
    let particle = found.particle.as_ref()?;
    particle.before.as_ref().or(particle.after.as_ref())
}

fn against_quantity(cause: &StepError, found: &Findings) -> Vec<String> {
    let text = |lines: &[&str]| lines.iter().map(|s| s.to_string()).collect();
    match cause {
        StepError::Bad {
            quantity: "density",
            ..
        } => text(&[
            "particles are squeezed or torn apart: raise `speed_of_sound` of the phase to ten times the largest speed, or give \
             `velocity_scale`",
            "if a splash folds the surface, `numerics.density_bounds` may be too narrow",
        ]),
        StepError::Bad {
            quantity: "position",
            ..
        } => text(&[
            "a particle left the domain: close the wall it went through, put an `[outlet.NAME]` where it leaves, or widen \
             `numerics.domain`",
        ]),
        StepError::Bad { .. } if found.largest().is_none() => {
            text(&["give the scene a smoother (`[smoother.brezzi-pitkaranta]`)"])
        }
        StepError::Stage { stage, .. } => match stage.as_str() {
            "implicit viscosity" => text(&[
                "the friction could not be solved for: name a solver with more iterations (`[linear-solver.conjugate-gradient] \
                 iterations`), or `[linear-solver.cholesky]`, which needs none",
            ]),
            "effective pressure" => text(&[
                "the pressure between the grains could not be solved for: raise `effective-pressure.laplace.iterations`, or \
                 loosen its `tolerance`",
            ]),
            _ => Vec::new(),
        },
        _ => Vec::new(),
    }
}

/// Whether an acceleration is beyond what drives flows.
fn large(scene: &Scene, acceleration: f64) -> bool {
    let size = |a: &Option<Vec<f64>>| a.iter().flatten().map(|x| x * x).sum::<f64>().sqrt();
    let driven = size(&scene.numerics.gravity) + size(&scene.numerics.driving);
    acceleration > LARGE * driven
}

/// The setting that tames the term.
fn against_term(scene: &Scene, share: &Share) -> Option<String> {
    let largest = format!("the largest term was `{}`", share.term);
    if let Some(a) = share.acceleration.filter(|a| !large(scene, *a)) {
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
    let chosen = |kind: &'static str| {
        let choice = scene.choice(kind);
        choice.map_or(format!("[{kind}]"), |c| format!("`{}`", c.path))
    };
    let what = match share.kind.as_str() {
        "formulation" if scene.choice("smoother").is_none() => {
            "give the scene a smoother (`[smoother.brezzi-pitkaranta]`), or look whether bodies overlap or collide".into()
        }
        "formulation" => "look whether bodies overlap or collide there".into(),
        "viscous-operator" if scene.choice("implicit-viscosity").is_none() => {
            "treat the viscosity implicitly (`[implicit-viscosity.backward-euler]`), or lower it".into()
        }
        "viscous-operator" => format!(
            "it is solved for, so look at the rheology: a smaller largest viscosity, or another {}",
            chosen("linear-solver")
        ),
        "smoother" => format!("lower the strength in {}", chosen("smoother")),
        "elastic-force" => format!(
            "lower Young's modulus of the soil, give it `damping`, or change {}",
            chosen("elastic-force")
        ),
        "interface" => format!("lower the coefficients of {}", chosen("interface")),
        "shifting" => format!("weaken {}", chosen("shifting")),
        "term" => "look at its parameters".into(),
        _ => return None,
    };
    Some(format!("{largest}: {what}"))
}

/// Two particles in one place are no matter of steps.
fn against_crowding(found: &Findings) -> Option<String> {
    let nearest = seen(found)?.nearest.filter(|d| *d < CLOSE)?;
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
