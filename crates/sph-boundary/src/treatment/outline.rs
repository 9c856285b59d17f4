//! Common parts of all wall treatments: the mesh, the conditions, the motion, the checks.

use std::collections::BTreeMap;

use sph_core::bed::Bed;
use sph_core::{Erodible, FrictionForm, Vect};
use sph_kernels::Sampler;
use sph_neighbours::{
    Coulomb, Domain, Elements, Frame, FreeBody, LinePull, WallForce, WallPoints, WallSet,
};

use crate::geometry::mesh::bed_of;
use crate::geometry::walls::cover::Cover;
use crate::treatment::contract::{groups, is_piece};
use crate::{
    BoundaryError, Movement, Node, PeriodicBox, Pose, Result, RigidState, WallMesh, WallSetup,
    WallSpec,
};

/// Most periods that walls may reach across: images are counted in a byte.
const MOST_PERIODS: f64 = 100.0;
/// Range of queries, over the support: also those of filling and of a generous skin.
const FARTHEST: f64 = 2.0;

/// The walls of a scene as a mesh, with the keys of each in the scene.
#[derive(Debug)]
pub(crate) struct Outline<const D: usize, M: WallMesh<D>> {
    pub mesh: M,
    pub support: f64,
    pub now: Placement<D>,
    /// That of the last build of the lists.
    pub listed: Placement<D>,
    /// True if `listed` is that of a build in an earlier process, not compared yet.
    pub put_back: bool,
    /// Walls with the same number move together.
    pub groups: Vec<usize>,
    /// Distances at which walls begin to push, of those that are drawn nearer to each other than others, m.
    pub gaps: BTreeMap<[usize; 2], f64>,
    pub spacing: f64,
    /// Distance beyond which nothing of the kernel counts, m.
    pub far_sight: f64,
    pub domain: Domain<D>,
    /// Forces on walls by stopped particles in the last drift.
    pub struck: Vec<WallForce<D>>,
    pub bodies: Vec<FreeBody<D>>,
    pub moved: u64,
    cover: Cover<D>,
    pub specs: Vec<WallSpec<D>>,
}

/// States of all walls, and the beds that some of them follow.
#[derive(Clone, Debug)]
pub(crate) struct Placement<const D: usize> {
    pub states: Vec<RigidState<D>>,
    pub beds: Vec<Bed>,
}

impl<const D: usize, M: WallMesh<D>> Outline<D, M> {
    /// Meshes the walls by elements of a size, m.
    pub fn new(setup: &WallSetup<'_, D>, support: f64, size: f64) -> Result<Self> {
        let whole = (0..setup.walls.len()).filter(|k| !is_piece(setup.walls, *k));
        for spec in whole.map(|k| &setup.walls[k]) {
            let sound = spec.erodible.iter().all(Erodible::is_sound);
            if !(spec.motion.is_sound() && sound) {
                return Err(BoundaryError::motion(spec.drawing.name()));
            }
            let slip = spec.condition.slip_length();
            if !(slip >= 0.0 && slip.is_finite()) {
                return Err(BoundaryError::not_positive("slip length", slip));
            }
        }
        let reach = FARTHEST * support;
        let domain = PeriodicBox::from_domain(setup.domain);
        domain.check()?;
        for spec in setup.walls {
            let periods = domain.periods_to(spec.drawing.points().into_iter());
            if periods > MOST_PERIODS {
                let why = format!(
                    "reaches {periods:.1e} periods from the periodic box, more than {MOST_PERIODS}: draw one period \
                     of it"
                );
                return Err(BoundaryError::unfit(spec.drawing.name(), why));
            }
        }
        let start = |spec: &WallSpec<D>| match &spec.mover {
            Some(mover) => mover.start(),
            None => spec.motion.state(0.0),
        };
        let mesh = M::build(setup.walls, size, reach, &domain)?;
        let now = Placement {
            states: setup.walls.iter().map(start).collect(),
            beds: mesh.walls().mesh.beds.clone(),
        };
        let mut outline = Outline {
            mesh,
            support,
            listed: now.clone(),
            now,
            put_back: false,
            groups: groups(setup.walls),
            gaps: BTreeMap::new(),
            spacing: setup.spacing,
            far_sight: far_sight::<D>(&*setup.kernel.sampler(D, setup.smoothing_length)),
            domain: setup.domain.clone(),
            struck: Vec::new(),
            bodies: Vec::new(),
            moved: 0,
            cover: Cover::default(),
            specs: setup.walls.to_vec(),
        };
        let poses = poses(&outline.now.states);
        if poses.iter().any(|pose| *pose != Pose::default()) {
            outline.mesh.move_walls(&poses)?;
        }
        outline.gaps = outline.drawn_gaps();
        outline.bodies = outline.bodies_at(0.0);
        Ok(outline)
    }

    pub fn name(&self, wall: usize) -> String {
        self.specs[wall].drawing.name().to_string()
    }

    /// Velocity and acceleration of the wall: its motion and the velocity of its surface.
    pub fn movement(&self, wall: usize, point: &Vect<D>) -> Movement<D> {
        self.movement_in(&self.now.states[wall], wall, point)
    }

