//! Common refusals, needs and remarks of all closures.

use sph_contribution::{Offer, Refusal, Report, Setting};
use sph_core::{Access, StepError, fields};
use sph_neighbours::{World, column_stage};

use super::phases::{BedEddies, KIND, acting, check, viscosities};
use crate::bed::{RoughBed, bed_shear};
use crate::columns::BED;
use crate::distance::wall_distance;

#[derive(Default)]
pub(crate) struct ClosureCommon<'a> {
    pub name: &'static str,
    /// Names of the phases that it acts on; empty in a scene of one.
    pub phases: &'a [String],
    pub bed: Option<&'a RoughBed>,
    /// Walls from which it reads distances, all if there are none, and beyond what distance it needs no value, m.
    pub distances: Option<(&'a [String], f64)>,
    /// True if it resolves eddies, which are of three dimensions.
    pub eddies_in_space: bool,
}

/// True if a wall of elements rubs by itself.
pub(crate) fn rubs<const D: usize>(setting: &Setting<'_, D>) -> bool {
    let factors = &setting.world.walls.elements.friction_factor;
    factors.iter().any(|factor| *factor > 0.0)
}

impl ClosureCommon<'_> {
    fn check<const D: usize>(&self, setting: &Setting<'_, D>) -> Result<(), Refusal> {
        let name = self.name;
        check(name, self.phases, setting)?;
        if let Some(bed) = self.bed {
            bed.check(self.phases, setting)?;
        }
        if let Some((named, _)) = self.distances {
            let walls = &setting.world.walls;
            if walls.elements.centre.is_empty() {
                let why = format!(
                    "`{name}` reads the distance from walls of segments or triangles, and there are none: it needs walls \
                     with `[walls.usaw]`"
                );
                return Err(Refusal::at_key(KIND, "", why));
            }
            let mut strange = named.iter().filter(|n| !walls.names.contains(n));
            if let Some(name) = strange.next() {
                return Err(Refusal::unknown(KIND, "walls", "wall", name, &walls.names));
            }
        }
        Ok(())
    }

    /// Offers the stage of a closure, of a name in plans and the columns that it reads, which sets the eddy viscosities, Pa s:
    /// none in phases on which it does not act, neither in soils nor in fluids that are not named. Besides the stages of
    /// distances and of the bed, if it reads them; and a word at the end, if it has one.
    pub fn offer_to<const D: usize>(
        &self,
        setting: &Setting<'_, D>,
        (name, access): (&'static str, Access),
        set: impl Fn(&World<D>, &mut [f64]) -> Result<(), StepError> + Send + 'static,
        offer: &mut Offer<D>,
    ) -> Result<(), Refusal> {
        self.check(setting)?;
        let acts = acting(self.phases, setting);
        let bed = self.bed.map(|bed| BedEddies {
            law: bed.law(),
            viscosities: viscosities(self.phases, setting),
        });
        let access = access
            .here(acts.as_ref().map(|_| fields::PHASE))
            .here(bed.as_ref().map(|_| (fields::DENSITY, BED)));
        let fill = move |world: &World<D>, eddies: &mut [f64]| {
            set(world, eddies)?;
            if let Some(acts) = &acts {
                let phase = world.free.get(fields::PHASE)?;
                let all = eddies.iter_mut().zip(phase);
                let others = all.filter(|(_, phase)| !acts[**phase as usize]);
                others.for_each(|(eddy, _)| *eddy = 0.0);
            }
            if let Some(bed) = &bed {
                bed.set(world, eddies)?;
            }
            Ok(())
        };
        offer.stage(column_stage(name, access, fields::EDDY_VISCOSITY, fill));
        if let Some((walls, within)) = self.distances {
            offer.stage(wall_distance(walls.to_vec(), within));
        }
        if let Some(bed) = self.bed {
            let number = setting.phases.iter().position(|p| *p == bed.phase);
            let number = number.unwrap_or_default() as u32;
            let own = viscosities(self.phases, setting);
            offer.stage(bed_shear(number, own, bed.law()));
        }
        if self.eddies_in_space && D == 2 {
            let warning = format!(
                "`{}` is a model of eddies below the spacing of a flow whose larger ones are resolved, and they are of \
                 three dimensions: in two its results are not those of a turbulent flow (Issa 2004, §5.2.3)",
                self.name
            );
            offer.report(Access::none(), move |_| Report::warning(&warning));
        }
        Ok(())
    }
}
