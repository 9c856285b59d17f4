//! The plugins taken where a scene names none; the only names the solver knows.

/// Kind and name of every default.
pub const DEFAULTS: [(&str, &str); 9] = [
    ("kernel", "wendland-c2"),
    ("formulation", "hu-adams"),
    ("integrator", "symplectic-euler"),
    ("walls", "usaw"),
    ("viscous-operator", "morris"),
    ("velocity-gradient", "renormalised"),
    ("elastic-force", "divergence"),
    ("equation-of-state", "tait"),
    ("linear-solver", "automatic"),
];

/// Skin of the neighbour lists as a share of the support radius.
pub const SKIN: f64 = 0.1;

/// The default plugin of a kind, if it has one.
pub fn of(kind: &str) -> Option<&'static str> {
    DEFAULTS
        .iter()
        .find(|(k, _)| *k == kind)
        .map(|(_, name)| *name)
}
