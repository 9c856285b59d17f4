//! μ(I) against its identities, an integrated equation and tables.

use sph_rheology::{MuI, MuIRegularisation};

fn beads(grain_diameter: f64) -> MuI {
    MuI {
        static_friction: 20.9_f64.to_radians().tan(),
        limiting_friction: 32.76_f64.to_radians().tan(),
        reference_inertial_number: 0.279,
        grain_diameter,
        grain_density: 800.0,
        fluid_viscosity: 0.0,
        fluid_density: 0.0,
        drag_coefficient: 0.0,
        regularisation: MuIRegularisation::MinattiParis {
            yield_stress: 190.0,
            stress_growth: 1.0,
        },
        largest_viscosity: None,
    }
}

fn sand() -> MuI {
    MuI {
        static_friction: 30.5_f64.to_radians().tan(),
        limiting_friction: 51.3_f64.to_radians().tan(),
        reference_inertial_number: 2.65,
        grain_diameter: 0.32e-3,
        grain_density: 2600.0,
        regularisation: MuIRegularisation::MinattiParis {
            yield_stress: 795.0,
            stress_growth: 1.2,
        },
        ..beads(1.0)
    }
}

fn near(a: f64, b: f64, tolerance: f64) {
    assert!((a / b - 1.0).abs() <= tolerance, "{a:e} {b:e}");
}

#[test]
fn residual_and_plastic_viscosity_add_up() {
    let mut worst: f64 = 0.0;
    for law in [beads(5e-3), beads(5e-4), sand()] {
        for k in 0..2000 {
            let rate = 10_f64.powf(-3.0 + f64::from(k % 50) / 10.0);
            let p = 10_f64.powf(-1.0 + f64::from(k / 50) / 8.0);
            // Minatti & Paris 2015, Eq. 6, 7 and 47 as they stand there.
            let (mu_s, mu_2) = (law.static_friction, law.limiting_friction);
            let (d, rho) = (law.grain_diameter, law.grain_density);
            let number = rate * d * (rho / p).sqrt();
            let mu = mu_s + (mu_2 - mu_s) / (1.0 + law.reference_inertial_number / number);
            let tau = mu_s * p;
            let knee = law.reference_inertial_number / d * (tau / (mu_s * rho)).sqrt();
            let residual = (mu_2 / mu_s - 1.0) * tau / (rate + knee);
            for (a, b) in [
                (law.residual_viscosity(rate, p), residual),
                (law.friction(rate, p), mu),
                (residual + tau / rate, mu * p / rate),
                (law.residual_viscosity(rate, p) + tau / rate, mu * p / rate),
            ] {
                worst = worst.max((a / b - 1.0).abs());
            }
        }
    }
    println!("identity: {worst:e}");
    assert!(worst < 1e-14, "{worst:e}");
}

#[test]
fn friction_is_half_way_at_the_reference_number_and_the_longest_time_counts() {
    let law = beads(5e-3);
    let p = 700.0;
    let half = 0.279 / law.inertial_time(p);
    let middle = 0.5 * (law.static_friction + law.limiting_friction);
    near(law.friction(half, p), middle, 1e-14);
    near(law.inertial_time(p), 5e-3 * (800.0_f64 / p).sqrt(), 1e-15);
    let in_honey = MuI {
        fluid_viscosity: 10.0,
        ..law
    };
    near(in_honey.inertial_time(p), 10.0 / p, 1e-15);
    let in_water = MuI {
        fluid_density: 1000.0,
        drag_coefficient: 4.0,
        ..law
    };
    near(
        in_water.inertial_time(p),
        5e-3 * (4000.0_f64 / p).sqrt(),
        1e-15,
    );
}

/// Minatti & Paris 2015, Eq. 52, by Runge–Kutta in ln τ_y from τ₀.
fn integrated(law: &MuI, m0: f64, tau0: f64, tau: f64, rate: f64) -> f64 {
    let mu_s = law.static_friction;
    let slope = |s: f64| {
        let tau = s.exp();
        let eta0 = |t: f64| law.residual_viscosity(rate, t / mu_s);
        // ∂η₀/∂ ln τ from the fourth-order difference.
        let h = 1e-3;
        let at = |k: f64| eta0((s + k * h).exp());
        let derivative = (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * h);
        (eta0(tau) - derivative) / (tau + eta0(tau) * rate)
    };
    let steps = 2000;
    let (from, to) = (tau0.ln(), tau.ln());
    let h = (to - from) / f64::from(steps);
    let mut m = m0;
    for k in 0..steps {
        let s = from + f64::from(k) * h;
        m += h / 6.0 * (slope(s) + 4.0 * slope(s + 0.5 * h) + slope(s + h));
    }
    m
}

