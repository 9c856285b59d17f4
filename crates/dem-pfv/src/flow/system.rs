//! The balance of all pores as one linear system.

use serde::{Deserialize, Serialize};
use sparse::{Cholesky, Order, UpperTriangle, conjugate_gradient, nested_dissection};

use crate::flow::assembly::{GIVEN, assemble, givers, joined, numbered, reachable};
use crate::flow::{Boundary, Conductance, FlowError, PoreGeometry, Throat};
use crate::{POSITIVE, require};

/// Solvers of the system.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
pub enum Solver {
    /// Cholesky factorisation by faer, kept from solve to solve.
    Direct,
    /// Conjugate gradients from the last pressures.
    ConjugateGradient {
        /// Residual relative to the right side.
        tolerance: f64,
        /// Largest number of iterations.
        limit: usize,
    },
    /// `Direct` up to 100,000 unknowns (about 16,000 spheres), conjugate gradients to 1e-10 above, where
    /// the factor's fill costs more.
    Automatic,
}

/// Compressibility of the fluid over a step: adds V_void / (K Δt) to the diagonal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Storage {
    /// Bulk modulus K of the fluid, Pa.
    pub bulk_modulus: f64,
    /// Step Δt, s.
    pub step: f64,
}

/// Above this many unknowns, `Automatic` iterates so.
const FACTORISED: usize = 100_000;
const ITERATED: Solver = Solver::ConjugateGradient {
    tolerance: 1e-10,
    limit: 20_000,
};

/// Σ_j k_ij (p_i − p_j) + V/(K Δt) (p_i − p_i,old) = −dV_i/dt + Q_i for all pores without a given pressure.
/// Symmetric and positive definite. Source: Catalano 2012, Eqs. (3.2), (3.3), (4.8).
///
/// A system stands for one geometry and one choice of cells with given pressures. Their values, sources, rates of
/// volumes and the step may change from solve to solve.
pub struct FlowSystem {
    /// k of every throat, m³ Pa⁻¹ s⁻¹; 0 for open ones.
    conductances: Vec<f64>,
    ends: Vec<[u32; 2]>,
    /// First of the cells that are one pore, for every cell.
    pores: Vec<u32>,
    /// Unknown of every cell, or `GIVEN`.
    unknowns: Vec<u32>,
    given: Vec<bool>,
    /// The cell whose given pressure holds in each cell: itself, or the first of its pore that has one.
    givers: Vec<u32>,
    void_volumes: Vec<f64>,
    storage: Option<Storage>,
    /// Diagonal without storage.
    diagonal: Vec<f64>,
    matrix: UpperTriangle,
    solver: Solver,
    factor: Option<Cholesky>,
    last: Vec<f64>,
}

impl FlowSystem {
    /// The system of a fluid of a dynamic viscosity (Pa s); with a `storage` that of a compressible one, in which no
    /// pressure need be given. Where none is, the mean pressure loses as many digits as k K Δt/V has: a closed room of
    /// stiff fluid (10¹¹) is known to 1e-4.
    ///
    /// # Errors
    /// A viscosity, bulk modulus or step that is not positive; a conductance that is not a number; a
    /// factorisation that fails; pores of an incompressible fluid that no given pressure can reach.
    pub fn new(
        geometry: &PoreGeometry,
        boundary: &Boundary,
        law: &dyn Conductance,
        viscosity: f64,
        storage: Option<Storage>,
        solver: Solver,
    ) -> Result<Self, FlowError> {
        require("viscosity is", viscosity, POSITIVE, viscosity > 0.0)?;
        let conductance = |t: &Throat| {
            if t.open || t.fluid_area <= 0.0 {
                return Ok(0.0);
            }
            match law.conductance(t) {
                g if g >= 0.0 && g.is_finite() => Ok(g / (viscosity * t.length)),
                g => Err(FlowError::BadConductance(t.cells, g)),
            }
        };
        let conductances = geometry.throats.iter().map(conductance);
        let conductances = conductances.collect::<Result<Vec<_>, _>>()?;
        let ends = geometry.throats.iter().map(|t| t.cells.map(|c| c as u32));
        let ends: Vec<_> = ends.collect();
        let open = geometry.throats.iter().zip(&ends).filter(|(t, _)| t.open);
        let pores = joined(geometry.volumes.len(), open.map(|(_, e)| *e));
        let givers = givers(boundary, &pores);
        let known = givers
            .iter()
            .map(|c| boundary.pressures[*c as usize].is_some());
        let known: Vec<_> = known.collect();
        if storage.is_none() {
            reachable(&conductances, &ends, &known, &pores)?;
        }
        let (unknowns, count) = numbered(&pores, &known);
        let (diagonal, matrix) = assemble(&conductances, &ends, &unknowns, count);
        let mut system = Self {
            conductances,
            ends,
            pores,
            unknowns,
            given: boundary.pressures.iter().map(Option::is_some).collect(),
            givers,
            void_volumes: geometry.void_volumes.to_vec(),
            storage,
            diagonal,
            matrix,
            solver: match solver {
                Solver::Automatic if count <= FACTORISED => Solver::Direct,
                Solver::Automatic => ITERATED,
                chosen => chosen,
            },
            factor: None,
            last: vec![0.0; count],
        };
        if system.solver == Solver::Direct && count > 0 {
            let mut places = vec![Default::default(); count];
            for (&u, at) in system.unknowns.iter().zip(&geometry.centres) {
                if u != GIVEN {
                    places[u as usize] = *at;
                }
            }
            let order = nested_dissection(&system.matrix, &places);
            system.factor = Some(Cholesky::analyse(&system.matrix, Order::Given(&order))?);
        }
        system.refresh()?;
        Ok(system)
    }

