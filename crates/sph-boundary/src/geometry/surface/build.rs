//! From surfaces to the mesh, and the side of the fluid.

use sph_core::Winding;

use super::crossing::contacts;
use super::drawn::{
    Drawn, MOST_ELEMENTS, Surface, check_extent, check_input, neighbours, too_many, weld,
};
use super::edges::{Cuts, Nodes, free_pieces};
use super::fill::{Corner, Filling, fill};
use super::patches::{Patch, patches};
use super::places::{Places, Site};
use super::wetted::{FaceContacts, remove_contacts, wetted_pieces};
use crate::error::{BoundaryError, Place, Result};
use crate::geometry::checks::unseen;
use crate::geometry::mesh::{
    Element, Face, FaceEdge, Mesh, Node, SAME_DISTANCE, SAME_HEIGHT, SAME_PLACE, Sides, Simplices,
    angle,
};
use crate::geometry::periodic::PeriodicBox;
use crate::geometry::vector::{Point, add, bounds, double_area, norm, sub};
use crate::parallel::*;

/// Elements with shorter sides than this part of the spacing are fine.
const FINE: f64 = 0.25;

impl Mesh<3> {
    /// Cuts the walls into triangles of about `spacing` metres.
    ///
    /// Walls with the same number in `groups`, one number per wall, move together: only those are
    /// joined with each other.
    ///
    /// # Errors
    /// A surface that is degenerate, not a manifold or inconsistently oriented, that crosses itself
    /// or another one, is drawn twice, has no thickness, or is far too small or too large. A wall
    /// that ends freely is not refused here: see [`Mesh::check_free_edges`].
    pub fn build(
        surfaces: &[Surface],
        groups: &[usize],
        spacing: f64,
        domain: &PeriodicBox<3>,
    ) -> Result<Self> {
        BoundaryError::check_positive("wall spacing", spacing)?;
        domain.check()?;
        if groups.len() != surfaces.len() {
            let (given, walls) = (groups.len(), surfaces.len());
            let why = format!("{given} group(s) given for {walls} wall(s)");
            return Err(BoundaryError(why));
        }
        let tolerance = SAME_PLACE * spacing;
        let mut places = Places::new(tolerance, domain);
        let (mut patches, touched) = planar_pieces(surfaces, groups, spacing, &mut places)?;
        let cuts = Cuts::new(&patches, &places, spacing);
        let seen = wetted_pieces(&patches, &cuts, &touched);
        let unseen = unseen_faces(surfaces, &patches, &seen);
        let mut kept = seen.iter();
        patches.retain(|_| kept.next() == Some(&true));
        let covered = |(wall, _): &(usize, &Surface)| !patches.iter().any(|p| p.wall == *wall);
        if let Some((_, surface)) = surfaces.iter().enumerate().find(covered) {
            return Err(BoundaryError(format!(
                "nothing is left of wall `{}`: other walls cover all of it, or face away from its edges: turn the one \
                 that faces the other way, leave the wall out, or give a plate of two sides a thickness",
                surface.name
            )));
        }
        let free = free_pieces(surfaces, &patches, &cuts)?;

        let mut nodes = Nodes::default();
        let mut sides = Vec::with_capacity(patches.len());
        for patch in &patches {
            let edges = patch.boundary.iter();
            let nodes = edges.map(|e| cuts.nodes(*e, &mut nodes, patch.wall));
            sides.push(nodes.collect::<Vec<_>>());
        }
        let position = |node: u32| nodes.positions[node as usize];
        let both = patches.as_slice().into_par_iter().zip(&sides);
        let filled = both.map(|(patch, sides)| fill(patch, sides, &position, domain, spacing));
        let filled: Vec<Result<Filling, String>> = filled.collect();

        let names = surfaces.iter().map(|s| s.name.clone()).collect();
        let mut mesh = Mesh::empty(names, groups, spacing, domain);
        mesh.reference_normals = patches.iter().map(|p| p.normal).collect();
        let triangles = filled.iter().flatten().map(|f| f.triangles.len());
        mesh.elements.reserve_exact(triangles.sum());
        for (patch, filling) in patches.iter().zip(filled) {
            let filling = filling.map_err(|reason| {
                let (wall, at) = (&surfaces[patch.wall].name, places.at(patch.boundary[0][0]));
                BoundaryError(format!(
                    "the planar piece of wall `{wall}` at {} cannot be cut into triangles: {reason}",
                    Place::from(at)
                ))
            })?;
            mesh.append(patch, filling, &mut nodes, &places);
        }
        mesh.check_count()?;
        let places = nodes.positions.iter().zip(&nodes.walls);
        mesh.nodes = places.map(|(x, wall)| Node::new(*x, *wall)).collect();
        mesh.reference = nodes.positions;
        for triangle in 0..mesh.elements.len() {
            mesh.measure(triangle);
        }
        mesh.free_edges = mesh.weigh();
        let corner = |site: &[Site; 2]| nodes.at_corner.get(&site[0].id).map(|n| *n as usize);
        mesh.find_openings(free.iter().filter_map(corner));
        mesh.warnings = mesh.fine_walls();
        mesh.warnings.extend(unseen);
        Ok(mesh)
    }
    fn append(&mut self, patch: &Patch, filling: Filling, nodes: &mut Nodes, places: &Places) {
        let face = self.faces.len();
        let mut corner = |c: Site| {
            let site = nodes.corner(c, places, patch.wall);
            (site.id as usize, site.image)
        };
        let edges = patch.boundary.iter().map(|edge| {
            let [(a, at), (b, to)] = edge.map(&mut corner);
            FaceEdge {
                nodes: [a, b],
                images: [at, to],
            }
        });
        self.faces.push(Face {
            wall: patch.wall,
            normal: patch.normal,
            edges: edges.collect(),
        });
        let first = nodes.positions.len() as u32;
        for position in &filling.inside {
            nodes.push(*position, patch.wall);
        }
        // A piece drawn in another image has its own nodes where it is drawn.
        let site = |c: Corner| match c {
            Corner::Edge(site) => site,
            Corner::Inside(k) => Site::unmoved(first + k),
        };
        for corners in filling.triangles {
            let sites = corners.map(site);
            self.elements.push(Element {
                nodes: sites.map(|s| s.id as usize),
                images: sites.map(|s| s.image),
                wall: patch.wall,
                face,
                measure: 0.0,
                centre: [0.0; 3],
                normal: patch.normal,
            });
        }
    }

