//! The contract of wall treatments.

use std::ops::Range;
use std::sync::Arc;

use sph_core::{
    AnyField, Erodible, FlowNature, StepError, SuitedPlugin, Vect, WallCondition, Work, contract,
};
use sph_kernels::Kernel;
use sph_neighbours::{DepthGauge, Domain, WallSet, World};

use crate::{Drawing, Mover, Result, RigidMotion};

/// One named wall; a wall drawn in several pieces is several of these with one name.
#[derive(Clone, Debug)]
pub struct WallSpec<const D: usize> {
    /// Its line or surface; the name is the wall's.
    pub drawing: Drawing,
    /// Condition of the fluid at the wall.
    pub condition: WallCondition,
    /// Velocity of the surface where the wall itself stays (a belt), m/s.
    pub surface_velocity: Vect<D>,
    /// Motion of the wall.
    pub motion: RigidMotion<D>,
    /// Its grains, if its surface is a bed: with a cell and a height to stretch.
    pub erodible: Option<Erodible>,
    /// Its mover, with the force of the fluid.
    pub mover: Option<Arc<dyn Mover<D>>>,
    /// True if fluid passes it: it stops no particle.
    pub open: bool,
}

impl<const D: usize> WallSpec<D> {
    /// A wall that stays, and to which the fluid sticks.
    pub fn at_rest(drawing: Drawing) -> Self {
        WallSpec {
            drawing,
            condition: WallCondition::default(),
            surface_velocity: Vect::zeros(),
            motion: RigidMotion::default(),
            erodible: None,
            mover: None,
            open: false,
        }
    }
}

/// Input of a wall treatment.
pub struct WallSetup<'a, const D: usize> {
    /// The walls of the scene.
    pub walls: &'a [WallSpec<D>],
    /// Particle spacing δr, m.
    pub spacing: f64,
    /// Smoothing length h, m.
    pub smoothing_length: f64,
    /// The kernel's shape.
    pub kernel: &'a dyn Kernel,
    /// The box with its periodic directions.
    pub domain: &'a Domain<D>,
}

/// States of the walls that movers move, as plain numbers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WallStates {
    /// Of now.
    pub now: Vec<f64>,
    /// Of the last build of the neighbour lists, for which the elements near particles were looked up; none if the lists
    /// are built anew.
    pub listed: Option<Vec<f64>>,
}

/// A wall so thin that the fluid on one side is within reach of that on the other.
#[derive(Clone, Debug)]
pub struct ThinWall<const D: usize> {
    /// Its name.
    pub wall: String,
    /// Its thinnest place, m.
    pub place: Vect<D>,
    /// Thickness there, m.
    pub thickness: f64,
    /// Thickness that would do, m.
    pub least: f64,
    /// Particle spacing at which it would do as it is, m.
    pub spacing: f64,
    /// True if there is fluid on both sides.
    pub wet: bool,
}

/// The shape of all walls of a scene; for checks and pictures, not for inner loops.
pub trait WallShape<const D: usize> {
    /// True if a point is on the fluid's side of all walls.
    fn contains(&self, point: &Vect<D>) -> bool;

    /// Winding number of walls with free ends around a point, positive where they face it; none of closed walls.
    fn enclosed(&self, point: &Vect<D>) -> Option<f64>;

    /// Distance of a point from the nearest wall, m, and that wall's name, if nearer than `within`.
    fn clearance(&self, point: &Vect<D>, within: f64) -> Option<(f64, &str)>;

    /// True if any wall ends freely: particles that pass its end are outside.
    fn ends_freely(&self) -> bool;

    /// Refuses points near the free end of an open wall.
    ///
    /// # Errors
    /// Names the wall and the end.
    fn check_free_ends(&self, points: &[Vect<D>]) -> Result<()>;

    /// The thinnest place of every wall that does not hide fluid on one side from fluid on the other; wet ones first.
    fn thin_walls(&self, points: &[Vect<D>]) -> Vec<ThinWall<D>>;

    /// Remarks on the walls.
    fn warnings(&self) -> Vec<String>;
}

/// The motion of all walls of a scene.
pub trait WallMotion<const D: usize> {
    /// Moves all walls from a time on by `dt`; movers get the [forces](WallSet::forces) that were measured last.
    ///
    /// # Errors
    /// If a wall cannot follow.
    fn advance(
        &mut self,
        walls: &mut WallSet<D>,
        gravity: Vect<D>,
        time: f64,
        dt: f64,
    ) -> Result<()>;

