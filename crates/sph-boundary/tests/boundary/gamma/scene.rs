//! A geometry with everything needed to compare the closed form with the reference.

use sph_boundary::{ElementTree, GammaSum, Mesh, PeriodicBox, Polyline, Renormalisation2d};

use crate::close;
use crate::gamma::kernels::TestKernel;
use crate::gamma::reference;

/// Smoothing length of all comparisons, m: not 1, so that a missing power of h is seen.
pub const H: f64 = 0.7;

/// A tank around bodies.
pub fn tank() -> Vec<[f64; 2]> {
    vec![[-9.0, -9.0], [9.0, -9.0], [9.0, 9.0], [-9.0, 9.0]]
}

pub struct Scene {
    pub loops: Vec<Vec<[f64; 2]>>,
    pub mesh: Mesh<2>,
    tree: ElementTree<2>,
    kernels: Vec<TestKernel>,
    renormalisations: Vec<Renormalisation2d>,
}

/// Largest errors of γ and of h∇γ per kernel.
#[derive(Default)]
pub struct Errors(Vec<[f64; 2]>);

impl Scene {
    pub fn new(loops: Vec<Vec<[f64; 2]>>, spacing: f64) -> Self {
        let lines = loops.iter().enumerate();
        let line = |(i, points): (usize, &Vec<_>)| Polyline::closed(format!("{i}"), points.clone());
        let lines: Vec<Polyline> = lines.map(line).collect();
        let mesh = Mesh::<2>::build(&lines, spacing, &PeriodicBox::none()).unwrap();
        let kernels = crate::gamma::kernels::all();
        let integrals = |k: &TestKernel| Renormalisation2d::new(&k.shape, H).unwrap();
        let renormalisations: Vec<_> = kernels.iter().map(integrals).collect();
        let reaches = renormalisations.iter().map(|r| r.kernel_radius());
        let tree = ElementTree::build(&mesh, reaches.fold(0.0, f64::max));
        Self {
            loops,
            mesh,
            tree,
            kernels,
            renormalisations,
        }
    }

    pub fn sums(&self, point: [f64; 2]) -> Vec<GammaSum<2>> {
        let all = self.renormalisations.iter();
        all.map(|r| r.at(point, &self.mesh, &self.tree)).collect()
    }

    /// Compares with the reference at one point.
    pub fn compare(&self, point: [f64; 2], errors: &mut Errors) {
        let edges = reference::edges(&self.loops, point);
        let exact = reference::gammas(&edges, &self.kernels, H);
        errors.0.resize(self.kernels.len(), [0.0; 2]);
        let all = self.kernels.iter().zip(&mut errors.0).zip(exact);
        for (sum, ((kernel, [gamma, gradient]), exact)) in self.sums(point).iter().zip(all) {
            close(sum.gamma(), exact, 1e-9, (kernel.name, point));
            *gamma = gamma.max((sum.gamma() - exact).abs());
            let slope = reference::gradient(&edges, kernel, H);
            let apart = (0..2).map(|i| H * sum.gradient[i] - slope[i]);
            *gradient = apart.fold(*gradient, |e, x| e.max(x.abs()));
        }
    }
}

impl Errors {
    /// Prints the largest errors and refuses those above the tolerance.
    pub fn check(&self, what: &str) {
        for (kernel, errors) in crate::gamma::kernels::all().iter().zip(&self.0) {
            let [gamma, gradient] = errors;
            println!("{what}, {}: γ {gamma:.1e}, h∇γ {gradient:.1e}", kernel.name);
        }
        let worst = self.0.iter().flatten().fold(0.0, |a: f64, b| a.max(*b));
        assert!(worst <= crate::gamma::TOLERANCE, "{what}: off by {worst:e}");
        let gamma = self.0.iter().fold(0.0, |a: f64, [gamma, _]| a.max(*gamma));
        assert!(
            gamma <= crate::gamma::OF_GAMMA,
            "{what}: γ is off by {gamma:e}"
        );
        assert!(!self.0.is_empty(), "{what}: nothing was compared");
    }
}
