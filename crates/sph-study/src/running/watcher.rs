//! Observers of the progress of a study.

use sph_run::Progress;

use crate::reading::variant::Variant;
use crate::running::record::Record;

/// A watcher of a study; variants may call it from several threads.
pub trait Watcher: Sync {
    /// A repetition of a variant begins or goes on.
    fn started(&self, _variant: &Variant, _repetition: usize) {}
    /// After every step.
    fn step(&self, _variant: &Variant, _progress: &Progress) {}
    /// A line worth saying.
    fn message(&self, _variant: &Variant, _text: &str) {}
    /// A variant has come to an end, or had one.
    fn finished(&self, _variant: &Variant, _record: &Record) {}
    /// True to stop, with finished variants kept.
    fn stop(&self) -> bool {
        false
    }
}

/// A silent watcher.
impl Watcher for () {}
