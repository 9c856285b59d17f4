//! Requests to a maker, and its refusals.

use super::*;

fn setting<const D: usize>() -> MoverSetting<'static, D> {
    MoverSetting {
        wall: "paddle",
        fluid: &[],
        walls: &[],
        spacing: 0.02,
        smoothing_length: 0.04,
        densities: [1000.0; 2],
        sound_speed: 20.0,
        gravity: Vect::from_fn(|k, _| if k + 1 == D { -9.81 } else { 0.0 }),
        flush: true,
    }
}

fn maker<const D: usize>(text: &str) -> WaveMaker<D> {
    toml::from_str(text).unwrap_or_else(|e| panic!("{e}"))
}

const REGULAR: &str = "level = 0.5\nwaves = { regular = { height = 0.06, period = 1.4 } }\n";

/// The stroke of `wavemaker-2d`: 58.85 mm of height for 50 mm.
#[test]
fn a_piston_has_the_stroke_of_linear_theory() {
    let mut piston = maker::<2>(&format!("{REGULAR}order = 1\nramp = 0\n"));
    piston.prepare(&setting()).expect("settled");
    let at = |t: f64| piston.next(&piston.start(), &Load::of_gravity(Vect::zeros()), t, 0.0);
    let stroke = at(0.35).pose.translation[0] - at(1.05).pose.translation[0];
    let transfer = 0.06 / stroke;
    let k = crate::waves::wavenumber(std::f64::consts::TAU / 1.4, 0.5, 9.81);
    assert!((transfer / Paddle::Piston.transfer(k, 0.5) - 1.0).abs() < 1e-12);
    assert!(at(0.0).velocity[0] > 0.0 && at(0.0).pose.translation[0] == 0.0);
}

/// In long waves the fluid of a wave of steady form has u = c η/(d + η) at all depths (Goring 1978): of second order,
/// X₂ = (b − a²/d)/(2kd) sin 2ωt, with b the second harmonic of Stokes' wave.
#[test]
fn second_order_is_that_of_long_waves_where_they_are_long() {
    let (depth, period, a) = (0.5, 40.0, 1e-6);
    let text = format!(
        "level = {depth}\nwaves = {{ regular = {{ height = {}, period = {period} }} }}",
        2.0 * a
    );
    let piston = maker::<2>(&text);
    let parts = piston
        .strokes(Paddle::Piston, [depth, 9.81])
        .expect("parts");
    let k = crate::waves::wavenumber(std::f64::consts::TAU / period, depth, 9.81);
    let kd: f64 = k * depth;
    let b = a * a * k * kd.cosh() * (2.0 + (2.0 * kd).cosh()) / (4.0 * kd.sinh().powi(3));
    let long = (b - a * a / depth) / (2.0 * kd);
    let error = (parts[1].amplitude / long - 1.0).abs();
    assert!(error < kd.powi(4), "{error} of {kd}");
}

#[test]
fn a_flap_turns_its_top_the_way_the_waves_run() {
    let flap = format!("{REGULAR}hinge = [0.0, 0.1]\nramp = 0\n");
    let mut plane = maker::<2>(&flap);
    plane.prepare(&setting()).expect("settled");
    let top = plane.next(&plane.start(), &Load::of_gravity(Vect::zeros()), 0.1, 0.0);
    assert!(top.movement([0.0, 0.5]).velocity[0] > 0.0);
    let text = format!("{REGULAR}hinge = [0.0, 0.0, 0.1]\nalong = [3, 4, 0]\nramp = 0\n");
    let mut space = maker::<3>(&text);
    space.prepare(&setting()).expect("settled");
    let top = space.next(&space.start(), &Load::of_gravity(Vect::zeros()), 0.1, 0.0);
    let u = top.movement([0.0, 0.0, 0.5]).velocity;
    assert!(u[0] > 0.0 && (u[0] * 4.0 - u[1] * 3.0).abs() < 1e-12, "{u}");
}

#[test]
fn impossible_wave_makers_are_refused_at_their_key() {
    let refused = |text: &str| {
        let mut maker = maker::<2>(text);
        maker.prepare(&setting()).expect_err("refused").key
    };
    assert_eq!(refused(&REGULAR.replace("0.5", "-0.5")), "level");
    assert_eq!(refused(&REGULAR.replace("0.06", "0.6")), "waves.regular");
    assert_eq!(refused(&format!("{REGULAR}hinge = [0.0, 0.7]")), "hinge");
    assert_eq!(
        refused(&format!("{REGULAR}hinge = [0.0, 0.0]\norder = 2")),
        "order"
    );
    assert_eq!(refused(&format!("{REGULAR}along = [0.0, 1.0]")), "along");
    assert_eq!(refused(&REGULAR.replace("1.4", "6.0")), "order");
    let mut dry = maker::<2>(REGULAR);
    let none = MoverSetting {
        gravity: Vect::zeros(),
        ..setting()
    };
    assert!(
        dry.prepare(&none)
            .expect_err("refused")
            .why
            .contains("gravity")
    );
}
