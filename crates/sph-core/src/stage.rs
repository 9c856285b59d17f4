//! Stages: the reads and writes of a piece of work, and the work itself.

use crate::field::AnyField;
use crate::{Field, Kind, StepError};

/// The columns a stage touches.
///
/// Reads at the particle and reads at its neighbours are separate: the planner needs both
/// for order and pruning, and a halo exchange would need only the second.
#[derive(Clone, Debug, Default)]
pub struct Access {
    /// Columns read at the particle itself.
    pub here: Vec<AnyField>,
    /// Columns read at its neighbours.
    pub neighbours: Vec<AnyField>,
    /// Columns written at the particle itself.
    pub writes: Vec<AnyField>,
    /// Columns read, here and at neighbours, in scenes that have them (phases); no stage has to write them.
    pub where_there: Vec<AnyField>,
    /// Columns that it writes and begins with the next time: they carry history.
    pub remembers: Vec<AnyField>,
    /// True if the stage walks over neighbours (a sweep).
    pub sweep: bool,
    /// Passes from particles to their neighbours, if more than one: 2 if it takes sums over neighbours of its own sums.
    pub rings: usize,
}

impl Access {
    /// No column at all.
    pub fn none() -> Self {
        Access::default()
    }

    /// Adds a column read at the particle.
    pub fn here<K: Kind>(mut self, field: Field<K>) -> Self {
        push(&mut self.here, field.any());
        self
    }

    /// Adds a column read at the particle and at its neighbours.
    pub fn both<K: Kind>(mut self, field: Field<K>) -> Self {
        push(&mut self.here, field.any());
        self.neighbours(field)
    }

    /// Adds a column read at the neighbours.
    pub fn neighbours<K: Kind>(mut self, field: Field<K>) -> Self {
        push(&mut self.neighbours, field.any());
        self.sweep = true;
        self
    }

    /// Adds a column written at the particle.
    pub fn writes<K: Kind>(mut self, field: Field<K>) -> Self {
        push(&mut self.writes, field.any());
        self
    }

    /// Adds a column written at the particle that carries history.
    pub fn remembers<K: Kind>(mut self, field: Field<K>) -> Self {
        push(&mut self.remembers, field.any());
        self.writes(field)
    }

    /// The same columns, at neighbours of neighbours: `rings` times from a particle to its neighbours.
    pub fn rings(self, rings: usize) -> Self {
        Access { rings, ..self }
    }

    /// Adds a column that is read where a scene has it.
    pub fn where_there<K: Kind>(mut self, field: Field<K>) -> Self {
        push(&mut self.where_there, field.any());
        self
    }

    /// Joins the accesses of two pieces of work done in one walk.
    pub fn and(mut self, other: Access) -> Self {
        let lists = [
            (&mut self.here, other.here),
            (&mut self.neighbours, other.neighbours),
            (&mut self.writes, other.writes),
            (&mut self.where_there, other.where_there),
            (&mut self.remembers, other.remembers),
        ];
        for (own, more) in lists {
            more.into_iter().for_each(|f| push(own, f));
        }
        self.sweep |= other.sweep;
        self.rings = self.rings.max(other.rings);
        self
    }

    /// Every column read, here or at neighbours, once.
    pub fn reads(&self) -> Vec<AnyField> {
        let mut all = self.here.clone();
        self.neighbours.iter().for_each(|f| push(&mut all, *f));
        all
    }
}

fn push(list: &mut Vec<AnyField>, field: AnyField) {
    if !list.contains(&field) {
        list.push(field);
    }
}

/// Something with a name and declared columns.
pub trait Declares {
    /// Name in plans and timings.
    fn name(&self) -> String;
    /// The columns it touches.
    fn access(&self) -> Access;
}

/// One piece of work of an evaluation, over all particles, in a context `C`.
pub trait Stage<C>: Declares + Send {
    /// Does the work.
    ///
    /// # Errors
    /// When a column is missing or a value is impossible; the step is then rolled back.
    fn run(&mut self, context: &mut C) -> Result<(), StepError>;
    /// The reason why it needs all particles at once, if it does: it adds up over all of them, or goes through their
    /// neighbours' neighbours.
    /// Otherwise it may run for some of them, with copies of others around, whose sums over neighbours come from their
    /// owners after it.
    fn needs_all(&self) -> Option<&'static str> {
        None
    }
    /// True if it may run for some of the particles, and then for the others, by the context.
    fn halves(&self) -> bool {
        false
    }
    /// Memory of the system that it solved last, matrix and solution, bytes; 0 where it solves none.
    fn bytes(&self) -> usize {
        0
    }
}
