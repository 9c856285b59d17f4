//! Box, kernel, walls and places of a scene: the world before it has columns.

use sph_boundary::{Wall, WallEntry};
use sph_contribution::Plugins;
use sph_core::Store;
use sph_core::plausible::Quantity;
use sph_neighbours::{WallSet, World};
use sph_scene::Scene;
use sph_solver::setup::Choices;
use sph_solver::{SolverError, defaults};

use crate::setup::domain::{check_periods, domain_of};
use crate::setup::leaks::{Leak, leaks};
use crate::setup::placement::{PlacedParticles, place};
use crate::setup::shapes::Drawn;
use crate::setup::share::{ExistingWalls, Share};
use crate::setup::walls::{build_walls, check_scaling, thin_walls, wall_problem};

/// The room in which particles will move, and where they begin.
pub(crate) struct InitialWorld<const D: usize> {
    /// Without columns.
    pub world: World<D>,
    /// The walls, if there are any.
    pub walls: Option<Box<dyn Wall<D>>>,
    /// Places and bodies of the particles.
    pub placed: PlacedParticles<D>,
    /// Walls behind which fluid can get.
    pub leaks: Vec<Leak<D>>,
    /// Remarks.
    pub warnings: Vec<String>,
}

impl<const D: usize> InitialWorld<D> {
    /// That of a share of a flow: [`among`](Self::among) walls that stand already, else [`of`](Self::from_scene) the scene.
    ///
    /// # Errors
    /// The key of the scene that is wrong.
    pub(crate) fn for_share(
        scene: &Scene,
        drawn: &Drawn<D>,
        choices: &mut Choices<D>,
        share: &mut Share<D>,
    ) -> Result<Self, SolverError> {
        match share {
            Share::Columns(standing) => InitialWorld::among(scene, drawn, choices, standing.take()),
            _ => InitialWorld::from_scene(scene, drawn, choices),
        }
    }

    /// Builds the walls and fills the bodies; takes the wall plugin out of the choices.
    ///
    /// # Errors
    /// The key of the scene that is wrong.
    pub fn from_scene(
        scene: &Scene,
        drawn: &Drawn<D>,
        choices: &mut Choices<D>,
    ) -> Result<Self, SolverError> {
        let mut world = empty(scene, drawn, choices)?;
        let h = world.kernel.smoothing_length();
        let mut warnings = scene.remarks.clone();
        if let Some(walls) = &mut choices.walls {
            check_scaling(scene, &**walls, &*choices.formulation)?;
            let shape = &*choices.kernel;
            let domain = &world.domain;
            world.walls = build_walls(scene, &drawn.walls, &mut **walls, shape, domain, h)?;
            warnings.extend(walls.warnings());
        }
        let placed = place(scene, &drawn.regions, choices.walls.as_deref());
        let placed = placed.map_err(SolverError::Scene)?;
        warnings.extend(placed.warnings.iter().cloned());
        if let Some(walls) = &choices.walls {
            let ends = walls.check_free_ends(&placed.positions);
            ends.map_err(|e| wall_problem(scene, &e))?;
            warnings.extend(thin_walls(scene, walls.thin_walls(&placed.positions))?);
        }
        let elements = match world.walls.elements.corners.is_empty() && !drawn.walls.is_empty() {
            true => with_elements(scene, drawn, &world, choices, h),
            false => None,
        };
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

    /// The same among walls that stand already, without a particle.
    ///
    /// # Errors
    /// The key of the scene that is wrong.
    pub(crate) fn among(
        scene: &Scene,
        drawn: &Drawn<D>,
        choices: &mut Choices<D>,
        standing: Option<Box<ExistingWalls<D>>>,
    ) -> Result<Self, SolverError> {
        let mut world = empty(scene, drawn, choices)?;
        choices.walls = None;
        let walls = standing.map(|standing| {
            let (walls, set) = *standing;
            world.walls = set;
            walls
        });
        Ok(InitialWorld {
            world,
            walls,
            placed: PlacedParticles {
                positions: Vec::new(),
                body: Vec::new(),
                warnings: Vec::new(),
            },
            leaks: Vec::new(),
            warnings: Vec::new(),
        })
    }
}

/// The walls as the default treatment cuts them into elements, for a treatment that has none; nothing where it refuses them.
fn with_elements<const D: usize>(
    scene: &Scene,
    drawn: &Drawn<D>,
    world: &World<D>,
    choices: &Choices<D>,
    h: f64,
) -> Option<WallSet<D>> {
    let nothing_named = Plugins::new(Vec::new(), Vec::new());
    let mut walls = nothing_named.one::<D, WallEntry>()?;
    let kernel = &*choices.kernel;
    build_walls(scene, &drawn.walls, &mut *walls, kernel, &world.domain, h).ok()
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
    let skin = scene.numerics.skin.unwrap_or(defaults::SKIN);
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
