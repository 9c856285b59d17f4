//! Columns that a contribution brings along.

use sph_core::{AnyField, Field, Scalar, Vect, Vector};

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

type Formula<const D: usize, T> = Box<dyn Fn(&Birth<'_, D>) -> T + Send + Sync>;

/// Values of a column at the start.
pub enum Initial<const D: usize> {
    /// Zero.
    Zero,
    /// A number per particle.
    Scalar(Formula<D, f64>),
    /// A vector per particle.
    Vector(Formula<D, Vect<D>>),
}

/// A column that carries history: sorted with the particles, kept within a step, rolled back, saved.
pub struct OwnColumn<const D: usize> {
    /// The field.
    pub field: AnyField,
    /// Its values at the start.
    pub initial: Initial<D>,
    /// Least and largest value with which particles may come in.
    pub within: [f64; 2],
}

impl<const D: usize> OwnColumn<D> {
    /// A scalar with its value at the start.
    pub fn scalar(
        field: Field<Scalar>,
        initial: impl Fn(&Birth<'_, D>) -> f64 + Send + Sync + 'static,
    ) -> Self {
        Self::new(field.any(), Initial::Scalar(Box::new(initial)))
    }

    /// A vector with its value at the start.
    pub fn vector(
        field: Field<Vector>,
        initial: impl Fn(&Birth<'_, D>) -> Vect<D> + Send + Sync + 'static,
    ) -> Self {
        Self::new(field.any(), Initial::Vector(Box::new(initial)))
    }

    /// A column of any type that starts with zeros.
    pub fn zero(field: AnyField) -> Self {
        Self::new(field, Initial::Zero)
    }

    fn new(field: AnyField, initial: Initial<D>) -> Self {
        let within = [f64::NEG_INFINITY, f64::INFINITY];
        OwnColumn {
            field,
            initial,
            within,
        }
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