    fn check_count(&self) -> Result<()> {
        let count = |wall: usize| self.elements.iter().filter(|t| t.wall == wall).count() as u64;
        let estimate = self.elements.len() as u64;
        if estimate <= MOST_ELEMENTS {
            return Ok(());
        }
        let most = (0..self.walls.len()).max_by_key(|w| count(*w)).unwrap_or(0);
        Err(too_many(&self.walls[most], count(most), estimate))
    }

    /// Remarks on walls most of whose triangles are far smaller than the spacing: they stay so.
    fn fine_walls(&self) -> Vec<String> {
        let mut counts = vec![[0usize; 2]; self.walls.len()];
        for triangle in &self.elements {
            // Half a square of side s has the area s²/2.
            let fine = 2.0 * triangle.measure < (FINE * self.spacing).powi(2);
            counts[triangle.wall][0] += usize::from(fine);
            counts[triangle.wall][1] += 1;
        }
        let walls = self.walls.iter().zip(counts);
        let fine = walls.filter(|(_, [fine, all])| 2 * fine > *all);
        let remark = |(wall, [fine, all]): (&String, [usize; 2])| {
            format!(
                "{fine} of the {all} triangles of wall `{wall}` are far smaller than the spacing {} m: draw it coarser",
                self.spacing
            )
        };
        fine.map(remark).collect()
    }
}

fn unseen_faces(surfaces: &[Surface], pieces: &[Patch], seen: &[bool]) -> Vec<String> {
    let remark = |(wall, surface): (usize, &Surface)| {
        let all = pieces.iter().zip(seen);
        let faces = all.filter(|(p, seen)| p.wall == wall && !**seen).count();
        (faces > 0).then(|| unseen(&surface.name, faces))
    };
    surfaces.iter().enumerate().filter_map(remark).collect()
}

/// Checks the surfaces; returns their planar pieces without the places where walls touch, and these.
fn planar_pieces(
    surfaces: &[Surface],
    groups: &[usize],
    spacing: f64,
    places: &mut Places,
) -> Result<(Vec<Patch>, FaceContacts)> {
    let tolerance = SAME_PLACE * spacing;
    for surface in surfaces {
        check_input(surface)?;
    }
    check_extent(surfaces, spacing)?;
    let mut drawn: Vec<Drawn> = Vec::new();
    let mut pieces: Vec<Patch> = Vec::new();
    let mut piece_of: Vec<u32> = Vec::new();
    for (wall, surface) in surfaces.iter().enumerate() {
        let own = weld(surface, wall, groups[wall], places)?;
        let beside = neighbours(&surface.name, &own, places)?;
        let (new, of) = patches(&own, &beside, tolerance);
        piece_of.extend(of.iter().map(|p| pieces.len() as u32 + p));
        pieces.extend(new);
        drawn.extend(own);
    }
    let domain = places.domain;
    let contacts = contacts(surfaces, &drawn, tolerance, &domain)?;
    let touched = remove_contacts(&mut pieces, &piece_of, &contacts, places);
    for piece in &mut pieces {
        piece.straighten(places, tolerance);
    }
    Ok((pieces, touched))
}

impl Simplices<3> for Mesh<3> {
    fn measure(&mut self, triangle: usize) {
        let corners = self.corners(triangle);
        let double = double_area(corners);
        let length = norm(double);
        let triangle = &mut self.elements[triangle];
        let [a, b, c] = corners;
        triangle.centre = std::array::from_fn(|k| (a[k] + b[k] + c[k]) / 3.0);
        triangle.measure = 0.5 * length;
        if length > 0.0 {
            triangle.normal = double.map(|x| x / length);
        }
    }

