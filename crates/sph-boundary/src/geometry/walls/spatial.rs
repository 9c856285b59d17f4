//! Walls in space: triangles for the wall treatments.

use rayon::prelude::*;
use sph_core::Vect;
use sph_kernels::PiecewisePolynomial;
use sph_neighbours::ContactBlock;

use crate::geometry::vector::bounds;
use crate::geometry::walls::beds::laid;
use crate::geometry::walls::faces::{Corner, Planes};
use crate::treatment::contract::groups;
use crate::{
    BoundaryError, Closest, Drawing, Feature, Gammas, Hindrance, Mesh, NearElement, NearRows,
    PeriodicBox, Pose, Renormalisation3d, Result, Surface, View, WallMesh, WallSpec, Walls,
    Weights,
};

/// Two places nearer than this, relatively, are equally near.
const EQUALLY_NEAR: f64 = 1.0 + 1e-9;
/// A place is in a plane if it is this near to it, relatively.
const SAME_PLANE: f64 = 1e-6;
/// A place of a dummy particle nearer to the fluid's side than this share of the spacing is left out.
const TOO_NEAR: f64 = 0.25;

/// A triangle with its closest place, the vector there and its length.
type NearTriangle<'a> = (&'a NearElement<3>, Closest<3>, Vect<3>, f64);

impl WallMesh<3> for Walls<3> {
    type Integrals = Renormalisation3d;
    type Scratch = Weights;

    fn build(all: &[WallSpec<3>], size: f64, reach: f64, domain: &PeriodicBox<3>) -> Result<Self> {
        let surface = |spec: &WallSpec<3>| match &spec.drawing {
            Drawing::Surface(surface) => Ok(surface.clone()),
            Drawing::Line(line) => Err(BoundaryError::unfit(
                &line.name,
                "is not drawn for 3 dimensions: a polyline is a wall of two, a surface one of three",
            )),
        };
        let surfaces: Vec<Surface> = all.iter().map(surface).collect::<Result<_, _>>()?;
        let mut mesh = Mesh::<3>::build(&surfaces, &groups(all), size, domain)?;
        mesh.motions = all.iter().map(|wall| wall.motion.clone()).collect();
        mesh.beds = laid(&mesh, all, domain)?;
        mesh.part_faces();
        // Ports of open faces are of elements.
        let open = all.iter().any(|wall| wall.open);
        let mut walls = Walls::new(mesh, all, reach);
        let motions = &walls.mesh.motions;
        let cut = |wall: usize| open || motions[wall].bends();
        walls.planes = Planes::new(&walls.mesh, cut);
        Ok(walls)
    }

    fn integrals(shape: &PiecewisePolynomial, h: f64) -> Result<Renormalisation3d> {
        Renormalisation3d::new(shape, h)
    }

    fn move_walls(&mut self, poses: &[Pose<3>]) -> Result<()> {
        self.mesh.move_walls(poses)?;
        self.tree.take();
        self.planes.follow(&self.mesh);
        Ok(())
    }

    /// Also those of which only the sphere around them is in reach: to look closer costs more than
    /// to see them left out by every γ. Face by face, as the triangles are.
    fn near_all(&self, points: &[Vect<3>], radius: f64, rows: &mut NearRows<3>) {
        let points: Vec<[f64; 3]> = points.iter().map(|p| (*p).into()).collect();
        self.tree().rows(&points, radius.min(self.reach), rows);
    }

    /// One triangle of each face that is one contact: the rest of it is found from there.
    fn merge(&self, NearRows { counts, elements }: &mut NearRows<3>) {
        let (mut from, mut kept) = (0, 0);
        for count in counts {
            let end = from + *count as usize;
            let before = kept;
            while from < end {
                let part = self
                    .faces(&elements[from..end])
                    .next()
                    .map_or(0, <[_]>::len);
                let face = self.mesh.elements[elements[from].index()].face;
                let left = match &self.planes.faces[face].map {
                    Some(_) => 1,
                    None => part,
                };
                elements.copy_within(from..from + left, kept);
                kept += left;
                from += part;
            }
            *count = (kept - before) as u32;
        }
        elements.truncate(kept);
    }

    fn clearance(&self, point: &Vect<3>, near: &[NearElement<3>]) -> f64 {
        let heights = self.faces(near).map(|part| {
            let first = &self.mesh.elements[part[0].index()];
            let corner = Corner::new(&self.mesh, first.nodes[0], first.images[0]);
            let seen = self.seen(&corner, part[0].image, point);
            -seen.dot(&Vect::from(first.normal))
        });
        heights.filter(|h| *h > 0.0).fold(f64::INFINITY, f64::min)
    }

