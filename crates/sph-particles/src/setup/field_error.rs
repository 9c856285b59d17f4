//! The difference of a field from a solution, at the end and as a probe over time.

use sph_core::{Plain, StepError, Vect, fields};
use sph_neighbours::World;
use sph_probes::{Probe, ProbeColumn, Solution, norm};
use sph_scene::{Norm, Reference, Scene};

/// Values of a field at the particles, those of a solution, and how many of them are one particle's.
pub fn beside_solution<const D: usize>(
    world: &World<D>,
    field: &str,
    solution: &dyn Solution<D>,
) -> Result<(Vec<f64>, Vec<f64>, usize), String> {
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
    Ok((values.into_owned(), exact, components))
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
        let compared = beside_solution(world, &self.field, &*self.solution);
        let compared = compared.map_err(|why| StepError::stage("references", why));
        let (values, exact, components) = compared?;
        let volume = world.free.get(fields::VOLUME)?;
        Ok(vec![norm::l2(&values, &exact, volume, components)])
    }
}

/// Name of the series' column with the error of a reference.
pub fn column(reference: &str) -> String {
    format!("error.{reference}")
}

/// A probe for every reference whose norm is a mean over time, with the solution of that.
pub fn probes<const D: usize>(
    scene: &Scene,
    solutions: &mut Vec<(String, Box<dyn Solution<D>>)>,
) -> Vec<(String, Box<dyn Probe<D>>)> {
    let means = scene.reference.iter();
    let means = means.filter(|(_, r)| r.norm() == Norm::L2Mean);
    let probe = |(name, reference): (&String, &Reference)| {
        let field = reference.field.clone()?;
        let at = solutions.iter().position(|(n, _)| n == name)?;
        let (_, solution) = solutions.remove(at);
        let probe: Box<dyn Probe<D>> = Box::new(ErrorProbe { field, solution });
        Some((column(name), probe))
    };
    means.filter_map(probe).collect()
}
