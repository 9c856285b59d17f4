//! The largest stable time step of a plugin, with its reason.

/// A plugin's own bound on the time step.
#[derive(Clone, Debug, PartialEq)]
pub struct StepLimit {
    /// Short name for the summary: "sound", "viscosity", "force".
    pub name: &'static str,
    /// Largest stable step, s; infinite where it does not bind.
    pub dt: f64,
}

impl StepLimit {
    /// A bound of `dt` seconds called `name`.
    pub fn new(name: &'static str, dt: f64) -> Self {
        StepLimit { name, dt }
    }

    /// The smallest of several bounds; a bound that is not a number counts as zero.
    pub fn least(limits: &[StepLimit]) -> Option<&StepLimit> {
        let key = |l: &StepLimit| if l.dt.is_nan() { 0.0 } else { l.dt };
        limits.iter().min_by(|a, b| key(a).total_cmp(&key(b)))
    }
}