    /// The same of a wall in another state.
    pub fn movement_in(&self, state: &RigidState<D>, wall: usize, point: &Vect<D>) -> Movement<D> {
        let mut movement = state.movement((*point).into());
        let spec = &self.specs[wall];
        let moment = state.pose.moment;
        spec.motion
            .add_bending(&mut movement, (*point).into(), moment);
        if let Some(bed) = bed_of(&self.now.beds, wall) {
            movement.velocity[D - 1] += bed.rate_of(&(*point).into());
        }
        movement.velocity += spec.surface_velocity;
        movement
    }

    pub fn maps(&self) -> Vec<impl Fn([f64; D]) -> [f64; D] + use<'_, D, M>> {
        let walls = self.specs.iter().zip(&self.now.states).enumerate();
        let map = |(k, (spec, state)): (usize, (&WallSpec<D>, &RigidState<D>))| {
            spec.motion.map(&state.pose, bed_of(&self.now.beds, k))
        };
        walls.map(map).collect()
    }

    pub fn bends(&self) -> bool {
        self.specs.iter().any(|s| s.motion.bends())
    }

    pub fn moves(&self) -> bool {
        let moves = |s: &WallSpec<D>| s.motion.moves() || s.mover.is_some();
        self.specs.iter().any(moves)
    }

    /// Shares of the nodes of which walls that move otherwise may take a part.
    pub fn covered(&mut self) -> Vec<(usize, f64)> {
        if self.groups.iter().all(|g| *g == self.groups[0]) {
            return Vec::new();
        }
        let visible = self.cover.shares(&self.mesh, &self.groups, self.spacing);
        let nodes = self.mesh.nodes();
        let share = |(v, part): (usize, f64)| (v, part * nodes[v].theta * nodes[v].size);
        visible.into_iter().map(share).collect()
    }

    pub fn frames(&self) -> Vec<Frame<D>> {
        if !self.moves() {
            return Vec::new();
        }
        let none = [f64::INFINITY, f64::NEG_INFINITY].map(Vect::<D>::repeat);
        let mut boxes = vec![none; self.now.states.len()];
        if self.domain.periodic.contains(&true) {
            for node in self.mesh.nodes() {
                let ([low, high], place) = (&mut boxes[node.wall], node.position.into());
                (*low, *high) = (low.inf(&place), high.sup(&place));
            }
        }
        let round = |[low, high]: [Vect<D>; 2]| {
            Vect::from_fn(|k, _| {
                let (length, middle) = (self.domain.length(k), 0.5 * (low[k] + high[k]));
                match self.domain.periodic[k] && middle.is_finite() {
                    true => ((middle - self.domain.lower[k]) / length).floor() * length,
                    false => 0.0,
                }
            })
        };
        let frame = |(state, all): (&RigidState<D>, [Vect<D>; 2])| Frame {
            rotation: state.pose.rotation,
            offset: state.pose.map()([0.0; D]).into(),
            round: round(all),
        };
        self.now.states.iter().zip(boxes).map(frame).collect()
    }

    /// A place of a wall as others see it, in the box, and the movement of the wall there.
    pub fn seen(&self, walls: &WallSet<D>, wall: usize, place: Vect<D>) -> (Vect<D>, Movement<D>) {
        let frame = walls.frames.get(wall);
        let seen = frame.map_or(place, |frame| place - frame.round);
        (seen, self.movement(wall, &place))
    }

    /// Puts a wall point at a place of its wall.
    pub fn put_point(&self, walls: &mut WallSet<D>, point: usize, wall: usize, place: Vect<D>) {
        let (seen, movement) = self.seen(walls, wall, place);
        let points = &mut walls.points;
        points.position[point] = seen;
        points.velocity[point] = movement.velocity;
        if let Some(acceleration) = points.acceleration.get_mut(point) {
            *acceleration = movement.acceleration;
        }
    }

    /// Forces of the lines of movers on their walls.
    pub fn pulls(&self) -> Vec<LinePull<D>> {
        let walls = self.specs.iter().zip(&self.now.states).enumerate();
        let of_wall = |(wall, (spec, state)): (usize, (&WallSpec<D>, &RigidState<D>))| {
            let pulls = spec.mover.as_ref().map(|m| m.pulls(state));
            let wall = wall as u32;
            let pull = move |(force, anchor)| LinePull {
                wall,
                force,
                anchor,
            };
            pulls.into_iter().flatten().map(pull)
        };
        walls.flat_map(of_wall).collect()
    }

    /// Writes frames, bodies, beds and the pulls of lines as they are.
    pub fn write(&self, walls: &mut WallSet<D>) {
        walls.frames = self.frames();
        walls.pulls = self.pulls();
        walls.bodies.clone_from(&self.bodies);
        walls.beds.clone_from(&self.now.beds);
    }

    pub fn slips(&self) -> bool {
        self.specs.iter().any(|s| s.condition.slip_length() > 0.0)
    }

    pub fn clearance(&self, point: &Vect<D>, within: f64) -> Option<(f64, &str)> {
        let (distance, wall) = self.mesh.nearest(point, within)?;
        Some((distance, self.mesh.names()[wall].as_str()))
    }

    /// Points of walls without fluid around, each with its wall, place, share of a particle and velocity.
    pub fn points_at(
        &self,
        all: impl Iterator<Item = (usize, Vect<D>, f64, Vect<D>)>,
    ) -> WallPoints<D> {
        let mut points = WallPoints::default();
        for (wall, place, share, velocity) in all {
            points.position.push(place);
            points.share.push(share);
            points.velocity.push(velocity);
            points.viscous_velocity.push(velocity);
            let condition = &self.specs[wall].condition;
            points.friction_factor.push(condition.friction_factor());
            points.wall.push(wall as u32);
        }
        let count = points.position.len();
        points.volume = vec![self.spacing.powi(D as i32); count];
        points.pressure = vec![0.0; count];
        if self.moves() {
            points.acceleration = vec![Vect::zeros(); count];
        }
        points
    }

    /// The nodes as wall points, at rest without fluid around.
    pub fn points(&self) -> WallPoints<D> {
        let nodes = || self.mesh.nodes().iter();
        let share = |n: &Node<D>| n.theta * n.size;
        let at_rest = nodes().map(|n| (n.wall, n.position.into(), share(n), Vect::zeros()));
        let mut points = self.points_at(at_rest);
        if self.slips() {
            let lengths = nodes().map(|n| self.specs[n.wall].condition.slip_length());
            points.slip = lengths.zip(self.mesh.normals()).collect();
        }
        points
    }

    /// The elements, at rest without fluid around.
    pub fn elements(&self) -> Elements<D> {
        let mut elements = Elements::default();
        let slips = self.slips();
        let rubs = |s: &WallSpec<D>| s.condition.friction_coefficient > Some(0.0);
        let rubs = self.specs.iter().any(rubs);
        for element in self.mesh.elements() {
            let condition = &self.specs[element.wall].condition;
            elements.centre.push(element.centre.into());
            elements.normal.push(element.normal.into());
            elements.measure.push(element.measure);
            elements.friction_factor.push(condition.friction_factor());
            elements.wall.push(element.wall as u32);
            elements.corners.push(element.nodes.map(|n| n as u32));
            if slips {
                elements.slip.push(condition.slip_length());
            }
            if rubs {
                elements.coulomb.push(Coulomb {
                    coefficient: condition.friction_coefficient.unwrap_or(0.0),
                    literal: condition.friction_form == Some(FrictionForm::Literal),
                });
            }
        }
        let count = elements.centre.len();
        elements.velocity = vec![Vect::zeros(); count];
        elements.volume = vec![self.spacing.powi(D as i32); count];
        elements.pressure = vec![0.0; count];
        if self.moves() {
            elements.acceleration = vec![Vect::zeros(); count];
            if D == 3 {
                elements.turning = vec![[Vect::zeros(); D]; count];
            }
        }
        elements
    }
}

