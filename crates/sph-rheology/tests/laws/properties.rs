//! Every law at thousands of states: finite, not negative, never more than it may carry.

use nalgebra::Matrix3;
use proptest::prelude::*;
use sph_core::Symmetric;
use sph_rheology::jaumann::magnitude;
use sph_rheology::{
    Bingham, Carreau, Casson, Cone, Cross, DruckerPrager, Elastic, HerschelBulkley, Inputs,
    MohrCoulomb, MuI, MuIRegularisation, PowerLaw, Regularisation, Rheology,
};

/// Zero, and everything between 10^from and 10^to.
fn scales(from: f64, to: f64) -> impl Strategy<Value = f64> {
    prop_oneof![1 => Just(0.0), 9 => (from..to).prop_map(|e| 10_f64.powf(e))]
}

fn pressures() -> impl Strategy<Value = f64> {
    prop_oneof![
        1 => Just(0.0),
        1 => Just(1e-310),
        2 => scales(-6.0, 7.0).prop_map(|p| -p),
        6 => scales(-12.0, 8.0),
    ]
}

fn regularisations() -> impl Strategy<Value = Regularisation> {
    prop_oneof![
        (-3.0..4.0).prop_map(|e: f64| Regularisation::Papanastasiou {
            stress_growth: 10_f64.powf(e)
        }),
        (-4.0..6.0).prop_map(|e: f64| Regularisation::BiViscosity {
            largest_viscosity: 10_f64.powf(e)
        }),
        (-6.0..2.0).prop_map(|e: f64| Regularisation::BercovierEngelman {
            strain_rate: 10_f64.powf(e)
        }),
        (0.0..8.0).prop_map(|e: f64| Regularisation::Ratio {
            ratio: 10_f64.powf(e)
        }),
    ]
}

fn cones() -> impl Strategy<Value = Cone> {
    prop_oneof![
        Just(Cone::Circumscribed),
        Just(Cone::Inscribed),
        Just(Cone::PlaneStrain),
        Just(Cone::Tan),
        Just(Cone::Sin),
    ]
}