    /// Changes the bulk modulus and the step of a compressible fluid; only the numeric phase is done again.
    ///
    /// # Errors
    /// Numbers that are not positive; a factorisation that fails.
    pub fn set_storage(&mut self, storage: Storage) -> Result<(), FlowError> {
        self.storage = Some(storage);
        self.refresh()
    }

    /// The diagonal with storage, and the factor of it.
    fn refresh(&mut self) -> Result<(), FlowError> {
        let mut diagonal = self.diagonal.clone();
        if let Some(storage) = self.storage {
            let (modulus, step) = (storage.bulk_modulus, storage.step);
            require("bulk modulus is", modulus, POSITIVE, modulus > 0.0)?;
            require("step is", step, POSITIVE, step > 0.0)?;
            for (c, &u) in self.unknowns.iter().enumerate() {
                if u != GIVEN {
                    diagonal[u as usize] += self.capacity(c);
                }
            }
        }
        for (i, value) in diagonal.into_iter().enumerate() {
            let place = self.matrix.diagonal(i);
            self.matrix.values[place] = value;
        }
        match &mut self.factor {
            Some(factor) => Ok(factor.factorise(&self.matrix)?),
            None => Ok(()),
        }
    }

    /// V_void / (K Δt) of a cell, m³ Pa⁻¹ s⁻¹.
    fn capacity(&self, cell: usize) -> f64 {
        let per_volume = |s: Storage| 1.0 / (s.bulk_modulus * s.step);
        let stored = |s| self.void_volumes[cell].max(0.0) * per_volume(s);
        self.storage.map_or(0.0, stored)
    }

    /// Pressures of all cells (Pa) from which conjugate gradients start; the last ones by default. A
    /// factorisation takes no notice.
    ///
    /// # Errors
    /// A list of another length than the cells.
    pub fn start_from(&mut self, pressures: &[f64]) -> Result<(), FlowError> {
        self.fits("pressures to start from", pressures.len())?;
        for (&u, &p) in self.unknowns.iter().zip(pressures) {
            if u != GIVEN {
                self.last[u as usize] = p;
            }
        }
        Ok(())
    }

    /// Checks that a list has a number for each cell.
    fn fits(&self, what: &'static str, given: usize) -> Result<(), FlowError> {
        let needed = self.unknowns.len();
        let wrong = FlowError::Length(what, given, needed);
        (given == needed).then_some(()).ok_or(wrong)
    }

    /// Pressures of all cells (Pa), with rates of the cells' volumes dV/dt (m³/s); an empty list stands for
    /// a skeleton at rest. A compressible fluid starts from the pressures before, see [`FlowSystem::step`].
    ///
    /// # Errors
    /// Lists of the wrong length, pressures given in other cells than before, no convergence.
    pub fn solve(&mut self, boundary: &Boundary, rates: &[f64]) -> Result<Vec<f64>, FlowError> {
        let zero = vec![0.0; self.unknowns.len()];
        self.step(boundary, rates, &zero)
    }

