//! A component of the velocity along a line, beside a reference.

use nalgebra::{DMatrix, DVector};
use sph_core::{Axis, StepError, Vect, fields, plugin};
use sph_neighbours::World;

use crate::flow::point::point;
use crate::{Curves, Probe, ProbeColumn, ProbeEntry};

/// Root mean square over a reference's places of u − e, with u a component of the velocity on a straight
/// line and e the reference, and the largest |u − e|, m/s. The profile itself is its curve.
///
/// u is the linear function that fits the velocities nearby best: the least Σ Vw (u(r_b) − u_b)² over the
/// particles and the points of walls that rub (at the velocity that friction sees there), weighed with their share of fluid. So it is exact for
/// linear velocities up to the wall, where a mean of the particles is off by h |∇u|. Where the places
/// nearby do not determine a slope it is their mean, and NaN where there is no particle.
///
/// Source: ours; moving least squares of first order.
///
/// ```toml
/// [probe.u]
/// kind = "profile"
/// component = "x"
/// from = [0.5, 0.0]
/// to = [0.5, 1.0]
/// file = "data/ghia1982_u_re100.csv"
/// ```
#[plugin(ProbeEntry [2, 3], "profile", "a component of the velocity along a line, beside a reference",
    source: "moving least squares of first order")]
pub struct Profile {
    /// Component of the velocity.
    pub component: Axis,
    /// Start of the line.
    #[parameter(unit: "m")]
    pub from: Vec<f64>,
    /// End of the line.
    #[parameter(unit: "m")]
    pub to: Vec<f64>,
    /// CSV file of the reference, relative to the scene's folder: distance from the start in m, velocity in m/s.
    pub file: String,
    #[serde(skip)]
    reference: Vec<[f64; 2]>,
}

impl Profile {
    /// Distances, velocities and references.
    fn sampled<const D: usize>(&self, world: &World<D>) -> Result<Vec<[f64; 3]>, StepError> {
        let from = point::<D>(&self.from);
        let along = (point::<D>(&self.to) - from)
            .try_normalize(0.0)
            .unwrap_or_else(Vect::zeros);
        let component = self.component as usize;
        let rows = self.reference.iter().map(|[s, e]| {
            let u = fitted(world, &(from + along * *s))?;
            let u = u.map_or(f64::NAN, |u| u.get(component).copied().unwrap_or(0.0));
            Ok([*s, u, *e])
        });
        rows.collect()
    }
}

/// Least eigenvalue over the largest of the matrix of a fit that is believed.
const LEAST: f64 = 1e-6;

/// The velocity at a place by a linear fit of the particles around; none where there is no particle.
fn fitted<const D: usize>(world: &World<D>, x: &Vect<D>) -> Result<Option<Vect<D>>, StepError> {
    let (positions, velocities) = world.free.all((fields::POSITION, fields::VELOCITY))?;
    let volumes = world.free.get(fields::VOLUME)?;
    let points = &world.walls.points;
    let h = world.kernel.smoothing_length();
    let mut matrix = DMatrix::<f64>::zeros(D + 1, D + 1);
    let mut right = DMatrix::<f64>::zeros(D + 1, D);
    let mut add = |place: &Vect<D>, u: &Vect<D>, volume: f64| {
        let apart = world.domain.nearest_image(place - x);
        let r = apart.norm();
        if r >= world.kernel.support_radius() || volume <= 0.0 {
            return false;
        }
        let weight = volume * world.kernel.at(r).0;
        let basis = DVector::from_fn(D + 1, |k, _| if k == 0 { 1.0 } else { apart[k - 1] / h });
        matrix.ger(weight, &basis, &basis, 1.0);
        right.ger(weight, &basis, &DVector::from_fn(D, |k, _| u[k]), 1.0);
        true
    };
    let mut some = false;
    for (k, place) in positions.iter().enumerate() {
        some |= add(place, &velocities[k], volumes[k]);
    }
    if !some {
        return Ok(None);
    }
    for (v, place) in points.position.iter().enumerate() {
        let volume = points.share[v] * points.volume[v] * points.friction_factor[v];
        add(place, &points.viscous_velocity[v], volume);
    }
    let spectrum = matrix.clone().symmetric_eigen().eigenvalues;
    let mean = Vect::from_fn(|k, _| right[(0, k)] / matrix[(0, 0)]);
    if spectrum.min() < LEAST * spectrum.max() {
        return Ok(Some(mean));
    }
    let fit = matrix.cholesky().map(|m| m.solve(&right));
    Ok(Some(fit.map_or(mean, |f| Vect::from_fn(|k, _| f[(0, k)]))))
}

impl<const D: usize> Probe<D> for Profile {
    fn columns(&self) -> Vec<ProbeColumn> {
        ProbeColumn::several(&[(".rms", "m/s"), (".largest", "m/s")])
    }

    fn file(&self) -> Option<&str> {
        Some(&self.file)
    }

    fn load_reference(&mut self, rows: Vec<[f64; 2]>) -> Result<(), String> {
        if rows.is_empty() || rows.iter().flatten().any(|v| !v.is_finite()) {
            return Err("is no profile: expected rows of a distance and a velocity".into());
        }
        self.reference = rows;
        Ok(())
    }

    fn measure(&self, world: &World<D>) -> Result<Vec<f64>, StepError> {
        let rows = self.sampled(world)?;
        let off = || rows.iter().map(|[_, u, e]| u - e).filter(|d| !d.is_nan());
        let count = off().count();
        if count == 0 {
            return Ok(vec![f64::NAN; 2]);
        }
        let squares: f64 = off().map(|d| d * d).sum();
        let largest = off().fold(0.0, |m: f64, d| m.max(d.abs()));
        Ok(vec![(squares / count as f64).sqrt(), largest])
    }

    fn as_curves(&self) -> Option<&dyn Curves<D>> {
        Some(self)
    }
}

impl<const D: usize> Curves<D> for Profile {
    fn curve_columns(&self) -> Vec<ProbeColumn> {
        ProbeColumn::several(&[("distance", "m"), ("velocity", "m/s"), ("reference", "m/s")])
    }

    fn curves(&self, world: &World<D>) -> Result<Vec<Vec<f64>>, StepError> {
        let rows = self.sampled(world)?;
        Ok(rows.into_iter().map(|row| row.to_vec()).collect())
    }
}
