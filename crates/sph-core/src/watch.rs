//! Holds pieces of work to the columns that they declared. In builds with debug assertions only.

use std::sync::{Mutex, MutexGuard, PoisonError};

use crate::{Access, fields};

/// Who is at work, the innermost last, with what they touched.
#[derive(Default)]
pub(crate) struct Watch(Mutex<Vec<Watched>>);

struct Watched {
    reads: Vec<&'static str>,
    writes: Vec<&'static str>,
    undeclared: Vec<String>,
}

impl Watch {
    fn all(&self) -> MutexGuard<'_, Vec<Watched>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub fn begin(&self, access: &Access) {
        let names = |fields: &[crate::AnyField]| fields.iter().map(|f| f.name).collect();
        let mut reads: Vec<_> = names(&access.reads());
        reads.extend(access.where_there.iter().map(|f| f.name));
        // Nobody walks over neighbours without their places, and what walls cut off.
        if access.sweep {
            reads.extend([fields::POSITION.name, fields::RENORMALISATION.name]);
        }
        self.all().push(Watched {
            reads,
            writes: names(&access.writes),
            undeclared: Vec::new(),
        });
    }

    /// What was touched without being declared since the last beginning.
    pub fn end(&self) -> Vec<String> {
        self.all().pop().map_or(Vec::new(), |w| w.undeclared)
    }

    pub fn read(&self, name: &'static str) {
        if let Some(last) = self.all().last_mut() {
            let known = last.reads.contains(&name) || last.writes.contains(&name);
            last.note(known, "reads", name);
        }
    }

    pub fn write(&self, name: &'static str) {
        if let Some(last) = self.all().last_mut() {
            let known = last.writes.contains(&name);
            last.note(known, "writes", name);
        }
    }
}

impl Watched {
    fn note(&mut self, known: bool, does: &str, name: &str) {
        if known {
            return;
        }
        let what = format!("{does} `{name}`");
        if !self.undeclared.contains(&what) {
            self.undeclared.push(what);
        }
    }
}