    /// True if the mover of a wall, by its number, needs forces.
    fn needs_forces(&self, wall: usize) -> bool;

    /// Gauges of the depth before walls with movers, by the numbers of these.
    fn depth_gauges(&self) -> Vec<(usize, DepthGauge<D>)>;

    /// [Numbers](crate::RigidState::numbers) of all walls with movers, one after the other.
    fn states(&self) -> WallStates;

    /// Puts all walls back where they were at a time.
    ///
    /// # Errors
    /// If the states are not those of these walls, or a wall cannot follow.
    fn put_back(&mut self, walls: &mut WallSet<D>, states: &WallStates, time: f64) -> Result<()>;
}

/// A treatment of all walls of a scene.
pub trait Wall<const D: usize>: WallShape<D> + WallMotion<D> + Send + Sync {
    /// Distance of the first row of particles from a flat wall, in spacings beyond half a spacing: 0 for rows at 1, 2,
    /// 3 δr (the wall itself carries points), 0.5 for ½, 1½, ….
    fn lattice_offset(&self) -> f64;

    /// Sets up the walls at time 0.
    ///
    /// # Errors
    /// If a wall is refused; the message names it.
    fn build(&mut self, setup: &WallSetup<'_, D>) -> Result<WallSet<D>>;

    /// Columns of particles that [`geometry`](Self::geometry) writes: γ, or s with its slope; none if the kernel is full.
    fn columns(&self) -> Vec<AnyField> {
        Vec::new()
    }

    /// Contacts and γ at the present positions; called after the lists are fresh.
    ///
    /// # Errors
    /// If a column is missing or a particle is where γ has no meaning.
    fn geometry(&mut self, world: &mut World<D>) -> Result<(), StepError>;

    /// Pressures, volumes and velocities of wall points and elements from the fluid's state.
    ///
    /// # Errors
    /// If a column is missing.
    fn state(&mut self, world: &mut World<D>) -> Result<(), StepError>;

    /// Corrects velocities that would carry particles through a wall within `dt`; called before every drift.
    ///
    /// # Errors
    /// If a column is missing.
    fn constrain(&mut self, world: &mut World<D>, dt: f64) -> Result<(), StepError>;
}

contract!(
    /// A wall treatment that a scene may name.
    pub WallEntry, "walls", One, "the treatment of all walls", Wall<D>,
    .by_default("usaw").suited(vertices).ordered(110).works(Work::Friction)
);

/// Vertices of semi-analytical walls: where the bodies are drawn for the half row that vertices carry.
fn vertices(flow: &FlowNature, named: Option<&str>) -> Option<SuitedPlugin> {
    let (parameters, reason) = match flow.half_rows {
        true => (
            "vertices = true",
            "bodies reach half a row beyond whole rows from the walls",
        ),
        false => (
            "vertices = false",
            "whole rows fit between the walls and the ends of the bodies",
        ),
    };
    let named = named.is_none_or(|name| name == "usaw");
    named.then_some(SuitedPlugin {
        name: "usaw",
        parameters,
        reason,
    })
}

/// For every wall the first one that moves as it does.
pub(crate) fn groups<const D: usize>(walls: &[WallSpec<D>]) -> Vec<usize> {
    let mut groups: Vec<usize> = Vec::with_capacity(walls.len());
    for (k, wall) in walls.iter().enumerate() {
        let first = match is_piece(walls, k) {
            true => groups[k - 1],
            false => {
                let prescribed = |w: &WallSpec<D>| w.mover.is_none();
                let as_it = |o: &WallSpec<D>| prescribed(o) && o.motion == wall.motion;
                let mut before = walls[..k].iter();
                let together = before.position(|o| prescribed(wall) && as_it(o));
                together.unwrap_or(k)
            }
        };
        groups.push(first);
    }
    groups
}

/// The pieces of a wall, by its first one.
pub(crate) fn pieces<const D: usize>(walls: &[WallSpec<D>], first: usize) -> Range<usize> {
    let more = (first + 1..walls.len()).take_while(|k| is_piece(walls, *k));
    first..first + 1 + more.count()
}

/// True if a wall is a further piece of the one before it, of which there may be thousands.
pub(crate) fn is_piece<const D: usize>(walls: &[WallSpec<D>], k: usize) -> bool {
    k > 0 && walls[k].drawing.name() == walls[k - 1].drawing.name()
}
