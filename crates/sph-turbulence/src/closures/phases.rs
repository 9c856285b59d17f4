//! Phases on which a closure acts.

use sph_contribution::{Refusal, Setting};
use sph_core::{Field, Index, StepError, fields};
use sph_neighbours::World;

use crate::columns::BED;
use crate::wall::WallLaw;

pub(crate) const KIND: &str = "eddy-viscosity";

pub(crate) fn check<const D: usize>(
    closure: &str,
    named: &[String],
    setting: &Setting<'_, D>,
) -> Result<(), Refusal> {
    let refused = |key: &str, why: String| Err(Refusal::at_key(KIND, key, why));
    let viscous = |k: usize| setting.viscosities[k].is_some_and(|nu| nu > 0.0);
    let all = setting.phases;
    if named.is_empty() && all.len() > 1 {
        let fluids = (0..all.len()).filter(|k| viscous(*k));
        let fluids: Vec<_> = fluids.map(|k| format!("\"{}\"", all[k])).collect();
        let (count, fluids) = (all.len(), fluids.join(", "));
        let why = format!(
            "this scene has {count} phases: say on which of them `{closure}` acts, `phases = [{fluids}]`"
        );
        return refused("phases", why);
    }
    for name in named {
        let Some(k) = all.iter().position(|phase| phase == name) else {
            return Err(Refusal::unknown(KIND, "phases", "phase", name, all));
        };
        if !viscous(k) && all.len() > 1 {
            let why = format!(
                "`{closure}` acts in fluids with one viscosity, and phase `{name}` has none: take it out of the list, \
                 or give it `rheology.newtonian` with a viscosity"
            );
            return refused("phases", why);
        }
    }
    if all.len() > 1 || viscous(0) {
        return Ok(());
    }
    let name = &all[0];
    let why = format!(
        "`{closure}` acts in a fluid with one viscosity, and phase `{name}` has none: give it `rheology.newtonian` with a \
         viscosity"
    );
    refused("", why)
}

/// Marks of phases on which it acts; none where there is but one.
pub(crate) fn acting<const D: usize>(
    named: &[String],
    setting: &Setting<'_, D>,
) -> Option<Vec<bool>> {
    let all = setting.phases;
    (all.len() > 1).then(|| all.iter().map(|phase| named.contains(phase)).collect())
}

/// ν of the phases that it acts on, m²/s, in the order of the phase numbers.
pub(crate) fn viscosities<const D: usize>(
    named: &[String],
    setting: &Setting<'_, D>,
) -> Vec<Option<f64>> {
    let both = setting.viscosities.iter().zip(setting.phases);
    let acts = |(nu, phase): (&Option<f64>, &String)| nu.filter(|_| acts_on(named, phase));
    both.map(acts).collect()
}

/// ν of every particle, m²/s; none of those of phases that a closure does not act on.
#[derive(Clone, Copy)]
pub(crate) struct Kinematic<'a> {
    of_phase: &'a [Option<f64>],
    phase: Option<&'a [u32]>,
}

impl<'a> Kinematic<'a> {
    /// Of the phases of a world.
    pub fn from_world<const D: usize>(
        of_phase: &'a [Option<f64>],
        world: &'a World<D>,
    ) -> Result<Self, StepError> {
        let phase = world.free.all(Self::column(of_phase))?;
        Ok(Kinematic { of_phase, phase })
    }

    /// The column of phases, where there are several.
    pub fn column(of_phase: &[Option<f64>]) -> Option<Field<Index>> {
        (of_phase.len() > 1).then_some(fields::PHASE)
    }

    /// That of a particle.
    pub fn at(&self, i: usize) -> Option<f64> {
        self.of_phase[self.phase.map_or(0, |p| p[i] as usize)]
    }
}

/// True if it acts on a phase of a name.
pub(crate) fn acts_on(named: &[String], phase: &str) -> bool {
    named.is_empty() || named.iter().any(|name| name == phase)
}

/// Eddies that make the shear of a rough bed.
pub(crate) struct BedEddies {
    pub law: WallLaw,
    /// ν of every phase, m²/s; none of those without a bed.
    pub viscosities: Vec<Option<f64>>,
}

impl BedEddies {
    /// η_t of (η + η_t) u_t/z = ρu*², where the laminar share is less than that.
    pub fn set<const D: usize>(
        &self,
        world: &World<D>,
        eddies: &mut [f64],
    ) -> Result<(), StepError> {
        let (friction, distance) = world.free.all(BED)?;
        let (density, phase) = world.free.all((fields::DENSITY, fields::PHASE))?;
        for i in (0..eddies.len()).filter(|i| friction[*i] > 0.0) {
            let Some(nu) = self.viscosities[phase[i] as usize] else {
                continue;
            };
            let speed = self.law.speed(friction[i], distance[i], nu);
            let both = friction[i] * friction[i] * distance[i] / speed;
            eddies[i] = density[i] * (both - nu).max(0.0);
        }
        Ok(())
    }
}
