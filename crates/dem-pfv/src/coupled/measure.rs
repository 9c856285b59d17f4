//! Measurements: pressures and stresses of layers, mobility, outflow.

use crate::coupled::system::sphere;
use crate::coupled::{CoupledError, CoupledSystem, Vector, condition};
use crate::flow::{FlowSystem, Solver};

impl CoupledSystem {
    /// A place inside each cell (m), for sensors and profiles: the mean of its centres, half-way to its walls.
    pub fn pore_places(&self) -> Vec<Vector> {
        self.pores.middles()
    }

    /// Mean pressure (Pa) of the cells whose places lie between two places along an axis (m), by their volumes; none
    /// without such cells.
    pub fn layer_pressure(&self, axis: usize, from: f64, to: f64) -> Option<f64> {
        let cells = self.cells(axis, |x| (from..to).contains(&x[axis]));
        let sums = cells.iter().fold((0.0, 0.0), |(v, pv), (_, volume, p)| {
            (v + volume, pv + p * volume)
        });
        (sums.0 > 0.0).then(|| sums.1 / sums.0)
    }

    /// Place along an axis (m), volume (m³) and pressure (Pa) of the cells whose places are inside.
    fn cells(&self, axis: usize, inside: impl Fn(&Vector) -> bool) -> Vec<(f64, f64, f64)> {
        let places = self.pores.middles();
        let clock = &self.clock;
        let cells = places.iter().zip(&clock.volumes).zip(&clock.pressures);
        let cells = cells.filter(|((x, _), _)| inside(x));
        cells
            .map(|((x, volume), p)| (x[axis], *volume, *p))
            .collect()
    }

    /// Slope −dp/dx of the pressure along an axis (Pa/m): least squares over the cells whose places (m) are inside, by
    /// their volumes; none with fewer than two.
    pub fn gradient(&self, axis: usize, inside: impl Fn(&Vector) -> bool) -> Option<f64> {
        let [mut w, mut x1, mut p1, mut xx, mut xp] = [0.0; 5];
        for (x, volume, p) in self.cells(axis, inside) {
            w += volume;
            x1 += volume * x;
            p1 += volume * p;
            xx += volume * x * x;
            xp += volume * x * p;
        }
        let spread = w * xx - x1 * x1;
        (spread > 0.0).then(|| -(w * xp - x1 * p1) / spread)
    }

    /// Sum of the fluid's forces on all grains, buoyancy apart, N.
    pub fn drag(&self) -> Vector {
        let grains = &self.grains.grains;
        let total: Vector = grains.external_force.iter().sum();
        total + self.setup.fluid.density * self.grains.gravity * grains.volume()
    }

    /// Weight of the grains less buoyancy Σ (ρ_s − ρ_f) V g, N.
    pub fn buoyant_weight(&self) -> Vector {
        let grains = &self.grains.grains;
        let solid: f64 = grains.mass.iter().sum();
        let fluid: f64 = grains.radius.iter().map(|r| sphere(*r)).sum();
        self.grains.gravity * (solid - self.setup.fluid.density * fluid)
    }

    /// Makes every further step measure the flow through walls.
    pub fn measure_inflow(&mut self) {
        self.inflows = Some(Vec::new());
    }

    /// Flow into the pores through a wall at the last step, m³/s, negative if out of them. The volume that a moving
    /// wall frees counts: through all walls together, the rate of the box's volume and the storage of the fluid. Where
    /// walls with pressures meet, the later one counts. None before the first step after
    /// [`CoupledSystem::measure_inflow`].
    pub fn inflow(&self, wall: usize) -> Option<f64> {
        self.inflows.as_ref()?.get(wall).copied()
    }

    /// K = κ/µ of the packing as it was meshed, m²/(Pa s): 1 Pa between the two walls across an axis, other walls
    /// closed, K = Q ℓ / (Δp S). Times γ_f it is the hydraulic conductivity. Source: Catalano 2012, Eq. (1.32).
    ///
    /// # Errors
    /// A system that cannot be solved.
    pub fn mobility(&self, axis: usize) -> Result<f64, CoupledError> {
        let geometry = &self.pores.geometry;
        let mut sides = vec![crate::coupled::WallBoundary::closed(); 6];
        let walls = self.grains.walls.iter().enumerate();
        let facing = |sign: f64| {
            let found = walls.clone().find(|(_, w)| sign * w.normal[axis] > 0.5);
            found.map(|(number, _)| number)
        };
        let none = crate::grains::GrainError::NoArea(2 * axis);
        let (Some(low), Some(high)) = (facing(1.0), facing(-1.0)) else {
            return Err(none.into());
        };
        sides[low] = crate::coupled::WallBoundary::drained(0.0);
        sides[high] = crate::coupled::WallBoundary::drained(1.0);
        let boundary = condition::boundary(&sides, geometry, 0.0);
        let viscosity = self.setup.fluid.viscosity;
        let mut system = FlowSystem::new(
            geometry,
            &boundary,
            &*self.law,
            viscosity,
            None,
            Solver::Automatic,
        )?;
        let pressures = system.solve(&boundary, &[])?;
        let length = self.grains.box_lengths().ok_or(none)?[axis];
        Ok(system.inflow(geometry, high, &pressures) * length / self.grains.section(axis)?)
    }
}
