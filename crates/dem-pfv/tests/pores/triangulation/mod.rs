//! What a regular triangulation is, and what is refused.

mod containers;
mod packings;
mod properties;
mod refusals;

use dem_pfv::triangulation::{Cell, Sphere, Triangulation, Vertex};
use nalgebra::Vector3;

/// Reproducible numbers in [0, 1).
struct Draw(u64);

impl Draw {
    fn unit(&mut self) -> f64 {
        let next = self.0.wrapping_mul(6_364_136_223_846_793_005);
        self.0 = next.wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// Spheres of which none holds the centre of another, so that none is hidden; many overlap.
fn random_spheres(n: usize, seed: u64) -> Vec<Sphere> {
    let mut draw = Draw(seed);
    let size = 0.4 / (n as f64).cbrt();
    let mut spheres: Vec<Sphere> = Vec::new();
    while spheres.len() < n {
        let centre = [(); 3].map(|()| 0.05 + 0.9 * draw.unit());
        let new = Sphere::new(centre, size * draw.unit());
        let free = |s: &Sphere| (s.centre - new.centre).norm() > s.radius.max(new.radius);
        if spheres.iter().all(free) {
            spheres.push(new);
        }
    }
    spheres
}

fn lattice(side: u32, step: f64) -> Vec<Sphere> {
    let at = |i: u32| (f64::from(i) + 0.5) * step;
    let site = |i: u32| [at(i % side), at(i / side % side), at(i / side / side)];
    let sphere = |i| Sphere::new(site(i), 0.5 * step);
    (0..side.pow(3)).map(sphere).collect()
}

/// Least power of any power centre to any sphere that is not a vertex of its cell, m².
fn least_power(mesh: &Triangulation) -> f64 {
    let mut least = f64::INFINITY;
    for (c, cell) in mesh.cells.iter().enumerate() {
        let centre = mesh.power_centre(c);
        let vertices = cell.vertices();
        let own = vertices.into_iter().find_map(Vertex::sphere);
        let own = mesh.spheres[own.expect("a cell has a sphere")].power(centre);
        for (k, s) in mesh.spheres.iter().enumerate() {
            if !vertices.contains(&Vertex::Sphere(k)) {
                least = least.min(s.power(centre) - own);
            }
        }
    }
    least
}

/// Six times the signed volume of a cell of four spheres, m³; positive if it is oriented as documented.
fn sixfold_volume(mesh: &Triangulation, cell: usize) -> f64 {
    let x = mesh.cells[cell].vertices().map(|v| match v {
        Vertex::Sphere(k) => mesh.spheres[k].centre,
        Vertex::Wall(_) => Vector3::repeat(f64::NAN),
    });
    -(x[1] - x[0]).cross(&(x[2] - x[0])).dot(&(x[3] - x[0]))
}

/// Neighbours name each other and share three vertices.
fn assert_consistent(mesh: &Triangulation) {
    for (c, cell) in mesh.cells.iter().enumerate() {
        for i in 0..4 {
            let Some(n) = cell.neighbour(i) else { continue };
            let other = &mesh.cells[n];
            assert!((0..4).any(|j| other.neighbour(j) == Some(c)));
            let (own, theirs) = (cell.vertices(), other.vertices());
            for k in (0..4).filter(|k| *k != i) {
                assert!(theirs.contains(&own[k]), "cells {c} and {n}");
            }
            assert!(!theirs.contains(&own[i]));
        }
    }
}

/// Cells as sets of vertices, in order.
fn canonical(mesh: &Triangulation) -> Vec<[Vertex; 4]> {
    renamed(mesh, |vertex| vertex)
}

/// The same under other names of the vertices.
fn renamed(mesh: &Triangulation, name: impl Fn(Vertex) -> Vertex) -> Vec<[Vertex; 4]> {
    let sorted = |cell: &Cell| {
        let mut vertices = cell.vertices().map(&name);
        vertices.sort();
        vertices
    };
    let mut cells: Vec<_> = mesh.cells.iter().map(sorted).collect();
    cells.sort();
    cells
}
