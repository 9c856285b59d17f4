//! Errors of a contribution that cannot be part of a scene.

/// A key of a scene, and its fault there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// The kind whose plugin's table has the key.
    pub kind: &'static str,
    /// The key in that table; the table itself, if empty.
    pub key: String,
    /// The defect and its remedy.
    pub why: String,
}

impl Refusal {
    /// Of a key in the table of a kind's plugin.
    pub fn at_key(kind: &'static str, key: impl Into<String>, why: impl Into<String>) -> Self {
        Refusal {
            kind,
            key: key.into(),
            why: why.into(),
        }
    }
}
