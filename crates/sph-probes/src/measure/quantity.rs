//! Quantities of single particles.

use sph_core::{Plain, StepError, fields, suggestion};
use sph_neighbours::World;

/// Quantities that are made of columns, with their units.
const MADE: [(&str, &str); 6] = [
    ("x", "m"),
    ("y", "m"),
    ("z", "m"),
    ("speed", "m/s"),
    ("kinetic_energy", "J"),
    ("potential_energy", "J"),
];

pub(crate) const AXES: [&str; 3] = ["x", "y", "z"];

/// A quantity that every particle has, by its name: a column, of several components their magnitude (`pressure`), a
/// component of one (`velocity.x`), or one that is made of columns (`x`, `speed`, `kinetic_energy`).
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Quantity(String);

/// The values of a quantity by the number of the particle, with their unit.
pub(crate) type Values<'a> = (Box<dyn Fn(usize) -> f64 + 'a>, &'static str);

impl Quantity {
    pub fn named(name: &str) -> Self {
        Quantity(name.into())
    }

    /// The unit of a quantity that is no column.
    pub fn unit(&self) -> Option<&'static str> {
        let made = MADE.iter().find(|(name, _)| *name == self.0);
        made.map(|(_, unit)| *unit)
    }

    /// A column, and the number of its component if it is one.
    fn parts(&self) -> (&str, Option<usize>) {
        let axis = |part: &str| AXES.iter().position(|axis| *axis == part);
        let parts = self.0.split_once('.');
        let component = parts.and_then(|(column, part)| Some((column, Some(axis(part)?))));
        component.unwrap_or((&self.0, None))
    }

    /// The column that has to be computed for it.
    pub fn column(&self) -> Option<&str> {
        self.unit().is_none().then(|| self.parts().0)
    }

    /// The values of all particles.
    ///
    /// # Errors
    /// If there is no such column or component.
    pub fn values<'a, const D: usize>(&self, world: &'a World<D>) -> Result<Values<'a>, StepError> {
        let free = &world.free;
        let value: Box<dyn Fn(usize) -> f64> = match self.0.as_str() {
            "speed" => {
                let u = free.get(fields::VELOCITY)?;
                Box::new(move |k| u[k].norm())
            }
            // ½ m u², per metre of depth in 2D.
            "kinetic_energy" => {
                let (m, u) = (free.get(fields::MASS)?, free.get(fields::VELOCITY)?);
                Box::new(move |k| 0.5 * m[k] * u[k].norm_squared())
            }
            // −m g·r, per metre of depth in 2D; it counts from the origin.
            "potential_energy" => {
                let (m, x) = (free.get(fields::MASS)?, free.get(fields::POSITION)?);
                let g = world.steady_gravity;
                Box::new(move |k| -(m[k] * g.dot(&x[k])))
            }
            name => match AXES.iter().position(|axis| *axis == name) {
                Some(axis) => {
                    let (x, axis) = (free.get(fields::POSITION)?, axis.min(D - 1));
                    Box::new(move |k| x[k][axis])
                }
                None => return of_column(world, self.parts()),
            },
        };
        Ok((value, self.unit().unwrap_or_default()))
    }
}

fn of_column<'a, const D: usize>(
    world: &'a World<D>,
    (name, component): (&str, Option<usize>),
) -> Result<Values<'a>, StepError> {
    let mut columns = world.free.columns();
    let found = columns.find(|(known, ..)| *known == name);
    let Some((_, unit, _, components, Plain::Real(values))) = found else {
        return Err(unknown(world, name));
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

fn unknown<const D: usize>(world: &World<D>, name: &str) -> StepError {
    let columns: Vec<_> = world.free.columns().map(|column| column.0).collect();
    let made = MADE.iter().map(|(name, _)| *name);
    let near = suggestion(name, columns.iter().copied().chain(made.clone()));
    let known: Vec<_> = columns.iter().copied().chain(made).collect();
    let known = known.join(", ");
    let reason = format!("there is no field `{name}` in this scene{near}; there are: {known}");
    StepError::stage("probes", reason)
}
