//! The nearest wall element of a point, by a tree.

use sph_core::{BoxTree, Vect};
use sph_neighbours::{Domain, WallSet, World};

/// Boxes around the elements of walls, for the true distance to the nearest of them, periodic images included.
#[derive(Clone, Debug)]
pub(crate) struct ElementTree<const D: usize> {
    corners: Vec<[Vect<D>; D]>,
    /// Number of each in the set of walls.
    element: Vec<u32>,
    tree: BoxTree<D>,
    shifts: Vec<Vect<D>>,
}

impl<const D: usize> ElementTree<D> {
    /// Of the present places of all elements that count.
    pub fn new(walls: &WallSet<D>, domain: &Domain<D>, counts: impl Fn(usize) -> bool) -> Self {
        let (elements, places) = (&walls.elements, &walls.points.position);
        let whole = |s: &u32| {
            let corners = elements.corners[*s as usize].map(|c| places[c as usize]);
            corners.map(|c| corners[0] + domain.nearest_image(c - corners[0]))
        };
        let all = 0..elements.centre.len();
        let element: Vec<u32> = all.filter(|s| counts(*s)).map(|s| s as u32).collect();
        let corners: Vec<[Vect<D>; D]> = element.iter().map(whole).collect();
        let around = |corners: &[Vect<D>; D]| {
            let low = corners[1..].iter().fold(corners[0], |low, c| low.inf(c));
            let high = corners[1..].iter().fold(corners[0], |high, c| high.sup(c));
            [low.into(), high.into()]
        };
        let boxes = corners.iter().map(around).collect();
        let middle = |_: &_, k: usize, axis: usize| corners[k].iter().map(|c| c[axis]).sum::<f64>();
        ElementTree {
            tree: BoxTree::by_middles(boxes, middle),
            element,
            shifts: shifts(domain),
            corners,
        }
    }

    /// Distance, m, to the nearest element and its number, if nearer than `within`.
    pub fn nearest(&self, x: &Vect<D>, within: f64) -> Option<(f64, u32)> {
        let mut best = None;
        for shift in &self.shifts {
            let x = x + shift;
            let within2 = best.map_or(within * within, |(squared, _)| squared);
            let squared = |k: usize| squared_distance(&x, &self.corners[k]);
            best = self.tree.nearest(x.into(), within2, squared).or(best);
        }
        best.map(|(squared, k)| (squared.sqrt(), self.element[k]))
    }
}

/// A tree that is kept while the walls stay.
#[derive(Default)]
pub(crate) struct KeptTree<const D: usize>(
    /// With the places of the wall points that it is of.
    Option<(ElementTree<D>, Vec<Vect<D>>)>,
);

impl<const D: usize> KeptTree<D> {
    /// Of the present places of all elements that count.
    pub fn updated(&mut self, world: &World<D>, counts: impl Fn(usize) -> bool) -> &ElementTree<D> {
        let (walls, places) = (&world.walls, &world.walls.points.position);
        self.0.take_if(|(_, of)| of != places);
        let tree = || ElementTree::new(walls, &world.domain, counts);
        &self.0.get_or_insert_with(|| (tree(), places.clone())).0
    }
}

/// Moves to the images of a point: none, and one period either way along each periodic axis and each diagonal.
fn shifts<const D: usize>(domain: &Domain<D>) -> Vec<Vect<D>> {
    let mut all = vec![Vect::zeros()];
    for axis in (0..D).filter(|k| domain.periodic[*k]) {
        let mut step = Vect::<D>::zeros();
        step[axis] = domain.length(axis);
        let moved: Vec<_> = all.iter().flat_map(|s| [s + step, s - step]).collect();
        all.extend(moved);
    }
    all
}

/// |x − c|² to the nearest point c of a segment (D = 2) or a triangle (D = 3), m².
fn squared_distance<const D: usize>(x: &Vect<D>, corners: &[Vect<D>; D]) -> f64 {
    match corners.as_slice() {
        [a, b] => of_segment(x, a, b),
        [a, b, c] => of_triangle(x, a, b, c),
        _ => f64::INFINITY,
    }
}

fn of_segment<const D: usize>(x: &Vect<D>, a: &Vect<D>, b: &Vect<D>) -> f64 {
    let (along, from) = (b - a, x - a);
    let length = along.norm_squared();
    let share = match length > 0.0 {
        true => (from.dot(&along) / length).clamp(0.0, 1.0),
        false => 0.0,
    };
    (from - along * share).norm_squared()
}