#[test]
fn the_closed_form_solves_the_equation_of_the_growth_time() {
    let mut worst: f64 = 0.0;
    for (law, tau0, m0) in [(beads(5e-3), 190.0, 1.0), (sand(), 795.0, 1.2)] {
        for rate in [1e-3_f64, 0.1, 1.0, 10.0, 100.0] {
            for tau in [1.0, 50.0, 400.0, 1500.0] {
                let m = integrated(&law, m0, tau0, tau, rate);
                let p = tau / law.static_friction;
                let growth = -(-m * rate).exp_m1() / rate;
                let eta = law.residual_viscosity(rate, p) + tau * growth;
                worst = worst.max((law.at(rate, p) / eta - 1.0).abs());
            }
        }
    }
    println!("closed form against integration: {worst:e}");
    assert!(worst < 1e-11, "{worst:e}");
}

/// Largest viscosities and local values computed independently for Minatti & Paris 2015.
#[test]
fn the_tables_of_values_are_met() {
    for (d, table) in [(5e-4, 190.3), (5e-3, 193.0)] {
        let law = beads(d);
        let largest = law.at(0.0, 190.0 / law.static_friction);
        assert!((largest - table).abs() < 0.05, "{largest}");
    }
    let columns = [
        (177.0, 1.2, 212.0),
        (483.0, 1.4, 676.0),
        (795.0, 1.2, 954.0),
        (1414.0, 1.4, 1980.0),
        (2415.0, 1.6, 3864.0),
        (2660.0, 1.6, 4256.0),
    ];
    for (tau0, m0, table) in columns {
        let law = MuI {
            regularisation: MuIRegularisation::MinattiParis {
                yield_stress: tau0,
                stress_growth: m0,
            },
            ..sand()
        };
        let largest = law.at(0.0, tau0 / law.static_friction);
        assert!((largest - table).abs() < 0.51, "{largest} {table}");
    }
    let local = [
        (beads(5e-3), 10.0, 110.23178, 0.46704038, 5.1480615),
        (beads(5e-3), 10.0, 678.7322, 0.42447166, 28.809097),
        (beads(5e-3), 0.1, 287.09161, 0.38264315, 106.08109),
        (sand(), 1.0, 85.377426, 0.58948397, 35.172776),
        (sand(), 20.0, 677.76254, 0.59214831, 20.066797),
        (sand(), 5.0, 4.26515, 0.59872685, 0.50946717),
    ];
    for (law, rate, p, mu, eta) in local {
        near(law.friction(rate, p), mu, 2e-8);
        near(law.at(rate, p), eta, 2e-7);
    }
}

#[test]
fn regularisations_have_their_values_at_rest_and_the_law_far_from_it() {
    let p = 350.0;
    for base in [beads(5e-3), sand()] {
        let mu_s = base.static_friction;
        let of = |regularisation| MuI {
            regularisation,
            ..base
        };
        let rest = of(MuIRegularisation::ChauchatMedale { strain_rate: 0.2 });
        near(rest.at(0.0, p), mu_s * p / 0.2, 1e-15);
        let grown = of(MuIRegularisation::Papanastasiou { stress_growth: 3.0 });
        let at_rest = base.residual_viscosity(0.0, p) + 3.0 * mu_s * p;
        near(grown.at(0.0, p), at_rest, 1e-15);
        near(base.at(1e-9, p), base.at(0.0, p), 1e-8);
        for law in [grown, base] {
            near(law.at(100.0, p), law.friction(100.0, p) * p / 100.0, 1e-12);
        }
        near(rest.at(1e5, p), rest.friction(1e5, p) * p / 1e5, 3e-6);
        assert_eq!(base.at(1.0, -3.0), 0.0);
    }
}
