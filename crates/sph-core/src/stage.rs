//! Stages: the reads and writes of a piece of work, and the work itself.

use crate::field::AnyField;
use crate::{FieldList, StepError};

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

    /// The same columns, at neighbours of neighbours: `rings` times from a particle to its neighbours.
    pub fn rings(self, rings: usize) -> Self {
        Access { rings, ..self }
    }

    /// Joins the accesses of two pieces of work done in one walk.
    pub fn and(mut self, other: Access) -> Self {
        for (own, others) in [
            (&mut self.here, other.here),
            (&mut self.neighbours, other.neighbours),
            (&mut self.writes, other.writes),
            (&mut self.where_there, other.where_there),
            (&mut self.remembers, other.remembers),
        ] {
            others.into_iter().for_each(|f| push(own, f));
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

/// Methods that add fields to lists.
macro_rules! adders {
    ($(#[doc = $doc:literal] $name:ident => [$($list:ident),+], sweep: $sweep:literal;)+) => {
        impl Access {$(
            #[doc = $doc]
            pub fn $name(mut self, fields: impl FieldList) -> Self {
                fields.for_each(|f| {
                    $(push(&mut self.$list, f);)+
                    self.sweep |= $sweep;
                });
                self
            }
        )+}
    };
}
adders! {
    /// Adds columns read at the particle.
    here => [here], sweep: false;
    /// Adds columns read at the particle and at its neighbours.
    both => [here, neighbours], sweep: true;
    /// Adds columns read at the neighbours.
    neighbours => [neighbours], sweep: true;
    /// Adds columns written at the particle.
    writes => [writes], sweep: false;
    /// Adds columns written at the particle that carry history.
    remembers => [remembers, writes], sweep: false;
    /// Adds columns that are read where a scene has them.
    where_there => [where_there], sweep: false;
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
    /// neighbours' neighbours. Otherwise it may run for some of them, with copies of others around, whose sums over
    /// neighbours come from their owners after it.
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

struct FunctionStage<F> {
    name: &'static str,
    access: Access,
    run: F,
}

/// A stage of a name in plans, the columns that it touches and its work.
pub fn stage<C>(
    name: &'static str,
    access: Access,
    run: impl FnMut(&mut C) -> Result<(), StepError> + Send,
) -> impl Stage<C> {
    FunctionStage { name, access, run }
}

impl<F> Declares for FunctionStage<F> {
    fn name(&self) -> String {
        self.name.into()
    }
    fn access(&self) -> Access {
        self.access.clone()
    }
}

impl<C, F: FnMut(&mut C) -> Result<(), StepError> + Send> Stage<C> for FunctionStage<F> {
    fn run(&mut self, context: &mut C) -> Result<(), StepError> {
        (self.run)(context)
    }
}
