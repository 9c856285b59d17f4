//! Faces of walls that a bed lifts.

use std::collections::{HashMap, HashSet};

use crate::geometry::vector::{dot, sub, unit};
use crate::{Element, Face, FaceEdge, Mesh};

/// A face whose normal has a smaller part upwards stays in its plane when nodes are lifted.
const UPRIGHT: f64 = 1e-9;
/// Two edges with a larger cosine between them are one.
const STRAIGHT: f64 = 1.0 - 1e-12;

/// A corner of an edge: its node, and whole periods to add.
type End = (usize, [i32; 3]);

impl Mesh<3> {
    /// Makes every triangle that a bed lifts a face of its own, but for those in upright faces. What is left of a face, and
    /// upright faces, are bounded by the edges of their triangles, so that they follow the nodes.
    pub(crate) fn part_faces(&mut self) {
        let lifts = |node: usize| {
            let (wall, place) = (self.nodes[node].wall as u32, &self.reference[node]);
            let mut beds = self.beds.iter();
            beds.any(|bed| bed.walls.contains(&wall) && bed.moves(place))
        };
        let lifted: Vec<bool> = (0..self.nodes.len()).map(lifts).collect();
        if !lifted.contains(&true) {
            return;
        }
        let moves = |e: &usize| self.elements[*e].nodes.iter().any(|n| lifted[*n]);
        let mut faces: Vec<Face> = Vec::new();
        let mut order: Vec<(usize, usize)> = Vec::with_capacity(self.elements.len());
        let all: Vec<usize> = (0..self.elements.len()).collect();
        for own in all.chunk_by(|a, b| self.elements[*a].face == self.elements[*b].face) {
            let face = &self.faces[self.elements[own[0]].face];
            if !own.iter().any(moves) {
                order.extend(own.iter().map(|e| (*e, faces.len())));
                faces.push(face.clone());
                continue;
            }
            let upright = face.normal[2].abs() < UPRIGHT;
            let (apart, rest): (Vec<usize>, Vec<usize>) =
                own.iter().partition(|e| !upright && moves(e));
            if !rest.is_empty() {
                order.extend(rest.iter().map(|e| (*e, faces.len())));
                let elements = rest.iter().map(|e| &self.elements[*e]);
                let edges = self.straightened(outer(elements), &lifted);
                faces.push(Face { edges, ..*face });
            }
            for e in apart {
                order.push((e, faces.len()));
                faces.push(Face {
                    edges: sides(&self.elements[e]).collect(),
                    ..*face
                });
            }
        }
        let mut places = vec![0; order.len()];
        for (place, (e, _)) in order.iter().enumerate() {
            places[*e] = place;
        }
        let element = |(e, face): &(usize, usize)| Element {
            face: *face,
            ..self.elements[*e]
        };
        self.elements = order.iter().map(element).collect();
        for edge in &mut self.free_edges {
            edge.triangle = places[edge.triangle];
        }
        self.reference_normals = faces.iter().map(|face| face.normal).collect();
        self.faces = faces;
    }

    /// Edges around a face, with those made one that are in line and meet at a node that stays.
    fn straightened(&self, edges: Vec<FaceEdge>, lifted: &[bool]) -> Vec<FaceEdge> {
        let end = |edge: &FaceEdge, k: usize| -> End { (edge.nodes[k], edge.images[k]) };
        let at = |(node, image): End| {
            let shift = self.domain.shift(image);
            std::array::from_fn::<f64, 3, _>(|k| self.reference[node][k] + shift[k])
        };
        let along = |edge: &FaceEdge| unit(sub(at(end(edge, 1)), at(end(edge, 0))));
        let mut meeting: HashMap<End, [Vec<usize>; 2]> = HashMap::new();
        for (k, edge) in edges.iter().enumerate() {
            for side in [0, 1] {
                meeting.entry(end(edge, side)).or_default()[side].push(k);
            }
        }
        // The edge that goes on where another one ends.
        let next = |k: usize| -> Option<usize> {
            let last = end(&edges[k], 1);
            let [starts, ends] = &meeting[&last];
            let ([go], [_]) = (&starts[..], &ends[..]) else {
                return None;
            };
            let straight = dot(along(&edges[k]), along(&edges[*go])) > STRAIGHT;
            (straight && !lifted[last.0]).then_some(*go)
        };
        let joined: HashSet<usize> = (0..edges.len()).filter_map(next).collect();
        let whole = |first: usize| {
            let mut last = first;
            while let Some(k) = next(last) {
                last = k;
            }
            FaceEdge {
                nodes: [edges[first].nodes[0], edges[last].nodes[1]],
                images: [edges[first].images[0], edges[last].images[1]],
            }
        };
        let firsts = (0..edges.len()).filter(|k| !joined.contains(k));
        firsts.map(whole).collect()
    }
}

fn sides(triangle: &Element<3>) -> impl Iterator<Item = FaceEdge> + '_ {
    (0..3).map(|k| {
        let ends = [k, (k + 1) % 3];
        FaceEdge {
            nodes: ends.map(|e| triangle.nodes[e]),
            images: ends.map(|e| triangle.images[e]),
        }
    })
}

/// The edges of triangles that no other one of them has, too.
fn outer<'a>(triangles: impl Iterator<Item = &'a Element<3>>) -> Vec<FaceEdge> {
    let edges: Vec<FaceEdge> = triangles.flat_map(sides).collect();
    let key = |[a, b]: [usize; 2], [i, k]: [[i32; 3]; 2]| {
        (a, b, std::array::from_fn::<i32, 3, _>(|n| k[n] - i[n]))
    };
    let all: HashSet<_> = edges.iter().map(|e| key(e.nodes, e.images)).collect();
    let turned = |e: &FaceEdge| key([e.nodes[1], e.nodes[0]], [e.images[1], e.images[0]]);
    let outer = edges.iter().filter(|edge| !all.contains(&turned(edge)));
    outer.copied().collect()
}
