//! Particles whose quantities are measured: those of a flow, or of one of the frames that it has written.

use std::borrow::Cow;

use sph_core::{Plain, StepError, Vect, fields, suggestion};
use sph_neighbours::World;

use crate::phases::phase::CountedPhase;

/// Quantities that are made of columns, with their units.
pub(crate) const MADE: [(&str, &str); 6] = [
    ("x", "m"),
    ("y", "m"),
    ("z", "m"),
    ("speed", "m/s"),
    ("kinetic_energy", "J"),
    ("potential_energy", "J"),
];

pub(crate) const AXES: [&str; 3] = ["x", "y", "z"];

/// The values of a quantity by the number of the particle, with their unit.
pub type Values<'a, U> = (Box<dyn Fn(usize) -> f64 + 'a>, U);

/// The name of a column, and the number of its component if a component is named.
pub(crate) fn parts(name: &str) -> (&str, Option<usize>) {
    let axis = |part: &str| AXES.iter().position(|axis| *axis == part);
    let parts = name.split_once('.');
    let component = parts.and_then(|(column, part)| Some((column, Some(axis(part)?))));
    component.unwrap_or((name, None))
}

/// Particles with columns, of which a [`MeasuringProbe`](crate::MeasuringProbe) measures quantities.
pub trait MeasuredParticles<const D: usize> {
    /// A quantity that these particles do not have.
    type Error;
    /// A unit.
    type Unit: From<&'static str>;

    /// Number of particles.
    fn count(&self) -> usize;
    /// Positions, m.
    ///
    /// # Errors
    /// If they are missing.
    fn positions(&self) -> Result<Cow<'_, [Vect<D>]>, Self::Error>;
    /// Velocities, m/s.
    ///
    /// # Errors
    /// If they are missing.
    fn velocities(&self) -> Result<Cow<'_, [Vect<D>]>, Self::Error>;
    /// Lengths of the velocities, m/s.
    ///
    /// # Errors
    /// If they are missing.
    fn speeds(&self) -> Result<Values<'_, Self::Unit>, Self::Error> {
        let u = self.velocities()?;
        Ok((Box::new(move |k| u[k].norm()), "m/s".into()))
    }
    /// Gravity that is constant in time, m/s².
    ///
    /// # Errors
    /// If it is not known.
    fn gravity(&self) -> Result<Vect<D>, Self::Error>;
    /// A column, of several components their magnitude, or a component of one (`velocity.x`).
    ///
    /// # Errors
    /// If there is no such column or component.
    fn column(&self, name: &str) -> Result<Values<'_, Self::Unit>, Self::Error>;
    /// The particles of a phase, by its name and its number; all if there is no name.
    ///
    /// # Errors
    /// If the number is not known, or the phases are missing.
    fn in_phase(
        &self,
        name: Option<&str>,
        number: Option<u32>,
    ) -> Result<Box<dyn Fn(usize) -> bool + '_>, Self::Error>;
    /// Initial particle spacing δr, m.
    fn spacing(&self) -> f64;
}

impl<const D: usize> MeasuredParticles<D> for World<D> {
    type Error = StepError;
    type Unit = &'static str;

    fn count(&self) -> usize {
        self.free.len()
    }

    fn positions(&self) -> Result<Cow<'_, [Vect<D>]>, StepError> {
        Ok(self.free.get(fields::POSITION)?.into())
    }

    fn velocities(&self) -> Result<Cow<'_, [Vect<D>]>, StepError> {
        Ok(self.free.get(fields::VELOCITY)?.into())
    }

    fn gravity(&self) -> Result<Vect<D>, StepError> {
        Ok(self.steady_gravity)
    }

    fn column(&self, name: &str) -> Result<Values<'_, &'static str>, StepError> {
        let (name, component) = parts(name);
        let mut columns = self.free.columns();
        let found = columns.find(|(known, ..)| *known == name);
        let Some((_, unit, _, components, Plain::Real(values))) = found else {
            return Err(unknown(self, name));
        };
        match component {
            Some(k) if k >= components => {
                let reason = format!("`{name}` has {components} components in this scene");
                Err(StepError::stage("probes", reason))
            }
            Some(k) => Ok((Box::new(move |i| values[i * components + k]), unit)),
            None if components == 1 => Ok((Box::new(move |i| values[i]), unit)),
            None => {
                let size = move |i: usize| {
                    let all = &values[i * components..(i + 1) * components];
                    all.iter().map(|x| x * x).sum::<f64>().sqrt()
                };
                Ok((Box::new(size), unit))
            }
        }
    }

    fn in_phase(
        &self,
        name: Option<&str>,
        number: Option<u32>,
    ) -> Result<Box<dyn Fn(usize) -> bool + '_>, StepError> {
        let phase = CountedPhase::in_phase(self, name, number)?;
        Ok(Box::new(move |k| phase.has(k)))
    }

    fn spacing(&self) -> f64 {
        self.spacing
    }
}

fn unknown<const D: usize>(world: &World<D>, name: &str) -> StepError {
    let columns: Vec<_> = world.free.columns().map(|column| column.0).collect();
    let made = MADE.iter().map(|(name, _)| *name);
    let near = suggestion(name, columns.iter().copied().chain(made.clone()));
    let known: Vec<_> = columns.iter().copied().chain(made).collect();
    let known = known.join(", ");
    let reason = format!("there is no field `{name}` in this scene{near}; there are: {known}");
    StepError::stage("probes", reason)
}
