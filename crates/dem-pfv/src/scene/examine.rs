//! Parts and cost of a scene, without preparing its grains.

use serde::Serialize;

use crate::scene::columns::headings;
use crate::scene::error::DemError;
use crate::scene::forecast::{Cost, foreseen};
use crate::scene::names::{planes, surfaces};
use crate::scene::read::Loaded;
use crate::scene::summary::PluginInForce;
use crate::scene::tables::{Fluid, Plugins, Scene};

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
        walls: planes(scene),
        surfaces: surfaces(scene),
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
        let volume = 4.0 / 3.0 * std::f64::consts::PI * cube;
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
    let stable = match coupled {
        false => "contacts: Δt < 2/ω, ω a bound from the stiffness of all contacts of a grain",
        true => {
            "contacts and drag: λ Δt/2 + ω² Δt²/4 < 1, λ the largest eigenvalue of the drag by power iterations"
        }
    };
    let motion = "motion: no grain goes further than a tenth of its radius in a step";
    [stable, motion]
}

fn derived(scene: &Scene) -> Vec<(&'static str, f64, &'static str)> {
    let mut all = Vec::new();
    let density = scene.grains.density;
    let gravity = scene
        .grains
        .gravity
        .map(|g| g.iter().map(|x| x * x).sum::<f64>().sqrt());
    if let (Some(fluid), Some(g)) = (&scene.fluid, gravity) {
        let weight = (density - fluid.given.density) * g;
        all.push(("buoyant weight of a solid volume", weight, "N/m³"));
    }
    if let (Some(fluid), Some([small, _])) = (&scene.fluid, scene.grains.radius) {
        // Catalano 2012, Eq. (4.20): about a third of it is stable for narrow gradings.
        let step = std::f64::consts::PI * density * (2.0 * small).powi(2)
            / (1200.0 * fluid.given.viscosity);
        let name = "viscous step by (4.20), three to six times too long";
        all.push((name, step, "s"));
    }
    all
}
