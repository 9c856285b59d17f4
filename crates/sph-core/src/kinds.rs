//! Kinds of plugins: their names, places in scenes, defaults and order.

use serde_json::Value as Json;

/// Description of a plugin that is not built.
#[derive(Clone, Copy)]
pub struct PluginInfo {
    /// Name in scene files.
    pub name: &'static str,
    /// One sentence.
    pub summary: &'static str,
    /// Publication and equation.
    pub source: &'static str,
    /// Crate and version that registered it.
    pub provider: &'static str,
    /// Dimensions it can be built in.
    pub dimensions: &'static [usize],
    /// JSON schema of its parameters.
    pub schema: fn() -> Json,
}

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

/// Nature of a flow that its scene states, by which kinds choose plugins and parameters that the scene leaves out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FlowNature {
    /// True if the bodies reach from wall to wall, or over a period, in every direction: no surface is free.
    pub confined: bool,
    /// True if all walls run along one periodic direction, as those of a channel do.
    pub parallel: bool,
    /// True if fluid passes a wall, or moves one: a wall has an open boundary or a mover.
    pub open: bool,
    /// True if gravity acts on it.
    pub heavy: bool,
    /// True if bodies reach half a row beyond whole rows from a wall, as they do where the wall carries half a row.
    pub half_rows: bool,
    /// Number of its phases.
    pub phases: usize,
    /// The law of the phase that is least a fluid.
    pub law: LawNature,
}

/// Nature of a constitutive law.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum LawNature {
    /// Flows under any stress, or under one that does not depend on the pressure.
    #[default]
    Fluid,
    /// Elastic below a strength that does not depend on the pressure.
    Elastic,
    /// Its strength grows with the pressure.
    Soil,
}

/// The nature of a law by its name and parameters; none of an unknown one.
pub struct LawNatures(pub fn(&str, &toml::Table) -> Option<LawNature>);
inventory::collect!(LawNatures);

/// The plugin that suits a flow, with the parameters that suit it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SuitedPlugin {
    /// Name of the plugin.
    pub name: &'static str,
    /// Parameters that differ from the plugin's defaults, as TOML.
    pub parameters: &'static str,
    /// Property of the flow that decides: "no surface is free".
    pub reason: &'static str,
}

/// The choice of a kind for a flow: the plugin where the scene names none, or parameters of the plugin that it names.
pub type Suits = fn(&FlowNature, Option<&str>) -> Option<SuitedPlugin>;

/// A kind of plugin; declared by [`contract!`](crate::contract).
#[derive(Clone, Copy, Debug)]
pub struct PluginKind {
    /// Name in scene files.
    pub name: &'static str,
    /// One sentence.
    pub purpose: &'static str,
    /// Place of its plugins in scenes.
    pub place: Place,
    /// The plugin of a scene that names none.
    pub default: Option<&'static str>,
    /// The plugin that messages advise, if it is another than the default.
    pub advised: Option<&'static str>,
    /// The plugin, or parameters of the named one, for a flow of a nature.
    pub suited: Suits,
    /// State of a scene that names none, for kinds without a default.
    pub absent: &'static str,
    /// The message to a scene that names a plugin and has no use for it; without one, such a scene is no mistake.
    pub idle: Option<&'static str>,
    /// Position of its terms in sums and of its hooks in steps, the least first.
    pub order: u8,
    /// The account of its work.
    pub work: Work,
    /// Dimensions of its plugins that have none of their own.
    pub dimensions: &'static [usize],
    /// Its plugins in this binary, by name.
    pub plugins: fn() -> Vec<PluginInfo>,
}
inventory::collect!(PluginKind);

impl PluginKind {
    /// A kind without a default, whose terms and hooks follow those of all kinds with an [order](Self::ordered).
    pub const fn new(name: &'static str, place: Place, purpose: &'static str) -> Self {
        PluginKind {
            name,
            purpose,
            place,
            default: None,
            advised: None,
            suited: |_, _| None,
            absent: "none if left out",
            idle: None,
            order: u8::MAX,
            work: Work::Own,
            dimensions: &[2, 3],
            plugins: Vec::new,
        }
    }

    /// With a default that depends on the flow; an empty table of the kind stands for none.
    pub const fn suited(mut self, choice: Suits) -> Self {
        self.suited = choice;
        self.absent = "the one that suits the flow if left out, none if its table is empty";
        self
    }

    /// With plugins in space alone.
    pub const fn in_space(mut self) -> Self {
        self.dimensions = &[3];
        self
    }

    /// True if its plugins stand in a table of the scene's own, `[KIND.PLUGIN]`.
    pub fn has_table(&self) -> bool {
        matches!(self.place, Place::One | Place::Any)
    }

    /// The advised plugin as scenes name it, "`[damping.acoustic]`"; the kind alone if it advises no plugin.
    pub fn advice(&self) -> String {
        let plugin = self.advised.or(self.default);
        let name = plugin.map_or(self.name.into(), |name| format!("{}.{name}", self.name));
        match self.has_table() {
            true => format!("`[{name}]`"),
            false => format!("`{name}`"),
        }
    }

    /// State of a scene that names none: "`tait` if left out".
    pub fn if_left_out(&self) -> String {
        self.default
            .map_or(self.absent.into(), |name| format!("`{name}` if left out"))
    }
}

/// Methods that set a field.
macro_rules! setters {
    ($(#[doc = $doc:literal] $name:ident($value:ident: $type:ty) => $field:ident = $set:expr;)+) => {
        impl PluginKind {$(
            #[doc = $doc]
            pub const fn $name(mut self, $value: $type) -> Self {
                self.$field = $set;
                self
            }
        )+}
    };
}
setters! {
    /// With a default.
    by_default(plugin: &'static str) => default = Some(plugin);
    /// With a plugin that messages advise.
    advises(plugin: &'static str) => advised = Some(plugin);
    /// With a text for scenes that name none, after a semicolon: "explicit if left out".
    absent(text: &'static str) => absent = text;
    /// With a message to scenes that name a plugin and have no use for it.
    idle(message: &'static str) => idle = Some(message);
    /// With a position of its terms and hooks, the least first.
    ordered(order: u8) => order = order;
    /// With an account of its work.
    works(work: Work) => work = work;
    /// With a list of its plugins.
    with_plugins(plugins: fn() -> Vec<PluginInfo>) => plugins = plugins;
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
