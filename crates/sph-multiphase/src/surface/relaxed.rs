//! Density constants that relax where a surface has gone, and hold at a new one.

use rayon::prelude::*;
use serde_json::{Value as Json, json};
use sph_contribution::{
    Contribution, Offer, Refusal, Report, Setting, StepHook, StepMoment, StepPhase,
    contribution_kind,
};
use sph_core::{Access, StepError, Work, fields, plugin};
use sph_neighbours::World;

use super::cone::{FREE_SURFACE, Place, free_surface};

contribution_kind!(
    /// A treatment of free surfaces that a scene may name.
    pub SurfaceEntry, "surface", One, "free surfaces, and densities there",
    .absent("surfaces that densities remember if left out").advises("cone-test").works(Work::Surface)
);

/// The density constant K of [`HuAdams`](crate::HuAdams) belongs to a place, not to a particle:
/// dK/dt = −(K − K′)/τ with τ = n h/c, where
///
/// * no surface is within the support: K′ is K cut to ± ε ρ₀, for a full support lacks nothing;
/// * the particle is at a surface: K′ is such that ρ is not below (1 − ε) ρ₀, for water there is not under tension; with
///   `no_pressure` K′ is such that ρ = ρ₀;
/// * the particle is alone: K′ is such that ρ = ρ₀, at once: it has no pressure and moves on a parabola;
/// * an open face is within the support: K stays, unless the particle is at a surface or alone. Half of the row that passes the
///   face is in no sum, so K swings by ± 0.15 ρ₀ there; what is cut of it is mass that does not pass;
/// * else K stays: the particle carries the part that the kernel misses within reach of a surface.
///
/// Symbols: h smoothing length (m), c speed of sound of the phase at rest (m/s). Where a full support has K > 0, as many of
/// the particles fill more space than they have volume: a fold closed on a gap. The loss of K lowers their pressure until
/// the water around has filled the gap; mass and momentum stay, the energy that goes is counted (in checkpoints). A change
/// of K moves the pressure by c h K/τ before sound has carried it off: with K up to 0.3 ρ₀ and a Mach number of 0.1, n = 30
/// keeps that below ρU². ε has to be a share of the spread that is borne, for constants come to rest at its edge: with 0.01
/// nearly all stay within 3 %, with 0.03 a few per cent of them stand just beyond.
///
/// Meant for water that tears. It adds 3 to 20 % to a step: only particles whose support lacks fluid are examined. Densities that
/// follow a rate have no memory of a surface: with other formulations nothing relaxes, and surfaces are found for other
/// readers.
///
/// Source: the cone test is of Marrone et al. 2010; relaxing K is ours.
///
/// ```toml
/// [surface.cone-test]
/// time = 30.0
/// ```
#[plugin(SurfaceEntry [2, 3], "cone-test", "densities forget surfaces that are no more; lone particles fly like stones",
    source: "Marrone et al. 2010 for the test", cfg(not(test)))]
pub struct ConeTest {
    /// n: the time τ over h/c.
    #[parameter(default: 30.0, unit: "1", min: 1.0, max: 1e6,
        source: "ours: 0.3/Mach², over 1, for a Mach number of 0.1")]
    pub time: f64,
    /// ε: share of ρ₀ that the constant may have where no surface is near.
    #[parameter(default: 0.01, unit: "1", min: 0.0, max: 1.0, source: "ours: a third of the 3 % that are borne")]
    pub tolerance: f64,
    /// True if particles at a surface have no pressure over that of the reference density: the condition p = 0 of a
    /// free surface, half a row too deep.
    #[parameter(default)]
    pub no_pressure: bool,
}

impl<const D: usize> Contribution<D> for ConeTest {
    fn offer(&mut self, setting: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        let sums = are_sums(setting);
        offer.stage(free_surface(sums));
        if sums {
            let laws = setting.laws.iter().map(|law| law.reference());
            offer.hook(Relaxation {
                plugin: *self,
                phases: laws.map(|r| (r.density, r.sound_speed)).collect(),
                energy: 0.0,
                parts: Vec::new(),
                given: Vec::new(),
            });
        }
        Ok(())
    }
}

/// True if densities are K and a sum.
pub(super) fn are_sums<const D: usize>(setting: &Setting<'_, D>) -> bool {
    setting.density.value.name == fields::DENSITY_CONSTANT.name
}

/// Sets the share of a difference that goes in `dt` seconds where sound of these speeds, m/s, takes it over `length`, m.
pub(super) fn set_parts(
    parts: &mut Vec<f64>,
    speeds: impl Iterator<Item = f64>,
    length: f64,
    dt: f64,
) {
    parts.clear();
    parts.extend(speeds.map(|c| 1.0 - (-dt * c / length).exp()));
}

struct Relaxation {
    plugin: ConeTest,
    /// ρ₀, kg/m³, and c, m/s, of every phase.
    phases: Vec<(f64, f64)>,
    /// Energy that it has given to the particles, J.
    energy: f64,
    /// Share of the difference that goes in a step, phase by phase; kept for its memory, as `given` is.
    parts: Vec<f64>,
    /// Energy given to each batch of particles, J.
    given: Vec<f64>,
}