    fn follow(&mut self, moved: &[bool]) {
        for (face, reference) in self.faces.iter_mut().zip(&self.reference_normals) {
            if moved[face.wall] {
                let pose = &self.poses[face.wall];
                face.normal = match pose.turns() {
                    true => pose.turned(*reference),
                    false => *reference,
                };
            }
        }
        for triangle in &self.elements {
            if moved[triangle.wall] && self.motions[triangle.wall].bed.is_some() {
                self.faces[triangle.face].normal = triangle.normal;
            }
        }
    }

    /// Seen along the ray, the point is within a triangle if it is on the left of all edges or on the right of all.
    /// Both triangles at an edge compute the same number but for its sign, and a point on an edge counts as moved by an
    /// infinitely small step, so that a ray through an edge or a node meets a closed surface as often as one beside it.
    fn crossing(corners: [Point; 3], _: Point, along: usize) -> Option<(f64, i32)> {
        let [u, v] = [(along + 1) % 3, (along + 2) % 3];
        let side = |i: usize| {
            let (a, b) = (corners[i], corners[(i + 1) % 3]);
            let area = a[u] * b[v] - a[v] * b[u];
            let upwards = b[v] > a[v] || (b[v] == a[v] && b[u] < a[u]);
            (area, area > 0.0 || (area == 0.0 && upwards))
        };
        let [ab, bc, ca] = [side(0), side(1), side(2)];
        let sum = ab.0 + bc.0 + ca.0;
        if ab.1 != bc.1 || bc.1 != ca.1 || sum == 0.0 {
            return None;
        }
        let heights = corners.map(|c| c[along]);
        let height = (bc.0 * heights[0] + ca.0 * heights[1] + ab.0 * heights[2]) / sum;
        Some((height, if ab.1 { -1 } else { 1 }))
    }

    fn is_fluid_beyond(&self, along: usize) -> bool {
        let mut free = vec![false; self.nodes.len()];
        for node in self.free_edges.iter().flat_map(|e| e.nodes) {
            free[node] = true;
        }
        let heights = || {
            let nodes = self.nodes.iter().zip(&free).filter(|(_, free)| !**free);
            nodes.map(|(node, _)| node.position[along])
        };
        let top = heights().fold(f64::NEG_INFINITY, f64::max);
        let scale = heights().fold(0.0, |scale: f64, h| scale.max(h.abs()));
        let mut outward: std::collections::BTreeMap<usize, f64> = Default::default();
        for (e, element) in self.elements.iter().enumerate() {
            for (corner, node) in element.nodes.iter().enumerate() {
                let height = self.nodes[*node].position[along];
                if !free[*node] && height >= top - SAME_HEIGHT * scale {
                    let weight = angle(&self.corners(e), corner);
                    *outward.entry(*node).or_default() += weight * element.normal[along];
                }
            }
        }
        outward.values().all(|up| *up >= -SAME_DISTANCE)
    }

    fn wind(&self, sides: &mut Sides<3>) {
        sides.winding = winding(self);
    }

    fn wound(&self, sides: &Sides<3>, point: Point) -> Option<f64> {
        sides.winding.as_ref().map(|winding| -winding.at(&point))
    }
}

/// Images of a periodic wall on either side reach this many extents of it, and are so many at most.
const IMAGES: (f64, f64) = (5.0, 16.0);

/// Of the faces, each a fan over its edges, and of their images where one axis is periodic.
fn winding(mesh: &Mesh<3>) -> Option<Winding> {
    let periodic = mesh.domain.periodic;
    if mesh.free_edges.is_empty() || periodic.iter().filter(|p| **p).count() > 1 {
        return None;
    }
    let ends = (0..mesh.faces.len()).map(|f| mesh.face_edges_from([0.0; 3], f, [0; 3]));
    let faces: Vec<Vec<[Point; 2]>> = ends.map(Iterator::collect).collect();
    let fan = |edges: &Vec<[Point; 2]>| {
        let apex = edges[0][0];
        let others = edges.iter().filter(move |[a, b]| *a != apex && *b != apex);
        others.map(move |[a, b]| [apex, *a, *b]).collect::<Vec<_>>()
    };
    let own: Vec<[Point; 3]> = faces.iter().flat_map(fan).collect();
    let Some(axis) = (0..3).find(|k| periodic[*k]) else {
        return Some(Winding::new(own));
    };
    let [low, high] = bounds(own.iter().flatten().copied());
    let images = IMAGES.0 * norm(sub(high, low)) / mesh.domain.periods()[axis];
    let images = images.ceil().min(IMAGES.1) as i32;
    let all = (-images..=images).flat_map(|n| {
        let image = std::array::from_fn(|k| if k == axis { n } else { 0 });
        let shift = mesh.domain.shift(image);
        own.iter().map(move |t| t.map(|p| add(p, shift)))
    });
    Some(Winding::new(all.collect()))
}
