//! What all closures refuse, need and say.

use sph_contribution::{Contribution, Refusal, Setting, Stages, StepWork};
use sph_core::{Access, AnyField, Stage, suggestion};
use sph_neighbours::World;

use super::phases::{BedEddies, Only, acting, check, viscosities};
use crate::bed::{BedShear, RoughBed};
use crate::distance::WallDistance;
use crate::kind::KIND;

/// Distances from walls that a closure reads.
#[derive(Clone, Debug)]
pub(crate) struct Distances {
    /// Which walls count; all, if empty.
    pub walls: Vec<String>,
    /// Beyond it nobody asks, m.
    pub within: f64,
}

/// What stands behind the stage of a closure.
#[derive(Clone, Debug, Default)]
pub(crate) struct Behind {
    /// Name of the plugin.
    pub name: &'static str,
    /// Names of the phases that it acts on; empty in a scene of one.
    pub phases: Vec<String>,
    /// A bed that is a rough wall.
    pub bed: Option<RoughBed>,
    /// Distances that it reads.
    pub distances: Option<Distances>,
    /// Whether it resolves eddies, which are of three dimensions.
    pub eddies_in_space: bool,
}

impl Behind {
    /// Refuses what no closure is for.
    pub fn check<const D: usize>(&self, setting: &Setting<'_, D>) -> Result<(), Refusal> {
        let refused = |key: &str, why: String| Err(Refusal::of(KIND, key, why));
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

    /// The stage of the closure, where there are several phases only in its own.
    pub fn stage<const D: usize>(
        &self,
        setting: &Setting<'_, D>,
        stage: impl Stage<World<D>> + 'static,
    ) -> Box<dyn Stage<World<D>>> {
        match acting(&self.phases, setting) {
            Some(acts) => {
                let bed = self.bed.as_ref().map(|bed| BedEddies {
                    law: bed.law(),
                    viscosities: viscosities(&self.phases, setting),
                });
                Box::new(Only { stage, acts, bed })
            }
            None => Box::new(stage),
        }
    }

    /// The stages of distances and of the bed, if it reads them.
    pub fn stages<const D: usize>(&self, setting: &Setting<'_, D>) -> Stages<D> {
        let stage = |d: &Distances| -> Box<dyn Stage<World<D>>> {
            Box::new(WallDistance::new(&d.walls, d.within))
        };
        let mut all: Stages<D> = self.distances.iter().map(stage).collect();
        if let Some(bed) = &self.bed {
            let number = setting.phases.iter().position(|p| *p == bed.phase);
            let own = viscosities(&self.phases, setting);
            let stage = BedShear::new(number.unwrap_or_default() as u32, own, bed.law());
            all.push(Box::new(stage));
        }
        all
    }

    /// A word at the end, if it has one.
    pub fn works<const D: usize>(&self) -> Vec<Box<dyn StepWork<D>>> {
        match self.eddies_in_space && D == 2 {
            true => vec![Box::new(Flat(self.name))],
            false => Vec::new(),
        }
    }
}

impl<const D: usize> Contribution<D> for Behind {
    fn check(&self, setting: &Setting<'_, D>) -> Result<(), Refusal> {
        Behind::check(self, setting)
    }
    fn stages(&self, setting: &Setting<'_, D>) -> Stages<D> {
        Behind::stages(self, setting)
    }
    fn works(
        &mut self,
        _: &Setting<'_, D>,
        _: &[AnyField],
    ) -> Result<Vec<Box<dyn StepWork<D>>>, Refusal> {
        Ok(Behind::works(self))
    }
}

/// Large eddies in the plane.
struct Flat(&'static str);

impl<const D: usize> StepWork<D> for Flat {
    fn name(&self) -> String {
        self.0.into()
    }
    fn access(&self) -> Access {
        Access::none()
    }
    fn warnings(&self) -> Vec<String> {
        vec![format!(
            "`{}` is a model of eddies below the spacing of a flow whose larger ones are resolved, and they are of three \
             dimensions: in two its results are not those of a turbulent flow (Issa 2004, §5.2.3)",
            self.0
        )]
    }
}
