//! The pressure between the grains: its kind, that of the water in the pores, and a harmonic function of place.

use rayon::prelude::*;
use sph_contribution::{Contribution, Offer, Refusal, Setting, contribution_kind};
use sph_core::{
    Access, AnyField, Declares, Field, Pool, Scalar, Stage, StepError, Vect, Work, fields,
    parameters, plugin,
};
use sph_multiphase::linear::{
    Assembly, ConjugateGradient, Entries, Jacobi, LinearSolver, Matrix, ParticleMatrix,
    Preconditioner, Report,
};
use sph_neighbours::{Space, World, column_stage, walk_in_lanes};

use crate::pores::DRAINED_PRESSURE;
use crate::stress::bed_system::{ClusterCoefficients, Couplings, Part, start};
use crate::stress::soil_surface::Grains;

/// Reference densities of the soils among the phases, kg/m³, in the order of the phase numbers; `None` for
/// a phase whose law reads no pressure.
pub type Soils = Vec<Option<f64>>;

contribution_kind!(
    /// An effective pressure that a scene may name: the pressure that makes friction in soils. One of its stages writes
    /// [`EFFECTIVE_PRESSURE`](sph_core::fields::EFFECTIVE_PRESSURE).
    pub EffectivePressureEntry, "effective-pressure", One, "the pressure between the grains of a soil",
    .absent("that of the equation of state if left out").ordered(20).works(Work::Others)
);

/// q = p − p', Pa: the pressure p of the equation of state is that of grains and water together, the
/// effective pressure p' that between the grains, 0 outside of soils.
///
/// Source: Ghaïtanellis 2017, Eq. 5.26.
fn pore_pressure<const D: usize>() -> impl Stage<World<D>> {
    let pressures = (fields::PRESSURE, fields::EFFECTIVE_PRESSURE);
    let (name, access) = ("pore pressure", Access::none().here(pressures));
    column_stage::<D, _>(name, access, fields::PORE_PRESSURE, move |world, pore| {
        let (whole, effective) = world.free.all(pressures)?;
        let both = whole.par_iter().zip(effective);
        let all = pore.par_iter_mut().zip(both).with_min_len(2048);
        all.for_each(|(pore, (whole, effective))| *pore = whole - effective);
        Ok(())
    })
}

/// Solver of the effective pressure.
#[parameters]
pub enum PressureSolver {
    /// With an incomplete factorisation; iterations grow with the rows of the bed.
    #[default]
    ConjugateGradient,
    /// As the source; sweeps grow with the square of the rows.
    Jacobi,
}

/// ∇²p' = 0 in the soil, p' = |g| Δρ max(β δr, d/2) at its surface, ∂p'/∂n = Δρ g·n at walls.
///
/// Symbols: p' effective pressure (Pa); Δρ = ρ₀ − ρ_p, the density of the soil less that of the fluid
/// in its pores (kg/m³); g gravity. It does not depend on the depth of the water above, nor of the noise of the
/// equation of state, and it is exact for a flat bed. Limits: static, whatever the soil does; not exact under steep
/// surfaces.
///
/// The surface is found by an empty cone above a particle (soil and walls only), so that loose grains
/// are surface, too, and no system is singular. What is solved is
/// Σ_b V_a V_b F_ab [p'_a − p'_b − Δρ g·(r_a − r_b)] = 0 over the grains: the deviation from the hydrostatic
/// pressure has no flux into walls, so that walls need no term, and sums that the surface cuts off are
/// no error (the source's second row is 28 % off). The matrix is symmetric; conjugate gradients, or `solver = "jacobi"` as in the
/// source, start from the pressure of the step before.
///
/// Source: Ghaïtanellis 2017, Eq. 4.63–4.65 and 4.85–4.87; the form of the sum and β = ½ are ours.
///
/// ```toml
/// [effective-pressure.laplace]
/// pore_density = 1000.0
/// ```
#[plugin(EffectivePressureEntry [2, 3], "laplace",
    "harmonic in the soil, from its buoyant weight at walls; blind to the water above",
    source: "Ghaïtanellis 2017, Eq. 4.63–4.65", cfg(not(test)))]
