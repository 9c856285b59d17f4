//! Walls as skins of elements that hang together, and the rims at which these end.

use std::collections::BTreeMap;

use sph_core::Vect;
use sph_neighbours::{Domain, WallSet};

use crate::setup::box_around;

/// Elements that hang together.
#[derive(Clone)]
pub(crate) struct Skin<const D: usize> {
    /// Index of the wall of its first element.
    pub wall: usize,
    /// Box around it, m.
    pub low: Vect<D>,
    pub high: Vect<D>,
    /// True if its normals point inwards: the fluid is in it.
    pub holds: bool,
    /// True if any of its elements lets fluid pass.
    pub open: bool,
}

/// Ends of skins: two ends in the plane, the edges around a hole in space.
pub(crate) struct Rim<const D: usize> {
    /// The skins, one or two.
    pub skins: [usize; 2],
    pub nodes: Vec<usize>,
    /// Length or area that would close it, m^(D−1), times the normal into the fluid that this would have.
    pub lid: Vect<D>,
}

/// All walls of a flow.
pub(crate) struct Skins<const D: usize> {
    pub all: Vec<Skin<D>>,
    pub rims: Vec<Rim<D>>,
    /// The skin of every wall point; none for points without an element.
    pub of_point: Vec<Option<usize>>,
}

impl<const D: usize> Skins<D> {
    pub fn new(walls: &WallSet<D>, domain: &Domain<D>) -> Self {
        let (points, elements) = (&walls.points.position, &walls.elements);
        let (of_point, of_element, count) = joined(points.len(), &elements.corners);
        let rims = match D {
            2 => ends(points, &elements.corners, &of_point, domain),
            _ => holes(points, &elements.corners, &of_point, domain),
        };
        let [low, high]: [Vect<D>; 2] = box_around([]);
        let none = Skin {
            wall: usize::MAX,
            low,
            high,
            holds: false,
            open: false,
        };
        let mut all = vec![none; count];
        for (x, skin) in points.iter().zip(&of_point) {
            if let Some(skin) = skin {
                let Skin { low, high, .. } = &mut all[*skin];
                (*low, *high) = (low.inf(x), high.sup(x));
            }
        }
        // Beside a rim the sum is that of the skin with a flat lid on it.
        let mut about: Vec<Vect<D>> = all.iter().map(|s| 0.5 * (s.low + s.high)).collect();
        for rim in rims.iter().filter(|r| r.skins[0] == r.skins[1]) {
            about[rim.skins[0]] = rim.centre(points);
        }
        let mut sums = vec![[0.0; 2]; count];
        for (k, skin) in of_element.into_iter().enumerate() {
            let arm = elements.centre[k] - about[skin];
            let [outwards, size] = &mut sums[skin];
            *outwards += arm.dot(&elements.normal[k]) * elements.measure[k];
            *size += arm.norm() * elements.measure[k];
            all[skin].open |= elements.open.get(k).is_some_and(|open| *open);
            all[skin].wall = all[skin].wall.min(elements.wall[k] as usize);
        }
        for (skin, [outwards, size]) in all.iter_mut().zip(sums) {
            skin.holds = outwards < -1e-6 * size;
        }
        Skins {
            all,
            rims,
            of_point,
        }
    }
}

impl<const D: usize> Rim<D> {
    /// Middle of the box around it, m.
    pub fn centre(&self, points: &[Vect<D>]) -> Vect<D> {
        let [low, high] = self.bounds(points);
        0.5 * (low + high)
    }

    /// Corners of the box around it, m.
    pub fn bounds(&self, points: &[Vect<D>]) -> [Vect<D>; 2] {
        box_around(self.nodes.iter().map(|n| &points[*n]))
    }
}

