//! From the drawn walls to those of the wall plugin.

use sph_boundary::{BoundaryError, ThinWall, Wall, WallSetup, WallSpec};
use sph_core::fields::SCALE;
use sph_kernels::Kernel;
use sph_multiphase::Formulation;
use sph_neighbours::{Domain, WallSet};
use sph_scene::Scene;
use sph_solver::SolverError;
use sph_solver::defaults::KNOWN_WALLS;

/// Refuses plugins that do not follow walls that scale the kernel.
///
/// # Errors
/// The key of the scene that does not.
pub fn check_scaling<const D: usize>(
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
    let why = format!("`{path}` has sums that `{treatment}` does not scale: take {KNOWN_WALLS}");
    Err(SolverError::at(refused.path, why))
}

/// Hands every drawn wall to the plugin; refusals point at the wall.
pub fn build_walls<const D: usize>(
    scene: &Scene,
    drawn: &[WallSpec<D>],
    walls: &mut dyn Wall<D>,
    kernel: &dyn Kernel,
    domain: &Domain<D>,
    h: f64,
) -> Result<WallSet<D>, SolverError> {
    let setup = WallSetup {
        walls: drawn,
        spacing: scene.numerics.spacing,
        smoothing_length: h,
        kernel,
        domain,
    };
    let built = walls.build(&setup);
    built.map_err(|e| wall_problem(scene, &e))
}

/// A refused wall, pointed at if its message names one of the scene's in backquotes.
pub fn wall_problem(scene: &Scene, error: &BoundaryError) -> SolverError {
    let text = error.to_string();
    let named = scene.wall.keys().find(|n| text.contains(&format!("`{n}`")));
    let path = named.map_or("wall".to_string(), |n| format!("wall.{n}"));
    SolverError::at(path, text)
}

/// Refuses walls that do not hide fluid on one side from fluid on the other; remarks on plates that have none there yet.
pub fn thin_walls<const D: usize>(
    scene: &Scene,
    thin: Vec<ThinWall<D>>,
) -> Result<Vec<String>, SolverError> {
    let told = |thin: &ThinWall<D>, what: &str| {
        let at: Vec<String> = thin.place.iter().map(|x| format!("{x:.4}")).collect();
        // On the safe side of rounding.
        let (least, spacing) = (1.01 * thin.least, 0.99 * thin.spacing);
        format!(
            "the wall is {:.2e} m thick near ({}), and {what} through it: make it {least:.2e} m thick or more, or \
             `numerics.spacing` {spacing:.2e} m or less",
            thin.thickness,
            at.join(", ")
        )
    };
    if let Some(thin) = thin.iter().find(|thin| thin.wet) {
        let what = "the fluid on its two sides would feel each other";
        return Err(SolverError::at(
            format!("wall.{}", thin.wall),
            told(thin, what),
        ));
    }
    let what = "fluid on its two sides would feel each other";
    let remark = |thin: &ThinWall<D>| format!("wall `{}`: {}", thin.wall, told(thin, what));
    let plate = |thin: &&ThinWall<D>| {
        scene
            .wall
            .get(&thin.wall)
            .is_some_and(|w| w.thickness.is_some())
    };
    Ok(thin.iter().filter(plate).map(remark).collect())
}
