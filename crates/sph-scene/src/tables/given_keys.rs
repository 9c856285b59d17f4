//! Keys of a table that are given.

/// The names of keys that are given.
pub(crate) fn given<const N: usize>(keys: [(&'static str, bool); N]) -> Vec<&'static str> {
    let given = keys.into_iter().filter(|(_, given)| *given);
    given.map(|(name, _)| name).collect()
}
