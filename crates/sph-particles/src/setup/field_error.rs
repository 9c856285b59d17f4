//! The difference of a field from a solution, at the end and as a probe over time.

use sph_core::{Plain, Registry, StepError, Vect, fields};
use sph_neighbours::World;
use sph_probes::{Probe, ProbeColumn, Solution, SolutionEntry, norm};
use sph_scene::{Norm, Scene};
use sph_solver::SolverError;

/// A field and its exact values, `components` numbers per particle.
pub struct Compared {
    /// Values of the field.
    pub values: Vec<f64>,
    /// Values of the solution.
    pub exact: Vec<f64>,
    /// Numbers per particle.
    pub components: usize,
}

impl Compared {
    /// The field at the particles beside the solution.
    ///
    /// # Errors
    /// If there is no such field, or the solution does not give it.
    pub fn with_solution<const D: usize>(
        world: &World<D>,
        field: &str,
        solution: &dyn Solution<D>,
    ) -> Result<Self, String> {
        let positions = world.free.get(fields::POSITION);
        let found = world.free.columns().find(|(n, ..)| *n == field);
        let Some((_, _, _, components, Plain::Real(values))) = found else {
            return Err(format!(
                "there is no field `{field}` of real numbers in this scene"
            ));
        };
        let mut exact = Vec::with_capacity(values.len());
        for x in positions.map_err(|e| e.to_string())? {
            match field {
                "velocity" => {
                    let u: Option<Vect<D>> = solution.velocity(x, world.time);
                    exact.extend(u.ok_or("the solution has no velocity")?.iter());
                }
                "pressure" => {
                    let p = solution.pressure(x, world.time);
                    exact.push(p.ok_or("the solution has no pressure")?);
                }
                _ => {
                    let value = solution.scalar(field, x, world.time);
                    let none = || format!("the solution does not give the field `{field}`");
                    exact.push(value.ok_or_else(none)?);
                }
            }
        }
        Ok(Compared {
            values: values.into_owned(),
            exact,
            components,
        })
    }
}

/// √(Σ V|u − e|² / Σ V|e|²) at every row of the series.
struct ErrorProbe<const D: usize> {
    field: String,
    solution: Box<dyn Solution<D>>,
}

impl<const D: usize> Probe<D> for ErrorProbe<D> {
    fn columns(&self) -> Vec<ProbeColumn> {
        ProbeColumn::only("1")
    }

    fn measure(&self, world: &World<D>) -> Result<Vec<f64>, StepError> {
        let compared = Compared::with_solution(world, &self.field, &*self.solution);
        let compared = compared.map_err(|why| StepError::stage("references", why))?;
        let volume = world.free.get(fields::VOLUME)?;
        let (values, exact) = (&compared.values, &compared.exact);
        Ok(vec![norm::l2(values, exact, volume, compared.components)])
    }
}

/// Name of the series' column with the error of a reference.
pub fn column(reference: &str) -> String {
    format!("error.{reference}")
}

/// A probe for every reference whose norm is a mean over time.
///
/// # Errors
/// If its solution cannot be built.
#[allow(clippy::type_complexity, reason = "the list of probes as it is kept")]
pub fn probes<const D: usize>(
    scene: &Scene,
) -> Result<Vec<(String, Box<dyn Probe<D>>)>, SolverError> {
    let mut probes: Vec<(String, Box<dyn Probe<D>>)> = Vec::new();
    for (name, reference) in &scene.reference {
        let (Norm::L2Mean, Some(field), Some(choice)) =
            (reference.norm(), &reference.field, scene.solution(name))
        else {
            continue;
        };
        let built = Registry::<SolutionEntry>::discovered()
            .and_then(|registry| registry.find(&choice.name))
            .and_then(|entry| entry.build::<D>(&choice.table));
        let solution = built.map_err(|e| SolverError::Scene(choice.scene_problems(&e)))?;
        let field = field.clone();
        probes.push((column(name), Box::new(ErrorProbe { field, solution })));
    }
    Ok(probes)
}
