//! Kinds of plugins: their names, and where a scene names a plugin of each. The one list of them.

/// Where a scene names plugins of a kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// `[KIND.PLUGIN]`, one at most.
    One,
    /// `[KIND.PLUGIN]`, any number.
    Any,
    /// `[phase.NAME.KIND.PLUGIN]`, one at most in every phase.
    InPhase,
    /// `[wall.NAME.KIND.PLUGIN]`, one at most for every wall.
    InWall,
    /// `[probe.NAME]` and `[gauge.NAME]`, their key `kind` being the plugin.
    Probe,
    /// `solution` of `[reference.NAME]`, and `[body.NAME.initial.PLUGIN]`.
    Solution,
}

/// A kind of plugin as scenes know it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct KindInfo {
    /// Name in scene files.
    pub name: &'static str,
    /// Where a scene names its plugins.
    pub place: Place,
    /// What a scene has that leaves it out, after a semicolon: "none if left out".
    pub absent: &'static str,
}
inventory::collect!(KindInfo);

impl KindInfo {
    /// Whether its plugins stand in a table of the scene's own, `[KIND.PLUGIN]`.
    pub fn has_table(&self) -> bool {
        matches!(self.place, Place::One | Place::Any)
    }
}

const DEFAULT: &str = "chosen by the solver if left out";
const NONE: &str = "none if left out";

const fn one(name: &'static str, absent: &'static str) -> KindInfo {
    let place = Place::One;
    KindInfo {
        name,
        place,
        absent,
    }
}

const fn at(place: Place, name: &'static str) -> KindInfo {
    KindInfo {
        name,
        place,
        absent: NONE,
    }
}

/// Those that the crates of this project have; others register theirs with [`kind!`](crate::kind).
static OWN: [KindInfo; 23] = [
    one("kernel", DEFAULT),
    one("formulation", DEFAULT),
    one("integrator", DEFAULT),
    one("walls", DEFAULT),
    one("viscous-operator", DEFAULT),
    one("implicit-viscosity", "explicit if left out"),
    one("linear-solver", DEFAULT),
    one("velocity-gradient", DEFAULT),
    one("elastic-force", DEFAULT),
    one(
        "effective-pressure",
        "that of the equation of state if left out",
    ),
    one("pressure", "that of the equation of state if left out"),
    one("seepage", NONE),
    one("eddy-viscosity", NONE),
    one("smoother", NONE),
    one("shifting", NONE),
    at(Place::Any, "interface"),
    at(Place::Any, "term"),
    at(Place::InPhase, "equation-of-state"),
    at(Place::InPhase, "rheology"),
    at(Place::InWall, "mover"),
    at(Place::InWall, "open-boundary"),
    at(Place::Probe, "probe"),
    at(Place::Solution, "solution"),
];

/// Every kind of plugin that a scene may name: this project's own, then those that other crates in this binary
/// registered, by name. A name that is taken already is left out.
pub fn kinds() -> Vec<&'static KindInfo> {
    let mut others: Vec<_> = inventory::iter::<KindInfo>.into_iter().collect();
    others.sort_by_key(|k| k.name);
    let mut all: Vec<&'static KindInfo> = OWN.iter().collect();
    for other in others {
        if all.iter().all(|k| k.name != other.name) {
            all.push(other);
        }
    }
    all
}

/// The kind of a name.
pub fn kind_of(name: &str) -> Option<&'static KindInfo> {
    kinds().into_iter().find(|k| k.name == name)
}

/// Registers a kind of plugin, so that scenes may name one (`One`) or any number (`Any`) of its plugins:
/// `kind!("tracer", Any, "none if left out")`.
#[macro_export]
macro_rules! kind {
    ($name:literal, One, $absent:literal) => {
        $crate::kind!(@ $name, One, $absent);
    };
    ($name:literal, Any, $absent:literal) => {
        $crate::kind!(@ $name, Any, $absent);
    };
    (@ $name:literal, $place:ident, $absent:literal) => {
        $crate::reexport::inventory::submit! {
            $crate::KindInfo { name: $name, place: $crate::Place::$place, absent: $absent }
        }
    };
}