pub(crate) fn poses<const D: usize>(states: &[RigidState<D>]) -> Vec<Pose<D>> {
    states.iter().map(|state| state.pose).collect()
}

/// Share of a particle's kernel that may be behind a wall.
const SEEN: f64 = 0.01;
/// Steps of integrals over the kernel.
const STEPS: u32 = 400;

/// Distance of a plane beyond which less than [`SEEN`] of the kernel lies, m.
///
/// In two dimensions 2r acos(d/r), in three 2πr(r − d) of the circle or sphere of radius r is beyond the distance d.
pub(crate) fn far_sight<const D: usize>(kernel: &dyn Sampler) -> f64 {
    let radius = kernel.support_radius();
    let beyond = |d: f64| -> f64 {
        let width = (radius - d) / f64::from(STEPS);
        let part = |k: u32| {
            let r = d + (f64::from(k) + 0.5) * width;
            let cap = match D {
                2 => 2.0 * r * (d / r).acos(),
                _ => std::f64::consts::TAU * r * (r - d),
            };
            kernel.at(r).0 * cap * width
        };
        (0..STEPS).map(part).sum()
    };
    let (mut near, mut far) = (0.0, radius);
    for _ in 0..40 {
        let middle = 0.5 * (near + far);
        match beyond(middle) > SEEN {
            true => near = middle,
            false => far = middle,
        }
    }
    far
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Wendland C2 in the plane: the share beyond a line at q = d/h, by quadrature of its marginal density.
    #[test]
    fn a_hundredth_of_the_kernel_is_beyond_the_far_sight() {
        let (h, kernel) = (0.5, sph_kernels::wendland_c2());
        let sampler = sph_kernels::Kernel::sampler(&kernel, 2, h);
        let far = far_sight::<2>(&*sampler);
        let n = 400;
        let step = 2.0 * h / f64::from(n);
        let mut beyond = 0.0;
        for i in 0..n {
            for j in -n..n {
                let [x, y] = [i, j].map(|k| (f64::from(k) + 0.5) * step);
                let w = sampler.at(x.hypot(y)).0;
                beyond += if x > far { w * step * step } else { 0.0 };
            }
        }
        assert!((beyond / SEEN - 1.0).abs() < 0.03, "{beyond} beyond {far}");
    }
}
