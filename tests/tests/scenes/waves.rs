//! Waves that travel.

use crate::shipped::finished;
use sph_waves as _;

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

/// With 10.5 rows over the depth instead of 20.5.
#[test]
fn a_solitary_wave_keeps_its_celerity_and_height_over_ten_depths() {
    let coarse = [
        "numerics.spacing=0.009523809523809525",
        "body.water.wave.bottom=0.0047619047619047624",
    ];
    let run = finished("solitary-wave", &coarse);
    let series = run.series();
    let column = |name: &str| {
        let column = series.column(name);
        column.unwrap_or_else(|| panic!("no {name}")).to_vec()
    };
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
        let run = finished(
            "wave-flume-absorbing",
            &["numerics.spacing=0.05", &flume, &water],
        );
        let series = run.series();
        let heights = series.column("waves.incident").expect("waves");
        heights[heights.len() - 1] / 2.0_f64.sqrt()
    };
    let [short, long] = [4.6, 5.1].map(height);
    let back = ((long - short) / (long + short)).abs();
    println!("{short} m and {long} m for 0.05 m: {back} of a wave comes back");
    assert!(
        back < 0.07,
        "{back} of a wave comes back: {short} m, {long} m"
    );
}

/// The lag over a period of 1.3 s is required to be below 0.05; a sample of the gauge is 0.015 of a period.
#[test]
fn a_shaken_tank_sloshes_in_time_with_the_experiment() {
    let run = finished("sloshing-tank", &["numerics.spacing=0.04", "run.end=4"]);
    run.error("phase", 0.05, 0.016);
}
