//! Prandtl's mixing length.

use sph_contribution::{Contribution, Offer, Refusal, Setting};
use sph_core::{Access, StepError, fields, plugin};
use sph_multiphase::viscosity::EddyViscosityEntry;
use sph_neighbours::World;

use super::common::ClosureCommon;
use crate::{FRICTION_VELOCITY, RoughBed, WALL_DISTANCE};

/// η_t = ρ L² √(2 D:D), with L = κz, at most `longest`, or L = κz√(1 − z/H) in an open channel of a `depth` H, and
/// the true distance z from the nearest wall.
///
/// Production balances dissipation in it: it is for steady layers along walls. Next to a wall with a wall function, nearer
/// than a spacing, the strain rate is that of its law in the logarithm, u*/(κz), since a sum over particles sees but a share of
/// a gradient that grows like 1/z. With `imposed_friction_velocity` it is u*/(κz) everywhere, of a given u*: for tests of the
/// viscosity by itself.
///
/// Sources: Issa 2004, Eq. 5.57 (L²S), 6.14 (κz), 6.19 (open channel), 6.39 (imposed).
///
/// ```toml
/// [eddy-viscosity.mixing-length]
/// depth = "0.4 m"
/// walls = ["bed"]
/// ```
#[plugin(EddyViscosityEntry [2, 3], "mixing-length",
    "a length by the distance from walls, squared, times the strain rate",
    source: "Prandtl 1925; Issa 2004, Eq. 5.57, 6.14, 6.19", cfg(not(test)))]
pub struct MixingLength {
    /// Von Kármán's κ.
    #[parameter(default: 0.41, unit: "1", above: 0.0, source: "Issa 2004, Eq. 6.14")]
    pub karman: f64,
    /// Depth H of an open channel.
    #[parameter(default, unit: "m", above: 0.0, source: "Issa 2004, Eq. 6.19")]
    pub depth: Option<f64>,
    /// L is not larger; unbounded if left out.
    #[parameter(default, unit: "m", above: 0.0)]
    pub longest: Option<f64>,
    /// Names of the walls that z counts from; all if left out.
    #[parameter(default)]
    pub walls: Vec<String>,
    /// Names of the phases that it acts on: fluids with one viscosity. To be left out where there is one.
    #[parameter(default)]
    pub phases: Vec<String>,
    /// The bed of another phase as a rough wall.
    #[parameter(default)]
    pub bed: Option<RoughBed>,
    /// u* of the strain rate u*/(κz) that takes the place of the flow's.
    #[parameter(default, unit: "m/s", above: 0.0, source: "Issa 2004, Eq. 6.39")]
    pub imposed_friction_velocity: Option<f64>,
}

impl MixingLength {
    fn length(&self) -> Length {
        Length {
            karman: self.karman,
            depth: self.depth,
            longest: self.longest,
        }
    }

    /// Strain rate, 1/s, that counts at a distance, m.
    fn strain_rate(&self, rate: f64, distance: f64, friction: f64, spacing: f64) -> f64 {
        let at = |friction: f64| friction / (self.karman * distance);
        match self.imposed_friction_velocity {
            Some(imposed) => at(imposed),
            None if friction > 0.0 && distance < spacing => at(friction),
            None => rate,
        }
    }

    fn set<const D: usize>(&self, world: &World<D>, eddies: &mut [f64]) -> Result<(), StepError> {
        let (density, rates) = world.free.all((fields::DENSITY, fields::STRAIN_RATE))?;
        let distance = world.free.get(WALL_DISTANCE)?;
        let friction = world.free.get(FRICTION_VELOCITY).ok();
        let length = self.length();
        for (i, eddy) in eddies.iter_mut().enumerate() {
            // A particle on the wall has no length and no eddies.
            let z = distance[i].max(f64::MIN_POSITIVE);
            let friction = friction.map_or(0.0, |u| u[i]);
            let rate = self.strain_rate(rates[i], z, friction, world.spacing);
            *eddy = density[i] * length.at(z).powi(2) * rate;
        }
        Ok(())
    }
}

