//! The elastic and the elastic–viscoplastic law along prescribed paths, against closed forms.

use sph_core::{Registry, Symmetric};
use sph_rheology::jaumann::magnitude;
use sph_rheology::{
    Cone, DruckerPrager, Elastic, ElasticSolid, Gradient, Inputs, Rheology, RheologyEntry, Yielding,
};

fn plastic() -> DruckerPrager {
    DruckerPrager {
        young_modulus: 8e5,
        poisson_ratio: 0.3,
        friction_angle: 38_f64.to_radians(),
        cohesion: 0.0,
        grain_diameter: 3.9e-3,
        grain_density: 1580.0,
        blending_order: 2.0,
        cone: Cone::Circumscribed,
        smallest_viscosity: 0.0,
        damping: 0.0,
    }
}

const P: f64 = 1000.0;

/// u_x = γ̇ y.
fn shear(rate: f64) -> Gradient {
    [[0.0, rate, 0.0], [0.0; 3], [0.0; 3]]
}

/// One particle under one law.
struct LawSample<'a, L> {
    law: &'a L,
    stress: Symmetric,
}

impl<L: Rheology> LawSample<'_, L> {
    fn inputs<'b>(rate: &'b [f64; 1], pressure: &'b [f64; 1]) -> Inputs<'b> {
        Inputs {
            strain_rate: rate,
            pressure,
        }
    }

    fn advance(&mut self, gradient: &Gradient, pressure: f64, dt: f64) {
        let d = Symmetric::part_of(*gradient).deviator();
        let rate = [2.0 * magnitude(&d)];
        let mut stress = [self.stress];
        let elastic = self.law.elastic().expect("elastic");
        elastic.advance(
            &Self::inputs(&rate, &[pressure]),
            &[*gradient],
            dt,
            &mut stress,
        );
        self.stress = stress[0];
    }

    /// Total deviatoric stress 2ηD + carried.
    fn total(&self, gradient: &Gradient, pressure: f64) -> Symmetric {
        let d = Symmetric::part_of(*gradient).deviator();
        let rate = [2.0 * magnitude(&d)];
        let (mut eta, mut carried) = ([0.0], [Symmetric::ZERO]);
        let pressure = [pressure];
        let inputs = Self::inputs(&rate, &pressure);
        self.law.viscosity(&inputs, &mut eta);
        let elastic = self.law.elastic().expect("elastic");
        elastic.carried(&inputs, &[self.stress], &mut carried);
        carried[0] + d * (2.0 * eta[0])
    }
}

fn fresh<L>(law: &L) -> LawSample<'_, L> {
    LawSample {
        law,
        stress: Symmetric::ZERO,
    }
}

/// η_y of Ghaïtanellis 2017, Eq. 4.82 for its materials.
#[test]
fn the_yield_viscosities_of_the_materials_are_met() {
    let of = |e, nu, d, rho| DruckerPrager {
        young_modulus: e,
        poisson_ratio: nu,
        grain_diameter: d,
        grain_density: rho,
        ..plastic()
    };
    let table = [
        (of(8.4e5, 0.3, 1e-3, 2650.0), 3.231e5, 99.3),
        (of(8.4e5, 0.3, 1.5e-3, 2650.0), 3.231e5, 148.9),
        (of(8e5, 0.3, 3.9e-3, 1580.0), 3.077e5, 291.8),
        (of(2.6e8, 0.33, 0.2e-3, 2650.0), 9.774e7, 343.6),
    ];
    for (law, modulus, eta) in table {
        assert!((law.shear_modulus() / modulus - 1.0).abs() < 2e-4);
        assert!(
            (law.yield_viscosity() - eta).abs() < 0.06,
            "{}",
            law.yield_viscosity()
        );
    }
    let tau = plastic().yield_stress(P);
    let sine = 38_f64.to_radians().sin();
    assert!((tau - 2.0 * 3_f64.sqrt() * sine / (3.0 - sine) * P).abs() < 1e-10);
}

