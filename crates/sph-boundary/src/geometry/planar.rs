//! Walls in the plane: segments for the wall treatments.

use std::sync::OnceLock;

use sph_core::Vect;
use sph_kernels::PiecewisePolynomial;
use sph_neighbours::ContactBlock;

use crate::geometry::checks::check_points;
use crate::geometry::layers::layers;
use crate::geometry::meeting::bounding;
use crate::geometry::mesh::SAME_PLACE;
use crate::geometry::segment_distance::distance_squared;
use crate::geometry::shells::{Gammas, ShellSums, Shells};
use crate::geometry::touching::without_shared;
use crate::geometry::wall_mesh::{Hindrance, MeshElement, MeshPoint, WallMesh};
use crate::treatment::groups::groups;
use crate::{
    BoundaryError, Drawing, GammaSum, NearSegment, PeriodicBox, Polyline, Pose, Renormalisation2d,
    SeenSegment, Segment, SegmentBatch, SegmentGrid, SegmentMesh, Vertex, WallSpec,
};

/// Polylines cut into segments, with the grid that finds them.
#[derive(Debug)]
pub struct PlanarWalls {
    pub(crate) mesh: SegmentMesh,
    /// Of the present position, made when somebody asks.
    grid: OnceLock<SegmentGrid>,
    reach: f64,
    spacing: f64,
    names: Vec<String>,
    shells: Shells,
    /// The wall of every polyline of the mesh.
    pub(crate) wall_of: Vec<usize>,
}

impl PlanarWalls {
    fn grid(&self) -> &SegmentGrid {
        let make = || SegmentGrid::build(&self.mesh, self.reach);
        self.grid.get_or_init(make)
    }

    fn normal(&self, vertex: &Vertex) -> Vect<2> {
        let of = |s: Option<usize>| s.map_or(Vect::zeros(), |s| self.segment(s).normal.into());
        let sum: Vect<2> = of(vertex.previous) + of(vertex.next);
        sum.try_normalize(1e-9).unwrap_or_else(Vect::zeros)
    }

    fn segment(&self, index: usize) -> &Segment {
        &self.mesh.segments()[index]
    }

    /// Where a segment keeps a particle off.
    fn hindrance(
        &self,
        (x, behind): (&Vect<2>, &[(u32, u32)]),
        near: NearSegment,
        reach: f64,
    ) -> Option<Hindrance<2>> {
        let segment = self.segment(near.segment);
        let [start, end] = self.mesh.seen_from([x[0], x[1]], near).map(Vect::from);
        let shell = self.shells.of(near.segment);
        let turned = behind.iter().any(|(_, s)| *s == shell);
        let normal = Vect::from(segment.normal) * if turned { -1.0 } else { 1.0 };
        // Only from the fluid's side: the far face of a plate is none of its business.
        let height = -start.dot(&normal);
        if height <= 0.0 || height > reach {
            return None;
        }
        let along = end - start;
        let share = -start.dot(&along) / along.norm_squared();
        let nearest = start + along * share.clamp(0.0, 1.0);
        let plane = Hindrance {
            away: normal,
            distance: height,
            only_if: None,
            wall: self.wall_of[segment.wall],
            place: x + nearest,
            image: self.mesh.domain().shift(near.image).into(),
        };
        if (0.0..=1.0).contains(&share) {
            return Some(plane);
        }
        let distance = nearest.norm();
        let round = -nearest / distance;
        // Where the next segment at the vertex is nearer, it holds the particle back; the
        // vertex is no bump on a straight wall. In a corner this one's plane counts as well.
        let vertex = &self.mesh.vertices()[segment.vertices[usize::from(share > 1.0)]];
        let next = match share > 1.0 {
            true => vertex.next,
            false => vertex.previous,
        };
        let over_next = next.is_some_and(|s| {
            let ahead = -nearest.dot(&Vect::from(self.segment(s).tangent()));
            if share > 1.0 {
                ahead > 0.0
            } else {
                ahead < 0.0
            }
        });
        let theta = if turned {
            1.0 - vertex.theta
        } else {
            vertex.theta
        };
        match over_next {
            false => Some(Hindrance {
                away: round,
                distance,
                ..plane
            }),
            true if theta > 0.5 + 1e-9 => None,
            true => Some(Hindrance {
                only_if: Some((round, distance)),
                ..plane
            }),
        }
    }
}

impl WallMesh<2> for PlanarWalls {
    type Near = NearSegment;
    type Seen = SeenSegment;
    type Integrals = Renormalisation2d;
    type Room = SegmentBatch;

