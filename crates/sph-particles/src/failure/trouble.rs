//! The first sign that a run is in trouble.

use serde::{Deserialize, Serialize};
use sph_core::StepError;

/// When, where and in which quantity a step first failed, whether or not a shorter one helped.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Trouble {
    /// Time of the state that was bad, s.
    pub time: f64,
    /// Steps taken before it.
    pub step: u64,
    /// The quantity, or the stage that reported it.
    pub quantity: String,
    /// The particle, where it is one's.
    pub particle: Option<u32>,
    /// Its place, m; empty if nobody's, or not finite.
    pub position: Vec<f64>,
    /// The value, if it is finite.
    pub value: Option<f64>,
    /// What was wrong with it.
    pub reason: String,
}

impl Trouble {
    /// What a failed step tells.
    pub fn of(cause: &StepError, time: f64, step: u64) -> Self {
        let bare = Trouble {
            time,
            step,
            ..Trouble::default()
        };
        match cause {
            StepError::Bad {
                quantity,
                particle,
                position,
                value,
                reason,
            } => Trouble {
                quantity: (*quantity).to_string(),
                particle: Some(*particle),
                position: match position.iter().all(|x| x.is_finite()) {
                    true => position.clone(),
                    false => Vec::new(),
                },
                value: value.is_finite().then_some(*value),
                reason: reason.clone(),
                ..bare
            },
            StepError::Stage { stage, reason } => Trouble {
                quantity: stage.clone(),
                reason: reason.clone(),
                ..bare
            },
            StepError::Field(error) => Trouble {
                quantity: "field".into(),
                reason: error.to_string(),
                ..bare
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_finite_survives_a_file() {
        let cause = StepError::Bad {
            quantity: "position",
            particle: 7,
            position: vec![f64::NAN, 1.0],
            value: f64::NAN,
            reason: "not finite".into(),
        };
        let trouble = Trouble::of(&cause, 0.5, 3);
        let text = serde_json::to_string(&trouble).unwrap();
        assert_eq!(serde_json::from_str::<Trouble>(&text).unwrap(), trouble);
        assert_eq!((trouble.particle, trouble.value), (Some(7), None));
    }
}
