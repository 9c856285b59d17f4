//! Keys that take one value or a list of them.

use schemars::JsonSchema;
use serde::{Deserialize, Deserializer};

/// One value or a list.
#[derive(Deserialize, JsonSchema)]
#[serde(untagged)]
pub(crate) enum OneOrMany<T> {
    /// One.
    One(T),
    /// Several.
    Many(Vec<T>),
}

/// The values of such a key.
pub(crate) fn one_or_many<'de, T, D>(from: D) -> Result<Vec<T>, D::Error>
where
    T: Deserialize<'de>,
    D: Deserializer<'de>,
{
    OneOrMany::deserialize(from).map(|given| match given {
        OneOrMany::One(one) => vec![one],
        OneOrMany::Many(many) => many,
    })
}
