//! Box, kernel, walls and places of a scene: the world before it has columns.

use sph_boundary::{BoundaryError, ThinWall, Wall, WallEntry, WallSetup};
use sph_contribution::Plugins;
use sph_core::fields::SCALE;
use sph_core::plausible::Quantity;
use sph_core::{Contract, Store, comma_list};
use sph_multiphase::Formulation;
use sph_neighbours::{WallSet, World};
use sph_scene::Scene;
use sph_solver::SolverError;
use sph_solver::setup::Choices;

use crate::setup::domain::{check_periods, domain_of};
use crate::setup::leaks::{Leak, leaks};
use crate::setup::placement::{PlacedParticles, place};
use crate::setup::shapes::Drawn;
use crate::setup::share::Share;

/// Skin of the neighbour lists as a share of the support radius, for scenes that give none.
pub(crate) const SKIN: f64 = 0.1;

/// The room in which particles will move, and where they begin.
pub(crate) struct InitialWorld<const D: usize> {
    /// Without columns.
    pub world: World<D>,
    pub walls: Option<Box<dyn Wall<D>>>,
    pub placed: PlacedParticles<D>,
    /// Walls behind which fluid can get.
    pub leaks: Vec<Leak<D>>,
    pub warnings: Vec<String>,
}

impl<const D: usize> InitialWorld<D> {
    /// The room of a share of a flow: builds the walls and fills the bodies, and takes the wall plugin out of the choices.
    /// Among walls that stand already there is no particle.
    pub fn for_share(
        scene: &Scene,
        drawn: &Drawn<D>,
        choices: &mut Choices<D>,
        share: &mut Share<D>,
    ) -> Result<Self, SolverError> {
        let mut world = empty(scene, drawn, choices)?;
        if let Share::Columns(standing) = share {
            choices.walls = None;
            let walls = standing.take().map(|standing| {
                let (walls, set) = *standing;
                world.walls = set;
                walls
            });
            return Ok(InitialWorld {
                world,
                walls,
                placed: PlacedParticles::default(),
                leaks: Vec::new(),
                warnings: Vec::new(),
            });
        }
        let mut warnings = scene.remarks.clone();
        let build = |walls: &mut dyn Wall<D>, world: &World<D>| {
            let setup = WallSetup {
                walls: &drawn.walls,
                spacing: scene.numerics.spacing,
                smoothing_length: world.kernel.smoothing_length(),
                kernel: &*choices.kernel,
                domain: &world.domain,
            };
            let built = walls.build(&setup);
            built.map_err(|e| wall_problem(scene, &e))
        };
        if let Some(walls) = &mut choices.walls {
            check_scaling(scene, &**walls, &*choices.formulation)?;
            world.walls = build(&mut **walls, &world)?;
            warnings.extend(walls.warnings());
        }
        let placed = place(scene, &drawn.regions, choices.walls.as_deref())?;
        warnings.extend(placed.warnings.iter().cloned());
        if let Some(walls) = &choices.walls {
            let ends = walls.check_free_ends(&placed.positions);
            ends.map_err(|e| wall_problem(scene, &e))?;
            warnings.extend(thin_walls(scene, walls.thin_walls(&placed.positions))?);
        }
        let mut elements = None;
        if world.walls.elements.corners.is_empty() && !drawn.walls.is_empty() {
            // As the default treatment cuts the walls, for a treatment without elements; nothing where it refuses them.
            let plugins = Plugins::new(Vec::new(), Vec::new());
            let walls = plugins.one::<D, WallEntry>();
            elements = walls.and_then(|mut walls| build(&mut *walls, &world).ok());
        }
        let skins = elements.as_ref().unwrap_or(&world.walls);
        let leaks = leaks(scene, &world, skins, &placed.positions);
        warnings.extend(leaks.iter().map(|leak| leak.text.clone()));
        Ok(InitialWorld {
            leaks,
            world,
            walls: choices.walls.take(),
            placed,
            warnings,
        })
    }
}

