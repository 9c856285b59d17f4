//! Kinds of plugins: their names, places in scenes, defaults and order.

use crate::PluginInfo;

/// Place of the plugins of a kind in scenes.
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
    /// Nowhere in scenes of particles.
    Elsewhere,
}

/// The account of the energy budget for the work of a kind's terms and hooks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Work {
    /// None: the pressure has the rest of the acceleration.
    Pressure,
    /// Friction.
    Friction,
    /// Diffusion of the density.
    Smoothing,
    /// Shifted positions.
    Shifting,
    /// Terms that damp sound, and hooks that damp velocities.
    Damping,
    /// Hooks that change the density constants of surface particles.
    Surface,
    /// That of all other forces.
    Others,
    /// An account of its own, which has the kind's name.
    Own,
}

/// A kind of plugin; declared by [`contract!`](crate::contract).
#[derive(Clone, Copy)]
pub struct PluginKind {
    /// Name in scene files.
    pub name: &'static str,
    /// One sentence.
    pub purpose: &'static str,
    /// Place of its plugins in scenes.
    pub place: Place,
    /// The plugin of a scene that names none.
    pub default: Option<&'static str>,
    /// State of a scene that names none, for kinds without a default.
    pub absent: &'static str,
    /// The message to a scene that names a plugin and has no use for it; without one, such a scene is no mistake.
    pub idle: Option<&'static str>,
    /// Position of its terms in sums and of its hooks in steps, the least first.
    pub order: u8,
    /// The account of its work.
    pub work: Work,
    /// Its plugins in this binary, by name.
    pub plugins: fn() -> Vec<PluginInfo>,
}
inventory::collect!(PluginKind);

impl std::fmt::Debug for PluginKind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name)
    }
}

impl PluginKind {
    /// A kind without a default, whose terms and hooks follow those of all kinds with an [order](Self::ordered).
    pub const fn new(name: &'static str, place: Place, purpose: &'static str) -> Self {
        PluginKind {
            name,
            purpose,
            place,
            default: None,
            absent: "none if left out",
            idle: None,
            order: u8::MAX,
            work: Work::Own,
            plugins: Vec::new,
        }
    }

    /// With a default.
    pub const fn by_default(mut self, plugin: &'static str) -> Self {
        self.default = Some(plugin);
        self
    }

    /// With a text for scenes that name none, after a semicolon: "explicit if left out".
    pub const fn absent(mut self, text: &'static str) -> Self {
        self.absent = text;
        self
    }

    /// With a message to scenes that name a plugin and have no use for it.
    pub const fn idle(mut self, message: &'static str) -> Self {
        self.idle = Some(message);
        self
    }

    /// With a position of its terms and hooks, the least first.
    pub const fn ordered(mut self, order: u8) -> Self {
        self.order = order;
        self
    }

    /// With an account of its work.
    pub const fn works(mut self, work: Work) -> Self {
        self.work = work;
        self
    }

    /// With a list of its plugins.
    pub const fn with_plugins(mut self, plugins: fn() -> Vec<PluginInfo>) -> Self {
        self.plugins = plugins;
        self
    }

    /// True if its plugins stand in a table of the scene's own, `[KIND.PLUGIN]`.
    pub fn has_table(&self) -> bool {
        matches!(self.place, Place::One | Place::Any)
    }

    /// State of a scene that names none: "`tait` if left out".
    pub fn if_left_out(&self) -> String {
        self.default
            .map_or(self.absent.into(), |name| format!("`{name}` if left out"))
    }
}

/// Every kind of plugin in this binary, by name. Of two with the same name one is left out.
pub fn kinds() -> Vec<&'static PluginKind> {
    let mut all: Vec<_> = inventory::iter::<PluginKind>.into_iter().collect();
    all.sort_by_key(|k| k.name);
    all.dedup_by_key(|k| k.name);
    all
}

/// The kind of a name.
pub fn kind_of(name: &str) -> Option<&'static PluginKind> {
    kinds().into_iter().find(|k| k.name == name)
}
