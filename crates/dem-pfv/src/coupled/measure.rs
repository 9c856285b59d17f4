//! Readings of a coupled system: pressures and stresses of layers, mobility, outflow, its state; exact consolidation.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use crate::coupled::pores::{PRESSED, Places};
use crate::coupled::{
    CoupledError, CoupledSystem, FlowSetup, PoreState, Vector, WallBoundary, condition,
};
use crate::flow::{Conductance, FlowSystem, PoreGeometry, Solver};
use crate::grains::{self, ContactLaw, GrainError, GrainSystem};

/// Everything a run needs to go on bit for bit, but for the laws of contacts and throats. For any serde format that
/// keeps every bit of a number.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct State {
    grains: grains::State,
    setup: FlowSetup,
    /// Places at which the mesh was made; it is made again there.
    places: Places,
    clock: PoreState,
}

impl CoupledSystem {
    /// Mean pressure (Pa) of the cells whose places lie between two places along an axis (m), by their volumes; none
    /// without such cells.
    pub fn layer_pressure(&self, axis: usize, from: f64, to: f64) -> Option<f64> {
        let cells = self.cells(axis, |x| (from..to).contains(&x[axis]));
        let add = |(v, pv), (_, volume, p): (_, f64, f64)| (v + volume, pv + p * volume);
        let (volume, sum) = cells.into_iter().fold((0.0, 0.0), add);
        (volume > 0.0).then(|| sum / volume)
    }

    /// Place along an axis (m), volume (m³) and pressure (Pa) of the cells whose places are inside.
    fn cells(&self, axis: usize, inside: impl Fn(&Vector) -> bool) -> Vec<(f64, f64, f64)> {
        let (places, clock) = (self.pores.geometry.middles(), &self.clock);
        let cells = places.iter().zip(&clock.volumes).zip(&clock.pressures);
        let cells = cells.filter(|((x, _), _)| inside(x));
        let cells = cells.map(|((x, volume), p)| (x[axis], *volume, *p));
        cells.collect()
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
        self.grains.gravity * (solid - self.setup.fluid.density * grains.volume())
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
        let mut sides = vec![WallBoundary::closed(); 6];
        let walls = &self.grains.walls;
        let facing = |sign: f64| walls.iter().position(|w| sign * w.normal[axis] > 0.5);
        let none = GrainError::NoArea(2 * axis);
        let (Some(low), Some(high)) = (facing(1.0), facing(-1.0)) else {
            return Err(none.into());
        };
        sides[low] = WallBoundary::drained(0.0);
        sides[high] = WallBoundary::drained(1.0);
        let boundary = condition::boundary(&sides, geometry, 0.0);
        let viscosity = self.setup.fluid.viscosity;
        let (law, solver) = (&*self.law, Solver::Automatic);
        let mut system = FlowSystem::new(geometry, &boundary, law, viscosity, None, solver)?;
        let pressures = system.solve(&boundary, &[])?;
        let length = self.grains.box_lengths().ok_or(none)?[axis];
        Ok(system.inflow(geometry, high, &pressures) * length / self.grains.section(axis)?)
    }

    /// The grains, their walls and contacts; the fluid's forces are the external ones.
    pub fn grains(&self) -> &GrainSystem {
        &self.grains
    }

    /// The grains, to steer walls, to set gravity or another contact law. Code that moves or scales grains here makes
    /// the mesh anew with [`CoupledSystem::remesh`].
    pub fn grains_mut(&mut self) -> &mut GrainSystem {
        self.evaluated = false;
        &mut self.grains
    }

    /// Time, s.
    pub fn time(&self) -> f64 {
        self.grains.time
    }

    /// The fluid, the conditions and the criterion for meshes.
    pub fn setup(&self) -> &FlowSetup {
        &self.setup
    }

    /// Cells and throats of the mesh; grains have moved a little since it was made.
    pub fn pores(&self) -> &PoreGeometry {
        &self.pores.geometry
    }

    /// State to resume.
    pub fn save(&self) -> State {
        State {
            grains: self.grains.save(),
            setup: self.setup.clone(),
            places: self.pores.places.clone(),
            clock: self.clock.clone(),
        }
    }

    /// Goes on from a saved state with the laws of contacts and conductances that the saved run had.
    ///
    /// # Errors
    /// A state whose parts do not fit together.
    pub fn resume(
        state: State,
        laws: Vec<Box<dyn ContactLaw>>,
        law: Box<dyn Conductance>,
    ) -> Result<Self, CoupledError> {
        let grains = GrainSystem::resume(state.grains, laws)?;
        let (setup, places, clock) = (state.setup, state.places, state.clock);
        setup.check(&grains)?;
        let bad = |problem| Err(CoupledError::BadState(problem));
        if places.centres.len() != grains.grains.len() || places.walls.len() != grains.walls.len() {
            return bad("the mesh is that of other grains or walls");
        }
        let system = Self::meshed(grains, setup, law, (places, PRESSED), clock)?;
        let (clock, cells) = (&system.clock, system.pores.geometry.volumes.len());
        let columns = [&clock.volumes, &clock.rates, &clock.pressures];
        if columns.iter().any(|c| c.len() != cells) {
            return bad("columns of the pores differ in length from the mesh");
        }
        Ok(system)
    }
}

/// Exact consolidation of an elastic layer under a sudden load, drained at one face: dp/dt = C_v d²p/dz².
///
/// T_v = C_v t / L², L the longest way to a drained face; a layer drained at both faces is two of half its height.
/// Source: Terzaghi 1923; Catalano 2012, Eqs. (4.29) to (4.31).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Terzaghi {
    /// C_v = K E_oed, m²/s.
    pub coefficient: f64,
    /// L, m.
    pub drainage: f64,
}

impl Terzaghi {
    /// Time factor T_v of a time, s.
    pub fn factor(&self, time: f64) -> f64 {
        self.coefficient * time / (self.drainage * self.drainage)
    }

    /// Time (s) of a time factor T_v.
    pub fn time(&self, factor: f64) -> f64 {
        factor * self.drainage * self.drainage / self.coefficient
    }

    /// p/Δσ at the distance `z` (m) from the drained face: Σ (2/M) sin(M z/L) exp(−M² T_v), M = π (2m + 1)/2.
    pub fn pressure(&self, z: f64, time: f64) -> f64 {
        let z = z / self.drainage;
        series(self.factor(time), |m| 2.0 / m * (m * z).sin()).clamp(0.0, 1.0)
    }

    /// Degree of consolidation U = 1 − Σ (2/M²) exp(−M² T_v), the settlement over the final one.
    pub fn consolidation(&self, time: f64) -> f64 {
        1.0 - series(self.factor(time), |m| 2.0 / (m * m))
    }
}

/// Σ f(M) exp(−M² T) until terms are below rounding, or 10⁵ of them.
fn series(factor: f64, term: impl Fn(f64) -> f64) -> f64 {
    if factor <= 0.0 {
        return 1.0;
    }
    let modes = (0..100_000).map(|m| 0.5 * PI * f64::from(2 * m + 1));
    let kept = modes.take_while(|m| m * m * factor < 40.0);
    kept.map(|m| term(m) * (-m * m * factor).exp()).sum()
}