#[test]
fn the_largest_viscosity_is_that_of_a_scan() {
    for q in [1.0, 1.5, 2.0, 3.0, 7.0] {
        let law = DruckerPrager {
            blending_order: q,
            ..plastic()
        };
        let knee = law.yield_stress(P) / law.yield_viscosity();
        let rates: Vec<f64> = (0..=40_000).map(|k| knee * f64::from(k) / 2e4).collect();
        let mut eta = vec![0.0; rates.len()];
        let pressure = vec![P; rates.len()];
        let inputs = Inputs {
            strain_rate: &rates,
            pressure: &pressure,
        };
        law.viscosity(&inputs, &mut eta);
        let most = eta.iter().copied().fold(0.0, f64::max);
        let bound = law.largest_viscosity();
        println!("q = {q}: {} η_y", bound / law.yield_viscosity());
        assert!(
            most <= bound * (1.0 + 1e-15) && most > bound * (1.0 - 1e-7),
            "{q}"
        );
    }
    let ratio = plastic().largest_viscosity() / plastic().yield_viscosity();
    assert!((ratio - 1.125).abs() < 1e-14);
}

/// Elastic up to yield, capped there: τ_xy = 𝒢 sin s, then |τ| = τ_y.
#[test]
fn slow_shear_is_elastic_up_to_yield_and_capped_there() {
    let law = plastic();
    let (modulus, yield_stress) = (law.shear_modulus(), law.yield_stress(P));
    let rate = 1e-4 * yield_stress / law.yield_viscosity();
    let mut soil = fresh(&law);
    let strain_at_yield = yield_stress / modulus;
    let (steps, gradient) = (400, shear(rate));
    let dt = 2.0 * strain_at_yield / rate / f64::from(steps);
    for k in 1..=steps {
        soil.advance(&gradient, P, dt);
        let s = rate * dt * f64::from(k);
        let free = 2.0 * modulus * (0.5 * s).sin();
        let expected = free.min(yield_stress);
        let size = magnitude(&soil.stress);
        assert!(
            (size / expected - 1.0).abs() < 1e-8,
            "{k}: {size} {expected}"
        );
        match free < yield_stress {
            true => assert!((soil.stress.0[3] / (modulus * s.sin()) - 1.0).abs() < 1e-8),
            false => assert!(size <= yield_stress * (1.0 + 1e-15)),
        }
    }
}

/// The liquid carries τ_y at every rate and so does the capped solid: so does their blend.
#[test]
fn steady_shear_gives_the_yield_stress_at_every_rate() {
    let law = plastic();
    let yield_stress = law.yield_stress(P);
    let knee = yield_stress / law.yield_viscosity();
    let (mut worst, mut least): (f64, f64) = (0.0, 1.0);
    for x in [0.01, 0.1, 0.3, 0.5, 0.75, 0.9, 0.999, 1.0, 1.5, 10.0, 1e4] {
        let gradient = shear(x * knee);
        // A stressed start, or between 0.9 and 1 it would stay a liquid.
        let mut soil = fresh(&law);
        soil.advance(&shear(1e-3 * knee), P, 1.0);
        let dt = 0.05 * yield_stress / law.shear_modulus() / (x * knee);
        (0..2000).for_each(|_| soil.advance(&gradient, P, dt));
        // The Jaumann rate tilts the solid's stress by δ, sin δ = τ_y/𝒢, from the liquid's.
        let zeta = if x < 1.0 {
            x * x * (3.0 - 2.0 * x)
        } else {
            1.0
        };
        let tilt = (yield_stress / law.shear_modulus()).asin();
        let squared = 1.0 - 2.0 * zeta * (1.0 - zeta) * (1.0 - tilt.cos());
        let total = magnitude(&soil.total(&gradient, P)) / yield_stress;
        worst = worst.max((total - squared.sqrt()).abs());
        least = least.min(total);
        // Blended between: the solid's part is (1 − ζ)τ_y.
        let share = magnitude(&soil.stress) / yield_stress;
        let expected = if x < 1.0 { 1.0 } else { 0.0 };
        assert!((share - expected).abs() < 1e-12, "{x}: {share}");
        assert!((law.liquid_share(x) - zeta).abs() < 1e-15);
    }
    println!("steady shear: least τ/τ_y {least}, error of the closed form {worst:e}");
    // Steps of a twentieth of the strain at yield leave the tilt with an error of a fortieth.
    assert!(least > 1.0 - 2e-6 && worst < 1e-7, "{least} {worst:e}");
}

