//! Colours of pictures: `output.picture_range` of any scene.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::Deserialize;

use crate::SceneProblem;

/// Values at the ends of the colours of pictures, SI.
///
/// ```
/// let range: scene_text::PictureRange = toml::Value::from(vec![0.0, 9000.0]).try_into()?;
/// assert_eq!(range.ends("pressure"), Some([0.0, 9000.0]));
/// assert!(range.falling("output.picture_range").is_empty());
/// # Ok::<(), toml::de::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum PictureRange {
    /// Those of all pictures.
    All([f64; 2]),
    /// Those of single fields.
    ByField(BTreeMap<String, [f64; 2]>),
}

impl PictureRange {
    /// The values at the ends for a field, if they are given.
    #[must_use]
    pub fn ends(&self, field: &str) -> Option<[f64; 2]> {
        match self {
            PictureRange::All(range) => Some(*range),
            PictureRange::ByField(ranges) => ranges.get(field).copied(),
        }
    }

    /// Names of the fields that have values of their own.
    pub fn fields(&self) -> impl Iterator<Item = &String> {
        let own = match self {
            PictureRange::All(_) => None,
            PictureRange::ByField(ranges) => Some(ranges.keys()),
        };
        own.into_iter().flatten()
    }

    /// A problem for each pair whose first value is not less than its second, by the key under `path`.
    #[must_use]
    pub fn falling(&self, path: &str) -> Vec<SceneProblem> {
        match self {
            PictureRange::All(range) => falling(path.into(), *range).into_iter().collect(),
            PictureRange::ByField(ranges) => {
                let each = ranges.iter();
                each.filter_map(|(field, range)| falling(format!("{path}.{field}"), *range))
                    .collect()
            }
        }
    }
}

/// A problem if the first value is not less than the second.
pub fn falling(path: String, [low, high]: [f64; 2]) -> Option<SceneProblem> {
    let message = format!("the first must be less than the second, found {low} and {high}");
    (low >= high).then(|| SceneProblem::new(path, message))
}
