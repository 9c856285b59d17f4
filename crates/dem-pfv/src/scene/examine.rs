//! Parts and cost of a scene, without preparing its grains.

use std::f64::consts::PI;

use serde::Serialize;
use serde_json::Value as Json;
use sph_core::bounds;

use crate::error::DEEPEST;
use crate::grains::{Grain, GrainSystem, Setup};
use crate::scene::{
    BOX, DemError, Fluid, Laws, Loaded, POURED, Plugins, Scene, from_file, headings, setup, volume,
};

/// Data of a scene before it runs.
#[derive(Clone, Debug, Serialize)]
pub struct Examination {
    /// Title.
    pub scene: String,
    /// Method of computation: always "grains".
    pub method: &'static str,
    /// Grains; as expected where the start decides.
    pub grains: Option<usize>,
    /// Their preparation.
    pub start: &'static str,
    /// Walls, those of the box first.
    pub walls: Vec<String>,
    /// Surfaces of triangles.
    pub surfaces: Vec<String>,
    /// True if a fluid fills the pores.
    pub coupled: bool,
    /// Kind, name and parameters of the plugins in force.
    pub plugins: Vec<PluginInForce>,
    /// Columns of the series with their units.
    pub columns: Vec<(String, String)>,
    /// Data per grain, with the bytes of each.
    pub memory: Vec<(&'static str, f64)>,
    /// Works of a step, in order.
    pub stages: Vec<&'static str>,
    /// Limiters of the step.
    pub limits: [&'static str; 2],
    /// Quantities that follow from the numbers of the scene: name, value, unit.
    pub derived: Vec<(&'static str, f64, &'static str)>,
    /// Lower bound of steps and run time.
    pub estimate: Cost,
    /// Remarks.
    pub warnings: Vec<String>,
}

/// Examines a scene.
///
/// # Errors
/// Files that are not there or hold no grains; runs that cannot end or cannot be right.
pub fn examine(loaded: &Loaded) -> Result<Examination, DemError> {
    loaded.check_files()?;
    let scene = &loaded.scene;
    let coupled = scene.fluid.is_some();
    let (estimate, warnings) = foreseen(loaded, count(scene))?;
    Ok(Examination {
        scene: scene.title.clone(),
        method: "grains",
        grains: count(scene).or(scene.start.file.as_ref().map(|_| estimate.grains)),
        start: start(scene),
        walls: scene.planes(),
        surfaces: scene.surfaces().map(|(name, _)| name.clone()).collect(),
        coupled,
        plugins: plugins(scene),
        columns: headings(scene),
        memory: memory(count(scene), coupled),
        stages: stages(scene.fluid.as_ref()),
        limits: limits(coupled),
        derived: derived(scene),
        estimate,
        warnings,
    })
}

fn count(scene: &Scene) -> Option<usize> {
    let lattice = scene.start.lattice.as_ref();
    let lattice = lattice.map(|l| l.count.iter().map(|n| *n as usize).product());
    let poured = || {
        let (rained, given) = (scene.start.rained.as_ref()?, scene.r#box.as_ref()?);
        let [small, large] = scene.grains.radius?;
        // Mean of r³ of radii that are even between two.
        let cube = 0.25 * (small + large) * (small * small + large * large);
        let area = (given.high[0] - given.low[0]) * (given.high[1] - given.low[1]);
        let volume = 4.0 / 3.0 * PI * cube;
        Some((0.6 * area * rained.height? / volume).round() as usize)
    };
    scene.grains.count.or(lattice).or_else(poured)
}

fn start(scene: &Scene) -> &'static str {
    let s = &scene.start;
    match (&s.cloud, &s.grown, &s.rained, &s.lattice) {
        (Some(_), ..) => "a cloud at random",
        (_, Some(_), ..) => "a cloud that grows in its box",
        (_, _, Some(_), _) => "a cloud that rains onto the floor",
        (.., Some(_)) => "a lattice",
        _ => "spheres from a file",
    }
}

/// Every contact law and conductance in force.
pub fn plugins(scene: &Scene) -> Vec<PluginInForce> {
    let law = |of: &str, plugins| ("contact-law", of.to_string(), plugins);
    let start = &scene.start;
    let mut tables = vec![
        law("grains", &scene.grains.contact),
        law("preparation", &start.contact),
        law("walls in the preparation", &start.wall_contact),
    ];
    tables.extend(scene.r#box.iter().map(|b| law("box", &b.contact)));
    let walls = scene.wall.iter();
    tables.extend(walls.map(|(name, wall)| law(&format!("wall {name}"), &wall.contact)));
    let none = Plugins::from([("hydraulic-radius".to_string(), toml::Table::new())]);
    tables.extend(scene.fluid.iter().map(|fluid| {
        let given = Some(&fluid.conductance).filter(|plugins| !plugins.is_empty());
        ("conductance", "throats".to_string(), given.unwrap_or(&none))
    }));
    let in_force = |(kind, of, plugins): (&str, String, &Plugins)| {
        let (name, table) = plugins.first_key_value()?;
        Some(PluginInForce {
            kind: kind.to_string(),
            of,
            name: name.clone(),
            parameters: serde_json::to_value(table).unwrap_or_default(),
        })
    };
    tables.into_iter().filter_map(in_force).collect()
}

/// Bytes per grain. Columns and contacts follow from their types; what belongs to cells was measured with packings of 1000
/// and 5000 grains: 5.7 cells a grain, and a factor that grows with the third root of the number of grains.
fn memory(grains: Option<usize>, coupled: bool) -> Vec<(&'static str, f64)> {
    let mut all = vec![
        ("columns of grains", COLUMNS),
        ("contacts and neighbours", CONTACTS),
    ];
    if coupled {
        let thousands = grains.unwrap_or(1000) as f64 / 1000.0;
        all.push(("pores and throats", PORES));
        all.push(("factor of the matrix", FACTOR * thousands.cbrt()));
    }
    all
}

/// Eleven vectors, a quaternion, three numbers and a flag.
const COLUMNS: f64 = 24.0 * 9.0 + 32.0 + 8.0 * 3.0 + 1.0;
/// Three to five pairs within the skin of 280 bytes each, and the lists of both grains.
const CONTACTS: f64 = 5.0 * 280.0 + 80.0;
/// 5.7 cells and 11.4 throats.
const PORES: f64 = 5.7 * 320.0 + 11.4 * 330.0;
/// 450 numbers with their rows in a packing of 1000.
const FACTOR: f64 = 450.0 * 12.0;

fn stages(fluid: Option<&Fluid>) -> Vec<&'static str> {
    let mut all = vec![
        "neighbours: a grid and a skin, made anew when a grain moved by half of it",
        "contacts: overlaps, forces by law, what is remembered of each",
        "sums: each grain adds its own contacts in the order of their numbers",
    ];
    if fluid.is_some() {
        all.push("pores: one pressure each, from the rates of their volumes; factor kept while the mesh lasts");
        all.push("fluid: forces of pressures and viscosity on grains and walls");
    }
    if fluid.is_some_and(|f| f.given.shear || f.given.lubrication.is_some()) {
        all.push("neighbours: shear across the faces between them, lubrication of their gaps");
    }
    all.push("motion: walls by their control, then velocities and positions by a leap-frog");
    if fluid.is_some() {
        all.push("volumes of pores; the mesh anew when the largest strain adds up");
    }
    all
}

fn limits(coupled: bool) -> [&'static str; 2] {
    let contacts = "contacts: Δt < 2/ω, ω a bound from the stiffness of all contacts of a grain";
    let drag = "contacts and drag: λ Δt/2 + ω² Δt²/4 < 1, λ the largest eigenvalue of the drag by power iterations";
    let motion = "motion: no grain goes further than a tenth of its radius in a step";
    [if coupled { drag } else { contacts }, motion]
}

fn derived(scene: &Scene) -> Vec<(&'static str, f64, &'static str)> {
    let mut all = Vec::new();
    let density = scene.grains.density;
    let size = |g: [f64; 3]| g.iter().map(|x| x * x).sum::<f64>().sqrt();
    let gravity = scene.grains.gravity.map(size);
    if let (Some(fluid), Some(g)) = (&scene.fluid, gravity) {
        let weight = (density - fluid.given.density) * g;
        all.push(("buoyant weight of a solid volume", weight, "N/m³"));
    }
    if let (Some(fluid), Some([small, _])) = (&scene.fluid, scene.grains.radius) {
        // Catalano 2012, Eq. (4.20): about a third of it is stable for narrow gradings.
        let step = PI * density * (2.0 * small).powi(2) / (1200.0 * fluid.given.viscosity);
        let name = "viscous step by (4.20), three to six times too long";
        all.push((name, step, "s"));
    }
    all
}

/// Time of a grain in a step on one core, s: a round number, since run times are lower bounds.
const SECONDS: f64 = 1e-6;
/// Longer runs are remarked upon, days.
const LONG: f64 = 30.0;

/// Lower bound of steps and run time.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Cost {
    /// Grains.
    pub grains: usize,
    /// Step of grains with one contact each, s; those of a packing are shorter.
    pub step: f64,
    /// Steps of this length.
    pub steps: f64,
    /// Time of these steps on one core, s.
    pub seconds: f64,
}

/// Lower bound of steps and run time, and remarks.
///
/// # Errors
/// Files that cannot be read, steps too short to move the clock, floors that do not carry a single grain.
pub fn foreseen(loaded: &Loaded, count: Option<usize>) -> Result<(Cost, Vec<String>), DemError> {
    let scene = &loaded.scene;
    let (grains, [small, large]) = match &scene.start.file {
        Some(file) => {
            let grains = from_file(loaded, file)?;
            let [[small], [large]] = bounds(grains.iter().map(|g| [g.radius]));
            (grains.len(), [small, large.max(0.0)])
        }
        None => (count.unwrap_or(1), radii(scene)),
    };
    carried(loaded, large)?;
    let end = scene.run.end;
    let step = scene.run.safety * stable(scene, small)?;
    if end + step == end {
        let message = format!(
            "steps of {step:.1e} s, which grains of {small:.1e} m bear, do not move a clock that stands near {end} s: \
             take larger grains, or a smaller `modulus`"
        );
        return Err(DemError::at("run.end", message));
    }
    let most = scene.run.max_steps.map_or(f64::INFINITY, |n| n as f64);
    let steps = (end / step).ceil().min(most);
    let seconds = SECONDS * grains as f64 * steps;
    let days = seconds / 86400.0;
    let remark = format!(
        "the run takes at least {steps:.1e} steps of {step:.1e} s, some {days:.0} days on one core: take larger \
         grains, a smaller `modulus` or an earlier `run.end`"
    );
    let remarks = (days > LONG).then_some(remark).into_iter().collect();
    let cost = Cost {
        grains,
        step,
        steps,
        seconds,
    };
    Ok((cost, remarks))
}

/// Smallest and largest radius, m; grains that grow are taken to fill their box to the porosity that they grow to.
fn radii(scene: &Scene) -> [f64; 2] {
    let radii = scene.grains.radius.unwrap_or_default();
    let (Some(grown), Some(given)) = (&scene.start.grown, &scene.r#box) else {
        return radii;
    };
    let room: f64 = (0..3).map(|k| given.high[k] - given.low[k]).product();
    let solid = (1.0 - grown.porosity.unwrap_or(POURED)) * room;
    let mean = 0.5 * volume(&radii) * scene.grains.count.unwrap_or(1) as f64;
    radii.map(|r| r * (solid / mean).cbrt())
}

/// The largest stable step (s) of a grain that touches another of its radius (m); in a fluid a third of (4.20) at the
/// most, which is stable for narrow gradings. Source: Catalano 2012, Eq. (4.20).
fn stable(scene: &Scene, radius: f64) -> Result<f64, DemError> {
    let density = scene.grains.density;
    let setup = Setup {
        grains: vec![Grain::new([0.0; 3], radius, density)],
        laws: Laws::from_scene(scene)?.all,
        ..Setup::default()
    };
    let told = |e| DemError::at("grains", e);
    let contacts = GrainSystem::new(setup).map_err(told)?.critical_step();
    let drag = |viscosity: f64| PI * density * (2.0 * radius).powi(2) / (3600.0 * viscosity);
    let fluid = scene.fluid.as_ref();
    Ok(contacts.min(fluid.map_or(f64::INFINITY, |f| drag(f.given.viscosity))))
}

/// Refuses a plane that a single grain of this radius (m) sinks into too deep by its buoyant weight:
///
/// ```text
/// ∫ k_n dδ from 0 to the deepest overlap < |g · n| (ρ_s − ρ_f) 4/3 π R³
/// ```
fn carried(loaded: &Loaded, radius: f64) -> Result<(), DemError> {
    let scene = &loaded.scene;
    let setup = setup(loaded, Vec::new(), Laws::from_scene(scene)?)?;
    let fluid = scene.fluid.as_ref().map_or(0.0, |f| f.given.density);
    let mass = (scene.grains.density - fluid) * volume(&[radius]);
    let deepest = DEEPEST * radius;
    for (wall, name) in setup.walls.iter().zip(scene.planes()) {
        let weight = -mass * setup.gravity.dot(&wall.normal);
        let law = &setup.laws[wall.law];
        let parts = 64;
        let depth = |k: i32| deepest * (f64::from(k) + 0.5) / f64::from(parts);
        let stiffness = |k| law.stiffness([radius, f64::INFINITY], depth(k)).normal;
        let mean = (0..parts).map(stiffness).sum::<f64>() / f64::from(parts);
        if weight > mean * deepest && !scene.wall.get(&name).is_some_and(|w| w.removed) {
            let message = format!(
                "a grain of {radius} m sinks into the wall `{name}` by more than {} of its radius under its weight of \
                 {weight:.3e} N: the contact law needs {:.1} times the `modulus`",
                DEEPEST,
                weight / (mean * deepest)
            );
            return Err(DemError::at(law_of(scene, &name), message));
        }
    }
    Ok(())
}

/// The table with the contact law of a plane.
fn law_of(scene: &Scene, name: &str) -> String {
    let own = scene.wall.get(name).filter(|w| !w.contact.is_empty());
    let of_box = scene.r#box.as_ref().filter(|b| !b.contact.is_empty());
    match (own, of_box) {
        (Some(_), _) => format!("wall.{name}.contact"),
        (None, Some(_)) if BOX.contains(&name) => "box.contact".into(),
        _ => "grains.contact".into(),
    }
}

/// A plugin and its parameters.
#[derive(Clone, Debug, Serialize)]
pub struct PluginInForce {
    /// Kind: "contact-law" or "conductance".
    pub kind: String,
    /// Owner of the plugin: "grains", "box", "wall top".
    pub of: String,
    /// Name.
    pub name: String,
    /// Parameters as the scene gives them, SI.
    pub parameters: Json,
}
