//! Ends of open walls at the same place.

use sph_core::BoxTree;

use crate::error::{BoundaryError, Place, Result};
use crate::geometry::vector::{add, sub, widened};
use crate::{PeriodicBox, Polyline, WallEnd};

/// Continuation of a wall behind its last point: the first point of a wall, moved by whole periods.
pub(super) type Continuation = Option<(usize, [i32; 2])>;

/// For every wall, the continuation of its last point, and true if its first point is free.
pub(super) struct Joints {
    pub after: Vec<Continuation>,
    pub starts_free: Vec<bool>,
}

struct OpenEnd {
    wall: usize,
    end: WallEnd,
    position: [f64; 2],
}

pub(super) fn joints(lines: &[Polyline], tolerance: f64, domain: &PeriodicBox) -> Result<Joints> {
    let alone = |(wall, line): (usize, &Polyline)| line.closed.then_some((wall, [0; 2]));
    let mut joints = Joints {
        after: lines.iter().enumerate().map(alone).collect(),
        starts_free: lines.iter().map(|line| !line.closed).collect(),
    };
    let ends = open_ends(lines);
    let wrapped = |end: &OpenEnd| domain.wrapped(end.position);
    let tree = BoxTree::new(ends.iter().map(|e| [wrapped(e); 2]).collect());
    for (i, end) in ends.iter().enumerate() {
        let met = |j: &usize| {
            let other = &ends[*j];
            let (image, rest) = domain.nearest(sub(end.position, other.position));
            (rest[0].hypot(rest[1]) <= tolerance).then_some((other, image))
        };
        let mut near = near(&tree, wrapped(end), tolerance, domain);
        near.retain(|j| *j != i);
        let met: Vec<(&OpenEnd, [i32; 2])> = near.iter().filter_map(met).collect();
        let name = |end: &OpenEnd| &lines[end.wall].name;
        let at = Place::from(end.position);
        match met.as_slice() {
            [] => {}
            [(other, _)] if other.end == end.end => {
                return Err(BoundaryError(format!(
                    "the {} end of wall `{}` meets the {} end of wall `{}` at {at}: their directions of travel put the \
                     fluid on opposite sides, reverse one of them",
                    end.end,
                    name(end),
                    other.end,
                    name(other)
                )));
            }
            [(other, image)] => {
                if end.end == WallEnd::Last {
                    joints.after[end.wall] = Some((other.wall, *image));
                    joints.starts_free[other.wall] = false;
                }
            }
            more => {
                let (count, wall) = (more.len() + 1, name(end));
                return Err(BoundaryError(format!(
                    "{count} ends of walls meet at {at}, the first of wall `{wall}`: only two can be joined"
                )));
            }
        }
    }
    Ok(joints)
}

/// Ends, moved into the periodic box, that may be at a place in it, ascending.
fn near(tree: &BoxTree<2>, place: [f64; 2], tolerance: f64, domain: &PeriodicBox) -> Vec<usize> {
    // Twice the tolerance: wrapping rounds.
    let around = widened([place; 2], 2.0 * tolerance);
    // A point just within one side of the box is at the place of one just within the other.
    let mut found = Vec::new();
    for image in domain.images_within([domain.lower, domain.upper], around) {
        let shift = domain.shift(image);
        tree.each(around.map(|corner| add(corner, shift)), |end| {
            found.push(end)
        });
    }
    found.sort_unstable();
    found.dedup();
    found
}

fn open_ends(polylines: &[Polyline]) -> Vec<OpenEnd> {
    let ends = |(wall, line): (usize, &Polyline)| {
        let last = line.points.len() - 1;
        [(WallEnd::First, 0), (WallEnd::Last, last)].map(|(end, k)| OpenEnd {
            wall,
            end,
            position: line.points[k],
        })
    };
    let open = polylines.iter().enumerate();
    let open = open.filter(|(_, line)| !line.closed);
    open.flat_map(ends).collect()
}
