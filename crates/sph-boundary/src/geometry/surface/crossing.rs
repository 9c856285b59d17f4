//! Triangles that cross or cover each other.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};

use sph_core::BoxTree;

use super::drawn::{Drawn, Surface, no_thickness};
use crate::error::{BoundaryError, MOST_PAIRS, Place, Result};
use crate::geometry::periodic::PeriodicBox;
use crate::geometry::vector::{Point, add, along, bounds, cross, dot, norm, sub, unit};
use crate::parallel::*;

/// Two triangles of different walls of one group that cover each other face to face: `other`,
/// moved by `image`, lies on `triangle`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Contact {
    pub triangle: u32,
    pub other: u32,
    pub image: [i32; 3],
}

enum Intersection {
    Cross(Point),
    /// They lie in one plane and cover each other, with equal or opposite normals.
    Cover {
        opposite: bool,
        at: Point,
    },
}

/// Contacts of walls face to face; refuses triangles that cross and pieces drawn twice.
///
/// Walls of different groups may cover each other, but not cross. A corner within `tolerance` of
/// the other triangle's plane is on it.
pub(super) fn contacts(
    surfaces: &[Surface],
    drawn: &[Drawn],
    tolerance: f64,
    domain: &PeriodicBox<3>,
) -> Result<Vec<Contact>> {
    let boxes: Vec<_> = drawn.iter().map(|d| bounds(d.places)).collect();
    let tree = BoxTree::new(boxes.clone());
    let pairs = AtomicUsize::new(0);
    // Triangle `t`, moved, against all others; every pair of images comes up once.
    let about = |t: usize| -> Result<Vec<Contact>> {
        let mut found = Vec::new();
        let images = domain.images_within(tree.bounds(), boxes[t]);
        for image in images.filter(|image| *image >= [0; 3]) {
            let shift = domain.shift(image);
            let query = boxes[t].map(|corner| add(corner, shift));
            let whole = tree.overlapping(query, &mut |other| {
                if image != [0; 3] || other > t {
                    found.push((other, image));
                }
                match pairs.fetch_add(1, Ordering::Relaxed) < MOST_PAIRS {
                    true => ControlFlow::Continue(()),
                    false => ControlFlow::Break(()),
                }
            });
            if whole.is_break() {
                let wall = &surfaces[drawn[t].wall].name;
                return Err(BoundaryError::tangled("triangles", wall));
            }
        }
        found.sort_unstable();
        let mut contacts = Vec::new();
        for (other, image) in found {
            let both = [&drawn[t], &drawn[other]];
            let shift = domain.shift(image);
            if touch(surfaces, both, shift, tolerance)? {
                contacts.push(Contact {
                    triangle: t as u32,
                    other: other as u32,
                    image: image.map(|n| -n),
                });
            }
        }
        Ok(contacts)
    };
    // Some at a time, so that a tangle is refused at its first crossing.
    let (mut contacts, mut done, mut next) = (Vec::new(), 0, 64);
    while done < drawn.len() {
        let end = (done + next).min(drawn.len());
        let all: Vec<_> = (done..end).into_par_iter().map(about).collect();
        for some in all {
            contacts.extend(some?);
        }
        (done, next) = (end, 2 * next);
    }
    Ok(contacts)
}

/// True if two triangles of walls that move together touch, the first one moved by a shift.
///
/// # Errors
/// If they cross, or one covers the other where it must not.
fn touch(surfaces: &[Surface], [a, b]: [&Drawn; 2], shift: Point, tolerance: f64) -> Result<bool> {
    let moved = a.places.map(|p| add(p, shift));
    let meeting = meet((moved, a.normal), (b.places, b.normal), tolerance);
    let together = a.group == b.group;
    match meeting {
        None => Ok(false),
        Some(Intersection::Cross(at)) => {
            let both = [a, b].map(|d| (&surfaces[d.wall].name[..], d.index));
            Err(BoundaryError::crossing("triangle", both, at))
        }
        Some(Intersection::Cover { opposite, at }) if together && !opposite => {
            let ([wall, other], at) = ([a, b].map(|d| &surfaces[d.wall].name), Place::from(at));
            Err(BoundaryError(format!(
                "triangle {} of wall `{wall}` and triangle {} of wall `{other}` cover each other near {at}: that piece \
                 is drawn twice",
                a.index, b.index
            )))
        }
        Some(Intersection::Cover { opposite, at }) if opposite && a.wall == b.wall => {
            Err(no_thickness(&surfaces[a.wall].name, [a, b], at))
        }
        Some(Intersection::Cover { .. }) => Ok(together),
    }
}

