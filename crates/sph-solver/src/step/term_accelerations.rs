//! Accelerations by class of terms, in columns that an output or a probe names.

use sph_core::{Field, Role, StepError, Vect, Vector, Work, kind_of};
use sph_neighbours::{ClassRate, class_rates};

use crate::step::flow::Flow;
use crate::step::hooks::{Boundary, ObservedFlow, Observer};

/// Membership of a class of terms.
type Holds = fn(Work) -> bool;

const fn column(name: &'static str, meaning: &'static str) -> Field<Vector> {
    Field::new(name, "m/s²", meaning)
}

/// Acceleration by the terms of a class of every particle at the last kick, m/s². That of the pressure has its part of
/// the walls; that of friction the eddies' and the walls'.
const COLUMNS: [(Field<Vector>, Holds); 4] = [
    (
        column("pressure_acceleration", "acceleration by pressure"),
        |work| matches!(work, Work::Pressure),
    ),
    (
        column("viscous_acceleration", "acceleration by friction"),
        |work| matches!(work, Work::Friction),
    ),
    (
        column("shifting_acceleration", "acceleration by shifted momentum"),
        |work| matches!(work, Work::Shifting),
    ),
    (
        column(
            "other_acceleration",
            "acceleration by all other terms of the sweep",
        ),
        |work| !matches!(work, Work::Pressure | Work::Friction | Work::Shifting),
    ),
];

/// Names of the columns.
pub fn names() -> impl Iterator<Item = &'static str> {
    COLUMNS.iter().map(|(field, _)| field.name)
}

/// Writes the columns at every kick.
struct TermAccelerations {
    columns: Vec<usize>,
    /// The class of every term, by its name.
    classes: Vec<(String, usize)>,
}

/// Opens the columns that are `shown`, and no others.
pub fn open<const D: usize>(shown: &[String], flow: &mut Flow<D>) {
    let named = |field: &Field<Vector>| shown.iter().any(|name| name == field.name);
    let columns: Vec<usize> = (0..COLUMNS.len())
        .filter(|k| named(&COLUMNS[*k].0))
        .collect();
    if columns.is_empty() {
        return;
    }
    for k in &columns {
        flow.world.free.add(COLUMNS[*k].0, Role::State);
    }
    let class = |kind: &str| {
        let work = kind_of(kind).map_or(Work::Others, |kind| kind.work);
        let class = COLUMNS.iter().position(|(_, holds)| holds(work));
        class.unwrap_or(COLUMNS.len() - 1)
    };
    let kinds = flow.kinds.iter();
    let classes = kinds.map(|(name, kind)| (name.clone(), class(kind)));
    let classes = classes.collect();
    let observer = TermAccelerations { columns, classes };
    flow.observers.push(Box::new(observer));
}

impl<const D: usize> Observer<D> for TermAccelerations {
    fn observe(&mut self, at: Boundary, seen: &mut ObservedFlow<'_, D>) -> Result<(), StepError> {
        if at != Boundary::Kicks {
            return Ok(());
        }
        let terms: Vec<_> = seen.terms.iter().map(|t| &**t).collect();
        let class = |name: &str| {
            let known = self.classes.iter().find(|(n, _)| n == name);
            Some(known.map_or(COLUMNS.len() - 1, |(_, class)| *class))
        };
        let world = &mut *seen.world;
        let rates: Vec<[ClassRate<D>; COLUMNS.len()]> = class_rates(world, &terms, class)?;
        for k in &self.columns {
            let all: Vec<Vect<D>> = rates.iter().map(|of| of[*k].acceleration).collect();
            *world.free.get_mut(COLUMNS[*k].0)? = all;
        }
        Ok(())
    }
}