    fn build(
        walls: &[WallSpec<2>],
        spacing: f64,
        reach: f64,
        domain: &PeriodicBox<2>,
    ) -> Result<Self, BoundaryError> {
        let mut lines: Vec<Polyline> = Vec::new();
        for spec in walls {
            match &spec.drawing {
                Drawing::Line(line) => lines.push(line.clone()),
                Drawing::Surface(surface) => {
                    let wall = surface.name.clone();
                    return Err(BoundaryError::Dimension { wall, dimension: 2 });
                }
            }
        }
        for line in &lines {
            check_points(line)?;
        }
        let pieces = without_shared(&lines, &groups(walls), spacing)?;
        let (pieces, unseen) = bounding(pieces, &groups(walls), SAME_PLACE * spacing);
        let (wall_of, lines): (Vec<usize>, Vec<Polyline>) = pieces.into_iter().unzip();
        let mut mesh = SegmentMesh::build(&lines, spacing, domain)?;
        mesh.remark(unseen);
        mesh.bend_by(wall_of.iter().map(|w| walls[*w].motion.clone()).collect());
        let names = walls.iter().map(|w| w.drawing.name().to_string()).collect();
        let lines = mesh.segments().iter();
        let lines = lines.map(|s| (s.vertices, walls[wall_of[s.wall]].open));
        let free = mesh.free_ends().iter().map(|end| end.vertex);
        Ok(PlanarWalls {
            shells: Shells::new(lines, mesh.vertices().len(), free),
            grid: OnceLock::new(),
            mesh,
            reach,
            spacing,
            names,
            wall_of,
        })
    }

    fn integrals(shape: &PiecewisePolynomial, h: f64) -> Result<Renormalisation2d, BoundaryError> {
        Renormalisation2d::new(shape, h)
    }

    fn names(&self) -> &[String] {
        &self.names
    }