fn meet(
    (a, normal_a): ([Point; 3], Point),
    (b, normal_b): ([Point; 3], Point),
    tolerance: f64,
) -> Option<Intersection> {
    let over_b = a.map(|p| dot(sub(p, b[0]), normal_b));
    let over_a = b.map(|p| dot(sub(p, a[0]), normal_a));
    let flat = |heights: [f64; 3]| heights.iter().all(|h| h.abs() <= tolerance);
    if flat(over_a) && flat(over_b) {
        let opposite = dot(normal_a, normal_b) < 0.0;
        let place = common_place(a, normal_a, b, tolerance);
        return place.map(|at| Intersection::Cover { opposite, at });
    }
    let straddles = |heights: [f64; 3]| {
        heights.iter().any(|h| *h > tolerance) && heights.iter().any(|h| *h < -tolerance)
    };
    if !(straddles(over_a) && straddles(over_b)) {
        return None;
    }
    // Both cut the line common to both planes; they cross if the pieces they cut out overlap.
    let line = unit(cross(normal_a, normal_b));
    let [first, second] = [cut(a, over_b, line), cut(b, over_a, line)];
    let larger = |a: (f64, Point), b: (f64, Point)| if a.0 > b.0 { a } else { b };
    let smaller = |a: (f64, Point), b: (f64, Point)| if a.0 < b.0 { a } else { b };
    let (from, to) = (larger(first[0], second[0]), smaller(first[1], second[1]));
    let apart = to.0 - from.0 <= 4.0 * tolerance;
    (!apart).then(|| Intersection::Cross(along(from.1, 0.5, sub(to.1, from.1))))
}

/// The piece of a line that a triangle cuts out of it: both ends with their coordinate along it.
fn cut(triangle: [Point; 3], heights: [f64; 3], line: Point) -> [(f64, Point); 2] {
    let mut ends = [
        (f64::INFINITY, triangle[0]),
        (f64::NEG_INFINITY, triangle[0]),
    ];
    for i in 0..3 {
        let j = (i + 1) % 3;
        if (heights[i] < 0.0) == (heights[j] < 0.0) {
            continue;
        }
        let part = heights[i] / (heights[i] - heights[j]);
        let at = along(triangle[i], part, sub(triangle[j], triangle[i]));
        let x = dot(at, line);
        if x < ends[0].0 {
            ends[0] = (x, at);
        }
        if x > ends[1].0 {
            ends[1] = (x, at);
        }
    }
    ends
}

/// A place inside both of two triangles of one plane, if they have more than a line in common.
fn common_place(a: [Point; 3], normal: Point, b: [Point; 3], tolerance: f64) -> Option<Point> {
    // What is left of b after cutting along the edges of a.
    let mut rest: Vec<Point> = b.to_vec();
    let mut longest: f64 = 0.0;
    for i in 0..3 {
        let edge = sub(a[(i + 1) % 3], a[i]);
        longest = longest.max(norm(edge));
        let inwards = unit(cross(normal, edge));
        let height = |p: Point| dot(sub(p, a[i]), inwards);
        let mut kept = Vec::with_capacity(rest.len() + 1);
        for (n, p) in rest.iter().enumerate() {
            let q = rest[(n + 1) % rest.len()];
            let (hp, hq) = (height(*p), height(q));
            if hp >= 0.0 {
                kept.push(*p);
            }
            if (hp >= 0.0) != (hq >= 0.0) {
                kept.push(along(*p, hp / (hp - hq), sub(q, *p)));
            }
        }
        rest = kept;
        if rest.len() < 3 {
            return None;
        }
    }
    let fan = (2..rest.len()).map(|k| cross(sub(rest[k - 1], rest[0]), sub(rest[k], rest[0])));
    let area = 0.5 * fan.map(|n| dot(n, normal).abs()).sum::<f64>();
    let part = 1.0 / rest.len() as f64;
    let centre = rest.iter().fold([0.0; 3], |sum, p| along(sum, part, *p));
    (area > 4.0 * tolerance * longest).then_some(centre)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn meeting(b: [Point; 3]) -> Option<Intersection> {
        let a = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]];
        let normal = unit(crate::geometry::vector::double_area(b));
        meet((a, [0.0, 0.0, 1.0]), (b, normal), 1e-6)
    }

    #[test]
    fn touching_is_not_crossing() {
        let standing = |z: f64| [[0.5, 0.5, z], [1.0, 0.5, z], [0.5, 0.5, z + 1.0]];
        let crosses = |b| matches!(meeting(b), Some(Intersection::Cross(_)));
        assert!(meeting(standing(0.0)).is_none());
        assert!(meeting(standing(-1e-7)).is_none());
        assert!(crosses(standing(-0.5)));
        let beside = [[2.0, 0.0, 0.0], [2.0, 2.0, 0.0], [0.0, 2.0, 0.0]];
        assert!(meeting(beside).is_none());
        let within = [[0.5, 0.5, 0.0], [0.5, 0.7, 0.0], [0.7, 0.5, 0.0]];
        let covers = |i| matches!(i, Intersection::Cover { opposite: true, .. });
        assert!(meeting(within).is_some_and(covers));
        // It has a corner in common and goes through.
        let through = [[0.0, 0.0, 0.0], [1.0, 1.0, -1.0], [1.0, 1.0, 1.0]];
        assert!(crosses(through));
    }
}
