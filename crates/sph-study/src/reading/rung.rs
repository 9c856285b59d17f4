//! Axes that are gone along until they break, and places on them.

use crate::reading::file::Bounds;

/// An axis that is gone along until it breaks.
#[derive(Clone, Debug, PartialEq)]
pub struct Ladder {
    /// Name in tables and folders.
    pub name: String,
    /// Title of the axis.
    pub title: String,
    /// Name of the scene.
    pub scene: String,
    /// References in the report; the plot shows the first.
    pub errors: Vec<String>,
    /// Names of the values, from harmless to absurd.
    pub labels: Vec<String>,
    /// The last value that must survive.
    pub must: Option<usize>,
    /// Bounds of green and yellow.
    pub judge: Bounds,
    /// True if variants after a red value are run all the same.
    pub to_the_end: bool,
}

/// The place of a variant on a ladder.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rung {
    /// Number of the ladder.
    pub ladder: usize,
    /// Number of the combination of plugins with which it is gone along.
    pub combination: usize,
    /// Number of the value.
    pub value: usize,
}

impl Rung {
    /// Ladder and combination, common to variants that run one after the other.
    pub fn chain(&self) -> (usize, usize) {
        (self.ladder, self.combination)
    }
}