    /// γ and the sum of ∇γ are exact over every planar face; the sum is shared out to the triangles of a cut face
    /// by quadrature. A face counts where the disc of its plane within the support meets one of its triangles,
    /// whatever else stands in the row.
    fn gammas<'a>(
        &self,
        integrals: &Renormalisation3d,
        points: impl Iterator<Item = (&'a Vect<3>, &'a [NearElement<3>])>,
        room: &mut Weights,
        contacts: &mut ContactBlock<3>,
        found: &mut Gammas,
    ) {
        for of in points {
            found.add(contacts, |contacts, sides, hidden| {
                self.see(integrals, of, room, contacts, (sides, hidden))
            });
        }
    }

    fn is_crossed(&self, near: NearElement<3>, point: &Vect<3>, by: &Vect<3>) -> bool {
        let corners = self.mesh.corners_from((*point).into(), near);
        let [a, b, c] = corners.map(Vect::from);
        let normal = Vect::from(self.mesh.elements[near.index()].normal);
        let here = a.dot(&normal);
        if here * (here - by.dot(&normal)) > 0.0 {
            return false;
        }
        let sides = [(a, b), (b, c), (c, a)].map(|(p, q): (Vect<3>, Vect<3>)| by.dot(&p.cross(&q)));
        sides.iter().all(|s| *s >= 0.0) || sides.iter().all(|s| *s <= 0.0)
    }

    fn hindrances(&self, of: View<'_, 3>, row: &[NearElement<3>], reach: f64) -> Vec<Hindrance<3>> {
        let (point, behind) = of;
        let x: [f64; 3] = (*point).into();
        let row = &self.expanded(point, row, reach)[..];
        let seen = row.iter().map(|near| {
            let closest = self.mesh.closest(x, *near);
            let offset = Vect::from(closest.offset);
            (near, closest, offset, offset.norm())
        });
        let before = |(near, closest, _, distance): &NearTriangle| {
            let shell = self.shells.shell_of(near.index());
            let turned = behind.iter().any(|(_, s)| *s == shell);
            let side = if turned { -1.0 } else { 1.0 };
            side * closest.height > 0.0 && *distance <= reach
        };
        let all: Vec<_> = seen.filter(before).collect();
        let mut hindrances = Vec::new();
        for (near, closest, offset, distance) in &all {
            // A place on the rim of a triangle counts where it is the nearest of the wall around:
            // on an edge that stands out, not where the plane beyond the rim is nearer.
            let beyond = |other: &NearTriangle| {
                let normal = Vect::from(self.mesh.elements[other.0.index()].normal);
                let apart = offset - other.2;
                other.3 * EQUALLY_NEAR < *distance
                    && apart.dot(&normal).abs() < SAME_PLANE * distance
                    && apart.norm() < 2.0 * distance
            };
            if *distance == 0.0 || (closest.feature != Feature::Face && all.iter().any(beyond)) {
                continue;
            }
            hindrances.push(Hindrance {
                away: -offset / *distance,
                distance: *distance,
                only_if: None,
                wall: self.mesh.elements[near.index()].wall,
                place: point + offset,
                image: self.mesh.domain.shift(near.image.map(i32::from)).into(),
            });
        }
        hindrances
    }

    fn enclosed(&self, point: &Vect<3>) -> Option<f64> {
        self.mesh.enclosed((*point).into())
    }

    fn contains(&self, point: &Vect<3>) -> bool {
        self.mesh.contains((*point).into())
    }

    fn check_free_ends(&self, points: &[Vect<3>], radius: f64) -> Result<()> {
        let points: Vec<[f64; 3]> = points.iter().map(|p| (*p).into()).collect();
        self.mesh.check_free_edges(&points, radius)
    }

    /// Nodes of the cubic lattice of half spacings, counted from the lower corner of the box around all
    /// walls, that are outside the fluid and within the support of a wall.
    ///
    /// Faces along the axes at whole spacings get rows at ½, 1½, … spacings; slanted and curved ones get steps.
    fn layers(&self, spacing: f64, support: f64) -> Vec<(usize, Vect<3>)> {
        let domain = &self.mesh.domain;
        let [low, high] = bounds(self.nodes().iter().map(|n| n.position));
        let axis = |k: usize| -> Vec<f64> {
            if domain.periodic[k] {
                let period = domain.upper[k] - domain.lower[k];
                let count = (period / spacing).round().max(1.0);
                let node = |i: usize| domain.lower[k] + (i as f64 + 0.5) * (period / count);
                return (0..count as usize).map(node).collect();
            }
            let beyond = (support / spacing).ceil();
            let count = ((high[k] - low[k]) / spacing).ceil() + 2.0 * beyond;
            let node = |i: usize| low[k] + (i as f64 + 0.5 - beyond) * spacing;
            (0..count as usize).map(node).collect()
        };
        let [xs, ys, zs] = [axis(0), axis(1), axis(2)];
        let column = |(x, y): (f64, f64)| -> Vec<(usize, Vect<3>)> {
            let place = |z: &f64| {
                let place = Vect::from([x, y, *z]);
                let (distance, wall) = self.nearest(&place, support)?;
                let kept = distance >= TOO_NEAR * spacing && !self.contains(&place);
                kept.then_some((wall, place))
            };
            zs.iter().filter_map(place).collect()
        };
        let columns = xs.iter().flat_map(|x| ys.iter().map(|y| (*x, *y)));
        let columns: Vec<_> = columns.collect();
        columns.into_par_iter().flat_map_iter(column).collect()
    }
}
