//! Water over soil, at test sizes.

use crate::shipped::finished;
use sph_tests::{below, close, within};

/// Density of the bed of `movable-bed-dambreak-sand`, kg/m³.
const BULK: f64 = 1892.0;

/// A dam break over sand with particles of 25 mm: four rows of bed. What the water takes stays mass of sand, the
/// curves lie one over the other, and nothing has moved where the water has not come.
#[test]
fn a_dam_break_digs_its_bed_and_keeps_the_sand() {
    let run = finished(
        "movable-bed-dambreak-sand",
        &[
            "numerics.spacing=0.025 run.end=0.5 body.bed.box=[[-2.4,0],[0,0.1]] \
             body.beyond.box=[[0,0],[3,0.1125]] body.reservoir.box=[[-2.4,0.1],[0,0.45]] \
             probe.erosion.level=0.1125",
        ],
    );
    let front = run.last("front");
    // 16 and 8 mm have 0.91 and 1.00 m: of first order, 0.81 m with 25 mm and 1.09 m at last; the foremost particle tells
    // the front to a spacing.
    within(front, 0.81 - 0.025..1.09, "m, measured 0.80");
    let risen = run.last("erosion.risen");
    // The water takes the row that it runs over, to the half row that a spacing resolves. A row is the density of the bed
    // times a spacing times the length under water.
    let row = BULK * 0.025 * front;
    within(risen / row, 0.5..1.5, "rows, measured 31 kg/m");
    assert_eq!(run.last("erosion.out"), 0.0);
    let curves = sph_io::read_table(run.path("curves/bed_0002.csv")).expect("curves");
    let of = |name: &str| curves.column(name).expect("a curve").to_vec();
    let (x, surface, interface, limit) = (of("x"), of("surface"), of("interface"), of("limit"));
    let mut still = 0;
    for k in 0..x.len() {
        assert!(surface[k] >= interface[k], "at {} m", x[k]);
        let out_of_the_bed = limit[k] > interface[k] + 1e-12;
        assert!(!out_of_the_bed, "at {} m", x[k]);
        if x[k] > front + 0.3 && x[k] < 2.9 {
            still += 1;
            close(interface[k], 0.1125, 0.002, "m high");
            assert_eq!(limit[k], interface[k], "at {} m", x[k]);
        }
    }
    assert!(still > 20, "{still} columns before the front");
}

/// Mud of 0.65 m by 0.65 m on a slope: it draws the water down behind and lifts it ahead; volumes stay.
#[test]
fn a_slide_draws_the_water_down_and_pushes_a_crest() {
    let run = finished(
        "submarine-landslide",
        &["numerics.spacing=0.045", "run.end=0.4", "output.every=0.4"],
    );
    for phase in ["slide", "water"] {
        let volume = run.column(&format!("{phase}-volume"));
        let change = volume[volume.len() - 1] / volume[0] - 1.0;
        below(change, 0.01, &format!("change of the {phase}"));
    }
    let rise = |gauge: &str| run.series().change(gauge);
    let (above, ahead) = (rise("above"), rise("ahead"));
    assert!(above < -0.01, "above the slide the water rose by {above} m");
    assert!(ahead > 0.003, "ahead it rose by {ahead} m");
    let gone = rise("toe");
    assert!(gone > 0.04, "the toe went {gone} m");
}

/// Beads slide into water 0.15 m deep. The crest that they push is slower than a solitary wave of its height, √(g(h + A)),
/// the fastest there is, and faster than a train of waves five depths long, √(g tanh(kh)/k) = 0.82 √(gh); it falls
/// from gauge to gauge.
#[test]
fn the_crest_before_a_slide_from_the_air_runs_between_two_speeds_of_theory_at_1_05_m_s() {
    let run = finished(
        "subaerial-landslide",
        &["numerics.spacing=0.012 run.end=1.2 output.times=[1.2] output.picture=[]"],
    );
    let times = run.column("time");
    let crest = |gauge: &str| {
        let levels = run.column(gauge);
        let highest = (0..levels.len()).max_by(|a, b| levels[*a].total_cmp(&levels[*b]));
        let highest = highest.expect("a level");
        (times[highest], levels[highest] - levels[0])
    };
    let [first, .., last] = ["G1", "G2", "G3"].map(crest);
    let speed = 0.6 / (last.0 - first.0);
    let (g, depth) = (9.81_f64, 0.15);
    let solitary = (g * (depth + first.1)).sqrt();
    let k = std::f64::consts::TAU / (5.0 * depth);
    let train = (g * (k * depth).tanh() / k).sqrt();
    println!(
        "{speed} m/s between {train} and {solitary}, {} and {} m high",
        first.1, last.1
    );
    within(speed, train..solitary, "m/s");
    within(last.1, 0.0..first.1, "m of the last crest");
}

/// Friction that grows with the strain rate in a viscous fluid: the closed form, between the speeds that were measured.
#[test]
fn an_avalanche_under_a_viscous_fluid_has_its_steady_speed() {
    // Half a row of 10.5 holds to the plane, and is not sheared.
    finished("submarine-avalanche", &[]).error("speed", 0.5 / 10.5, 0.0407);
}
