//! Quantities of single particles.

use sph_core::{Plain, StepError, fields, suggestion};
use sph_neighbours::World;

use crate::contract::refused;

/// Quantities that are made of columns, with their units.
const MADE: [(&str, &str); 6] = [
    ("x", "m"),
    ("y", "m"),
    ("z", "m"),
    ("speed", "m/s"),
    ("kinetic_energy", "J"),
    ("potential_energy", "J"),
];

/// A quantity that every particle has.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Quantity {
    /// A coordinate, m.
    Coordinate(usize),
    /// |u|, m/s.
    Speed,
    /// ½ m u², J (per metre of depth in 2D).
    KineticEnergy,
    /// −m g·r, J (per metre of depth in 2D); it counts from the origin.
    PotentialEnergy,
    /// A scalar column, or the magnitude of a column with several components.
    Column(String),
    /// A component of a column.
    Component(String, usize),
}

/// The values of a quantity by the number of the particle, with their unit.
pub(crate) type Values<'a> = (Box<dyn Fn(usize) -> f64 + 'a>, &'static str);

impl Quantity {
    /// A quantity by its name: `pressure`, `velocity.x`, `x`, `speed`, `kinetic_energy`.
    pub fn named(name: &str) -> Self {
        let axis = |name: &str| ["x", "y", "z"].iter().position(|axis| *axis == name);
        match name {
            "speed" => Quantity::Speed,
            "kinetic_energy" => Quantity::KineticEnergy,
            "potential_energy" => Quantity::PotentialEnergy,
            _ => match (axis(name), name.split_once('.')) {
                (Some(axis), _) => Quantity::Coordinate(axis),
                (None, Some((column, part))) if axis(part).is_some() => {
                    Quantity::Component(column.into(), axis(part).unwrap_or_default())
                }
                _ => Quantity::Column(name.into()),
            },
        }
    }

    /// The column that has to be computed for it.
    pub fn column(&self) -> Option<&str> {
        match self {
            Quantity::Column(name) | Quantity::Component(name, _) => Some(name),
            _ => None,
        }
    }

    /// The values of all particles.
    ///
    /// # Errors
    /// If there is no such column or component.
    pub fn values<'a, const D: usize>(&self, world: &'a World<D>) -> Result<Values<'a>, StepError> {
        let free = &world.free;
        Ok(match self {
            Quantity::Coordinate(axis) => {
                let (x, axis) = (free.get(fields::POSITION)?, (*axis).min(D - 1));
                (Box::new(move |k| x[k][axis]), "m")
            }
            Quantity::Speed => {
                let u = free.get(fields::VELOCITY)?;
                (Box::new(move |k| u[k].norm()), "m/s")
            }
            Quantity::KineticEnergy => {
                let (m, u) = (free.get(fields::MASS)?, free.get(fields::VELOCITY)?);
                (Box::new(move |k| 0.5 * m[k] * u[k].norm_squared()), "J")
            }
            Quantity::PotentialEnergy => {
                let (m, x) = (free.get(fields::MASS)?, free.get(fields::POSITION)?);
                let g = world.steady_gravity;
                (Box::new(move |k| -(m[k] * g.dot(&x[k]))), "J")
            }
            Quantity::Column(name) => of_column(world, name, None)?,
            Quantity::Component(name, axis) => of_column(world, name, Some(*axis))?,
        })
    }
}

fn of_column<'a, const D: usize>(
    world: &'a World<D>,
    name: &str,
    component: Option<usize>,
) -> Result<Values<'a>, StepError> {
    let mut columns = world.free.columns();
    let found = columns.find(|(known, ..)| *known == name);
    let Some((_, unit, _, components, Plain::Real(values))) = found else {
        return Err(unknown(world, name));
    };
    match component {
        Some(k) if k >= components => {
            let reason = format!("`{name}` has {components} components in this scene");
            Err(refused("probes", reason))
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

fn unknown<const D: usize>(world: &World<D>, name: &str) -> StepError {
    let columns: Vec<_> = world.free.columns().map(|column| column.0).collect();
    let made = MADE.iter().map(|(name, _)| *name);
    let near = suggestion(name, columns.iter().copied().chain(made.clone()));
    let known: Vec<_> = columns.iter().copied().chain(made).collect();
    let known = known.join(", ");
    let reason = format!("there is no field `{name}` in this scene{near}; there are: {known}");
    refused("probes", reason)
}

/// The unit of a quantity that is no column.
pub(crate) fn unit_of(name: &str) -> Option<&'static str> {
    MADE.iter()
        .find(|(known, _)| *known == name)
        .map(|(_, unit)| *unit)
}