/// The skin of every point and of every element, and how many there are.
fn joined<const D: usize>(
    points: usize,
    corners: &[[u32; D]],
) -> (Vec<Option<usize>>, Vec<usize>, usize) {
    let mut root: Vec<usize> = (0..points).collect();
    fn find(root: &mut [usize], mut k: usize) -> usize {
        while root[k] != k {
            root[k] = root[root[k]];
            k = root[k];
        }
        k
    }
    for element in corners {
        let first = find(&mut root, element[0] as usize);
        for corner in &element[1..] {
            let other = find(&mut root, *corner as usize);
            root[other] = first;
        }
    }
    let mut number: BTreeMap<usize, usize> = BTreeMap::new();
    let mut of_element = Vec::with_capacity(corners.len());
    let mut of_point = vec![None; points];
    for element in corners {
        let (next, first) = (number.len(), find(&mut root, element[0] as usize));
        let skin = *number.entry(first).or_insert(next);
        of_element.push(skin);
        for corner in element {
            of_point[*corner as usize] = Some(skin);
        }
    }
    (of_point, of_element, number.len())
}

/// Ends of lines, each last one with the nearest first one.
fn ends<const D: usize>(
    points: &[Vect<D>],
    corners: &[[u32; D]],
    of_point: &[Option<usize>],
    domain: &Domain<D>,
) -> Vec<Rim<D>> {
    let mut counts = vec![[0u32; 2]; points.len()];
    for element in corners {
        counts[element[0] as usize][0] += 1;
        counts[element[1] as usize][1] += 1;
    }
    let counts = &counts;
    let free = |side: usize| {
        (0..counts.len()).filter(move |&k| counts[k][side] > 0 && counts[k][1 - side] == 0)
    };
    let way = |last: usize, first: usize| domain.nearest(points[first] - points[last]);
    let pairs = free(1).flat_map(|last| free(0).map(move |first| (last, first)));
    let mut pairs: Vec<(usize, usize)> = pairs.collect();
    let far = |pair: &(usize, usize)| way(pair.0, pair.1).norm_squared();
    pairs.sort_by(|a, b| far(a).total_cmp(&far(b)));
    let mut taken = vec![false; points.len()];
    let mut rims = Vec::new();
    for (last, first) in pairs {
        let skins = [last, first].map(|k| of_point[k]);
        let (false, [Some(a), Some(b)]) = (taken[last] || taken[first], skins) else {
            continue;
        };
        (taken[last], taken[first]) = (true, true);
        let along = way(last, first);
        let mut lid = Vect::zeros();
        (lid[0], lid[1]) = (-along[1], along[0]);
        rims.push(Rim {
            skins: [a, b],
            nodes: vec![last, first],
            lid,
        });
    }
    rims
}

/// Edges of one triangle alone, those that hang together as one.
fn holes<const D: usize>(
    points: &[Vect<D>],
    corners: &[[u32; D]],
    of_point: &[Option<usize>],
    domain: &Domain<D>,
) -> Vec<Rim<D>> {
    let mut edges: BTreeMap<[u32; 2], (u32, [u32; 2])> = BTreeMap::new();
    for element in corners {
        for k in 0..D {
            let way = [element[k], element[(k + 1) % D]];
            let key = [way[0].min(way[1]), way[0].max(way[1])];
            edges.entry(key).or_insert((0, way)).0 += 1;
        }
    }
    let free: Vec<[u32; 2]> = edges.values().filter(|e| e.0 == 1).map(|e| e.1).collect();
    let (rim_of, of_edge, count) = joined(points.len(), &free);
    let none = |_| Rim {
        skins: [0; 2],
        nodes: Vec::new(),
        lid: Vect::zeros(),
    };
    let mut rims: Vec<Rim<D>> = (0..count).map(none).collect();
    for (node, rim) in rim_of.iter().enumerate() {
        if let (Some(rim), Some(skin)) = (rim, of_point[node]) {
            rims[*rim].nodes.push(node);
            rims[*rim].skins = [skin; 2];
        }
    }
    let centres: Vec<Vect<D>> = rims.iter().map(|rim| rim.centre(points)).collect();
    for ([from, to], rim) in free.iter().zip(of_edge) {
        // The lid is travelled the other way round than the triangles beside it.
        let [to, from] = [to, from].map(|k| points[*k as usize]);
        let (a, b) = (to - centres[rim], domain.nearest(from - to));
        let next = |k: usize| (k + 1) % D;
        for k in 0..D {
            let (i, j) = (next(k), next(next(k)));
            rims[rim].lid[k] += 0.5 * (a[i] * b[j] - a[j] * b[i]);
        }
    }
    rims
}
