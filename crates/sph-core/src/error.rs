//! Typed errors of the shared vocabulary.

use scene_text::{SceneProblem, suggestion};
use thiserror::Error;

/// A column of another kind than its reader expects.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum FieldError {
    /// No stage or term declared the field.
    #[error("field `{0}` is not allocated in this scene: no plugin declared it")]
    Missing(&'static str),
    /// The field has another type.
    #[error("field `{0}` is read with a type it does not have")]
    Type(&'static str),
    /// A column came back with another length.
    #[error("field `{0}` has {1} entries where {2} were expected")]
    Length(&'static str, usize, usize),
}

/// A set of stages that cannot be put in order.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{0}")]
pub struct PlanError(pub String);

/// A plugin that cannot be found or built.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum RegistryError {
    /// No plugin of that kind has that name: the whole message.
    #[error("{0}")]
    Unknown(String),
    /// Two crates registered the same name.
    #[error("the {kind} `{name}` is registered twice, by {} and by {}", .providers[0], .providers[1])]
    Duplicate {
        /// Kind of plugin.
        kind: &'static str,
        /// The contested name.
        name: &'static str,
        /// Both providers.
        providers: [&'static str; 2],
    },
    /// The plugin of a kind and a name exists, but not in this dimension.
    #[error("the {0} `{1}` has no {2}D form")]
    Dimension(&'static str, &'static str, usize),
    /// A parameter is wrong; the paths are relative to the plugin's table.
    #[error("{}", .0.iter().map(ToString::to_string).collect::<Vec<_>>().join("; "))]
    Parameters(Vec<SceneProblem>),
}

impl RegistryError {
    /// A plugin name that its kind does not have.
    pub fn unknown<'n>(
        kind: &'static str,
        name: &str,
        known: impl Iterator<Item = &'n str> + Clone,
    ) -> Self {
        let hint = suggestion(name, known.clone());
        let known = known.collect::<Vec<_>>().join(", ");
        RegistryError::Unknown(format!(
            "there is no {kind} called `{name}`{hint} (registered: {known}; \
             a plugin of another crate must be mentioned in your binary: `use my_plugin as _;`)"
        ))
    }
}

/// A time step that went wrong, with the particle and the quantity.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum StepError {
    /// A column is of another kind than its reader expects.
    #[error(transparent)]
    Field(#[from] FieldError),
    /// A value left its bounds or is not a number.
    #[error(
        "{quantity} of particle {particle} at ({}) is {value}, {reason}",
        .position.iter().map(|x| format!("{x:.6}")).collect::<Vec<_>>().join(", ")
    )]
    Bad {
        /// Name of the quantity.
        quantity: &'static str,
        /// Identity of the particle.
        particle: u32,
        /// Its place.
        position: Vec<f64>,
        /// The value.
        value: f64,
        /// The reason.
        reason: String,
    },
    /// A stage failed for a reason of its own.
    #[error("{stage}: {reason}")]
    Stage {
        /// Name of the stage.
        stage: String,
        /// The error and its remedy.
        reason: String,
    },
}

impl StepError {
    /// Of a stage, for a reason of its own.
    pub fn stage(stage: impl Into<String>, reason: impl ToString) -> Self {
        StepError::Stage {
            stage: stage.into(),
            reason: reason.to_string(),
        }
    }
}