    fn points(&self) -> impl Iterator<Item = MeshPoint<2>> + '_ {
        self.mesh.vertices().iter().map(|vertex| {
            let half = |s: Option<usize>| s.map_or(0.0, |s| 0.5 * self.segment(s).length);
            // A free end answers for the half that is missing, too.
            let (before, after) = (half(vertex.previous), half(vertex.next));
            let length = match (vertex.previous, vertex.next) {
                (Some(_), Some(_)) => before + after,
                _ => 2.0 * (before + after),
            };
            MeshPoint {
                position: vertex.position.into(),
                normal: self.normal(vertex),
                theta: vertex.theta,
                size: length / self.spacing,
                wall: self.wall_of[vertex.wall],
            }
        })
    }

    fn elements(&self) -> impl Iterator<Item = MeshElement<2>> + '_ {
        self.mesh.segments().iter().map(|segment| MeshElement {
            centre: segment.centre.into(),
            normal: segment.normal.into(),
            measure: segment.length,
            wall: self.wall_of[segment.wall],
            corners: segment.vertices.map(|v| v as u32),
        })
    }

    fn move_walls(&mut self, poses: &[Pose<2>]) -> Result<(), BoundaryError> {
        let poses: Vec<_> = self.wall_of.iter().map(|w| poses[*w]).collect();
        if poses == self.mesh.poses() {
            return Ok(());
        }
        self.mesh.move_walls(&poses)?;
        self.grid = OnceLock::new();
        Ok(())
    }

    fn near_all(
        &self,
        points: &[Vect<2>],
        radius: f64,
        counts: &mut Vec<u32>,
        rows: &mut Vec<NearSegment>,
    ) {
        let (radius, grid) = (radius.min(self.reach), self.grid());
        for point in points {
            let from = rows.len();
            rows.extend(grid.near(&self.mesh, [point[0], point[1]], radius));
            counts.push((rows.len() - from) as u32);
        }
    }

    fn clearance(&self, point: &Vect<2>, near: &[NearSegment]) -> f64 {
        let heights = near.iter().map(|near| {
            let [start, _] = self.mesh.seen_from([point[0], point[1]], *near);
            let normal: Vect<2> = self.segment(near.segment).normal.into();
            -Vect::<2>::from(start).dot(&normal)
        });
        heights.filter(|h| *h > 0.0).fold(f64::INFINITY, f64::min)
    }

    /// The segments of all points side by side: a point alone sees too few to fill vectors.
    fn gammas<'a>(
        &self,
        integrals: &Renormalisation2d,
        points: impl Iterator<Item = (&'a Vect<2>, &'a [NearSegment])>,
        batch: &mut SegmentBatch,
        contacts: &mut ContactBlock<2>,
        found: &mut Gammas,
    ) {
        batch.clear();
        for (point, row) in points {
            for &near in row {
                let ends = self.mesh.seen_from([point[0], point[1]], near);
                let normal = self.segment(near.segment).normal;
                integrals.see(batch, near.segment as u32, ends, normal);
            }
            batch.end();
        }
        integrals.weigh(batch);
        let mut from = 0;
        let mut sides = std::mem::take(&mut found.sides);
        for &end in &batch.ends {
            let mut sum = GammaSum::default();
            let planes = contacts.planes();
            sides.clear();
            for k in from..end {
                let (element, distance) = batch.seen[k];
                let segment = self.segment(element as usize);
                let integral = integrals.weighed(batch, k);
                sum.add(&integral, segment);
                sides.add(self.shells.of(element as usize), integral.gamma);
                if integral.kernel != 0.0 {
                    let share = std::iter::once((element, integral.kernel));
                    contacts.push(segment.normal.into(), distance, share);
                }
            }
            let touches = sum.contact_fraction > 0.0;
            match sides.gamma(sum.signed_sum).filter(|_| !touches) {
                None => found.push(sum.gamma(), contacts.planes(), &ShellSums::default()),
                Some(gamma) => {
                    contacts.truncate(planes);
                    for k in from..end {
                        let (element, distance) = batch.seen[k];
                        let shell = self.shells.of(element as usize);
                        let kernel = integrals.weighed(batch, k).kernel;
                        if kernel != 0.0 && sides.behind().all(|(s, _)| s != shell) {
                            let normal = self.segment(element as usize).normal;
                            contacts.push(
                                normal.into(),
                                distance,
                                std::iter::once((element, kernel)),
                            );
                        }
                    }
                    found.push(gamma, contacts.planes(), &sides);
                }
            }
            from = end;
        }
        found.sides = sides;
    }

    fn shells(&self) -> &Shells {
        &self.shells
    }

    fn element(&self, near: NearSegment) -> usize {
        near.segment
    }

    fn is_crossed(&self, near: NearSegment, point: &Vect<2>, by: &Vect<2>) -> bool {
        let [a, b] = self.mesh.seen_from((*point).into(), near).map(Vect::from);
        let along: Vect<2> = b - a;
        by.perp(&a) * by.perp(&b) <= 0.0 && along.perp(&-a) * along.perp(&(by - a)) <= 0.0
    }

    fn hindrances(
        &self,
        of: (&Vect<2>, &[(u32, u32)]),
        near: &[NearSegment],
        reach: f64,
        hindrances: &mut Vec<Hindrance<2>>,
    ) {
        hindrances.extend(
            near.iter()
                .filter_map(|near| self.hindrance(of, *near, reach)),
        );
    }

    /// The side of the nearest segment if a wall is near, else of all walls together. Open walls
    /// have no inside, but they have a front.
    fn enclosed(&self, point: &Vect<2>) -> Option<f64> {
        self.mesh.enclosed([point[0], point[1]])
    }

    fn contains(&self, point: &Vect<2>) -> bool {
        let near = self.near(point, self.reach);
        let seen: Vec<_> = near.into_iter().map(|n| self.seen(point, n)).collect();
        match Self::signed_distance(&seen, &Vect::zeros(), self.reach) {
            Some(distance) => distance >= 0.0,
            None => self.mesh.contains([point[0], point[1]]),
        }
    }

    fn wall_of(&self, near: NearSegment) -> usize {
        self.wall_of[self.segment(near.segment).wall]
    }

    fn seen(&self, point: &Vect<2>, near: NearSegment) -> SeenSegment {
        self.mesh.seen((*point).into(), near)
    }

    fn signed_distance(seen: &[SeenSegment], place: &Vect<2>, within: f64) -> Option<f64> {
        SeenSegment::signed_distance(seen, (*place).into(), within)
    }

    fn nearest(&self, point: &Vect<2>, within: f64) -> Option<(f64, usize)> {
        let point = [point[0], point[1]];
        let near = self.grid().near(&self.mesh, point, within.min(self.reach));
        near.map(|near| {
            let [start, end] = self.mesh.seen_from(point, near);
            (distance_squared(start, end), near.segment)
        })
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(d2, segment)| (d2.sqrt(), self.wall_of[self.segment(segment).wall]))
    }

    fn bounds(&self) -> Option<(Vect<2>, Vect<2>)> {
        let places = || self.mesh.vertices().iter().map(|v| Vect::from(v.position));
        let low = places().reduce(|a, b| a.inf(&b))?;
        Some((low, places().reduce(|a, b| a.sup(&b))?))
    }

    fn check_free_ends(&self, points: &[Vect<2>], radius: f64) -> Result<(), BoundaryError> {
        if self.mesh.free_ends().is_empty() {
            return Ok(());
        }
        let points: Vec<[f64; 2]> = points.iter().map(|p| [p[0], p[1]]).collect();
        self.mesh.check_free_ends(&points, radius)
    }

    fn layers(&self, spacing: f64, support: f64) -> Vec<(usize, Vect<2>)> {
        layers(self, &self.mesh, &self.wall_of, [spacing, support])
    }

    fn warnings(&self) -> Vec<String> {
        let all = self.mesh.warnings().iter();
        all.map(ToString::to_string).collect()
    }
}
