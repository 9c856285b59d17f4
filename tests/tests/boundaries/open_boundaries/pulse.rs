//! What comes back of a pulse of pressure.

use sph_tests::{below, close, scene};

use super::*;

/// Speed of sound of [`CHANNEL`], m/s, and width of a pulse in it, m.
const SOUND: f64 = 12.0;
const WIDTH: f64 = 0.8;

/// A channel of a length without friction, in which all moves with `flow` but for a pulse of pressure that runs to the
/// right from 5 m: a simple wave, δρ/ρ = u/c. Beside walls the rows of a lattice are out of balance in a pulse, and
/// stir: they start relaxed.
fn with_pulse(length: f64, flow: f64, high: f64, far: &str) -> Stepper<2> {
    let text = CHANNEL
        .replace(
            "spacing = 0.1\n",
            "spacing = 0.1\nrelax = { steps = 400, tolerance = 0.001 }\n",
        )
        .replace("phase = \"mud\"\n", "phase = \"water\"\n")
        .replace("[wall.bottom]", "[wall.bottom]\ncondition = \"free-slip\"")
        .replace("[wall.top]", "[wall.top]\ncondition = \"free-slip\"")
        .replace("[2.0,", &format!("[{length:.1},"))
        .replace("velocity = \"1 m/s\"", &format!("velocity = {flow:.1}"))
        .replace(
            "velocity = [1.0, 0.0]",
            &format!("velocity = [{flow:.1}, 0.0]"),
        )
        .replace("strength = 0.04", "strength = 0.01")
        .replace("memory = \"1 s\"", far);
    let mut stepper = Stepper::<2>::new(&scene(&text, &[])).unwrap_or_else(|e| panic!("{e}"));
    stepper.evaluate().unwrap_or_else(|e| panic!("{e}"));
    let pulse = |x: f64| high * (-((x - 5.0) / WIDTH).powi(2)).exp();
    let free = &stepper.parts().flow.world.free;
    let position = free.get(fields::POSITION).unwrap();
    let at: Vec<f64> = position.iter().map(|x| x[0]).collect();
    let gamma = free.get(fields::RENORMALISATION).unwrap();
    let constant = free.get(fields::DENSITY_CONSTANT).unwrap();
    let raised = constant.iter().zip(gamma).zip(&at);
    let raised: Vec<f64> = raised.map(|((k, g), x)| k + g * pulse(*x)).collect();
    let velocity = at.iter().flat_map(|x| [flow + SOUND * pulse(*x), 0.0]);
    let velocity: Vec<f64> = velocity.collect();
    stepper
        .set("velocity", &velocity)
        .unwrap_or_else(|e| panic!("{e}"));
    stepper
        .set("density_constant", &raised)
        .unwrap_or_else(|e| panic!("{e}"));
    stepper
}

/// Mean pressures at a time of the columns of particles within the first 10 m, Pa.
fn columns_at(stepper: &mut Stepper<2>, time: f64) -> Vec<f64> {
    stepper.run_until(time).unwrap_or_else(|e| panic!("{e}"));
    stepper.evaluate().unwrap_or_else(|e| panic!("{e}"));
    let free = &stepper.parts().flow.world.free;
    let pressure = free.get(fields::PRESSURE).unwrap();
    let mut sums = vec![[0.0; 2]; 100];
    for (x, p) in free.get(fields::POSITION).unwrap().iter().zip(pressure) {
        if let Some(sum) = sums.get_mut((x[0] / 0.1) as usize) {
            sum[0] += p;
            sum[1] += 1.0;
        }
    }
    sums.iter().map(|[p, n]| p / n).collect()
}

/// The value farthest from zero.
fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(
        0.0,
        |most: f64, p| if p.abs() > most.abs() { p } else { most },
    )
}

/// What comes back of a pulse of pressure that runs into the outlet, in per cent of it and with its sign, 0.55, 0.7 and
/// 0.83 s after the start. It is around 8.4, 6.6 and 5 m then.
///
/// It is what differs from a channel of twice the length, whose outlet nothing has reached yet: the pulse leaves slower
/// waves behind it, which have never been at the outlet. Of both what the flow makes without a pulse is taken.
fn comes_back(flow: f64, far: &str) -> [f64; 3] {
    let high = 1e-3;
    let mut channels =
        [10.0, 20.0].map(|length| [high, 0.0].map(|high| with_pulse(length, flow, high, far)));
    let before = largest(pulse_at(&mut channels[0], 0.2).into_iter()).abs();
    pulse_at(&mut channels[1], 0.2);
    assert!(before > 0.5 * SOUND * SOUND * high, "{before} Pa arrived");
    let shares = [0.55, 0.7, 0.83].map(|time| {
        let [a, b] = [0, 1].map(|k| pulse_at(&mut channels[k], time));
        // The last four spacings, a support, are those in which waves still leave.
        let apart = a.iter().zip(&b).map(|(a, b)| a - b);
        100.0 * largest(apart.take(96)) / before
    });
    println!("{flow} m/s, {far}: {shares:.2?} % came back at 0.55, 0.7 and 0.83 s");
    shares
}

/// Mean pressures of columns of a channel with a pulse over those of the channel without, Pa.
fn pulse_at(channels: &mut [Stepper<2>; 2], time: f64) -> Vec<f64> {
    let [with, without] = channels.each_mut().map(|c| columns_at(c, time));
    with.iter().zip(without).map(|(a, b)| a - b).collect()
}

#[test]
fn a_pressure_pulse_leaves() {
    for (flow, far) in [(0.0, "velocity = \"0 m/s\""), (1.0, "velocity = \"1 m/s\"")] {
        let shares = comes_back(flow, far);
        below(largest(shares.into_iter()), 2.0, "% that came back");
    }
}

/// With a memory T its mean of a pulse p(t) takes ∫p dt/T for slow, and throws that back: √π width/cT, 11.8 % here.
#[test]
fn a_memory_throws_back_what_its_mean_takes_of_a_pulse() {
    let shares = comes_back(0.0, "memory = \"1 s\"");
    let taken = 100.0 * std::f64::consts::PI.sqrt() * WIDTH / SOUND;
    for share in shares {
        close(share, -taken, 2.0, "% that came back");
    }
}