#[derive(Copy)]
pub struct Laplace {
    /// Density of the fluid in the pores; 0 for a dry soil.
    #[parameter(default, unit: "kg/m³", min: 0.0, source: "Ghaïtanellis 2017, Eq. 4.60")]
    pub pore_density: f64,
    /// Depth β of surface particles over the spacing: ½ is that of their centres, 1 the source's.
    #[parameter(default: 0.5, unit: "1", min: 0.0, source: "ours; 1: Ghaïtanellis 2017, Eq. 4.87")]
    pub surface_depth: f64,
    /// Diameter d of the grains: surface particles are then never less deep than d/2, so that spacings finer than the grains do not
    /// make lighter ones. Only the spacing counts if left out.
    #[parameter(default, unit: "m", above: 0.0, source: "ours")]
    pub grain_diameter: Option<f64>,
    /// Time between solves over √(δr/|g|); 0 for every evaluation. In between the pressure goes with
    /// its particle.
    #[parameter(default: 0.01, unit: "1", min: 0.0, source: "ours")]
    pub interval: f64,
    /// Relative residual at which the iteration ends.
    #[parameter(default: 1e-5, unit: "1", above: 0.0, max: 0.1, source: "ours")]
    pub tolerance: f64,
    /// The iterative solver.
    #[parameter(default, source: "ours; jacobi: Ghaïtanellis 2017, §4.6.1")]
    pub solver: PressureSolver,
    /// Iterations after which it gives up; the step is then tried again with half its length. 2000 of conjugate gradients and
    /// 100 000 sweeps of Jacobi if left out.
    #[parameter(default, unit: "1", min: 1, source: "ours")]
    pub iterations: Option<usize>,
}

impl Laplace {
    /// Solves once, starting from the pressures that are there, and returns the effort.
    ///
    /// # Errors
    /// If the iteration does not end, or a column is missing.
    pub fn solve<const D: usize>(
        &self,
        soils: Soils,
        world: &mut World<D>,
    ) -> Result<Report, StepError> {
        self.on(soils).solve(world)
    }

    fn on<const D: usize>(&self, soils: Soils) -> Solve<D> {
        let buoyant = |density: f64| (density - self.pore_density).max(0.0);
        Solve {
            law: *self,
            target: fields::EFFECTIVE_PRESSURE,
            buoyant: soils.into_iter().map(|s| s.map(buoyant)).collect(),
            solver: match self.solver {
                PressureSolver::ConjugateGradient => {
                    let iterations = self.iterations.unwrap_or(2000);
                    Box::new(conjugate_gradient(self.tolerance, iterations))
                }
                PressureSolver::Jacobi => Box::new(Jacobi {
                    tolerance: self.tolerance,
                    sweeps: self.iterations.unwrap_or(100_000),
                }),
            },
            parts: Vec::new(),
            assembly: Assembly::default(),
            pressure: Vec::new(),
            pool: Pool::default(),
        }
    }
}

impl<const D: usize> Contribution<D> for Laplace {
    fn offer(&mut self, setting: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal> {
        if !setting.soils.contains(&true) {
            let why = "no law of this scene reads a pressure: take this table out";
            return Err(Refusal::at_key("effective-pressure", "", why));
        }
        offer.stage(pore_pressure());
        offer.saturated = self.pore_density > 0.0;
        let why = "the pressure between the grains could not be solved for: raise \
                   `effective-pressure.laplace.iterations`, or loosen its `tolerance`";
        (offer.remedies_of_failures).push(("effective pressure", why.into()));
        Ok(())
    }
    fn offer_to_readers(
        &mut self,
        setting: &Setting<'_, D>,
        read: &[AnyField],
        offer: &mut Offer<D>,
    ) -> Result<(), Refusal> {
        let both = setting.soils.iter().zip(setting.laws.iter());
        let soils = both.map(|(soil, law)| soil.then(|| law.reference().density));
        let mut solve = self.on(soils.collect());
        if read.contains(&DRAINED_PRESSURE.any()) {
            solve.target = DRAINED_PRESSURE;
        }
        offer.stage(solve);
        Ok(())
    }
}

/// The solver of systems of soils.
pub(crate) fn conjugate_gradient<const D: usize>(
    tolerance: f64,
    iterations: usize,
) -> ConjugateGradient<D> {
    ConjugateGradient {
        preconditioner: Preconditioner::IncompleteDiagonal,
        tolerance,
        iterations,
        ..ConjugateGradient::default()
    }
}

struct Solve<const D: usize> {
    law: Laplace,
    /// The column of the pressure: another than p' where pores are not at rest.
    target: Field<Scalar>,
    /// Δρ of every phase, kg/m³; `None` where it is no soil.
    buoyant: Vec<Option<f64>>,
    solver: Box<dyn LinearSolver<1>>,
    parts: Vec<Part>,
    assembly: Assembly<f64, 1>,
    pressure: Vec<Vect<1>>,
    pool: Pool<ClusterCoefficients>,
}

impl<const D: usize> Declares for Solve<D> {
    fn name(&self) -> String {
        "effective pressure".into()
    }
    fn access(&self) -> Access {
        Access::none()
            .both((fields::POSITION, fields::VOLUME))
            // A solve starts from the last one.
            .remembers(self.target)
            .both((self.buoyant.len() > 1).then_some(fields::PHASE))
    }
}

impl<const D: usize> Stage<World<D>> for Solve<D> {
    fn needs_all(&self) -> Option<&'static str> {
        (self.law.solver == PressureSolver::Jacobi).then_some(
            "its solver sweeps over the rows of all particles: take `conjugate-gradient`",
        )
    }
    fn run(&mut self, world: &mut World<D>) -> Result<(), StepError> {
        match self.due(world) {
            true => self.solve(world).map(drop),
            false => Ok(()),
        }
    }
    fn bytes(&self) -> usize {
        let Assembly {
            pattern, values, ..
        } = &self.assembly;
        size_of_val(&pattern.starts[..])
            + size_of_val(&pattern.columns[..])
            + size_of_val(&values.diagonal[..])
            + size_of_val(&values.others[..])
            + size_of_val(&self.pressure[..])
    }
}