/// A box with a kernel and nothing in it.
fn empty<const D: usize>(
    scene: &Scene,
    drawn: &Drawn<D>,
    choices: &Choices<D>,
) -> Result<World<D>, SolverError> {
    let spacing = scene.numerics.spacing;
    let h = scene.numerics.smoothing_ratio * spacing;
    let kernel = choices.kernel.sampler(D, h);
    let support = kernel.support_radius() / spacing;
    if let Some(why) = Quantity::refused("kernel support over the spacing", support) {
        return Err(SolverError::at("numerics.smoothing_ratio", why));
    }
    let skin = scene.numerics.skin.unwrap_or(SKIN);
    let domain = domain_of(scene, drawn);
    check_periods(&domain, kernel.support_radius() * (1.0 + skin))?;
    Ok(World {
        free: Store::new(0),
        walls: WallSet::default(),
        lists: Default::default(),
        domain,
        kernel,
        spacing,
        skin,
        gravity: scene.gravity::<D>(),
        steady_gravity: scene.gravity::<D>(),
        driving: scene.driving::<D>(),
        time: 0.0,
        dt: 0.0,
        transported: Vec::new(),
        extent: None,
        communicator: None,
    })
}

/// Refuses plugins that do not follow walls that scale the kernel.
fn check_scaling<const D: usize>(
    scene: &Scene,
    walls: &dyn Wall<D>,
    formulation: &dyn Formulation<D>,
) -> Result<(), SolverError> {
    if !walls.columns().contains(&SCALE.any()) {
        return Ok(());
    }
    let refused = match formulation.is_scaled() {
        true => scene.choice("pressure"),
        false => scene.choice("formulation"),
    };
    let Some(refused) = refused else {
        return Ok(());
    };
    let treatment = scene.choice("walls").map_or(String::new(), |c| c.path);
    let path = &refused.path;
    let why = format!(
        "`{path}` has sums that `{treatment}` does not scale: take {}",
        WallEntry::KIND.advice()
    );
    Err(SolverError::at(refused.path, why))
}

/// A refused wall, pointed at if its message names one of the scene's in backquotes.
fn wall_problem(scene: &Scene, error: &BoundaryError) -> SolverError {
    let text = error.to_string();
    let named = scene.wall.keys().find(|n| text.contains(&format!("`{n}`")));
    let path = named.map_or("wall".to_string(), |n| format!("wall.{n}"));
    SolverError::at(path, text)
}

/// Refuses walls that do not hide fluid on one side from fluid on the other; remarks on plates that have none there yet.
fn thin_walls<const D: usize>(
    scene: &Scene,
    thin: Vec<ThinWall<D>>,
) -> Result<Vec<String>, SolverError> {
    let told = |thin: &ThinWall<D>, what: &str| {
        let at = comma_list(thin.place.iter().map(|x| format!("{x:.4}")));
        // On the safe side of rounding.
        let (least, spacing) = (1.01 * thin.least, 0.99 * thin.spacing);
        format!(
            "the wall is {:.2e} m thick near ({at}), and {what} through it: make it {least:.2e} m thick or more, or \
             `numerics.spacing` {spacing:.2e} m or less",
            thin.thickness
        )
    };
    if let Some(thin) = thin.iter().find(|thin| thin.wet) {
        let why = told(thin, "the fluid on its two sides would feel each other");
        return Err(SolverError::at(format!("wall.{}", thin.wall), why));
    }
    let what = "fluid on its two sides would feel each other";
    let remark = |thin: &ThinWall<D>| format!("wall `{}`: {}", thin.wall, told(thin, what));
    let plate = |thin: &&ThinWall<D>| {
        let wall = scene.wall.get(&thin.wall);
        wall.is_some_and(|w| w.thickness.is_some())
    };
    Ok(thin.iter().filter(plate).map(remark).collect())
}
