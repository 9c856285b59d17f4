//! What both wall treatments share: the mesh, the conditions, the motion, the checks.

use sph_core::Vect;
use sph_neighbours::Elements;

use crate::grid::distance_squared;
use crate::{BoundaryError, Condition, PeriodicBox, SegmentGrid, SegmentMesh, WallSetup, WallSpec};

/// The walls of a scene as segments, with what the scene says of each.
#[derive(Debug)]
pub(crate) struct Outline {
    pub mesh: SegmentMesh,
    pub grid: SegmentGrid,
    pub reach: f64,
    pub support: f64,
    specs: Vec<WallSpec<2>>,
}

impl Outline {
    pub fn new(setup: &WallSetup<'_, 2>, support: f64) -> Result<Self, BoundaryError> {
        let lines: Vec<_> = setup.walls.iter().map(|w| w.polyline.clone()).collect();
        let domain = PeriodicBox {
            lower: setup.domain.lower.into(),
            upper: setup.domain.upper.into(),
            periodic: setup.domain.periodic,
        };
        let mesh = SegmentMesh::build(&lines, setup.spacing, &domain)?;
        // Twice the support also serves the queries of filling and of a generous skin.
        let reach = 2.0 * support;
        Ok(Outline {
            grid: SegmentGrid::build(&mesh, reach),
            mesh,
            reach,
            support,
            specs: setup.walls.to_vec(),
        })
    }

    /// Velocity of the wall, m/s: its motion and that of its surface.
    pub fn velocity(&self, wall: usize, point: [f64; 2], time: f64) -> Vect<2> {
        let spec = &self.specs[wall];
        Vect::from(spec.motion.velocity_at(point, time)) + spec.surface_velocity
    }

    /// 1 where the wall rubs, 0 where it slips freely.
    pub fn grip(&self, wall: usize) -> f64 {
        match self.specs[wall].condition {
            Condition::NoSlip => 1.0,
            Condition::FreeSlip => 0.0,
        }
    }

    /// Whether any wall ever moves.
    pub fn moves(&self) -> bool {
        self.specs.iter().any(|s| s.motion.moves())
    }

    /// Moves the mesh; says whether anything moved.
    pub fn move_to(&mut self, time: f64) -> Result<bool, BoundaryError> {
        let poses: Vec<_> = self.specs.iter().map(|s| s.motion.pose(time)).collect();
        if poses == self.mesh.poses() {
            return Ok(false);
        }
        self.mesh.move_walls(&poses)?;
        self.grid = SegmentGrid::build(&self.mesh, self.reach);
        Ok(true)
    }

    /// Whether a point is on the fluid's side: of the nearest segment if a wall is near, else
    /// of all walls together. Open walls have no inside, but they have a front.
    pub fn contains(&self, point: &Vect<2>) -> bool {
        let point = [point[0], point[1]];
        let mut nearest = (f64::INFINITY, 0.0, 0.0);
        for near in self.grid.near(&self.mesh, point, self.reach) {
            let [start, end] = self.mesh.seen_from(point, near);
            let distance2 = distance_squared(start, end);
            let normal = self.mesh.segments()[near.segment].normal;
            let height = -(start[0] * normal[0] + start[1] * normal[1]);
            // Two segments at a corner are equally near; the one seen more from above decides.
            // Both faces of a plate of zero thickness are, too; the one seen from its front does.
            let same = (distance2 - nearest.0).abs() <= 1e-9 * distance2;
            let faces = (height + nearest.2).abs() <= 1e-9 * nearest.1;
            let decides = match (same, faces) {
                (true, true) => height > 0.0,
                (true, false) => height.abs() > nearest.1,
                (false, _) => distance2 < nearest.0,
            };
            if decides {
                nearest = (distance2, height.abs(), height);
            }
        }
        match nearest.0.is_finite() {
            true => nearest.2 >= 0.0,
            false => self.mesh.contains(point),
        }
    }

    pub fn clearance(&self, point: &Vect<2>, within: f64) -> Option<(f64, &str)> {
        let point = [point[0], point[1]];
        let within = within.min(self.reach);
        self.grid
            .near(&self.mesh, point, within)
            .map(|near| {
                let [start, end] = self.mesh.seen_from(point, near);
                (distance_squared(start, end), near.segment)
            })
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .map(|(d2, segment)| {
                let wall = self.mesh.segments()[segment].wall;
                (d2.sqrt(), self.mesh.walls()[wall].as_str())
            })
    }

    pub fn check_free_ends(&self, points: &[Vect<2>]) -> Result<(), BoundaryError> {
        if self.mesh.free_ends().is_empty() {
            return Ok(());
        }
        let points: Vec<[f64; 2]> = points.iter().map(|p| [p[0], p[1]]).collect();
        self.mesh.check_free_ends(&points, self.support)
    }

    /// Centres, normals, velocities and lengths of the segments at a time.
    pub fn elements(&self, time: f64, spacing: f64) -> Elements<2> {
        let mut elements = Elements::default();
        for segment in self.mesh.segments() {
            elements.centre.push(segment.centre.into());
            elements.normal.push(segment.normal.into());
            elements
                .velocity
                .push(self.velocity(segment.wall, segment.centre, time));
            elements.measure.push(segment.length);
            elements.volume.push(spacing * spacing);
            elements.pressure.push(0.0);
            elements.grip.push(self.grip(segment.wall));
            elements.wall.push(segment.wall as u32);
            elements.corners.push(segment.vertices.map(|v| v as u32));
        }
        elements
    }
}

/// The methods of [`Wall<2>`](crate::Wall) that ask nothing but the outline of the walls; the
/// plugin keeps it in `self.set_up`.
macro_rules! checks_by_outline {
    () => {
        fn contains(&self, point: &Vect<2>) -> bool {
            let set_up = self.set_up.as_ref();
            set_up.is_none_or(|s| s.outline.contains(point))
        }

        fn clearance(&self, point: &Vect<2>, within: f64) -> Option<(f64, &str)> {
            self.set_up.as_ref()?.outline.clearance(point, within)
        }

        fn check_free_ends(&self, points: &[Vect<2>]) -> Result<(), BoundaryError> {
            match &self.set_up {
                Some(set_up) => set_up.outline.check_free_ends(points),
                None => Ok(()),
            }
        }

        fn warnings(&self) -> Vec<String> {
            let set_up = self.set_up.as_ref();
            set_up.map_or(Vec::new(), |s| {
                let all = s.outline.mesh.warnings().iter();
                all.map(ToString::to_string).collect()
            })
        }
    };
}
pub(crate) use checks_by_outline;
