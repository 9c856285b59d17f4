//! A whole scene as plain data.

use std::collections::BTreeMap;
use std::path::PathBuf;

use sph_core::{PluginChoice, SceneProblem, Vect, parameters};

use crate::geometry::vector::array;
use crate::reading::plugins::{Plugins, Probe, in_table, probes, solution};
use crate::{Body, Numerics, Outlet, Output, Phase, Reference, Region, Run, Wall, Zone};

/// Displacement at the start, over the spacing, where particles are shifted and the scene has no key for it.
///
/// Shifts follow the symmetry of the particles: those of a perfect lattice cancel however it is stretched, until
/// rounding has grown. From 0.001 on, the errors of vortices at 50² are those of a full disorder (L1 0.0023, from 0.01
/// on 0.0021, from 0 0.0042).
pub const OFF_LATTICE: f64 = 0.01;

/// A scene: materials and their places, laws, duration and outputs.
#[parameters]
pub struct Scene {
    /// The scene in one line, with its publication.
    pub title: String,
    /// Subject of the scene and its results.
    pub description: Option<String>,
    /// Number of space dimensions.
    #[parameter(min: 2, max: 3)]
    pub dimension: usize,
    /// Duration and accuracy of the run.
    pub run: Run,
    /// Resolution, forces, periodic directions and bounds.
    pub numerics: Numerics,
    /// Plugins of every kind of which a scene has one or any number ([`sph_core::kinds`]): `[KIND.PLUGIN]`.
    #[serde(skip)]
    pub(crate) plugins: BTreeMap<&'static str, Plugins>,
    /// Kinds and keys that the scene leaves to its flow, with the property of the flow that decides.
    #[serde(skip)]
    pub suited: Vec<(&'static str, &'static str)>,
    /// Walls by name, `[wall.NAME]`.
    #[parameter(default)]
    pub wall: BTreeMap<String, Wall>,
    /// Materials by name, `[phase.NAME]`, at least one.
    #[parameter(default)]
    pub phase: BTreeMap<String, Phase>,
    /// Bodies by name, `[body.NAME]`, at least one.
    #[parameter(default)]
    pub body: BTreeMap<String, Body>,
    /// Places where particles leave, by name, `[outlet.NAME]`.
    #[parameter(default)]
    pub outlet: BTreeMap<String, Outlet>,
    /// Places with finer particles, by name, `[zone.NAME]`.
    #[parameter(default)]
    pub zone: BTreeMap<String, Zone>,
    /// Corners of the box outside of which bodies have no particles, m; without it they are whole.
    #[serde(skip)]
    pub window: Option<[Vec<f64>; 2]>,
    /// Measurements by name, `[probe.NAME]`; `kind` is the plugin, the other keys its parameters.
    #[parameter(default)]
    #[schemars(with = "BTreeMap<String, Probe>")]
    pub probe: Plugins,
    /// Measurements at fixed places, `[gauge.NAME]`; the same as probes.
    #[parameter(default)]
    #[schemars(with = "BTreeMap<String, Probe>")]
    pub gauge: Plugins,
    /// Remarks on its numbers, each with its place in the text.
    #[serde(skip)]
    pub remarks: Vec<String>,
    /// Paths of the files that probes and gauges name in `file`, by the name of the probe.
    #[serde(skip)]
    pub probe_files: BTreeMap<String, PathBuf>,
    /// Comparisons by name, `[reference.NAME]`; their errors are in the summary.
    #[parameter(default)]
    pub reference: BTreeMap<String, Reference>,
    /// Files of a run, and the times of writing.
    #[parameter(default)]
    pub output: Output,
}

impl Scene {
    /// Steady gravity, m/s²; zero if the scene gives none.
    pub fn gravity<const D: usize>(&self) -> Vect<D> {
        array::<D>(self.numerics.gravity.as_deref().unwrap_or(&[])).into()
    }

    /// True if gravity changes over time: a motion against it or with it takes or gives energy.
    pub fn swings(&self) -> bool {
        self.numerics.gravity_over_time.is_some() || self.numerics.frame.is_some()
    }

    /// Driving force per mass, m/s²; zero if the scene gives none.
    pub fn driving<const D: usize>(&self) -> Vect<D> {
        array::<D>(self.numerics.driving.as_deref().unwrap_or(&[])).into()
    }

    /// Largest displacement of a particle at the start along each axis over the spacing: that of the scene, or
    /// [`OFF_LATTICE`] where it shifts.
    pub fn jitter(&self) -> f64 {
        let shifted = self.choice("shifting").is_some();
        let unless_given = if shifted { OFF_LATTICE } else { 0.0 };
        self.numerics.jitter.unwrap_or(unless_given)
    }

