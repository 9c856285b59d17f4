//! Accelerations by class of terms, in columns that an output or a probe names.

use sph_core::{Field, Role, StepError, Vect, Vector, Work, kind_of};
use sph_neighbours::class_rates;

use crate::step::flow::Flow;
use crate::step::hooks::{Boundary, ObservedFlow, Observer};

sph_core::fields! {
    /// Its part of the walls is among it.
    PRESSURE: Vector = "pressure_acceleration", "m/s²", "acceleration by pressure";
    /// Friction of eddies and of walls is among it.
    FRICTION: Vector = "viscous_acceleration", "m/s²", "acceleration by friction";
    SHIFTING: Vector = "shifting_acceleration", "m/s²", "acceleration by shifted momentum";
    OTHERS: Vector = "other_acceleration", "m/s²", "acceleration by all other terms of the sweep";
}

/// Acceleration of every particle at the last kick by terms with a work, the last one by all others.
const COLUMNS: [(Field<Vector>, Option<Work>); 4] = [
    (PRESSURE, Some(Work::Pressure)),
    (FRICTION, Some(Work::Friction)),
    (SHIFTING, Some(Work::Shifting)),
    (OTHERS, None),
];

/// Names of the columns.
pub fn names() -> impl Iterator<Item = &'static str> {
    COLUMNS.iter().map(|(field, _)| field.name)
}

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
        let class = COLUMNS.iter().position(|(_, of)| *of == Some(work));
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
        let rates = class_rates(world, &terms, COLUMNS.len(), class)?;
        for k in &self.columns {
            let own = rates.iter().skip(*k).step_by(COLUMNS.len());
            let all: Vec<Vect<D>> = own.map(|rate| rate.acceleration).collect();
            *world.free.get_mut(COLUMNS[*k].0)? = all;
        }
        Ok(())
    }
}
