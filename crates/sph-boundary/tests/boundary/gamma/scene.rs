//! A geometry with everything needed to compare the closed form with the reference.

use sph_boundary::{ElementTree, GammaSum, Mesh, PeriodicBox, Polyline, Renormalisation2d};

use crate::gamma::kernels::TestKernel;
use crate::gamma::reference;

/// Smoothing length of all comparisons, m: not 1, so that a missing power of h is seen.
pub const H: f64 = 0.7;

pub struct Scene {
    pub loops: Vec<Vec<[f64; 2]>>,
    pub mesh: Mesh<2>,
    tree: ElementTree<2>,
    kernels: Vec<TestKernel>,
    renormalisations: Vec<Renormalisation2d>,
}

/// Largest errors per kernel.
#[derive(Clone)]
pub struct Errors {
    names: Vec<&'static str>,
    gamma: Vec<f64>,
    gradient: Vec<f64>,
}

impl Scene {
    pub fn new(loops: Vec<Vec<[f64; 2]>>, spacing: f64) -> Self {
        let lines: Vec<Polyline> = loops
            .iter()
            .enumerate()
            .map(|(i, points)| Polyline::closed(format!("wall {i}"), points.clone()))
            .collect();
        let mesh = Mesh::<2>::build(&lines, spacing, &PeriodicBox::none()).unwrap();
        let kernels = crate::gamma::kernels::all();
        let renormalisations: Vec<Renormalisation2d> = kernels
            .iter()
            .map(|k| Renormalisation2d::new(&k.shape, H).unwrap())
            .collect();
        let reach = renormalisations
            .iter()
            .map(|r| r.kernel_radius())
            .fold(0.0, f64::max);
        let tree = ElementTree::build(&mesh, reach);
        Self {
            loops,
            mesh,
            tree,
            kernels,
            renormalisations,
        }
    }

    pub fn sums(&self, point: [f64; 2]) -> Vec<GammaSum<2>> {
        self.renormalisations
            .iter()
            .map(|r| r.at(point, &self.mesh, &self.tree))
            .collect()
    }

    /// Compares with the reference at one point.
    pub fn compare(&self, point: [f64; 2], errors: &mut Errors) {
        let edges = reference::edges(&self.loops, point);
        let exact = reference::gammas(&edges, &self.kernels, H);
        for (k, sum) in self.sums(point).iter().enumerate() {
            let error = (sum.gamma() - exact[k]).abs();
            assert!(
                error < 1e-9,
                "{}: γ at {point:?} is {}, not {}, {sum:?}",
                errors.names[k],
                sum.gamma(),
                exact[k]
            );
            errors.gamma[k] = errors.gamma[k].max(error);
            let slope = reference::gradient(&edges, &self.kernels[k], H);
            let apart = (0..2).map(|i| H * sum.gradient[i] - slope[i]);
            errors.gradient[k] = apart.fold(errors.gradient[k], |e, x| e.max(x.abs()));
        }
    }
}

impl Errors {
    pub fn none() -> Self {
        let names: Vec<&'static str> = crate::gamma::kernels::all()
            .iter()
            .map(|k| k.name)
            .collect();
        Self {
            gamma: vec![0.0; names.len()],
            gradient: vec![0.0; names.len()],
            names,
        }
    }

    /// Prints the largest errors and refuses those above the tolerance.
    pub fn check(&self, what: &str) {
        for (k, name) in self.names.iter().enumerate() {
            println!(
                "{what}, {name}: γ {:.1e}, h∇γ {:.1e}",
                self.gamma[k], self.gradient[k]
            );
        }
        for (k, name) in self.names.iter().enumerate() {
            assert!(
                self.gamma[k] <= crate::gamma::TOLERANCE,
                "{what}, {name}: γ off by {}",
                self.gamma[k]
            );
            assert!(
                self.gradient[k] <= crate::gamma::TOLERANCE,
                "{what}, {name}: h∇γ off by {}",
                self.gradient[k]
            );
        }
    }
}
