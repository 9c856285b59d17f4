//! Edges of the planar pieces, cut at the spacing alike for all pieces that share them.

use std::collections::{BTreeMap, HashMap};

use sph_core::BoxTree;

use super::drawn::Surface;
use super::patches::Patch;
use super::places::{EdgeKey, Places, Site, edge_key};
use crate::error::{BoundaryError, Place, Result};
use crate::geometry::mesh::SAME_PLACE;
use crate::geometry::vector::{Point, add, along, bounds, dot, norm, sub, widened};

/// Nodes of the mesh while it is built.
#[derive(Default)]
pub(super) struct Nodes {
    pub positions: Vec<Point>,
    pub walls: Vec<usize>,
    pub at_corner: HashMap<u32, u32>,
    /// First of the nodes within each straight piece of an edge, and the number of equal parts.
    within: HashMap<EdgeKey, (u32, u32)>,
}

impl Nodes {
    pub fn push(&mut self, position: Point, wall: usize) -> u32 {
        self.positions.push(position);
        self.walls.push(wall);
        self.positions.len() as u32 - 1
    }

    pub fn corner(&mut self, corner: Site, places: &Places, wall: usize) -> Site {
        let known = self.at_corner.get(&corner.id).copied();
        let id = known.unwrap_or_else(|| self.push(places.positions[corner.id as usize], wall));
        self.at_corner.insert(corner.id, id);
        Site { id, ..corner }
    }
}

/// Cuts of every edge of the patches by corners of the patches of its group.
pub(super) struct Cuts<'a> {
    /// Corners along the edge, both ends included, from the key's first end.
    chains: HashMap<EdgeKey, Vec<Site>>,
    pub places: &'a Places,
    spacing: f64,
}

impl<'a> Cuts<'a> {
    pub fn new(patches: &[Patch], places: &'a Places, spacing: f64) -> Self {
        let corners = Corners::new(patches, places, spacing);
        let mut chains = HashMap::new();
        for edge in patches.iter().flat_map(|patch| &patch.boundary) {
            let (key, ..) = edge_key(edge[0], edge[1]);
            let chain = chains.entry(key);
            chain.or_insert_with(|| corners.along(&key, places));
        }
        Self {
            chains,
            places,
            spacing,
        }
    }

    /// The corners along an edge in the direction in which it is travelled, both ends included.
    pub fn along(&self, [from, to]: [Site; 2]) -> Vec<Site> {
        let (key, forward, image) = edge_key(from, to);
        let mut chain: Vec<Site> = self.chains[&key].iter().map(|c| c.moved(image)).collect();
        if !forward {
            chain.reverse();
        }
        chain
    }

    pub fn nodes(&self, edge: [Site; 2], nodes: &mut Nodes, wall: usize) -> Vec<Site> {
        let mut sites = Vec::new();
        for pair in self.along(edge).windows(2) {
            self.add_piece([pair[0], pair[1]], nodes, wall, &mut sites);
        }
        sites.push(nodes.corner(edge[1], self.places, wall));
        sites
    }

    /// Appends the nodes from one end up to but without the other, along a straight piece of an edge.
    fn add_piece(&self, ends: [Site; 2], nodes: &mut Nodes, wall: usize, sites: &mut Vec<Site>) {
        let (key, forward, image) = edge_key(ends[0], ends[1]);
        sites.push(nodes.corner(ends[0], self.places, wall));
        let (first, parts) = match nodes.within.get(&key) {
            Some(known) => *known,
            None => {
                let start = self.places.positions[key.first as usize];
                let whole = sub(self.places.at(key.second), start);
                let parts = ((norm(whole) / self.spacing).round() as u32).max(1);
                let first = nodes.positions.len() as u32;
                for k in 1..parts {
                    let part = f64::from(k) / f64::from(parts);
                    nodes.push(along(start, part, whole), wall);
                }
                nodes.within.insert(key, (first, parts));
                (first, parts)
            }
        };
        sites.extend((0..parts - 1).map(|k| Site {
            id: first + if forward { k } else { parts - 2 - k },
            image,
        }));
    }
}

/// Corners of all patches, with the images that come near the walls.
struct Corners {
    tolerance: f64,
    sites: Vec<Site>,
    tree: BoxTree<3>,
    /// Length of the pieces in which an edge is looked along, m.
    piece: f64,
}

