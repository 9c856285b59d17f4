//! Walls in the plane: segments for the wall treatments.

use sph_core::Vect;
use sph_core::place_cells::PlaceCells;
use sph_kernels::PiecewisePolynomial;
use sph_neighbours::ContactBlock;

use crate::geometry::checks::check_points;
use crate::geometry::junctions::{bounding, without_shared};
use crate::geometry::mesh::SAME_PLACE;
use crate::geometry::walls::beds::laid;
use crate::treatment::contract::groups;
use crate::{
    BoundaryError, Drawing, GammaSum, Gammas, Hindrance, Mesh, NearElement, NearRows, PeriodicBox,
    Polyline, Pose, Renormalisation2d, Result, SeenElement, SegmentBatch, View, WallMesh, WallSpec,
    Walls,
};

/// Two dummy particles nearer than this share of the spacing are one.
const TOO_CLOSE: f64 = 0.7;

impl Walls<2> {
    fn hindrance(
        &self,
        (x, behind): View<'_, 2>,
        near: NearElement<2>,
        reach: f64,
    ) -> Option<Hindrance<2>> {
        let segment = &self.mesh.elements[near.index()];
        let [start, end] = self.mesh.corners_from([x[0], x[1]], near).map(Vect::from);
        let shell = self.shells.shell_of(near.index());
        let turned = behind.iter().any(|(_, s)| *s == shell);
        let normal = Vect::from(segment.normal) * if turned { -1.0 } else { 1.0 };
        // Only from the fluid's side: the far face of a plate does not act.
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
            wall: segment.wall,
            place: x + nearest,
            image: self.mesh.domain.shift(near.image.map(i32::from)).into(),
        };
        if (0.0..=1.0).contains(&share) {
            return Some(plane);
        }
        let distance = nearest.norm();
        let round = -nearest / distance;
        // Where the next segment at the node is nearer, it holds the particle back; the
        // node is no bump on a straight wall. In a corner this one's plane counts as well.
        let ahead = usize::from(share > 1.0);
        let node = segment.nodes[ahead];
        let next = self.mesh.beside[node][ahead];
        let over_next = next.is_some_and(|s| {
            let ahead = -nearest.dot(&Vect::from(self.mesh.elements[s].tangent()));
            let side = if share > 1.0 { 1.0 } else { -1.0 };
            side * ahead > 0.0
        });
        let theta = self.mesh.nodes[node].theta;
        let theta = if turned { 1.0 - theta } else { theta };
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

impl WallMesh<2> for Walls<2> {
    type Integrals = Renormalisation2d;
    type Scratch = SegmentBatch;

    fn build(walls: &[WallSpec<2>], size: f64, reach: f64, domain: &PeriodicBox) -> Result<Self> {
        let line = |spec: &WallSpec<2>| match &spec.drawing {
            Drawing::Line(line) => check_points(line).map(|()| line.clone()),
            Drawing::Surface(surface) => Err(BoundaryError::unfit(
                &surface.name,
                "is not drawn for 2 dimensions: a polyline is a wall of two, a surface one of three",
            )),
        };
        let lines: Vec<Polyline> = walls.iter().map(line).collect::<Result<_, _>>()?;
        let pieces = without_shared(&lines, &groups(walls), size)?;
        let (pieces, unseen) = bounding(pieces, &groups(walls), SAME_PLACE * size);
        let (wall_of, lines): (Vec<usize>, Vec<Polyline>) = pieces.into_iter().unzip();
        let names = walls.iter().map(|w| w.drawing.name().to_string()).collect();
        let mut mesh = Mesh::of_pieces((&lines, &wall_of), names, size, domain)?;
        mesh.warnings.extend(unseen);
        mesh.motions = walls.iter().map(|wall| wall.motion.clone()).collect();
        mesh.beds = laid(&mesh, walls, domain)?;
        Ok(Walls::new(mesh, walls, reach))
    }

    fn integrals(shape: &PiecewisePolynomial, h: f64) -> Result<Renormalisation2d> {
        Renormalisation2d::new(shape, h)
    }

    fn move_walls(&mut self, poses: &[Pose<2>]) -> Result<()> {
        if poses == self.mesh.poses {
            return Ok(());
        }
        self.mesh.move_walls(poses)?;
        self.tree.take();
        Ok(())
    }

    fn near_all(&self, points: &[Vect<2>], radius: f64, rows: &mut NearRows<2>) {
        let (radius, tree) = (radius.min(self.reach), self.tree());
        for point in points {
            let from = rows.elements.len();
            let near = tree.near(&self.mesh, (*point).into(), radius);
            rows.elements.extend(near);
            rows.counts.push((rows.elements.len() - from) as u32);
        }
    }

    fn clearance(&self, point: &Vect<2>, near: &[NearElement<2>]) -> f64 {
        let heights = near.iter().map(|near| {
            let [start, _] = self.mesh.corners_from((*point).into(), *near);
            let normal: Vect<2> = self.mesh.elements[near.index()].normal.into();
            -Vect::<2>::from(start).dot(&normal)
        });
        heights.filter(|h| *h > 0.0).fold(f64::INFINITY, f64::min)
    }

