//! Pieces of walls that bound the fluid: without the places where walls touch face to face, and where more than two
//! meet in an edge.

use std::collections::{BTreeMap, BTreeSet, HashSet};

use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay::{Overlay, ShapeType};
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::i_float::int::point::IntPoint;
use sph_core::Sets;

use super::crossing::Contact;
use super::edges::Cuts;
use super::patches::Patch;
use super::places::{EdgeKey, Places, Site, edge_key};
use crate::geometry::junctions::{AdjacentFace, bound_fluid, wedges};
use crate::geometry::vector::{Plane, cross, dot, norm, sub};

#[derive(Default)]
pub(super) struct FaceContacts {
    /// Edges of the pieces that touched, as they were.
    pub edges: HashSet<EdgeKey>,
    /// By piece: true if it is the rest of one that touched.
    pub pieces: Vec<bool>,
}

/// By piece, whether it bounds the fluid.
///
/// Around an edge a wedge of fluid lies between two faces that look at each other, and these belong together. Where an
/// open face or another wall closes a pipe that has a thickness, three faces meet: the pipe within, its end, and the
/// closing face. The first and the last hold the fluid; the end, and what hangs together with it, is the outside of the
/// pipe. It ends there on the back of another wall, so that no fluid can be before it.
pub(super) fn wetted_pieces(pieces: &[Patch], cuts: &Cuts<'_>, met: &FaceContacts) -> Vec<bool> {
    let mut runs: BTreeMap<EdgeKey, Vec<(usize, bool)>> = BTreeMap::new();
    for (piece, patch) in pieces.iter().enumerate() {
        for edge in &patch.boundary {
            for ends in cuts.along(*edge).windows(2) {
                let (key, forward, _) = edge_key(ends[0], ends[1]);
                runs.entry(key).or_default().push((piece, forward));
            }
        }
    }
    let mut parts = Sets::new(pieces.len());
    // Pieces that nothing continues, each with those that do go on there.
    let mut severed: Vec<(usize, Vec<usize>)> = Vec::new();
    for (key, run) in &runs {
        let pairs = match run[..] {
            [(piece, _)] => {
                if met.edges.contains(key) {
                    let others = (0..pieces.len()).filter(|p| met.pieces[*p]);
                    severed.push((piece, others.collect()));
                }
                continue;
            }
            [(a, with), (b, other)] if with != other => vec![[a, b]],
            _ => wedges(around(pieces, cuts.places, key, run)),
        };
        pairs.iter().for_each(|pair| parts.join(*pair));
        let joined: Vec<usize> = pairs.into_iter().flatten().collect();
        let alone = run.iter().filter(|(piece, _)| !joined.contains(piece));
        severed.extend(alone.map(|(piece, _)| (*piece, joined.clone())));
    }
    bound_fluid(parts, pieces.len(), &severed)
}

fn around(
    pieces: &[Patch],
    places: &Places,
    key: &EdgeKey,
    run: &[(usize, bool)],
) -> Vec<AdjacentFace> {
    let along = sub(places.at(key.second), places.positions[key.first as usize]);
    let direction = |(piece, with): (usize, bool)| {
        let inwards = cross(pieces[piece].normal, along);
        if with { inwards } else { inwards.map(|c| -c) }
    };
    let first = direction(run[0]);
    let beside = |&(piece, with): &(usize, bool)| {
        let own = direction((piece, with));
        let sine = dot(along, cross(first, own)) / norm(along);
        AdjacentFace {
            piece,
            with,
            angle: sine.atan2(dot(first, own)),
        }
    };
    run.iter().map(beside).collect()
}

/// Bits of the whole numbers that span a patch: 2⁻⁴⁴ of its size is the resolution.
const BITS: i32 = 44;

