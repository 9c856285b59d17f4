//! What all closures refuse, need and say.

use sph_contribution::{Contribution, Refusal, Setting, Stages, StepWork};
use sph_core::{Access, AnyField, suggestion};
use sph_neighbours::World;

use crate::distance::WallDistance;

/// The kind of all closures.
pub(crate) const KIND: &str = "eddy-viscosity";

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
    /// Distances that it reads.
    pub distances: Option<Distances>,
    /// Whether it resolves eddies, which are of three dimensions.
    pub eddies_in_space: bool,
}

impl Behind {
    /// Refuses what no closure is for.
    pub fn check<const D: usize>(&self, setting: &Setting<'_, D>) -> Result<(), Refusal> {
        let refused = |key: &str, why: String| Err(Refusal::of(KIND, key, why));
        if setting.phases.len() > 1 {
            return refused(
                "",
                format!(
                    "`{}` acts in scenes of one phase, and this one has {}: between phases the production of turbulence is \
                     another one, which is not built in",
                    self.name,
                    setting.phases.len()
                ),
            );
        }
        if !matches!(setting.viscosities, [Some(nu)] if *nu > 0.0) {
            return refused(
                "",
                format!(
                    "`{}` acts in a fluid with one viscosity, and phase `{}` has none: give it `rheology.newtonian` with a \
                     viscosity",
                    self.name, setting.phases[0]
                ),
            );
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

    /// The distance stage, if it reads one.
    pub fn stages<const D: usize>(&self) -> Stages<D> {
        let stage = |d: &Distances| -> Box<dyn sph_core::Stage<World<D>>> {
            Box::new(WallDistance::new(&d.walls, d.within))
        };
        self.distances.iter().map(stage).collect()
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
    fn stages(&self, _: &Setting<'_, D>) -> Stages<D> {
        Behind::stages(self)
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
