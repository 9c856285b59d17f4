//! The largest stable step.

use serde::{Deserialize, Serialize};

use crate::coupled::pores::{Places, Pores};
use crate::coupled::{CoupledError, StepLimit, Vector};
use crate::flow::Boundary;
use crate::grains::{GrainSystem, Wall};

/// The mode of strongest drag, kept as the start of the next search.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
pub(crate) struct Mode {
    /// Velocities of the grains, m/s; empty before the first search.
    grains: Vec<Vector>,
    /// Velocities of the walls along their normals, m/s.
    walls: Vec<f64>,
    /// λ, 1/s.
    pub rate: f64,
    pub grain: usize,
}

/// Applications of the operator at most, and the relative change of λ at which they end.
const MOST: usize = 60;
const LEAST: usize = 4;
const CHANGE: f64 = 1e-3;

/// Root of λ Δt / 2 + ω² Δt² / 4 = 1 with ω = 2 / `elastic`: beyond it the leap-frog with drag of the velocity half a
/// step behind, z² − (2 − λ Δt − ω² Δt²) z + (1 − λ Δt), has a root below −1.
pub(crate) fn combined(elastic: f64, rate: f64, grain: usize) -> StepLimit {
    let half = 0.25 * rate;
    // 1 / (a + √(a² + 1/Δt_e²)), the root without the difference of near numbers.
    let step = 1.0 / (half + (half * half + elastic.powi(-2)).sqrt());
    StepLimit {
        step,
        elastic,
        viscous: 2.0 / rate,
        grain,
    }
}

/// λ_max of M⁻¹ S G⁻¹ E by power iterations: velocities change the volumes of pores, pressures answer, their forces
/// slow the grains. Bodies are the free grains and free pistons. The change of volumes is a central difference, exact
/// but for 1e-8 as volumes are cubic. Source: Catalano 2012, Eqs. (4.9) to (4.15), but for all grains at once.
pub(crate) fn strongest_drag(
    grains: &GrainSystem,
    pores: &mut Pores,
    mode: Mode,
) -> Result<Mode, CoupledError> {
    let bodies = Bodies::new(grains);
    let boundary = pores.boundary.silent();
    let places = Places::from_grains(grains);
    let mut mode = bodies.started(mode);
    bodies.normalise(&mut mode);
    for made in 0..MOST {
        let before = mode.rate;
        bodies.apply(&places, pores, &boundary, &mut mode)?;
        mode.rate = bodies.normalise(&mut mode);
        let still = (mode.rate - before).abs() <= CHANGE * mode.rate;
        if mode.rate == 0.0 || (made >= LEAST && still) {
            break;
        }
    }
    let speeds = mode.grains.iter().map(Vector::norm_squared).enumerate();
    let faster = |best: (usize, f64), (i, v)| if v > best.1 { (i, v) } else { best };
    (mode.grain, _) = speeds.fold((0, -1.0), faster);
    Ok(mode)
}

/// Masses of free bodies; infinite for the others.
struct Bodies {
    grains: Vec<f64>,
    walls: Vec<f64>,
    smallest: f64,
}

impl Bodies {
    fn new(system: &GrainSystem) -> Self {
        let grains = &system.grains;
        let held = grains.held.iter().zip(&grains.mass);
        let grain = |(held, m): (&bool, &f64)| if *held { f64::INFINITY } else { *m };
        Self {
            grains: held.map(grain).collect(),
            walls: system.walls.iter().map(Wall::mass).collect(),
            smallest: grains.radius.iter().copied().fold(f64::INFINITY, f64::min),
        }
    }

    /// Alternating velocities that no symmetry of a packing shares, if there is no mode from before.
    fn started(&self, mode: Mode) -> Mode {
        let fits = mode.grains.len() == self.grains.len() && mode.walls.len() == self.walls.len();
        if fits && mode.rate > 0.0 {
            return mode;
        }
        let mut seed = 0x9e37_79b9_7f4a_7c15_u64;
        let mut draw = || {
            // Marsaglia's xorshift.
            seed ^= seed << 13;
            seed ^= seed >> 7;
            seed ^= seed << 17;
            (seed >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
        };
        let free = |mass: f64| if mass.is_finite() { 1.0 } else { 0.0 };
        let grains = self.grains.iter();
        let grains = grains.map(|m| Vector::from_fn(|_, _| draw()) * free(*m));
        Mode {
            grains: grains.collect(),
            walls: self.walls.iter().map(|m| free(*m)).collect(),
            rate: 0.0,
            grain: 0,
        }
    }

    /// Scales to Σ m v² = 1; returns the root before.
    fn normalise(&self, mode: &mut Mode) -> f64 {
        let energy = |m: f64, square: f64| if m.is_finite() { m } else { 0.0 } * square;
        let grains = mode.grains.iter().zip(&self.grains);
        let grains = grains.map(|(v, m)| energy(*m, v.norm_squared()));
        let walls = mode.walls.iter().zip(&self.walls);
        let walls = walls.map(|(v, m)| energy(*m, 1.0) * v * v);
        let size = grains.chain(walls).sum::<f64>().sqrt();
        if size > 0.0 {
            mode.grains.iter_mut().for_each(|v| *v /= size);
            mode.walls.iter_mut().for_each(|v| *v /= size);
        }
        size
    }

    /// Replaces velocities by their decrease per second by drag.
    fn apply(
        &self,
        places: &Places,
        pores: &mut Pores,
        boundary: &Boundary,
        mode: &mut Mode,
    ) -> Result<(), CoupledError> {
        let fastest = mode.grains.iter().map(|v| v.amax()).fold(0.0, f64::max);
        let fastest = mode.walls.iter().map(|v| v.abs()).fold(fastest, f64::max);
        if fastest == 0.0 {
            return Ok(());
        }
        let time = 1e-4 * self.smallest / fastest;
        let moved = |time: f64| {
            let centres = places.centres.iter().zip(&mode.grains);
            let walls = places.walls.iter().zip(&mode.walls);
            Places {
                centres: centres.map(|(x, v)| x + v * time).collect(),
                walls: walls.map(|((n, c), v)| (*n, c + v * time)).collect(),
            }
        };
        let (after, before) = (pores.volumes(&moved(time)), pores.volumes(&moved(-time)));
        let rates = after.iter().zip(&before);
        let rates: Vec<_> = rates.map(|(a, b)| (a - b) / (2.0 * time)).collect();
        let pressures = pores.system.solve(boundary, &rates)?;
        let forces = pores.forces.apply(&pressures);
        let (on_grains, on_walls) = forces.split_at(self.grains.len());
        for ((v, m), f) in mode.grains.iter_mut().zip(&self.grains).zip(on_grains) {
            *v = -f / *m;
        }
        for (wall, (n, _)) in places.walls.iter().enumerate() {
            mode.walls[wall] = -on_walls[wall].dot(n) / self.walls[wall];
        }
        Ok(())
    }
}
