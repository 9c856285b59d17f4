//! Waves that travel.

use crate::shipped::finished;
use sph_open as _;

/// Time of the crest, s, as the middle of the times at half its height, and its height over the first
/// value, m.
fn passage(time: &[f64], level: &[f64]) -> [f64; 2] {
    let raised: Vec<f64> = level.iter().map(|y| y - level[0]).collect();
    let height = raised.iter().copied().fold(0.0, f64::max);
    let half = 0.5 * height;
    let pairs = raised.windows(2).zip(time.windows(2));
    let crossed = pairs.filter(|(y, _)| (y[0] < half) != (y[1] < half));
    let place = |(y, t): (&[f64], &[f64])| t[0] + (half - y[0]) / (y[1] - y[0]) * (t[1] - t[0]);
    let times: Vec<f64> = crossed.map(place).collect();
    assert!(times.len() >= 2, "no crest passes");
    [0.5 * (times[0] + times[times.len() - 1]), height]
}

/// Amplitude of a standing wave in every half period over that of the first: √(largest less least kinetic energy).
fn amplitudes(overrides: &[&str]) -> Vec<f64> {
    const HALF: f64 = 3.5515 / 2.0;
    let coarse = [
        "numerics.spacing=0.05 body.water.box=[[-1.0,0.0],[1.0,1.025]] \
         numerics.smoothing_ratio=2.0 smoother.delta-sph.strength=0.1 run.end=10.7 \
         reference.swing.window=[8.9,10.7]",
    ];
    let run = finished("standing-wave-inviscid", &[&coarse, overrides].concat());
    let column = |name| run.column(name);
    let (time, energy) = (column("time"), column("energy"));
    let swing = |k: usize| {
        let within = |t: f64| (t / HALF) as usize == k;
        let of_half = time.iter().zip(&energy).filter(|(t, _)| within(**t));
        let (low, high) = of_half.fold((f64::MAX, 0.0_f64), |(low, high), (_, e)| {
            (low.min(*e), high.max(*e))
        });
        (high - low).sqrt()
    };
    (0..6).map(|k| swing(k) / swing(0)).collect()
}

/// 20 rows, three periods. The loss without the plugin is the same at half the amplitude and at any strength of smoother and
/// damper: it is that of cut supports.
#[test]
fn a_standing_wave_keeps_its_amplitude_with_a_renormalised_surface() {
    let kept = amplitudes(&[])[5];
    let without = amplitudes(&["surface={}"])[5];
    println!("{kept} of the amplitude after three periods, {without} without");
    assert!((0.98..1.01).contains(&kept), "{kept}");
    assert!(without < 0.97, "{without}");
}

/// With 10.5 rows over the depth instead of 20.5.
#[test]
fn a_solitary_wave_keeps_its_celerity_and_height_over_ten_depths() {
    let coarse =
        ["numerics.spacing=0.009523809523809525 body.water.wave.bottom=0.0047619047619047624"];
    let run = finished("solitary-wave", &coarse);
    let column = |name| run.column(name);
    let time = column("time");
    let [[early, first], [late, last]] =
        ["before", "end"].map(|name| passage(&time, &column(name)));
    let celerity = 1.0 / (late - early);
    let exact = (9.81_f64 * 0.13).sqrt();
    let error = (celerity / exact - 1.0).abs();
    assert!(error < 0.05, "{celerity} m/s for {exact}: {error}");
    let loss = 1.0 - last / first;
    println!("celerity {celerity} m/s for {exact}, crest {first} m, then {last} m");
    assert!(loss.abs() < 0.1, "the crest loses {loss} of {first} m");
    let start = column("start")[0] - column("end")[0];
    let missed = (start / 0.03 - 1.0).abs();
    assert!(missed < 0.1, "the wave starts {start} m high: {missed}");
}

/// Waves that run to a wall have a/(1 − R e^{−2ikL}) of the height a that the piston makes, R of what comes back to it being sent out
/// again. Lengths that differ by a quarter of a wave turn the sign, so that the ratio of both heights is (1 + R')/(1 − R') with
/// R' ≤ R; less than 7 % is asked of flumes. Without absorption R is 1, and the ratio has no bound.
#[test]
fn a_piston_takes_back_what_a_wall_sends_to_it() {
    let height = |length: f64| {
        let flume = format!("wall.flume.polyline=[[-0.5,0.0],[{length},0.0],[{length},0.8]]");
        let water = format!("body.water.box=[[0.0,0.0],[{length},0.5]]");
        let set = ["numerics.spacing=0.05", &flume, &water];
        finished("wave-flume-absorbing", &set).last("waves.incident") / 2.0_f64.sqrt()
    };
    let [short, long] = [4.6, 5.1].map(height);
    let back = ((long - short) / (long + short)).abs();
    println!("{short} m and {long} m for 0.05 m: {back} of a wave comes back");
    assert!(back < 0.07, "{back} back: {short} m, {long} m");
}

/// The lag over a period of 1.3 s is required to be below 0.05; a sample of the gauge is 0.015 of a period.
#[test]
fn a_shaken_tank_sloshes_in_time_with_the_experiment() {
    let run = finished("sloshing-tank", &["numerics.spacing=0.04", "run.end=4"]);
    run.error("phase", 0.05, 0.016);
}

/// Phase, rad, of what swings with a period in a series from a time on, over whole periods.
fn phase(time: &[f64], level: &[f64], from: f64, period: f64) -> f64 {
    let omega = std::f64::consts::TAU / period;
    let rows = || time.iter().zip(level).filter(|(t, _)| **t >= from);
    let mean = rows().map(|(_, y)| y).sum::<f64>() / rows().count() as f64;
    let sum = |f: fn(f64) -> f64| -> f64 { rows().map(|(t, y)| (y - mean) * f(omega * t)).sum() };
    sum(f64::sin).atan2(sum(f64::cos))
}

/// With ten rows in place of 20, and ten periods. The lag of a gauge 1.5 m farther on tells how long the waves are: they are to be
/// nearer to the waves on the current, √(gk tanh kd) + kU = ω, than to those in still water. Less than 7 % may come back.
#[test]
fn waves_on_and_against_a_current_have_its_length_and_leave() {
    let coarse = [
        "numerics.spacing=0.05 run.end=14.4 probe.waves.from=12 probe.waves.to=14.4 \
         reference.height.window=[14.39,14.41] reference.reflection.window=[14.39,14.41]",
    ];
    let still = 2.048;
    for (scene, theory) in [
        ("waves-on-current", 2.399),
        ("waves-against-current", 1.638),
    ] {
        let run = finished(scene, &coarse);
        let time = run.column("time");
        let [near, far] = ["near", "far"].map(|name| phase(&time, &run.column(name), 12.0, 1.2));
        let lag = (far - near).rem_euclid(std::f64::consts::TAU);
        let length = std::f64::consts::TAU * 1.5 / lag;
        let back = run.last("waves.coefficient");
        println!("{scene}: {length} m long for {theory} m, {back} comes back");
        let off = (length - theory).abs();
        assert!(off < 0.5 * (theory - still).abs(), "{length} m");
        assert!(back < 0.07, "{back} of a wave comes back");
    }
}