    /// The segments of all points side by side: a point alone sees too few to fill vectors.
    fn gammas<'a>(
        &self,
        integrals: &Renormalisation2d,
        points: impl Iterator<Item = (&'a Vect<2>, &'a [NearElement<2>])>,
        batch: &mut SegmentBatch,
        contacts: &mut ContactBlock<2>,
        found: &mut Gammas,
    ) {
        batch.clear();
        for (point, row) in points {
            for &near in row {
                let ends = self.mesh.corners_from((*point).into(), near);
                let normal = self.mesh.elements[near.index()].normal;
                integrals.see(batch, near.element, ends, normal);
            }
            batch.end();
        }
        integrals.weigh(batch);
        let mut from = 0;
        for &end in &batch.ends {
            found.add(contacts, |contacts, sides, hidden| {
                let mut sum = GammaSum::<2>::default();
                for k in from..end {
                    let (element, distance) = batch.seen[k];
                    let normal = self.mesh.elements[element as usize].normal;
                    let integral = integrals.weighed(batch, k);
                    sum.add(&integral, element as usize, &self.mesh);
                    let shell = self.shells.shell_of(element as usize);
                    sides.add(shell, integral.gamma);
                    if integral.kernel != 0.0 && !hidden.contains(&shell) {
                        let share = std::iter::once((element, integral.kernel));
                        contacts.push(normal.into(), distance, share);
                    }
                }
                sum
            });
            from = end;
        }
    }

    fn is_crossed(&self, near: NearElement<2>, point: &Vect<2>, by: &Vect<2>) -> bool {
        let corners = self.mesh.corners_from((*point).into(), near);
        let [a, b] = corners.map(Vect::from);
        let along: Vect<2> = b - a;
        by.perp(&a) * by.perp(&b) <= 0.0 && along.perp(&-a) * along.perp(&(by - a)) <= 0.0
    }

    fn hindrances(&self, of: View<'_, 2>, row: &[NearElement<2>], reach: f64) -> Vec<Hindrance<2>> {
        let all = row
            .iter()
            .filter_map(|near| self.hindrance(of, *near, reach));
        all.collect()
    }

    fn enclosed(&self, point: &Vect<2>) -> Option<f64> {
        self.mesh.enclosed((*point).into())
    }

    /// The side of the nearest segment if a wall is near, else of all walls together. Open walls
    /// have no inside, but they have a front.
    fn contains(&self, point: &Vect<2>) -> bool {
        let seen = self.seen(point, &self.near(point, self.reach));
        match SeenElement::signed_distance(&seen, [0.0; 2], self.reach) {
            Some(distance) => distance >= 0.0,
            None => self.mesh.contains((*point).into()),
        }
    }

    fn check_free_ends(&self, points: &[Vect<2>], radius: f64) -> Result<()> {
        let points: Vec<[f64; 2]> = points.iter().map(|p| (*p).into()).collect();
        self.mesh.check_free_ends(&points, radius)
    }

    /// Rows at ½, 1½, … spacings behind every straight stretch, prolonged round corners.
    ///
    /// A place is kept if it is outside the fluid, not nearer to any wall than its own row, and not
    /// on top of a place already kept; so right angles are tiled exactly and others nearly so.
    fn layers(&self, spacing: f64, support: f64) -> Vec<(usize, Vect<2>)> {
        let rows = (support / spacing - 1e-9).ceil() as usize;
        let mut kept = Vec::new();
        let mut places = PlaceCells::new(spacing, []);
        let domain = &self.mesh.domain;
        let inside_period = |p: [f64; 2]| {
            (0..2).all(|k| {
                !domain.periodic[k]
                    || (p[k] >= domain.lower[k] - 1e-9 * spacing
                        && p[k] < domain.upper[k] - 1e-9 * spacing)
            })
        };
        for row in 0..rows {
            let depth = (row as f64 + 0.5) * spacing;
            for (s, segment) in self.mesh.elements.iter().enumerate() {
                let [start, _] = self.mesh.corners(s);
                let tangent = segment.tangent();
                // A segment is about one spacing long: its own place is in its middle, and both
                // ends reach on so that outer corners are filled.
                let reach = rows as i64;
                for k in -reach..=reach {
                    let along = segment.measure * 0.5 + k as f64 * spacing;
                    let p =
                        [0, 1].map(|a| start[a] + tangent[a] * along - segment.normal[a] * depth);
                    let beyond = k != 0;
                    if self.contains(&p.into()) {
                        continue;
                    }
                    let clearance = self.nearest(&p.into(), depth);
                    if clearance.is_some_and(|(d, _)| d < depth * (1.0 - 1e-6)) {
                        continue;
                    }
                    // A prolonged row serves only places that no segment's own row reaches.
                    if beyond && self.nearest(&p.into(), depth * (1.0 + 1e-6)).is_some() {
                        continue;
                    }
                    // A wall may lie across a periodic border; a line that closes through it has a place there already.
                    let seen = match inside_period(p) {
                        true => p,
                        false => domain.wrapped(p),
                    };
                    let taken = places.around(seen).any(|q: &[f64; 2]| {
                        (seen[0] - q[0]).hypot(seen[1] - q[1]) < TOO_CLOSE * spacing
                    });
                    if !taken {
                        places.add(seen, seen);
                        kept.push((segment.wall, p.into()));
                    }
                }
            }
        }
        kept
    }
}
