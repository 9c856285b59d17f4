//! Many unit blocks stacked at random in a tank: everything about them can be counted.

use sph_boundary::{Mesh, PeriodicBox, Pose, Surface};

use crate::close;
use crate::surface::shapes::*;
use crate::vector::unit;

const SIDE: usize = 4;

struct Stack {
    solid: [[[bool; SIDE]; SIDE]; SIDE],
    /// Whether the sides along x and y are periodic.
    wraps: bool,
}

impl Stack {
    fn new(seed: u64, part: f64, wraps: bool) -> Self {
        let mut random = Random(seed);
        let mut stack = Stack {
            solid: [[[false; SIDE]; SIDE]; SIDE],
            wraps,
        };
        for solid in stack.solid.iter_mut().flatten().flatten() {
            *solid = random.next() < part;
        }
        // A block covered on all sides is refused.
        let mut cells = stack.cells();
        cells.sort_unstable();
        for cell in cells {
            let [x, y, z] = cell.map(|i| i as usize);
            stack.solid[x][y][z] &= stack.open_sides(cell) > 0;
        }
        stack
    }

    /// Whether the fluid is in a cell; not beyond the tank.
    fn fluid(&self, mut cell: [i32; 3]) -> bool {
        let side = SIDE as i32;
        if self.wraps {
            cell[0] = cell[0].rem_euclid(side);
            cell[1] = cell[1].rem_euclid(side);
        }
        let within = cell.iter().all(|i| (0..side).contains(i));
        within && {
            let [x, y, z] = cell.map(|i| i as usize);
            !self.solid[x][y][z]
        }
    }

    /// Sides of a cell beyond which there is fluid.
    fn open_sides(&self, cell: [i32; 3]) -> usize {
        let beside = |k: usize, step: i32| {
            let mut other = cell;
            other[k] += step;
            self.fluid(other)
        };
        let both = |k: usize| usize::from(beside(k, 1)) + usize::from(beside(k, -1));
        (0..3).map(both).sum()
    }

    fn cells(&self) -> Vec<[i32; 3]> {
        let side = SIDE as i32;
        let cell = |n: i32| [n % side, n / side % side, n / side / side];
        (0..side.pow(3)).map(cell).collect()
    }

    /// Faces between fluid and solid, each of unit area.
    fn area(&self) -> usize {
        let fluid = self.cells().into_iter().filter(|c| self.fluid(*c));
        fluid.map(|c| 6 - self.open_sides(c)).sum()
    }

    fn walls(&self) -> Vec<Surface> {
        let side = SIDE as f64;
        let mut tank = tank([0.0; 3], [side; 3]);
        if self.wraps {
            // Floor and roof alone.
            tank.triangles.truncate(4);
        }
        let mut walls = vec![tank];
        for cell in self.cells().into_iter().filter(|c| !self.fluid(*c)) {
            let low = cell.map(f64::from);
            let name = format!("block {cell:?}");
            walls.push(block(&name, low, low.map(|x| x + 1.0)));
        }
        walls
    }

    fn check(&self, mesh: &Mesh<3>, place: impl Fn(Point) -> Point, back: impl Fn(Point) -> Point) {
        assert!(mesh.free_edges.is_empty());
        let expected = self.area() as f64;
        close(area(mesh), expected, 1e-10, "area");
        let sizes: f64 = mesh.nodes.iter().map(|n| n.size).sum();
        close(sizes * mesh.spacing.powi(2), expected, 1e-9, "sizes");
        for node in &mesh.nodes {
            let at = back(node.position);
            // The fluid in the eight octants around the node.
            let octant = |n: i32| {
                let step = |k: i32| if n >> k & 1 == 1 { 0.01 } else { -0.01 };
                let p = [at[0] + step(0), at[1] + step(1), at[2] + step(2)];
                self.fluid(p.map(|x| x.floor() as i32))
            };
            let expected = (0..8).filter(|n| octant(*n)).count() as f64 / 8.0;
            close(node.theta, expected, 1e-12, at);
        }
        for cell in self.cells() {
            let centre = place(cell.map(|i| f64::from(i) + 0.5));
            assert_eq!(mesh.contains(centre), self.fluid(cell), "{cell:?}");
        }
    }
}

#[test]
fn areas_and_angles_of_stacks_in_a_tank() {
    let mut triangles = 0;
    for seed in 1..40 {
        let stack = Stack::new(seed * 977, 0.1 + 0.01 * seed as f64, false);
        let mesh = mesh(&stack.walls(), 0.5);
        stack.check(&mesh, |p| p, |p| p);
        assert!(leak(&mesh) < 1e-12);
        // A lattice throughout: its cells are halves of squares.
        let measures = mesh.elements.iter().map(|t| t.measure);
        measures.for_each(|area| close(area, 0.125, 1e-14, seed));
        triangles += mesh.elements.len();
    }
    println!("{triangles} triangles of 39 stacks");
}

#[test]
fn areas_and_angles_of_stacks_turned_out_of_the_axes() {
    for seed in 1..30 {
        let stack = Stack::new(seed * 1009, 0.3, false);
        let mut random = Random(seed);
        let translation = random.within([-3.0; 3], [3.0; 3]);
        let axis = random.within([-1.0; 3], [1.0; 3]);
        let pose = Pose {
            translation,
            ..Pose::turned_about(unit(axis), 3.0 * random.next(), [1.0; 3])
        };
        let mut walls = stack.walls();
        for p in walls.iter_mut().flat_map(|w| &mut w.points) {
            *p = pose.map()(*p);
        }
        let mesh = mesh(&walls, 0.37);
        let back = |p: Point| {
            let moved = [0, 1, 2].map(|k| p[k] - pose.centre[k] - pose.translation[k]);
            let columns = [0, 1, 2].map(|k| [0, 1, 2].map(|i| pose.rotation[i][k]));
            [0, 1, 2].map(|k| pose.centre[k] + dot(columns[k], moved))
        };
        stack.check(&mesh, pose.map(), back);
        assert!(leak(&mesh) < 1e-12);
    }
}

#[test]
fn areas_and_angles_of_stacks_across_periods() {
    let domain = periodic([0.0; 3], [SIDE as f64; 3], [true, true, false]);
    for seed in 1..30 {
        let stack = Stack::new(seed * 31, 0.3, true);
        let mesh = mesh_in(&stack.walls(), 0.5, &domain);
        stack.check(&mesh, |p| p, |p| p);
    }
}

#[test]
fn stacks_of_other_groups_are_left_as_they_are() {
    let stack = Stack::new(5, 0.3, false);
    let walls = stack.walls();
    let groups: Vec<usize> = (0..walls.len()).collect();
    let mesh = Mesh::<3>::build(&walls, &groups, 0.5, &PeriodicBox::none()).unwrap();
    assert!((area(&mesh) - 6.0 * (15 + walls.len()) as f64).abs() < 1e-10);
    let side = SIDE as i32;
    for cell in stack.cells() {
        let centre = cell.map(|i| f64::from(i) + 0.5);
        assert_eq!(mesh.contains(centre), stack.fluid(cell));
    }
    assert!(!mesh.contains([side as f64 + 0.5; 3]));
}