impl ConeTest {
    /// Change of K of a particle with K, ρ and γ in a step of which a share `part` of the difference goes.
    fn change(
        &self,
        place: f64,
        [constant, density, gamma]: [f64; 3],
        reference: f64,
        part: f64,
    ) -> f64 {
        let slack = self.tolerance * reference;
        let is = |p: Place| place == p.number();
        if is(Place::Alone) {
            gamma * (reference - density)
        } else if is(Place::At) && self.no_pressure {
            part * gamma * (reference - density)
        } else if is(Place::At) {
            part * gamma * (reference - slack - density).max(0.0)
        } else if is(Place::Inside) {
            part * (constant.clamp(-slack, slack) - constant)
        } else {
            0.0
        }
    }
}

impl Relaxation {
    /// Relaxes the constants over a step, and counts the energy of the particles from it.
    fn relax<const D: usize>(
        &mut self,
        world: &World<D>,
        constant: &mut [f64],
        dt: f64,
    ) -> Result<(), StepError> {
        let h = world.kernel.smoothing_length();
        let (surface, density) = world.free.all((FREE_SURFACE, fields::DENSITY))?;
        let (pressure, volume) = world.free.all((fields::PRESSURE, fields::VOLUME))?;
        let phase = world.free.get(fields::PHASE).ok();
        let gamma = world.free.get(fields::RENORMALISATION).ok();
        let open = &world.walls.elements.open;
        let speeds = self.phases.iter().map(|(_, c)| *c);
        set_parts(&mut self.parts, speeds, self.plugin.time * h, dt);
        let (plugin, phases, parts) = (self.plugin, &self.phases, &self.parts);
        let one = |i: usize, constant: &mut f64| -> f64 {
            let phase = phase.map_or(0, |p| p[i] as usize);
            let mut contacts = world.walls.contacts.of_particle(i).iter();
            let inside = surface[i] == Place::Inside.number();
            if inside && contacts.any(|c| open.get(c.element as usize) == Some(&true)) {
                return 0.0;
            }
            let seen = [*constant, density[i], gamma.map_or(1.0, |g| g[i])];
            let change = plugin.change(surface[i], seen, phases[phase].0, parts[phase]);
            *constant += change;
            // dE = m p/ρ² dρ
            volume[i] * pressure[i] * change / (seen[2] * density[i])
        };
        const BATCH: usize = 2048;
        let batches = constant.par_chunks_mut(BATCH).enumerate();
        let given = batches.map(|(batch, all)| {
            let places = all.iter_mut().enumerate();
            places.map(|(k, c)| one(batch * BATCH + k, c)).sum()
        });
        given.collect_into_vec(&mut self.given);
        self.energy += self.given.iter().sum::<f64>();
        Ok(())
    }
}

impl<const D: usize> StepHook<D> for Relaxation {
    fn name(&self) -> String {
        "relaxation of the density constant".into()
    }
    fn access(&self) -> Access {
        Access::none()
            .here((FREE_SURFACE, fields::DENSITY_CONSTANT, fields::DENSITY))
            .here((fields::PRESSURE, fields::VOLUME))
            .where_there((fields::PHASE, fields::RENORMALISATION))
            .writes(fields::DENSITY_CONSTANT)
    }
    fn phases(&self) -> &'static [StepPhase] {
        &[StepPhase::AfterKick]
    }
    fn run(&mut self, _: StepPhase, moment: &mut StepMoment<'_, D>) -> Result<(), StepError> {
        let (world, dt) = (&mut *moment.world, moment.dt);
        let mut constant = world.free.take(fields::DENSITY_CONSTANT)?;
        self.relax(world, &mut constant, dt)?;
        Ok(world.free.put(fields::DENSITY_CONSTANT, constant)?)
    }
    fn report(&self, _: &World<D>) -> Report {
        Report {
            counts: Some(json!({ "energy": self.energy })),
            ..Report::default()
        }
    }
    fn resume(&mut self, counts: Json) {
        self.energy = counts["energy"].as_f64().unwrap_or(0.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constants_change_by_the_place_of_a_particle() {
        use Place::{Alone, At, Inside, Near};
        // K and ρ, the share of the difference that goes, whether surfaces have no pressure, and the change.
        for (place, constant, density, part, no_pressure, change) in [
            // A full support loses what it has beyond the tolerance.
            (Inside, 9.0, 1000.0, 1.0, false, 0.0),
            (Inside, -9.0, 1000.0, 1.0, false, 0.0),
            (Inside, 430.0, 1000.0, 1.0, false, -420.0),
            (Inside, -130.0, 1000.0, 1.0, false, 120.0),
            // Surfaces have no pressure where that is asked for.
            (At, 0.0, 1030.0, 0.5, true, -15.0),
            (At, 0.0, 960.0, 0.5, true, 20.0),
            // Within reach of a surface nothing changes.
            (Near, 400.0, 900.0, 1.0, false, 0.0),
            // Surfaces are not under tension, and lone particles have no pressure.
            (At, 0.0, 590.0, 0.5, false, 200.0),
            (At, 0.0, 1100.0, 0.5, false, 0.0),
            (Alone, 0.0, 140.0, 0.5, false, 860.0),
        ] {
            let plugin = ConeTest {
                no_pressure,
                ..ConeTest::default()
            };
            let seen = [constant, density, 1.0];
            let found = plugin.change(place.number(), seen, 1000.0, part);
            assert_eq!(found, change, "{place:?} with {constant} and {density}");
        }
    }
}
