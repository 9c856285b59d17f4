//! Plugins that messages advise to take; the only names in the solver.

/// Skin of the neighbour lists as a share of the support radius.
pub const SKIN: f64 = 0.1;

/// Kind and name of the plugin that is advised for a scene without one.
const SUGGESTIONS: [(&str, &str); 2] = [
    ("smoother", "brezzi-pitkaranta"),
    ("implicit-viscosity", "backward-euler"),
];

/// Takes one kick and one drift per step.
pub const ONE_KICK: &str = "`[integrator.symplectic-euler]`";
/// Walls that can be opened.
pub const OPEN_WALLS: &str = "`[walls.usaw]` with `vertices = false`";
/// Walls for every formulation and pressure scheme.
pub const KNOWN_WALLS: &str = "`[walls.usaw]`";
/// Lets fluid out.
pub const OUTFLOW: &str = "`open-boundary.outflow`";
/// Takes sound that walls feed.
pub const SOUND_DAMPING: &str = "`[damping.acoustic]`";
/// Relaxes densities at former surfaces.
pub const SURFACE: &str = "`[surface.cone-test]`";

/// The table of plugins that are advised for a scene without one of a kind.
pub fn suggested(kind: &str) -> Option<String> {
    let found = SUGGESTIONS.iter().find(|(k, _)| *k == kind);
    found.map(|(kind, name)| format!("`[{kind}.{name}]`"))
}