/// The foot on the plane where it lies within the triangle, else the nearest point of an edge.
fn of_triangle<const D: usize>(x: &Vect<D>, a: &Vect<D>, b: &Vect<D>, c: &Vect<D>) -> f64 {
    let (ab, ac, ax) = (b - a, c - a, x - a);
    let [bb, bc, cc] = [ab.dot(&ab), ab.dot(&ac), ac.dot(&ac)];
    let [xb, xc] = [ax.dot(&ab), ax.dot(&ac)];
    let area = bb * cc - bc * bc;
    if area > 0.0 {
        let share = [(cc * xb - bc * xc) / area, (bb * xc - bc * xb) / area];
        if share[0] >= 0.0 && share[1] >= 0.0 && share[0] + share[1] <= 1.0 {
            return (ax - ab * share[0] - ac * share[1]).norm_squared();
        }
    }
    let edges = [(a, b), (b, c), (c, a)];
    let each = edges.map(|(from, to)| of_segment(x, from, to));
    each.into_iter().fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A polygon's edges, one element each.
    fn ring(sides: usize) -> WallSet<2> {
        let mut walls = WallSet::<2>::default();
        for k in 0..sides {
            let angle = std::f64::consts::TAU * k as f64 / sides as f64;
            let point = Vect::from([angle.cos(), angle.sin()]);
            walls.points.position.push(point);
            let corners = [k as u32, ((k + 1) % sides) as u32];
            walls.elements.corners.push(corners);
            walls.elements.centre.push(point);
        }
        walls
    }

    #[test]
    fn it_finds_what_looking_at_all_of_them_finds() {
        let walls = ring(61);
        let domain = Domain::open(Vect::repeat(-5.0), Vect::repeat(5.0));
        let tree = ElementTree::new(&walls, &domain, |_| true);
        for k in 0..200 {
            let (angle, radius) = (0.731 * f64::from(k), 0.013 * f64::from(k));
            let x = Vect::from([radius * angle.cos(), radius * angle.sin()]);
            let each = walls.elements.corners.iter();
            let each = each.map(|c| c.map(|c| walls.points.position[c as usize]));
            let exact = each.map(|c| squared_distance(&x, &c).sqrt());
            let exact = exact.fold(f64::INFINITY, f64::min);
            let found = tree.nearest(&x, 10.0).expect("an element").0;
            assert!((found - exact).abs() < 1e-14, "{k}: {found}, {exact}");
        }
        assert_eq!(tree.nearest(&Vect::zeros(), 0.5), None);
    }

    #[test]
    fn images_across_a_period_count_and_walls_may_be_left_out() {
        let mut walls = WallSet::<2>::default();
        walls.points.position = [[0.1, 0.0], [0.1, 1.0]].map(Vect::from).to_vec();
        walls.elements.corners = vec![[0, 1]];
        walls.elements.centre = vec![Vect::from([0.1, 0.5])];
        let domain = Domain {
            lower: Vect::zeros(),
            upper: Vect::from([2.0, 2.0]),
            periodic: [true, false],
        };
        let tree = ElementTree::new(&walls, &domain, |_| true);
        let found = tree.nearest(&Vect::from([1.9, 0.5]), 5.0).expect("one");
        assert!((found.0 - 0.2).abs() < 1e-15 && found.1 == 0);
        let none = ElementTree::new(&walls, &domain, |_| false);
        assert_eq!(none.nearest(&Vect::zeros(), 5.0), None);
    }

    #[test]
    fn segments_end_at_their_ends() {
        let segment = [Vect::from([0.0, 0.0]), Vect::from([2.0, 0.0])];
        let at = |x, y| squared_distance(&Vect::from([x, y]), &segment).sqrt();
        assert_eq!(at(1.0, 0.5), 0.5);
        assert_eq!(at(-3.0, 4.0), 5.0);
        assert_eq!(at(5.0, -4.0), 5.0);
    }

    #[test]
    fn triangles_have_a_face_edges_and_corners() {
        let at = |x: [f64; 3]| {
            let corners = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
            squared_distance(&Vect::from(x), &corners.map(Vect::from)).sqrt()
        };
        assert_eq!(at([1.0, 1.0, -2.0]), 2.0);
        assert_eq!(at([2.0, -3.0, 4.0]), 5.0);
        assert!((at([3.0, 3.0, 1.0]) - 3f64.sqrt()).abs() < 1e-15);
        assert_eq!(at([-3.0, 0.0, 4.0]), 5.0);
        // A triangle without an area is its edges.
        let flat = [[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]].map(Vect::from);
        assert_eq!(squared_distance(&Vect::from([3.0, 0.0, 0.0]), &flat), 1.0);
    }
}
