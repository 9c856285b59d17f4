//! Pieces of physics, the scene that they are in, and columns that they bring along.

use std::ops::Range;

use sph_core::{AnyField, Evolved, Field, FieldError, Scalar, Store, Vect, fields, suggestion};
use sph_neighbours::World;
use sph_rheology::state::Laws;

use crate::Offer;

/// The scene for a contribution.
pub struct Setting<'a, const D: usize> {
    /// Equations of state with their reference densities and speeds of sound, in the order of the phase numbers.
    pub laws: &'a Laws,
    /// Names of the phases, in the order of their numbers.
    pub phases: &'a [String],
    /// Names of the bodies.
    pub bodies: &'a [String],
    /// η/ρ₀ of every phase whose law has one viscosity, m²/s; none of the others.
    pub viscosities: &'a [Option<f64>],
    /// Phases that are soils: their laws read a pressure.
    pub soils: &'a [bool],
    /// The scalar that the formulation integrates for the density, with its rate.
    pub density: Evolved,
    /// True if densities are sums over positions, which every motion of particles changes.
    pub summed: bool,
    /// True if pressure is that of the end of the step, which no density that a step adds can overshoot.
    pub pressure_ahead: bool,
    /// The Courant number C of c Δt ≤ C h, for speeds of sound and elastic waves.
    pub courant: f64,
    /// C of νΔt ≤ C h².
    pub viscous: f64,
    /// True if a step has one kick and one drift, both over all of it.
    pub kicks_once: bool,
    /// True if a solve for friction may hold soils beyond their strength.
    pub delayed_yield: bool,
    /// True if the fluid moves with its walls: every wall has a prescribed motion, or no wall acts against gravity.
    pub carried: bool,
    /// A wall that moves, if there is one.
    pub moving_wall: Option<&'a str>,
    /// Columns, walls and kernel before the first step.
    pub world: &'a World<D>,
}

impl<const D: usize> Setting<'_, D> {
    /// Number of the phase that a key of a kind of plugin names.
    ///
    /// # Errors
    /// An unknown phase; the refusal names the nearest one.
    pub fn phase_number(
        &self,
        kind: &'static str,
        key: &str,
        name: &str,
    ) -> Result<usize, Refusal> {
        let found = self.phases.iter().position(|phase| phase == name);
        found.ok_or_else(|| Refusal::unknown(kind, key, "phase called", name, self.phases))
    }
}

/// A piece of physics.
pub trait Contribution<const D: usize> {
    /// Columns that carry history, with their values at the start.
    fn columns(&self) -> Vec<OwnColumn<D>> {
        Vec::new()
    }
    /// Offers its pieces; called once, of all contributions in turn.
    ///
    /// # Errors
    /// The key that does not fit the scene, and why.
    fn offer(&mut self, setting: &Setting<'_, D>, offer: &mut Offer<D>) -> Result<(), Refusal>;
    /// Offers the pieces that depend on the columns that are `read`: by the stages and terms of all, by probes and by outputs.
    ///
    /// # Errors
    /// As [`offer`](Self::offer).
    fn offer_to_readers(
        &mut self,
        _setting: &Setting<'_, D>,
        _read: &[AnyField],
        _offer: &mut Offer<D>,
    ) -> Result<(), Refusal> {
        Ok(())
    }
}

/// A key of a scene, and its fault there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// The kind whose plugin's table has the key.
    pub kind: &'static str,
    /// The key in that table; the table itself, if empty.
    pub key: String,
    /// The defect and its remedy.
    pub why: String,
}

impl Refusal {
    /// Of a key in the table of a kind's plugin.
    pub fn at_key(kind: &'static str, key: impl Into<String>, why: impl Into<String>) -> Self {
        Refusal {
            kind,
            key: key.into(),
            why: why.into(),
        }
    }

    /// Of a key with an unknown name; the message has the nearest known name.
    pub fn unknown(
        kind: &'static str,
        key: impl Into<String>,
        thing: &str,
        name: &str,
        known: &[String],
    ) -> Self {
        let near = suggestion(name, known.iter().map(String::as_str));
        Refusal::at_key(kind, key, format!("there is no {thing} `{name}`{near}"))
    }
}

/// A particle at its start.
#[derive(Clone, Copy, Debug)]
pub struct Birth<'a, const D: usize> {
    /// Position, m.
    pub position: Vect<D>,
    /// Velocity, m/s.
    pub velocity: Vect<D>,
    /// Density, kg/m³.
    pub density: f64,
    /// Mass, kg (per metre of depth in two dimensions).
    pub mass: f64,
    /// Name of its phase.
    pub phase: &'a str,
    /// Name of its body.
    pub body: &'a str,
}

type Formula<const D: usize> = Box<dyn Fn(&Birth<'_, D>) -> f64 + Send + Sync>;

/// A column that carries history: sorted with the particles, kept within a step, rolled back, saved.
pub struct OwnColumn<const D: usize> {
    /// The field.
    pub field: Field<Scalar>,
    /// Its value at the start, by the particle.
    initial: Formula<D>,
    /// Least and largest value with which particles may come in.
    pub within: [f64; 2],
}

impl<const D: usize> OwnColumn<D> {
    /// A scalar with its value at the start.
    pub fn scalar(
        field: Field<Scalar>,
        initial: impl Fn(&Birth<'_, D>) -> f64 + Send + Sync + 'static,
    ) -> Self {
        OwnColumn {
            field,
            initial: Box::new(initial),
            within: [f64::NEG_INFINITY, f64::INFINITY],
        }
    }

    /// Gives the particles of some slots their values at the start; `names` has the phase and the body of a particle.
    ///
    /// # Errors
    /// If a column is missing.
    pub fn begin<'n>(
        &self,
        free: &mut Store<D>,
        slots: Range<usize>,
        names: impl Fn(usize) -> (&'n str, &'n str),
    ) -> Result<(), FieldError> {
        let (position, velocity) = (free.get(fields::POSITION)?, free.get(fields::VELOCITY)?);
        let (density, mass) = (free.get(fields::DENSITY)?, free.get(fields::MASS)?);
        let birth = |k: usize| {
            let (phase, body) = names(k);
            Birth {
                position: position[k],
                velocity: velocity[k],
                density: density[k],
                mass: mass[k],
                phase,
                body,
            }
        };
        let births = slots.clone().map(birth);
        let values: Vec<f64> = births.map(|birth| (self.initial)(&birth)).collect();
        free.get_mut(self.field)?[slots].copy_from_slice(&values);
        Ok(())
    }

    /// The same column, whose values may not be zero or negative where particles come in.
    pub fn positive(self) -> Self {
        self.within(f64::MIN_POSITIVE, f64::INFINITY)
    }

    /// The same column, whose values are from `least` to `most` where particles come in.
    pub fn within(self, least: f64, most: f64) -> Self {
        OwnColumn {
            within: [least, most],
            ..self
        }
    }
}