/// Viscosity at one state, within the law's bounds.
fn sound(law: &dyn Rheology, rate: f64, pressure: f64) -> f64 {
    let mut eta = [f64::NAN];
    let inputs = Inputs {
        strain_rate: &[rate],
        pressure: &[pressure],
    };
    law.viscosity(&inputs, &mut eta);
    let most = law.largest_viscosity() * (1.0 + 1e-14);
    assert!(
        eta[0].is_finite() && eta[0] >= 0.0 && eta[0] <= most,
        "{law:?} at {rate:e}, {pressure:e}: {:e} of {most:e}",
        eta[0]
    );
    match law.uniform_viscosity() {
        Some(uniform) => assert!((eta[0] - uniform).abs() <= 1e-14 * uniform),
        None => assert!(law.needs().strain_rate),
    }
    eta[0]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 4096, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn viscous_and_plastic_fluids_are_finite(
        rate in scales(-300.0, 12.0),
        viscosity in scales(-6.0, 4.0),
        yield_stress in scales(-9.0, 6.0),
        exponent in 0.05..3.0_f64,
        most in (-3.0..6.0_f64).prop_map(|e| 10_f64.powf(e)),
        time in scales(-6.0, 4.0),
        regularisation in regularisations(),
    ) {
        let bingham = Bingham { viscosity, yield_stress, regularisation };
        let eta = sound(&bingham, rate, 0.0);
        prop_assert!(eta * rate <= (viscosity * rate + yield_stress) * (1.0 + 1e-12));
        let power = PowerLaw {
            consistency: viscosity,
            exponent,
            smallest_viscosity: 0.0,
            largest_viscosity: most,
        };
        sound(&power, rate, 0.0);
        sound(&HerschelBulkley {
            consistency: viscosity,
            exponent,
            yield_stress,
            regularisation,
            smallest_viscosity: 0.0,
            largest_viscosity: most,
        }, rate, 0.0);
        let stress_growth = time.max(1e-6);
        sound(&Casson { viscosity, yield_stress, stress_growth }, rate, 0.0);
        let (rest_viscosity, infinite_viscosity, relaxation_time) = (most, viscosity, time);
        sound(&Cross { rest_viscosity, infinite_viscosity, relaxation_time, exponent }, rate, 0.0);
        sound(&Carreau {
            rest_viscosity,
            infinite_viscosity,
            relaxation_time,
            exponent: exponent.min(1.0),
            sharpness: exponent,
        }, rate, 0.0);
    }

    #[test]
    fn soils_and_grains_are_finite(
        rate in scales(-300.0, 12.0),
        pressure in pressures(),
        viscosity in scales(-6.0, 4.0),
        cohesion in scales(-6.0, 5.0),
        angle in prop_oneof![1 => Just(0.0), 5 => 0.0..60.0_f64],
        regularisation in regularisations(),
        fluid in scales(-6.0, 3.0),
        time in (-3.0..3.0_f64).prop_map(|e| 10_f64.powf(e)),
        choice in 0..3,
    ) {
        let friction_angle = angle.to_radians();
        let soil = MohrCoulomb { viscosity, friction_angle, cohesion, regularisation };
        let eta = sound(&soil, rate, pressure);
        let stress = viscosity * rate + soil.yield_stress(pressure);
        prop_assert!(eta * rate <= stress * (1.0 + 1e-12) + 1e-290);
        let grains = MuI {
            static_friction: 0.38,
            limiting_friction: 0.64,
            reference_inertial_number: 0.28,
            grain_diameter: 1e-3,
            grain_density: 2500.0,
            fluid_viscosity: fluid,
            fluid_density: 1000.0,
            drag_coefficient: fluid,
            regularisation: match choice {
                0 => MuIRegularisation::ChauchatMedale { strain_rate: time },
                1 => MuIRegularisation::Papanastasiou { stress_growth: time },
                _ => MuIRegularisation::MinattiParis { yield_stress: 1e3 * time, stress_growth: time },
            },
            largest_viscosity: None,
        };
        let eta = sound(&grains, rate, pressure);
        prop_assert!(eta * rate <= 0.64 * pressure.max(0.0) * (1.0 + 1e-12) + 1e-290);
    }

    #[test]
    fn elastic_soil_carries_no_more_than_its_yield_stress(
        rate in scales(-12.0, 8.0),
        pressure in pressures(),
        young in 5.0..9.0_f64,
        poisson_ratio in -0.5..0.5_f64,
        angle in prop_oneof![1 => Just(0.0), 5 => 0.0..60.0_f64],
        cohesion in scales(-6.0, 5.0),
        blending_order in 1.0..6.0_f64,
        cone in cones(),
        tensor in prop::array::uniform9(-1.0..1.0_f64),
        first in prop::array::uniform6(-1.0..1.0_f64),
        size in scales(-6.0, 9.0),
        dt in (-7.0..0.0_f64).prop_map(|e| 10_f64.powf(e)),
        damping in 0.0..1.0_f64,
    ) {
        let law = DruckerPrager {
            young_modulus: 10_f64.powf(young),
            poisson_ratio,
            friction_angle: angle.to_radians(),
            cohesion,
            grain_diameter: 1e-3,
            grain_density: 2650.0,
            blending_order,
            cone,
            smallest_viscosity: 0.0,
            damping,
        };
        let shape = Matrix3::from_row_slice(&tensor);
        let unit = 2.0 * magnitude(&Symmetric::part_of(shape).deviator());
        let gradient: [[f64; 3]; 3] = (shape * (rate / unit.max(1e-3))).into();
        let strain_rate = [2.0 * magnitude(&Symmetric::part_of(gradient).deviator())];
        let eta = sound(&law, strain_rate[0], pressure);
        let yield_stress = law.yield_stress(pressure);
        let inputs = Inputs { strain_rate: &strain_rate, pressure: &[pressure] };
        let mut stress = [Symmetric(first).deviator() * size];
        for _ in 0..3 {
            law.advance(&inputs, &[gradient], dt, &mut stress);
            let mut carried = [Symmetric::ZERO];
            law.carried(&inputs, &stress, &mut carried);
            let bound = yield_stress * (1.0 + 1e-14);
            prop_assert!(stress[0].0.iter().all(|c| c.is_finite()));
            prop_assert!(magnitude(&stress[0]) <= bound);
            prop_assert!(magnitude(&carried[0]) <= bound);
            // Solid and liquid together as well, but for the damping.
            let total = magnitude(&carried[0]) + eta * strain_rate[0];
            prop_assert!(total <= yield_stress * (1.0 + damping + 1e-12) + 1e-290, "{total:e} {yield_stress:e}");
        }
    }
}