impl<const D: usize> Solve<D> {
    fn solve(&mut self, world: &mut World<D>) -> Result<Report, StepError> {
        let space = world.space()?;
        let mut parts = std::mem::take(&mut self.parts);
        self.find_parts(world, &space, &mut parts)?;
        self.parts = parts;
        let (parts, assembly) = (&self.parts, &mut self.assembly);
        let system = Couplings {
            owned: &space.owned,
            parts,
            volume: world.free.get(fields::VOLUME)?,
            gravity: world.gravity,
        };
        assembly.fill_wanted(
            world,
            |i| system.is_solved(i),
            |rows, cluster| system.add(cluster, rows, &self.pool),
            |rows, others| others.for_each(|i| system.add_known(i, rows)),
        )?;
        let values = std::mem::take(&mut assembly.values);
        let matrix = Matrix::on(assembly.pattern.clone(), Entries::Scalar(values));
        let mut pressure = world.free.take(self.target)?;
        let x = &mut self.pressure;
        x.clear();
        let both = pressure.iter().zip(parts);
        x.extend(both.map(|(p, part)| start(*p, part)));
        let system = ParticleMatrix::new(&matrix, &space, None);
        let solved = self.solver.solve(&system, &assembly.sources, x);
        let both = pressure.iter_mut().zip(&*x);
        both.for_each(|(p, x)| *p = x[0].max(0.0));
        world.free.put(self.target, pressure)?;
        if let Entries::Scalar(values) = matrix.entries {
            assembly.values = values;
        }
        solved.map_err(|e| StepError::stage("effective pressure", e.to_string()))
    }

    /// True if a multiple of the interval has passed within the last step: the same for a run that was interrupted.
    fn due(&self, world: &World<D>) -> bool {
        let interval = self.law.interval * (world.spacing / world.gravity.norm()).sqrt();
        let count = |time: f64| (time / interval).floor();
        let passed = count(world.time) > count(world.time - world.dt);
        passed || world.time <= 0.0 || !(interval > 0.0 && interval.is_finite())
    }

    /// The roles of all particles; marks of copies at the surface are those of their owners.
    fn find_parts(
        &self,
        world: &World<D>,
        space: &Space<D>,
        parts: &mut Vec<Part>,
    ) -> Result<(), StepError> {
        let volume = world.free.get(fields::VOLUME)?;
        let soils = &self.buoyant[..];
        let phase = (world.free).all((soils.len() > 1).then_some(fields::PHASE))?;
        let buoyant = |i: usize| soils[phase.map_or(0, |p| p[i] as usize)];
        let least_depth = 0.5 * self.law.grain_diameter.unwrap_or(0.0);
        let depth = (self.law.surface_depth * world.spacing).max(least_depth);
        // Over Δρ the pressure of surface particles, m²/s².
        let top = depth * world.gravity.norm();
        let positions = world.free.get(fields::POSITION)?;
        let soil = |j: usize| buoyant(j).is_some();
        let grains = Grains { volume, soil };
        parts.clear();
        parts.resize(volume.len(), Part::Outside);
        walk_in_lanes(world, &grains, soil, parts, |sums, rows| {
            let (_, surface) = grains.surface(world, positions, sums, rows);
            Part::new(buoyant(rows.particle), surface, top)
        })?;
        let surface = |part: &Part| matches!(part, Part::Surface(..));
        let of = |i: usize, surface: bool| Part::new(buoyant(i), surface, top);
        space.refresh_marked(parts, surface, of);
        Ok(())
    }
}