impl Corners {
    fn new(patches: &[Patch], places: &Places, spacing: f64) -> Self {
        let corners = || patches.iter().flat_map(|p| p.boundary.iter().flatten());
        let [low, high] = bounds(corners().map(|c| places.at(*c)));
        let edges = || patches.iter().flat_map(|p| &p.boundary);
        let length = |e: &[Site; 2]| norm(sub(places.at(e[1]), places.at(e[0])));
        let mean = edges().map(length).sum::<f64>() / edges().count().max(1) as f64;
        let mut ids: Vec<u32> = corners().map(|c| c.id).collect();
        ids.sort_unstable();
        ids.dedup();
        // An edge starts from its key's first end, which may be drawn a period elsewhere.
        let periods = places.domain.periods();
        let around = [sub(low, periods), add(high, periods)];
        let images = |id: u32| {
            let own = [places.positions[id as usize]; 2];
            let all = places.domain.images_within(around, own);
            all.map(move |image| Site { id, image })
        };
        let sites: Vec<Site> = ids.into_iter().flat_map(images).collect();
        Corners {
            // Corners left out of a straight edge lie off it by up to one tolerance.
            tolerance: 2.0 * SAME_PLACE * spacing,
            tree: BoxTree::new(sites.iter().map(|s| [places.at(*s); 2]).collect()),
            sites,
            piece: (2.0 * mean).max(SAME_PLACE * spacing),
        }
    }

    /// Corners on an edge, from end to end.
    fn along(&self, key: &EdgeKey, places: &Places) -> Vec<Site> {
        let first = Site::unmoved(key.first);
        let [start, end] = [first, key.second].map(|c| places.at(c));
        let whole = sub(end, start);
        let length2 = dot(whole, whole);
        let group = places.groups[key.first as usize];
        let pieces = ((length2.sqrt() / self.piece) as usize).max(1);
        let mut met: Vec<(f64, Site)> = Vec::new();
        for piece in 0..pieces {
            let at = |k: usize| along(start, k as f64 / pieces as f64, whole);
            let around = widened(bounds([at(piece), at(piece + 1)]), self.tolerance);
            self.tree.each(around, |n| {
                let corner = self.sites[n];
                let to = sub(places.at(corner), start);
                let part = dot(to, whole) / length2;
                let off = norm(along(to, -part, whole));
                let within = part > 0.0 && part < 1.0 && off <= self.tolerance;
                let same = places.groups[corner.id as usize] == group;
                if within && same && corner != first && corner != key.second {
                    met.push((part, corner));
                }
            });
        }
        met.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        met.dedup_by_key(|(_, corner)| *corner);
        let between = met.into_iter().map(|(_, corner)| corner);
        let chain = std::iter::once(first).chain(between);
        chain.chain([key.second]).collect()
    }
}

/// Walls that travel a piece of an edge in one direction, each with its ends.
type Travelled = Vec<(usize, [Site; 2])>;

/// Ends of the straight pieces of edges that no other patch continues.
///
/// # Errors
/// Walls that meet with the fluid on opposite sides.
pub(super) fn free_pieces(
    surfaces: &[Surface],
    patches: &[Patch],
    cuts: &Cuts<'_>,
) -> Result<Vec<[Site; 2]>> {
    // Of every piece: the walls that travel it with and against its key.
    let mut walls: BTreeMap<EdgeKey, [Travelled; 2]> = BTreeMap::new();
    for patch in patches {
        for edge in &patch.boundary {
            for pair in cuts.along(*edge).windows(2) {
                let ends = [pair[0], pair[1]];
                let (key, forward, _) = edge_key(ends[0], ends[1]);
                let both = walls.entry(key).or_default();
                both[usize::from(!forward)].push((patch.wall, ends));
            }
        }
    }
    let mut free = Vec::new();
    for [with, against] in walls.values() {
        let (more, fewer) = match with.len() > against.len() {
            true => (with, against),
            false => (against, with),
        };
        match more.len() - fewer.len() {
            0 => {}
            1 => free.push(more[0].1),
            _ => {
                let [a, b] = more[0].1.map(|c| cuts.places.at(c));
                return Err(BoundaryError(format!(
                    "walls `{}` and `{}` meet in an edge at {} but put the fluid on opposite sides: reverse the \
                     triangles of one of them",
                    surfaces[more[0].0].name,
                    surfaces[more[1].0].name,
                    Place::from(along(a, 0.5, sub(b, a)))
                )));
            }
        }
    }
    Ok(free)
}
