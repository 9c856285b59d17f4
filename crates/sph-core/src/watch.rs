//! Holds pieces of work to the columns that they declared. In builds with debug assertions only.

use std::sync::{Mutex, MutexGuard, PoisonError};

use crate::{Access, AnyField, fields};

/// The works in progress, the innermost last, with the columns that they touched.
#[derive(Default)]
pub(crate) struct Watch(Mutex<WorksInProgress>);

#[derive(Default)]
struct WorksInProgress {
    /// The works in progress, and behind them the buffers of earlier ones.
    all: Vec<AccessRecord>,
    depth: usize,
}

#[derive(Default)]
struct AccessRecord {
    reads: Vec<&'static str>,
    writes: Vec<&'static str>,
    undeclared: Vec<String>,
}

impl Watch {
    fn at_work(&self) -> MutexGuard<'_, WorksInProgress> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Begins work that may touch the columns that all of these declare.
    pub fn begin<'a>(&self, declared: impl IntoIterator<Item = &'a Access>) {
        let mut at_work = self.at_work();
        let place = at_work.depth;
        at_work.depth += 1;
        if at_work.all.len() == place {
            at_work.all.push(AccessRecord::default());
        }
        let own = &mut at_work.all[place];
        own.reads.clear();
        own.writes.clear();
        own.undeclared.clear();
        declared.into_iter().for_each(|access| own.allow(access));
    }

    /// Columns touched without being declared since the last beginning.
    pub fn end(&self) -> Vec<String> {
        let mut at_work = self.at_work();
        let Some(place) = at_work.depth.checked_sub(1) else {
            return Vec::new();
        };
        at_work.depth = place;
        std::mem::take(&mut at_work.all[place].undeclared)
    }

    /// Notes that the innermost work reads a column; in builds with debug assertions alone, as all of this.
    pub fn read(&self, name: &'static str) {
        self.touch("reads", name, |own| {
            own.reads.contains(&name) || own.writes.contains(&name)
        });
    }

    /// Notes that it writes one.
    pub fn write(&self, name: &'static str) {
        self.touch("writes", name, |own| own.writes.contains(&name));
    }

    fn touch(&self, does: &str, name: &str, declared: impl Fn(&AccessRecord) -> bool) {
        if !cfg!(debug_assertions) {
            return;
        }
        let mut at_work = self.at_work();
        let depth = at_work.depth;
        let Some(last) = at_work.all[..depth].last_mut() else {
            return;
        };
        let what = || format!("{does} `{name}`");
        if !declared(last) && !last.undeclared.contains(&what()) {
            last.undeclared.push(what());
        }
    }
}

impl AccessRecord {
    fn allow(&mut self, access: &Access) {
        let name = |field: &AnyField| field.name;
        let reads = [&access.here, &access.neighbours, &access.where_there];
        self.reads.extend(reads.into_iter().flatten().map(name));
        // Every walk over neighbours reads their places, and the part that walls cut off.
        if access.sweep {
            let always = [
                fields::POSITION.name,
                fields::RENORMALISATION.name,
                fields::SCALE.name,
                fields::SCALE_SLOPE.name,
            ];
            self.reads.extend(always);
        }
        self.writes.extend(access.writes.iter().map(name));
    }
}
