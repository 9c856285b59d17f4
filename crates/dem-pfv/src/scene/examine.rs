//! Parts and cost of a scene, without preparing its grains.

use serde::Serialize;

use crate::scene::columns::headings;
use crate::scene::error::DemError;
use crate::scene::forecast::{Cost, foreseen};
use crate::scene::laws::listing;
use crate::scene::names::{planes, surfaces};
use crate::scene::read::Loaded;
use crate::scene::summary::PluginInForce;
use crate::scene::tables::{Fluid, Scene};

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
    pub memory: Vec<(String, f64)>,
    /// Works of a step, in order.
    pub stages: Vec<String>,
    /// Limiters of the step.
    pub limits: Vec<String>,
    /// Quantities that follow from the numbers of the scene: name, value, unit.
    pub derived: Vec<(String, f64, String)>,
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
    let mut all = Vec::new();
    let mut add = |kind: &str, of: &str, given: Option<(String, serde_json::Value)>| {
        if let Some((name, parameters)) = given {
            all.push(PluginInForce {
                kind: kind.into(),
                of: of.into(),
                name,
                parameters,
            });
        }
    };
    add("contact-law", "grains", listing(&scene.grains.contact));
    add("contact-law", "preparation", listing(&scene.start.contact));
    let walls = listing(&scene.start.wall_contact);
    add("contact-law", "walls in the preparation", walls);
    if let Some(given) = &scene.r#box {
        add("contact-law", "box", listing(&given.contact));
    }
    for (name, wall) in &scene.wall {
        add(
            "contact-law",
            &format!("wall {name}"),
            listing(&wall.contact),
        );
    }
    if let Some(fluid) = &scene.fluid {
        let default = || Some(("hydraulic-radius".to_string(), serde_json::json!({})));
        add(
            "conductance",
            "throats",
            listing(&fluid.conductance).or_else(default),
        );
    }
    all
}

/// Bytes per grain. Columns and contacts follow from their types; what belongs to cells was measured with packings of 1000
/// and 5000 grains: 5.7 cells a grain, and a factor that grows with the third root of the number of grains.
fn memory(grains: Option<usize>, coupled: bool) -> Vec<(String, f64)> {
    let mut all = vec![
        ("columns of grains".to_string(), COLUMNS),
        ("contacts and neighbours".to_string(), CONTACTS),
    ];
    if coupled {
        let thousands = grains.unwrap_or(1000) as f64 / 1000.0;
        all.push(("pores and throats".to_string(), PORES));
        all.push((
            "factor of the matrix".to_string(),
            FACTOR * thousands.cbrt(),
        ));
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

fn stages(fluid: Option<&Fluid>) -> Vec<String> {
    let mut all = vec![
        "neighbours: a grid and a skin, made anew when a grain moved by half of it".to_string(),
        "contacts: overlaps, forces by law, what is remembered of each".to_string(),
        "sums: each grain adds its own contacts in the order of their numbers".to_string(),
    ];
    let edges = fluid.is_some_and(|f| f.given.shear || f.given.lubrication.is_some());
    if fluid.is_some() {
        all.push("pores: one pressure each, from the rates of their volumes; factor kept while the mesh lasts".into());
        all.push("fluid: forces of pressures and viscosity on grains and walls".into());
    }
    if edges {
        all.push(
            "neighbours: shear across the faces between them, lubrication of their gaps".into(),
        );
    }
    all.push("motion: walls by their control, then velocities and positions by a leap-frog".into());
    if fluid.is_some() {
        all.push("volumes of pores; the mesh anew when the largest strain adds up".into());
    }
    all
}

fn limits(coupled: bool) -> Vec<String> {
    let stable = match coupled {
        false => "contacts: Δt < 2/ω, ω a bound from the stiffness of all contacts of a grain",
        true => {
            "contacts and drag: λ Δt/2 + ω² Δt²/4 < 1, λ the largest eigenvalue of the drag by power iterations"
        }
    };
    let motion = "motion: no grain goes further than a tenth of its radius in a step";
    [stable, motion].map(String::from).to_vec()
}

fn derived(scene: &Scene) -> Vec<(String, f64, String)> {
    let mut all = Vec::new();
    let density = scene.grains.density;
    let gravity = scene
        .grains
        .gravity
        .map(|g| g.iter().map(|x| x * x).sum::<f64>().sqrt());
    if let (Some(fluid), Some(g)) = (&scene.fluid, gravity) {
        let weight = (density - fluid.given.density) * g;
        all.push((
            "buoyant weight of a solid volume".to_string(),
            weight,
            "N/m³".to_string(),
        ));
    }
    if let (Some(fluid), Some([small, _])) = (&scene.fluid, scene.grains.radius) {
        // Catalano 2012, Eq. (4.20): about a third of it is stable for narrow gradings.
        let step = std::f64::consts::PI * density * (2.0 * small).powi(2)
            / (1200.0 * fluid.given.viscosity);
        all.push((
            "viscous step by (4.20), three to six times too long".into(),
            step,
            "s".into(),
        ));
    }
    all
}
