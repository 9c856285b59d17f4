//! What a wall treatment refuses, by name.

use sph_boundary::{BoundaryError, Drawing, Polyline, WallSpec};
use sph_core::Vect;
use sph_kernels::{Kernel, Sampler, ScalarSampler, wendland_c2};

use crate::bench::{fixed_line, line, setup, treatment, wide};

/// f(q) = exp(−q²), cut at q = 3.
#[derive(Clone, Debug)]
struct Gaussian;

impl Kernel for Gaussian {
    fn name(&self) -> &str {
        "gaussian"
    }
    fn support(&self) -> f64 {
        3.0
    }
    fn value(&self, q: f64) -> f64 {
        if q < 3.0 { (-q * q).exp() } else { 0.0 }
    }
    fn derivative(&self, q: f64) -> f64 {
        -2.0 * q * self.value(q)
    }
    fn sampler(&self, dimension: usize, h: f64) -> Box<dyn Sampler> {
        Box::new(ScalarSampler::new(self.clone(), dimension, h))
    }
}

fn square() -> WallSpec<2> {
    let corners = vec![[0.0, 0.0], [8.0, 0.0], [8.0, 8.0], [0.0, 8.0]];
    fixed_line(Polyline::closed("tank", corners))
}

fn built(name: &str, walls: &[WallSpec<2>], kernel: &dyn Kernel) -> Result<(), BoundaryError> {
    let domain = wide();
    let mut wall = treatment(name);
    wall.build(&setup(walls, 0.5, kernel, &domain)).map(|_| ())
}

#[test]
fn a_kernel_without_polynomial_is_refused_by_usaw_and_by_nobody_else() {
    let refused = built("usaw", &[square()], &Gaussian).unwrap_err();
    let told = refused.to_string();
    let why = "kernel is not a piecewise polynomial with a positive integral: `gaussian` gives no radial moments";
    assert!(told.starts_with(why), "{told}");
    built("dummy-particles", &[square()], &Gaussian).expect("dummies ask no moments");
    built("usaw", &[square()], &wendland_c2()).expect("a polynomial");
}

#[test]
fn a_free_end_within_reach_is_refused_by_name_and_one_beyond_is_not() {
    for name in ["usaw", "dummy-particles"] {
        let line = vec![[0.0, 3.0], [0.0, 0.0], [8.0, 0.0], [8.0, 5.0]];
        let open = fixed_line(Polyline::open("beaker", line));
        let domain = wide();
        let mut wall = treatment(name);
        wall.build(&setup(&[open], 0.5, &wendland_c2(), &domain))
            .unwrap();
        let far = Vect::<2>::new(1.0, 1.2);
        wall.check_free_ends(&[far]).expect("2.06 h from the rim");
        let refused = wall.check_free_ends(&[far, Vect::<2>::new(0.5, 1.2)]);
        let told = refused.unwrap_err().to_string();
        assert!(told.contains("end of wall `beaker`"), "{told}");
        assert!(told.contains("within the kernel radius 2 m"), "{told}");
        let (_, away) = told.split_once("particle 1 is ").expect("its particle");
        let distance: f64 = away.split(' ').next().unwrap().parse().unwrap();
        assert!((distance - 0.5f64.hypot(1.8)).abs() < 1e-14, "{told}");
    }
}

#[test]
fn walls_that_cross_are_refused_with_both_names_and_the_place() {
    for name in ["usaw", "dummy-particles"] {
        let corners = vec![[3.0, -1.0], [3.0, 1.0], [5.0, 1.0], [5.0, -1.0]];
        let sill = Polyline::closed("sill", corners);
        let refused = built(name, &[square(), fixed_line(sill)], &wendland_c2()).unwrap_err();
        let told = refused.to_string();
        assert!(told.contains(" crosses edge "), "{told}");
        let named = |wall: &str| told.contains(&format!("of wall `{wall}`"));
        assert!(named("sill") && named("tank"), "{told}");
        let place = ["near (3, 0)", "near (5, 0)"].map(|at| told.ends_with(at));
        assert!(place.contains(&true), "{told}");
    }
}

#[test]
fn a_wall_drawn_the_wrong_way_round_has_its_fluid_outside() {
    let mut inside_out = square();
    inside_out.drawing = Drawing::Line(line(&inside_out).clone().reversed());
    let domain = wide();
    for (spec, fluid_inside) in [(square(), true), (inside_out, false)] {
        let mut wall = treatment("usaw");
        wall.build(&setup(&[spec], 0.5, &wendland_c2(), &domain))
            .unwrap();
        for x in [[4.0, 4.0], [0.1, 0.1], [7.9, 4.0]].map(Vect::from) {
            let beside = Vect::<2>::new(-x[0], x[1]);
            assert_eq!(wall.contains(&x), fluid_inside, "{x}");
            assert_eq!(wall.contains(&beside), !fluid_inside, "{beside}");
        }
        let near = wall.clearance(&Vect::<2>::new(0.1, 4.0), 1.0);
        assert_eq!(near.unwrap().1, "tank");
    }
}