#[test]
fn damping_is_a_viscosity_of_the_solid_alone() {
    let damped = DruckerPrager {
        damping: 0.3,
        ..plastic()
    };
    let viscosity = |law: &DruckerPrager, x: f64| {
        let rate = [x * law.yield_stress(P) / law.yield_viscosity()];
        let mut eta = [0.0];
        law.viscosity(&LawSample::<DruckerPrager>::inputs(&rate, &[P]), &mut eta);
        eta[0] / law.yield_viscosity()
    };
    assert_eq!(viscosity(&damped, 0.0), 0.3);
    for x in [1.0, 1.5, 30.0] {
        assert_eq!(viscosity(&damped, x), viscosity(&plastic(), x));
    }
    // What it adds to the stress over τ_y, largest where x(1 − ζ) is.
    let added = |x: f64| x * (viscosity(&damped, x) - viscosity(&plastic(), x));
    let most = (1..1000).map(|k| added(1e-3 * f64::from(k)));
    let most = most.fold(0.0, f64::max);
    assert!((most / (0.3 * 0.25997) - 1.0).abs() < 1e-4, "{most}");
    let largest = damped.largest_viscosity() / damped.yield_viscosity();
    let scanned = (0..1000).map(|k| viscosity(&damped, 1e-3 * f64::from(k)));
    assert!(scanned.fold(0.0, f64::max) <= largest);
}

#[test]
fn liquid_forgets_and_is_solid_again_below_nine_tenths() {
    let law = plastic();
    let knee = law.yield_stress(P) / law.yield_viscosity();
    let mut soil = fresh(&law);
    let at = |soil: &mut LawSample<'_, DruckerPrager>, x: f64| {
        soil.advance(&shear(x * knee), P, 1e-6);
        magnitude(&soil.stress)
    };
    assert!(at(&mut soil, 0.5) > 0.0);
    assert!(at(&mut soil, 0.95) > 0.0, "solid up to one");
    assert_eq!(at(&mut soil, 1.0), 0.0);
    assert_eq!(at(&mut soil, 0.95), 0.0, "still liquid");
    assert_eq!(at(&mut soil, 0.9000001), 0.0);
    // What is solid again carries the strain of this step and no more.
    let gained = law.shear_modulus() * 0.89 * knee * 1e-6;
    assert!((at(&mut soil, 0.89) / gained - 1.0).abs() < 1e-12);
    // Without pressure there is no strength.
    soil.advance(&[[0.0; 3]; 3], -10.0, 1e-6);
    assert_eq!(soil.stress, Symmetric::ZERO);
}

/// 0.5 rad in 50 000 steps.
#[test]
fn a_stressed_block_turns_with_its_stress() {
    let soil = plastic();
    let rubber = ElasticSolid {
        young_modulus: 8e5,
        poisson_ratio: 0.3,
        viscosity: 0.0,
    };
    let first = Symmetric([100.0, -60.0, -40.0, 80.0, 0.0, 0.0]);
    let gradient = [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0; 3]];
    let q = nalgebra::Rotation3::from_axis_angle(&nalgebra::Vector3::z_axis(), 0.5).into_inner();
    let exact = Symmetric::part_of(q * first.matrix() * q.transpose());
    let mut turned = [first; 2];
    for _ in 0..50_000 {
        let (a, b) = turned.split_at_mut(1);
        let inputs = Inputs {
            strain_rate: &[0.0],
            pressure: &[P],
        };
        Elastic::advance(&soil, &inputs, &[gradient], 1e-5, a);
        Elastic::advance(&rubber, &Inputs::default(), &[gradient], 1e-5, b);
    }
    for stress in turned {
        let error = magnitude(&(stress - exact)) / magnitude(&first);
        println!("rotation by 0.5 rad: {error:e}");
        assert!(error < 1e-10, "{error:e}");
    }
}