    /// The bodies' shapes, in the order of `body`.
    ///
    /// A body that fills the walls has none unless a `box` bounds it and is left out: where
    /// there is one ([`Body::fill`]), ask [`Scene::regions_within`].
    pub fn regions<const D: usize>(&self) -> Vec<Region<D>> {
        self.body.values().filter_map(Region::from_body).collect()
    }

    /// One region for every body, in the order of `body`; `bounds` is the box around all walls, m.
    ///
    /// The region of a body that fills the walls is that box, or the part of it in the body's own `box`; its lattice
    /// counts from the lower corner. The caller removes the part behind walls, as it is of a body with `clip`.
    ///
    /// # Errors
    /// If a body fills the walls and there are no bounds, or its box has nothing in common with
    /// them.
    pub fn regions_within<const D: usize>(
        &self,
        bounds: Option<([f64; D], [f64; D])>,
    ) -> Result<Vec<Region<D>>, SceneProblem> {
        let region = |(name, body): (&String, &Body)| match body.fill {
            None => Region::from_body(body)
                .ok_or_else(|| SceneProblem::new(format!("body.{name}"), "a shape is missing")),
            Some(_) => Region::enclosed(body, bounds)
                .map_err(|(key, why)| SceneProblem::new(format!("body.{name}.{key}"), why)),
        };
        self.body.iter().map(region).collect()
    }

    /// The plugin that the scene chooses for a kind of which it has one at most.
    pub fn choice(&self, kind: &str) -> Option<PluginChoice> {
        self.choices(kind).into_iter().next()
    }

    /// The plugins that the scene names of a kind of which it has one or any number.
    pub fn choices(&self, kind: &str) -> Vec<PluginChoice> {
        match self.plugins.get_key_value(kind) {
            Some((kind, plugins)) => in_table(kind, plugins, kind),
            None => Vec::new(),
        }
    }

    /// The kinds of which the scene names plugins in tables of its own, by name.
    pub fn kinds_named(&self) -> impl Iterator<Item = &'static str> {
        let named = self.plugins.iter().filter(|(_, all)| !all.is_empty());
        named.map(|(kind, _)| *kind)
    }

    /// The plugin of a kind that a phase, wall or body of a name chooses in its table: `rheology`, `mover`, `initial`, ….
    pub fn choice_in(&self, kind: &'static str, name: &str) -> Option<PluginChoice> {
        let (table, plugins) = match kind {
            "equation-of-state" => ("phase", &self.phase.get(name)?.equation_of_state),
            "rheology" => ("phase", &self.phase.get(name)?.rheology),
            "mover" => ("wall", &self.wall.get(name)?.mover),
            "open-boundary" => ("wall", &self.wall.get(name)?.open_boundary),
            "initial" => ("body", &self.body.get(name)?.initial),
            _ => return None,
        };
        let all = in_table(kind, plugins, &format!("{table}.{name}.{kind}"));
        all.into_iter().next()
    }

    /// The reference solution of a comparison, if it has one.
    pub fn solution(&self, reference: &str) -> Option<PluginChoice> {
        let given = self.reference.get(reference)?;
        let name = given.solution.clone()?;
        Some(solution(reference, name, given.parameters.clone()))
    }

    /// The zone of twice the ratio whose shape encloses that of a zone.
    pub fn around_zone(&self, zone: &Zone) -> Option<&String> {
        match self.dimension {
            2 => self.around_shape::<2>(zone),
            _ => self.around_shape::<3>(zone),
        }
    }

    fn around_shape<const D: usize>(&self, zone: &Zone) -> Option<&String> {
        let inner = zone.shape_in::<D>(self)?;
        let shape = |other: &Zone| other.shape_in::<D>(self);
        let encloses = |other: &Zone| shape(other).is_some_and(|s| s.encloses(&inner, 0.0));
        let twice = |other: &Zone| other.ratio == 2.0 * zone.ratio;
        let mut all = self.zone.iter();
        let found = all.find(|(_, other)| twice(other) && encloses(other));
        found.map(|(name, _)| name)
    }

    /// The table of a probe or gauge of a name: `probe` or `gauge`.
    pub fn table_of_probe(&self, name: &str) -> &'static str {
        let gauge = self.gauge.contains_key(name);
        if gauge { "gauge" } else { "probe" }
    }

    /// Probes and gauges: the name of each and its plugin.
    pub fn probes(&self) -> Vec<(String, PluginChoice)> {
        let mut all = probes("probe", &self.probe);
        all.extend(probes("gauge", &self.gauge));
        all.sort_by(|a, b| a.0.cmp(&b.0));
        all
    }
}
