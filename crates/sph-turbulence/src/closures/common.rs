//! Common refusals, needs and remarks of all closures.

use sph_contribution::{Offer, Refusal, Report, Setting};
use sph_core::{Access, Stage, suggestion};
use sph_neighbours::World;

use super::phases::{BedEddies, PhaseFilter, acting, check, viscosities};
use crate::bed::{BedShear, RoughBed};
use crate::distance::WallDistance;
use crate::kind::KIND;

/// Distances from walls that a closure reads.
#[derive(Clone, Debug)]
pub(crate) struct Distances {
    /// Walls that count; all, if empty.
    pub walls: Vec<String>,
    /// Beyond it no value is needed, m.
    pub within: f64,
}

/// State behind the stage of a closure.
#[derive(Clone, Debug, Default)]
pub(crate) struct ClosureCommon {
    /// Name of the plugin.
    pub name: &'static str,
    /// Names of the phases that it acts on; empty in a scene of one.
    pub phases: Vec<String>,
    /// A bed that is a rough wall.
    pub bed: Option<RoughBed>,
    /// Distances that it reads.
    pub distances: Option<Distances>,
    /// True if it resolves eddies, which are of three dimensions.
    pub eddies_in_space: bool,
}

impl ClosureCommon {
    /// Refuses phases that no closure is for.
    fn check<const D: usize>(&self, setting: &Setting<'_, D>) -> Result<(), Refusal> {
        let refused = |key: &str, why: String| Err(Refusal::at_key(KIND, key, why));
        check(self.name, &self.phases, setting)?;
        if let Some(bed) = &self.bed {
            bed.check(&self.phases, setting)?;
        }
        if let Some(distances) = &self.distances {
            let walls = &setting.world.walls;
            if walls.elements.centre.is_empty() {
                let why = format!(
                    "`{}` reads the distance from walls of segments or triangles, and there are none: it needs walls \
                     with `[walls.usaw]`",
                    self.name
                );
                return refused("", why);
            }
            let mut strange = distances.walls.iter().filter(|n| !walls.names.contains(n));
            if let Some(name) = strange.next() {
                let near = suggestion(name, walls.names.iter().map(String::as_str));
                return refused("walls", format!("there is no wall `{name}`{near}"));
            }
        }
        Ok(())
    }

    /// Offers the stage of a closure, where there are several phases only in its own; the stages of distances and of the
    /// bed, if it reads them; and a word at the end, if it has one.
    ///
    /// # Errors
    /// The key of what no closure is for.
    pub fn offer_to<const D: usize>(
        &self,
        setting: &Setting<'_, D>,
        stage: impl Stage<World<D>> + 'static,
        offer: &mut Offer<D>,
    ) -> Result<(), Refusal> {
        self.check(setting)?;
        match acting(&self.phases, setting) {
            None => offer.stage(stage),
            Some(acts) => {
                let bed = self.bed.as_ref().map(|bed| BedEddies {
                    law: bed.law(),
                    viscosities: viscosities(&self.phases, setting),
                });
                offer.stage(PhaseFilter { stage, acts, bed });
            }
        }
        if let Some(d) = &self.distances {
            offer.stage(WallDistance::new(&d.walls, d.within));
        }
        if let Some(bed) = &self.bed {
            let number = setting.phases.iter().position(|p| *p == bed.phase);
            let own = viscosities(&self.phases, setting);
            let number = number.unwrap_or_default() as u32;
            offer.stage(BedShear::new(number, own, bed.law()));
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