/// Plane compression u = (−ax, 0, 0): τ = 2𝒢t D′, with a stress out of the plane.
#[test]
fn plane_compression_strains_the_deviator() {
    let rubber = ElasticSolid {
        young_modulus: 8e5,
        poisson_ratio: 0.3,
        viscosity: 3.0,
    };
    let gradient = [[-0.1, 0.0, 0.0], [0.0; 3], [0.0; 3]];
    let mut block = fresh(&rubber);
    (0..100).for_each(|_| block.advance(&gradient, 0.0, 1e-4));
    let unit = 2.0 * rubber.shear_modulus() * 0.1 * 1e-2 / 3.0;
    let exact = Symmetric([-2.0 * unit, unit, unit, 0.0, 0.0, 0.0]);
    assert!(magnitude(&(block.stress - exact)) < 1e-12 * unit);
    let total = block.total(&gradient, 0.0);
    let viscous = Symmetric::part_of(gradient).deviator() * 6.0;
    assert!(magnitude(&(total - exact - viscous)) < 1e-12 * unit);
}

#[test]
fn the_registered_laws_read_their_parameters() {
    let registry = Registry::<RheologyEntry>::discovered().expect("unique names");
    let build = |name: &str, text: &str| {
        let entry = registry.find(name).expect("registered");
        (entry.build)(&toml::from_str(text).expect("TOML"))
    };
    let sand = "young_modulus = '0.8 MPa'\npoisson_ratio = 0.3\nfriction_angle = '38 deg'\n\
                grain_diameter = '3.9 mm'\ngrain_density = 1580\n";
    let law = build("drucker-prager", sand).expect("builds");
    let same = plastic().largest_viscosity();
    assert!((law.largest_viscosity() / same - 1.0).abs() < 1e-14);
    assert!(law.needs().pressure && law.elastic().is_some());
    for cone in ["circumscribed", "inscribed", "plane-strain", "tan", "sin"] {
        build("drucker-prager", &format!("{sand}cone = '{cone}'")).expect("a cone");
    }
    let refused = |name: &str, text: &str, word: &str| {
        let message = build(name, text).expect_err("refused").to_string();
        assert!(message.contains(word), "{message}");
    };
    refused(
        "drucker-prager",
        &format!("{sand}cone = 'plain'"),
        "plane-strain",
    );
    // Thirty radians: degrees without their unit.
    refused(
        "mohr-coulomb",
        "viscosity = 1\nfriction_angle = 30\nregularisation.ratio.ratio = 10",
        "at most 1.5 rad",
    );
    let rubber = build("elastic", "young_modulus = 2e6\npoisson_ratio = 0.4").expect("builds");
    assert_eq!(rubber.uniform_viscosity(), Some(0.0));
}

/// The parts of the blend one by one: what is carried is (1 − ζ) of what is held, and the liquid alone has min(τ_y/γ̇, η_y).
#[test]
fn the_shares_of_the_blend_are_those_of_its_stress() {
    let law = plastic();
    let elastic = law.elastic().expect("elastic");
    assert!(elastic.blends());
    let yield_rate = law.yield_stress(P) / law.yield_viscosity();
    let rate = [0.0, 0.5, 0.95, 0.95, 1.0, 4.0].map(|x| x * yield_rate);
    let inputs = Inputs {
        strain_rate: &rate,
        pressure: &[P; 6],
    };
    let mut stress = [Symmetric([300.0, -300.0, 0.0, 2500.0, 0.0, 0.0]); 6];
    stress[3] = Symmetric::ZERO;
    let mut yielding = [Yielding::NONE; 6];
    elastic.yielding(&inputs, &stress, &mut yielding);
    let mut carried = [Symmetric::ZERO; 6];
    elastic.carried(&inputs, &stress, &mut carried);
    let mut liquid = [0.0; 6];
    elastic.liquid_viscosity(&inputs, &mut liquid);
    for k in 0..6 {
        let share = law.liquid_share(rate[k] / yield_rate);
        let y = yielding[k];
        assert_eq!([y.friction, y.solid], [share, 1.0 - share]);
        let apart = magnitude(&(carried[k] - stress[k] * (y.held * y.solid)));
        assert!(apart < 1e-12 * law.yield_stress(P), "{k}: {apart} Pa apart");
        let asked = (law.yield_stress(P) / rate[k]).min(law.yield_viscosity());
        assert!(
            (liquid[k] / asked - 1.0).abs() < 1e-12,
            "{k}: {}",
            liquid[k]
        );
    }
    // From x = 1 on, and a stress that is zero from 0.9 on.
    assert_eq!(
        yielding.map(|y| y.forgets),
        [false, false, false, true, true, true]
    );
}
