//! The energy budget of a flow.

use sph_core::{Field, Scalar, StepError, fields, plugin};
use sph_neighbours::World;
use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use crate::{Needs, Probe, ProbeColumn, ProbeEntry, ProbeScene};

/// Terms that give energy to a particle or take it, in the order of [`ENERGY_WORKS`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EnergyWork {
    /// Friction, explicit or solved for, of eddies and at walls too; the work of moving walls.
    Viscosity,
    /// Diffusion of the density.
    Smoother,
    /// Shifted positions, and the density and velocity that shifted particles take up.
    Shifting,
    /// Terms of `[damping.…]`: the damper of sound.
    Damper,
    /// Work of `[damping.…]` on velocities.
    Damping,
    /// Changes of the density constant by `[surface.…]`.
    Surface,
    /// Pressure at walls, and particles that are kept off them.
    Walls,
    /// Driving, interfaces, elastic and other forces.
    Others,
    /// Error of the step's length, and terms without a column.
    Remainder,
}

/// Work of all terms on a particle since the start, J (per metre of depth in 2D).
pub const ENERGY_WORKS: [Field<Scalar>; 9] = [
    energy("work_viscosity", "work of friction since the start"),
    energy("work_smoother", "work of the smoother since the start"),
    energy("work_shifting", "work of shifting since the start"),
    energy("work_damper", "work of the damper of sound since the start"),
    energy("work_damping", "work of damped velocities since the start"),
    energy("work_surface", "work of forgotten surfaces since the start"),
    energy("work_walls", "work of walls by pressure since the start"),
    energy("work_others", "work of other forces since the start"),
    energy("work_remainder", "work of finite steps since the start"),
];
/// Energy of compression of a particle when it was last booked.
pub const BOOKED_COMPRESSION: Field<Scalar> =
    energy("booked_compression", "energy of compression, as booked");
/// Energy of a particle at the start.
pub const ENERGY_AT_START: Field<Scalar> =
    energy("energy_at_start", "energy of the particle at the start");

const fn energy(name: &'static str, meaning: &'static str) -> Field<Scalar> {
    Field::new(name, "J", meaning)
}

/// Kinetic, potential and internal energy (of compression) of all particles, and the work of all parts that give or
/// take energy since the start, J (per metre of depth in 2D). Positive work gives:
///
/// | column | work of |
/// |---|---|
/// | `viscosity` | friction, Σ m a_η·ū Δt; implicit too, of eddies and of moving walls |
/// | `smoother` | diffusion of the density, Σ m [e(ρ + ρ̇_δ Δt) − e(ρ)] at ρ in the middle of the motion |
/// | `shifting` | shifts: of weights, −Σ m g·s Δt, of densities, and what shifted particles take up |
/// | `damper`, `damping` | terms of `[damping.…]` (`acoustic`), and work on velocities (`rayleigh`) |
/// | `surface` | changes of the density constant by `[surface.…]` |
/// | `walls` | pressure, Σ m a_p·ū Δt − Σ V p D{ū} Δt: gradient and density sum are adjoint but at walls; lone particles that are stopped |
/// | `others` | driving, interfaces, elastic and other forces |
/// | a kind of plugin of yours | its terms and hooks |
/// | `remainder` | what is left: the length of the step, and the bound on the density of lone particles |
/// | `unlisted` | energy less that of the start less all these: 0 to rounding, unless something moves particles or densities that the books do not see |
///
/// ū is the mean of the velocities before and after a kick and all that follows it, Σ m δu·ū is then exact; e = ∫p/ρ² dρ; D the rate at which the
/// density of the formulation follows the motion. Symbols: m mass (kg), ρ density (kg/m³), V volume (m^d), p pressure (Pa), s
/// shift velocity (m/s), g gravity (m/s²).
///
/// Most of the remainder comes back: a kick, then a drift keep E − ½ΔtΣF·u and not E.
///
/// Every work is also a column of the particles, `work_viscosity` and so on, that outputs may show: a map of where the
/// energy goes. Between particles energy moves by pressure, so that `walls` and `remainder` of single particles mean nothing.
///
/// Limits: integrators of one kick and one drift per step, `symplectic-euler`; no particles that come in or leave. Several more walks
/// over the neighbours in every step.
///
/// ```toml
/// [probe.budget]
/// kind = "energy-budget"
/// ```
#[plugin(ProbeEntry [2, 3], "energy-budget",
    "where the energy goes: energies, and the work of all parts that give or take some",
    source: "ours: the first law, discrete")]
pub struct EnergyBudget {
    /// Works of strangers.
    #[serde(skip)]
    strangers: Vec<Field<Scalar>>,
}

/// The work of a kind of plugin that no crate of this project declares, J: the column `work_KIND`.
pub fn work_of_stranger(kind: &str) -> Field<Scalar> {
    static KNOWN: Mutex<BTreeMap<String, &'static str>> = Mutex::new(BTreeMap::new());
    let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    // Names of fields have the lifetime of the program; there are as many as kinds.
    let name = known
        .entry(kind.to_string())
        .or_insert_with(|| Box::leak(format!("work_{kind}").into_boxed_str()));
    energy(name, "work of a plugin since the start")
}

impl<const D: usize> Probe<D> for EnergyBudget {
    fn columns(&self) -> Vec<ProbeColumn> {
        let works = ENERGY_WORKS.iter().chain(&self.strangers);
        let works = works.map(|work| work.name.replacen("work_", ".", 1));
        let all = [".kinetic", ".potential", ".internal"].map(String::from);
        let all = all.into_iter().chain(works).chain([".unlisted".into()]);
        all.map(|suffix| ProbeColumn::named(&suffix, "J")).collect()
    }

    fn prepare(&mut self, scene: &ProbeScene<'_>) -> Result<(), String> {
        let strangers = scene.strangers.iter();
        self.strangers = strangers.map(|kind| work_of_stranger(kind)).collect();
        Ok(())
    }

    fn needs(&self) -> Needs<'_> {
        Needs {
            books: true,
            ..Needs::default()
        }
    }

    fn measure(&self, world: &World<D>) -> Result<Vec<f64>, StepError> {
        let free = &world.free;
        let (mass, velocity) = free.all((fields::MASS, fields::VELOCITY))?;
        let position = free.get(fields::POSITION)?;
        let sum = |field| -> Result<f64, StepError> { Ok(free.get(field)?.iter().sum()) };
        let kinetic = mass.iter().zip(velocity);
        let potential = mass.iter().zip(position);
        let mut all = vec![
            kinetic.map(|(m, u)| 0.5 * m * u.norm_squared()).sum(),
            potential
                .map(|(m, x)| -m * world.steady_gravity.dot(x))
                .sum(),
            sum(BOOKED_COMPRESSION)?,
        ];
        let now: f64 = all.iter().sum();
        let works = ENERGY_WORKS.iter().chain(&self.strangers).copied().map(sum);
        let works = works.collect::<Result<Vec<f64>, _>>()?;
        let unlisted = now - sum(ENERGY_AT_START)? - works.iter().sum::<f64>();
        all.extend(works);
        all.push(unlisted);
        Ok(all)
    }
}