    /// Pressures after a step of a compressible fluid, with those before it (Pa).
    ///
    /// # Errors
    /// As [`FlowSystem::solve`].
    pub fn step(
        &mut self,
        boundary: &Boundary,
        rates: &[f64],
        before: &[f64],
    ) -> Result<Vec<f64>, FlowError> {
        let right = self.right_side(boundary, rates, before)?;
        match (self.solver, &mut self.factor) {
            (_, Some(factor)) => self.last = factor.solve(&right),
            (Solver::ConjugateGradient { tolerance, limit }, None) => {
                conjugate_gradient(&self.matrix, &right, &mut self.last, tolerance, limit)?;
            }
            (_, None) => {}
        }
        let pressure = |c: usize| match self.unknowns[c] {
            GIVEN => self.given_pressure(boundary, c),
            u => self.last[u as usize],
        };
        Ok((0..self.unknowns.len()).map(pressure).collect())
    }

    fn given_pressure(&self, boundary: &Boundary, cell: usize) -> f64 {
        boundary.pressures[self.givers[cell] as usize].unwrap_or(0.0)
    }

    fn right_side(
        &self,
        boundary: &Boundary,
        rates: &[f64],
        before: &[f64],
    ) -> Result<Vec<f64>, FlowError> {
        let cells = self.unknowns.len();
        self.fits("pressures", boundary.pressures.len())?;
        if !rates.is_empty() {
            self.fits("rates of volumes", rates.len())?;
        }
        self.fits("pressures before the step", before.len())?;
        let changed = |c: &usize| boundary.pressures[*c].is_some() != self.given[*c];
        if let Some(cell) = (0..cells).find(changed) {
            return Err(FlowError::ConditionsChanged(cell));
        }
        let mut right = vec![0.0; self.matrix.len()];
        for (c, &u) in self.unknowns.iter().enumerate() {
            if u != GIVEN {
                let rate = rates.get(c).copied().unwrap_or(0.0);
                right[u as usize] += boundary.sources[c] - rate + self.capacity(c) * before[c];
            }
        }
        for (k, [i, j]) in self.conductances.iter().zip(&self.ends) {
            for (i, j) in [(*i, *j), (*j, *i)] {
                let (u, v) = (self.unknowns[i as usize], self.unknowns[j as usize]);
                if u != GIVEN && v == GIVEN && *k > 0.0 {
                    right[u as usize] += k * self.given_pressure(boundary, j as usize);
                }
            }
        }
        Ok(right)
    }

    /// Flux (m³/s) into the room through each cell with a given pressure, zero in others: its flow to others, its gain
    /// of volume and its storage, less its source. With the sources they add up to the rates of all volumes and the
    /// storage. Arguments as those of [`FlowSystem::step`] that gave the pressures (Pa).
    pub fn influx(
        &self,
        boundary: &Boundary,
        rates: &[f64],
        before: &[f64],
        pressures: &[f64],
    ) -> Vec<f64> {
        let mut flux = vec![0.0; self.unknowns.len()];
        for (k, ends) in self.conductances.iter().zip(&self.ends) {
            let [i, j] = ends.map(|c| c as usize);
            let through = k * (pressures[i] - pressures[j]);
            flux[i] += through;
            flux[j] -= through;
        }
        let mut given = vec![0.0; flux.len()];
        let cells = self.unknowns.iter().enumerate();
        for (c, _) in cells.filter(|(_, u)| **u == GIVEN) {
            let rate = rates.get(c).copied().unwrap_or(0.0);
            let stored = self.capacity(c) * (pressures[c] - before[c]);
            given[self.givers[c] as usize] += flux[c] + rate + stored - boundary.sources[c];
        }
        given
    }

    /// Flux (m³/s) into the room through a wall with given pressures: the flow from the pores on it to others.
    pub fn inflow(&self, geometry: &PoreGeometry, wall: usize, pressures: &[f64]) -> f64 {
        let mut on_wall = vec![false; self.pores.len()];
        let wall = crate::triangulation::Vertex::Wall(wall);
        for &c in geometry.mesh.cells_around(wall) {
            on_wall[self.pores[c as usize] as usize] |= self.given[c as usize];
        }
        let throats = self.conductances.iter().zip(&self.ends);
        let flux = throats.map(|(k, ends)| {
            let [i, j] = ends.map(|c| c as usize);
            let [inside, beyond] = [i, j].map(|c| on_wall[self.pores[c] as usize]);
            match (inside, beyond) {
                (true, false) => k * (pressures[i] - pressures[j]),
                (false, true) => k * (pressures[j] - pressures[i]),
                _ => 0.0,
            }
        });
        flux.sum()
    }
}
