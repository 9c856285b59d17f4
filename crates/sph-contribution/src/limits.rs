//! Bounds on the time step: those of a plugin, and the steps that sound and forces allow.

use rayon::prelude::*;
use sph_core::{StepError, StepLimit, fields};
use sph_neighbours::{World, lightness};
use sph_rheology::state::{BoundState, Laws};

/// A plugin's bound on the step at the present state.
pub trait Limiter<const D: usize>: Send + Sync {
    /// The bound with its name.
    ///
    /// # Errors
    /// If a column is missing.
    fn limit(&self, world: &World<D>) -> Result<StepLimit, StepError>;
    /// The formula, for listings.
    fn formula(&self) -> String;
    /// Remedies that take the bound away or lengthen it, for runs that it holds up; a sentence without its end.
    fn remedy(&self) -> Option<String> {
        None
    }
}

/// The bound that a function gives, s, with its name, formula and remedy.
pub fn bound<const D: usize>(
    name: &'static str,
    formula: impl Into<String>,
    remedy: Option<&'static str>,
    dt: impl Fn(&World<D>) -> Result<f64, StepError> + Send + Sync,
) -> impl Limiter<D> {
    FunctionLimit {
        name,
        formula: formula.into(),
        remedy,
        dt,
    }
}

struct FunctionLimit<F> {
    name: &'static str,
    formula: String,
    remedy: Option<&'static str>,
    dt: F,
}

impl<const D: usize, F> Limiter<D> for FunctionLimit<F>
where
    F: Fn(&World<D>) -> Result<f64, StepError> + Send + Sync,
{
    fn limit(&self, world: &World<D>) -> Result<StepLimit, StepError> {
        Ok(StepLimit::new(self.name, (self.dt)(world)?))
    }
    fn formula(&self) -> String {
        self.formula.clone()
    }
    fn remedy(&self) -> Option<String> {
        self.remedy.map(String::from)
    }
}

/// Δt ≤ C h / c with the largest local speed of sound, Ghaïtanellis 2017, Eq. 2.104.
///
/// With the equations of state in the order of the phase numbers.
pub fn sound_limit<const D: usize>(courant: f64, laws: Laws) -> impl Limiter<D> {
    let formula = format!("sound: dt <= {courant} h / c");
    let remedy = "a lower `speed_of_sound` lengthens the step in proportion, as long as it stays ten times the \
                  largest speed";
    bound("sound", formula, Some(remedy), move |world: &World<D>| {
        let density = world.free.get(fields::DENSITY)?;
        // Sound is fastest where density is highest, so one law call per phase is enough.
        let fastest = match &laws[..] {
            // The stiffness of contact between bodies is that of the fluid at rest.
            laws if density.is_empty() => {
                let each = laws.iter().map(|law| law.reference().sound_speed);
                each.fold(0.0, f64::max)
            }
            [law] => law.sound_speed(largest(density, |rho| *rho)),
            laws => {
                let phase = world.free.get(fields::PHASE)?;
                let fastest = |k: usize, law: &dyn BoundState| {
                    let own = density.iter().zip(phase).filter(|(_, p)| **p as usize == k);
                    law.sound_speed(own.map(|(rho, _)| *rho).fold(0.0, f64::max))
                };
                let each = laws.iter().enumerate();
                each.map(|(k, law)| fastest(k, &**law)).fold(0.0, f64::max)
            }
        };
        Ok(courant * world.kernel.smoothing_length() / fastest)
    })
}

/// Δt ≤ (h/c)/√Λ, Λ the largest ratio of the inertia of a layer of fluid of the thickness h at a body to that of the
/// body: the compressed layer is a spring between both, which an explicit step twice as long would swing up.
pub fn light_body_limit<const D: usize>(laws: &Laws) -> impl Limiter<D> + use<D> {
    let references = laws.iter().map(|law| law.reference());
    let stiffness = references.map(|r| r.density * r.sound_speed.powi(2));
    let stiffest = stiffness.fold(0.0, f64::max);
    let formula =
        "light body: dt <= (h / c) sqrt(inertia of the body / that of a layer h of fluid)";
    let remedy = "a heavier or thicker body lengthens the step, and `[pressure.implicit]` needs no such bound";
    bound(
        "light body",
        formula,
        Some(remedy),
        move |world: &World<D>| {
            let bodies = world.walls.bodies.iter();
            let lightness = bodies.map(|body| lightness(body, &world.walls.elements));
            let lightest = lightness.fold(0.0, f64::max);
            Ok((world.kernel.smoothing_length() / (stiffest * lightest)).sqrt())
        },
    )
}

/// Δt ≤ C √(h / |a|) with the largest acceleration.
pub fn force_limit<const D: usize>(coefficient: f64) -> impl Limiter<D> {
    let formula = format!("force: dt <= {coefficient} sqrt(h / |a|)");
    bound("force", formula, None, move |world: &World<D>| {
        let acceleration = world.free.get(fields::ACCELERATION)?;
        let squared = largest(acceleration, |a| a.norm_squared());
        Ok(coefficient * (world.kernel.smoothing_length() / squared.sqrt()).sqrt())
    })
}

/// Δt ≤ C δr / |u| with the fastest point of any wall, so that walls leap over neither particles nor walls.
pub fn motion_limit<const D: usize>(share: f64) -> impl Limiter<D> {
    let formula = format!("motion: dt <= {share} spacing / |u_wall|");
    bound("motion", formula, None, move |world: &World<D>| {
        let fastest = largest(&world.walls.points.velocity, |u| u.norm_squared()).sqrt();
        Ok(share * world.spacing / fastest)
    })
}

/// The largest value of a column; a value that is not a number counts as infinite.
pub fn largest<T: Sync>(column: &[T], value: impl Fn(&T) -> f64 + Sync) -> f64 {
    let all = column.par_iter().with_min_len(1024).map(|x| {
        let v = value(x);
        if v.is_nan() { f64::INFINITY } else { v }
    });
    all.reduce(|| 0.0, f64::max)
}