impl<const D: usize> Contribution<D> for MixingLength {
    fn offer(&mut self, setting: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        let common = ClosureCommon {
            name: "mixing-length",
            phases: &self.phases,
            bed: self.bed.as_ref(),
            distances: Some((&self.walls[..], self.length().farthest())),
            ..ClosureCommon::default()
        };
        let access = Access::none()
            .here((fields::DENSITY, fields::STRAIN_RATE, WALL_DISTANCE))
            .where_there(FRICTION_VELOCITY);
        let own = self.clone();
        let set = move |world: &World<D>, eddies: &mut [f64]| own.set(world, eddies);
        common.offer_to(setting, ("mixing length", access), set, offer)
    }
}

/// L = κz, at most `longest`; L = κz√(1 − z/H) where there is a depth. Source: Issa 2004, Eq. 6.14 and 6.19.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Length {
    pub karman: f64,
    /// Depth H of an open channel, m.
    pub depth: Option<f64>,
    /// L is not larger, m.
    pub longest: Option<f64>,
}

impl Length {
    /// L at a distance, m.
    pub fn at(&self, distance: f64) -> f64 {
        let share = self.depth.map_or(1.0, |h| (1.0 - distance / h).max(0.0));
        let length = self.karman * distance * share.sqrt();
        length.min(self.longest.unwrap_or(f64::INFINITY))
    }

    /// The distance beyond which L is the same everywhere, m.
    pub fn farthest(&self) -> f64 {
        let of_longest = self.longest.map_or(f64::INFINITY, |l| l / self.karman);
        self.depth.unwrap_or(of_longest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Page §3.7: with the log law's gradient it is κu*z(1 − z/H), κu*H/4 at mid-depth.
    #[test]
    fn an_open_channel_has_its_parabola() {
        let closure = MixingLength {
            depth: Some(0.4),
            imposed_friction_velocity: Some(0.05),
            ..MixingLength::default()
        };
        for z in [0.001, 0.1, 0.2, 0.3, 0.399] {
            let rate = closure.strain_rate(123.0, z, 0.0, 0.01);
            let found = closure.length().at(z).powi(2) * rate;
            let exact = 0.41 * 0.05 * z * (1.0 - z / 0.4);
            assert!((found - exact).abs() < 1e-16, "{z}: {found}, {exact}");
        }
        assert!((0.41f64 * 0.05 * 0.4 / 4.0 - 2.05e-3).abs() < 1e-15);
    }

    #[test]
    fn the_law_of_the_wall_gives_the_strain_next_to_it_alone() {
        let closure = MixingLength::default();
        assert_eq!(closure.strain_rate(3.0, 0.02, 0.05, 0.01), 3.0);
        assert_eq!(closure.strain_rate(3.0, 0.005, 0.0, 0.01), 3.0);
        let found = closure.strain_rate(3.0, 0.005, 0.05, 0.01);
        assert!((found - 0.05 / (0.41 * 0.005)).abs() < 1e-12);
    }

    #[test]
    fn it_grows_from_the_wall_and_ends_at_the_surface_or_at_the_longest() {
        let plain = Length {
            karman: 0.4,
            depth: None,
            longest: Some(0.1),
        };
        assert!((plain.at(0.1) - 0.04).abs() < 1e-15);
        assert_eq!(plain.at(5.0), 0.1);
        assert!((plain.farthest() - 0.25).abs() < 1e-15);
        let channel = Length {
            depth: Some(2.0),
            longest: None,
            ..plain
        };
        assert!((channel.at(1.5) - 0.4 * 1.5 * 0.5).abs() < 1e-15);
        assert_eq!([channel.at(2.0), channel.at(3.0)], [0.0; 2]);
        assert_eq!(channel.farthest(), 2.0);
    }
}
