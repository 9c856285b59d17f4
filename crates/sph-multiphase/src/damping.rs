//! Decay of velocities: for fluids that are to settle, and sponges that absorb waves.
//!
//! * [`Rayleigh`] is the plugin, `[damping.rayleigh]`; [`Zone`] is where it acts.
//! * [`DampingEntry`] is the kind, for plugins of other crates.

use rayon::prelude::*;
use sph_contribution::{
    Contribution, Offer, Refusal, Setting, StepHook, StepMoment, StepPhase, contribution_kind,
};
use sph_core::{Access, Axis, StepError, Vect, Work, fields, parameters, plugin};

contribution_kind!(
    /// Damping that a scene may name.
    pub DampingEntry, "damping", Any, "damping of motion: of a fluid that is to settle, of waves, of sound",
    .advises("acoustic").works(Work::Damping)
);

/// du/dt = −Γ(x) (u − U), with the velocity of the end of the step: u ← (u + ΓΔt U)/(1 + ΓΔt) after every kick, for any
/// ΓΔt.
///
/// Γ is `rate` everywhere, or in `zones` with a share that grows smoothly ([`Zone`]; the largest where they overlap). It takes
/// momentum out of the fluid that no wall takes up: for fluids that are to settle before something begins (`until`), and for
/// sponges at the ends of flumes.
///
/// Source: Issa 2004, Eq. 4.10 (everywhere); Israeli & Orszag 1981 (sponges).
///
/// ```toml
/// [damping.rayleigh]
/// rate = "20 1/s"
/// zones = [{ axis = "x", from = 8.0, to = 10.0 }]
/// ```
#[plugin(DampingEntry [2, 3], "rayleigh", "in proportion to the velocity: everywhere, or in sponges",
    source: "Issa 2004, Eq. 4.10; Israeli & Orszag 1981")]
pub struct Rayleigh {
    /// Rate Γ.
    #[parameter(unit: "1/s", min: 0.0)]
    pub rate: f64,
    /// Zones of the damping; everywhere if left out.
    #[parameter(default)]
    pub zones: Vec<Zone>,
    /// Velocity U that is left, by component; rest if left out.
    #[parameter(default, unit: "m/s")]
    pub velocity: Vec<f64>,
    /// The time at which it ends; never if left out.
    #[parameter(unit: "s")]
    pub until: Option<f64>,
}

/// A zone in which the damping grows with the square of the way into it, from nothing at `from` to all of it at `to` and beyond:
/// a rate that jumped would send waves back.
///
/// Source: Israeli & Orszag 1981, J. Comput. Phys. 41, 115–135 (smooth rates).
#[parameters]
#[derive(Copy, PartialEq)]
pub struct Zone {
    /// The axis along which it grows.
    #[parameter(default)]
    pub axis: Axis,
    /// Start of the zone.
    #[parameter(unit: "m")]
    pub from: f64,
    /// End of the growth; `to` may be less than `from`.
    #[parameter(unit: "m")]
    pub to: f64,
}

impl Zone {
    /// The share of the rate at a place, 0 to 1.
    pub fn share<const D: usize>(&self, x: &Vect<D>) -> f64 {
        let way = (x[self.axis as usize] - self.from) / (self.to - self.from);
        way.clamp(0.0, 1.0).powi(2)
    }
}

impl Rayleigh {
    /// Γ at a place, 1/s.
    pub fn rate_at<const D: usize>(&self, x: &Vect<D>) -> f64 {
        let shares = self.zones.iter().map(|zone| zone.share(x));
        match self.zones.is_empty() {
            true => self.rate,
            false => self.rate * shares.fold(0.0, f64::max),
        }
    }
}

impl<const D: usize> Contribution<D> for Rayleigh {
    fn offer(&mut self, _: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        let refuse = |key, text: String| Err(Refusal::at_key("damping", key, text));
        if !(self.rate >= 0.0 && self.rate.is_finite()) {
            let rate = self.rate;
            return refuse(
                "rate",
                format!("{rate} where a number from 0 on was expected"),
            );
        }
        if !self.velocity.is_empty() && self.velocity.len() != D {
            let found = self.velocity.len();
            return refuse(
                "velocity",
                format!("{found} components where {D} were expected"),
            );
        }
        for zone in &self.zones {
            if zone.axis as usize >= D {
                return refuse("zones", format!("there is no third axis in {D} dimensions"));
            }
            let finite = zone.from.is_finite() && zone.to.is_finite();
            if !finite || zone.from == zone.to {
                let why = "`from` and `to` are to be two different places";
                return refuse("zones", why.into());
            }
        }
        offer.hook(self.clone());
        Ok(())
    }
}

impl<const D: usize> StepHook<D> for Rayleigh {
    fn name(&self) -> String {
        "damping".into()
    }
    fn access(&self) -> Access {
        Access::none()
            .here((fields::POSITION, fields::VELOCITY))
            .writes(fields::VELOCITY)
    }
    fn phases(&self) -> &'static [StepPhase] {
        &[StepPhase::AfterKick]
    }
    fn run(&mut self, _: StepPhase, moment: &mut StepMoment<'_, D>) -> Result<(), StepError> {
        let StepMoment { world, dt, .. } = moment;
        if self.until.is_some_and(|until| world.time >= until) {
            return Ok(());
        }
        let left = Vect::<D>::from_fn(|k, _| self.velocity.get(k).copied().unwrap_or(0.0));
        let mut velocity = world.free.take(fields::VELOCITY)?;
        let position = world.free.get(fields::POSITION)?;
        let both = velocity.par_iter_mut().zip(position).with_min_len(4096);
        both.for_each(|(u, x)| {
            let share = self.rate_at(x) * *dt;
            if share > 0.0 {
                *u = (*u + left * share) / (1.0 + share);
            }
        });
        Ok(world.free.put(fields::VELOCITY, velocity)?)
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector2;

    use super::*;

    #[test]
    fn a_sponge_grows_with_the_square_of_the_way_and_either_way() {
        let zone = |from, to| Zone {
            axis: Axis::X,
            from,
            to,
        };
        let damping = Rayleigh {
            rate: 8.0,
            zones: vec![zone(2.0, 4.0), zone(1.0, 0.0)],
            velocity: Vec::new(),
            until: None,
        };
        for (x, rate) in [
            (1.5, 0.0),
            (3.0, 2.0),
            (4.0, 8.0),
            (9.0, 8.0),
            (0.5, 2.0),
            (-1.0, 8.0),
        ] {
            assert_eq!(damping.rate_at(&Vector2::new(x, 0.0)), rate, "at {x}");
        }
    }
}