/// Takes from every patch the part that patches of other walls cover with opposite normals.
///
/// The difference of polygons is taken in whole numbers; corners that come out of it are welded to
/// those that are known, so that the rests of both walls meet in the same edges. Returns where they touched.
pub(super) fn remove_contacts(
    patches: &mut Vec<Patch>,
    patch_of: &[u32],
    contacts: &[Contact],
    places: &mut Places,
) -> FaceContacts {
    let mut covers: BTreeMap<u32, BTreeSet<(u32, [i32; 3])>> = BTreeMap::new();
    for contact in contacts {
        let [a, b] = [contact.triangle, contact.other].map(|t| patch_of[t as usize]);
        covers.entry(a).or_default().insert((b, contact.image));
        let back = contact.image.map(|n| -n);
        covers.entry(b).or_default().insert((a, back));
    }
    if covers.is_empty() {
        return FaceContacts::default();
    }
    let covered = covers.keys().flat_map(|p| &patches[*p as usize].boundary);
    let edges = covered.map(|[a, b]| edge_key(*a, *b).0).collect();
    let mut rest = |p: u32, others| difference(p as usize, others, patches, places);
    let left = covers.iter().map(|(p, others)| (*p, rest(*p, others)));
    let left: BTreeMap<u32, Vec<Patch>> = left.collect();
    let mut pieces = Vec::new();
    for (p, patch) in std::mem::take(patches).into_iter().enumerate() {
        let rest = left.get(&(p as u32));
        patches.extend(rest.cloned().unwrap_or_else(|| vec![patch]));
        pieces.resize(patches.len(), rest.is_some());
    }
    FaceContacts { edges, pieces }
}

/// The rest of a patch without others, each moved by whole periods.
fn difference(
    patch: usize,
    others: &BTreeSet<(u32, [i32; 3])>,
    patches: &[Patch],
    places: &mut Places,
) -> Vec<Patch> {
    let whole = &patches[patch];
    let [from, to] = whole.boundary[0].map(|c| places.at(c));
    let plane = Plane::along(sub(to, from), whole.origin, whole.normal);
    let loops_of = |other: &Patch, image: [i32; 3], places: &Places| -> Vec<Vec<[f64; 2]>> {
        let point = |c: &Site| plane.foot(places.at(c.moved(image)));
        let contour = |corners: &Vec<Site>| corners.iter().map(point).collect();
        other.loops().iter().map(contour).collect()
    };
    let own = loops_of(whole, [0; 3], places);
    let theirs = others.iter();
    let theirs = theirs.flat_map(|(p, image)| loops_of(&patches[*p as usize], *image, places));
    let theirs: Vec<_> = theirs.collect();
    let numbers = own.iter().chain(&theirs).flatten().flatten();
    let size = numbers.fold(f64::MIN_POSITIVE, |m: f64, x| m.max(x.abs()));
    // A power of two: no rounding but that to whole numbers.
    let scale = f64::powi(2.0, BITS - size.log2().ceil() as i32);
    let whole_numbers = |contour: &Vec<[f64; 2]>| -> Vec<IntPoint<i64>> {
        let point = |x: &[f64; 2]| {
            let [x, y] = x.map(|x| (x * scale).round() as i64);
            IntPoint::new(x, y)
        };
        contour.iter().map(point).collect()
    };
    let count = own.iter().chain(&theirs).map(Vec::len).sum();
    let mut overlay = Overlay::<i64>::new(count);
    for contour in &own {
        overlay.add_contour(&whole_numbers(contour), ShapeType::Subject);
    }
    for contour in &theirs {
        overlay.add_contour(&whole_numbers(contour), ShapeType::Clip);
    }
    let shapes = overlay.overlay(OverlayRule::Difference, FillRule::NonZero);
    let mut left = Vec::new();
    for shape in shapes {
        let mut edges: BTreeMap<[Site; 2], i32> = BTreeMap::new();
        for contour in &shape {
            let corner = |p: &IntPoint<i64>| {
                let x = [p.x as f64 / scale, p.y as f64 / scale];
                places.find(plane.place(x), whole.group)
            };
            let corners: Vec<Site> = contour.iter().map(corner).collect();
            for (k, a) in corners.iter().enumerate() {
                let b = corners[(k + 1) % corners.len()];
                // Slivers of rounding collapse: their edges run back and forth, or nowhere.
                match edges.get_mut(&[b, *a]) {
                    _ if *a == b => {}
                    Some(back) if *back > 0 => *back -= 1,
                    _ => *edges.entry([*a, b]).or_default() += 1,
                }
            }
        }
        let all = edges.into_iter();
        let all = all.flat_map(|(edge, times)| std::iter::repeat_n(edge, times as usize));
        let boundary: Vec<[Site; 2]> = all.collect();
        if boundary.len() >= 3 {
            left.push(Patch {
                boundary,
                ..whole.clone()
            });
        }
    }
    left
}
