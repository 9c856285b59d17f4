//! Report of a failed step, for summaries.

use sph_core::StepError;
use sph_run::Trouble;

/// Report of a failed step.
pub(crate) fn trouble(cause: &StepError, time: f64, step: u64) -> Trouble {
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
        other => Trouble {
            reason: other.to_string(),
            ..bare
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_that_are_not_finite_survive_a_file() {
        let cause = StepError::Bad {
            quantity: "position",
            particle: 7,
            position: vec![f64::NAN, 1.0],
            value: f64::NAN,
            reason: "not finite".into(),
        };
        let told = trouble(&cause, 0.5, 3);
        let text = serde_json::to_string(&told).unwrap();
        assert_eq!(serde_json::from_str::<Trouble>(&text).unwrap(), told);
        assert_eq!((told.particle, told.value), (Some(7), None));
    }
}
