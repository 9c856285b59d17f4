//! Numbers within their ranges.

use thiserror::Error;

/// A number out of its range.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{what} {value}; it must be {valid}")]
pub struct OutOfRange {
    /// The quantity with its verb: "the step is".
    pub what: String,
    /// Its value.
    pub value: f64,
    /// The valid values.
    pub valid: &'static str,
}

/// Checks a number; `what` is the quantity with its verb.
///
/// # Errors
/// Unless it is `fine` and finite.
pub fn require(
    what: impl Into<String>,
    value: f64,
    valid: &'static str,
    fine: bool,
) -> Result<(), OutOfRange> {
    if fine && value.is_finite() {
        return Ok(());
    }
    let what = what.into();
    Err(OutOfRange { what, value, valid })
}
