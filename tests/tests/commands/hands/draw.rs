//! Pictures that are made of a run afterwards, and the distance to the surface.

use sph_tests::{DAM_BREAK, Says, bench};

use crate::hands::reals;

/// Water at rest in a tank, whose distance to the surface is drawn.
const TANK: &str = include_str!("tank.toml");
/// The walls of the tank.
const WALLS: &str = "[walls.usaw]\nvertices = false\n[wall.tank]\nbox = [[0.0, 0.0], [1.0, 1.0]]\nopen = [\"y+\"]\n";

/// Place and distance of every particle of the last frame.
fn distances(bench: &sph_tests::Bench, frame: &str) -> Vec<([f64; 3], f64)> {
    let (piece, _) = sph_io::read_vtu(bench.path(frame)).expect("a frame");
    let values = reals(&piece, "surface_distance");
    piece.points.iter().copied().zip(values).collect()
}

/// On a lattice the nearest surface particle stands straight above: H − y, up to what the water falls in 0.1 ms, 5·10⁻⁸ m.
#[test]
fn in_a_tank_it_is_the_depth_beside_walls_too() {
    let bench = bench!(TANK);
    bench.done("run scene.toml -q --threads 1 --out a");
    let all = distances(&bench, "a/fields/fluid_000000.vtu");
    assert_eq!(all.len(), 20 * 12);
    let off = |(x, d): &([f64; 3], f64)| (d - (0.6 - x[1])).abs();
    let worst = all.iter().map(off).fold(0.0, f64::max);
    println!("off by {worst:.1e} m at most");
    assert!(worst < 1e-6, "{worst}");
    assert!(bench.path("a/pictures/surface_distance_0000.png").exists());
}

/// A drop whose rim is the staircase of a lattice. A particle with an empty cone lacks a neighbour within 45° of the normal
/// and is therefore less than a spacing within the circle; one beside it may be as near to the circle and a spacing away.
#[test]
fn in_a_drop_it_is_the_radius_less_the_place_within_a_spacing() {
    let scene = TANK
        .replace(WALLS, "")
        .replace(
            "gravity = [0.0, -9.81]\n",
            "domain = [[-1.0, -1.0], [1.0, 1.0]]\n",
        )
        .replace(
            "box = [[0.0, 0.0], [1.0, 0.6]]\npressure = \"hydrostatic\"",
            "disc = { centre = [0.0, 0.0], radius = 0.6 }",
        );
    let bench = bench!(&scene);
    bench.done("run scene.toml -q --threads 1 --out a");
    let all = distances(&bench, "a/fields/fluid_000000.vtu");
    let off = |(x, d): &([f64; 3], f64)| d - (0.6 - x[0].hypot(x[1]));
    let worst = all.iter().map(|p| off(p).abs()).fold(0.0, f64::max);
    println!("off by {:.2} spacings at most", worst / 0.05);
    assert!(worst < 0.05, "{worst}");
}

#[test]
fn without_a_surface_it_is_no_number_and_who_does_not_ask_has_no_column() {
    let scene = TANK
        .replace(WALLS, "")
        .replace(
            "gravity = [0.0, -9.81]",
            "periodic = { x = [0, 1], y = [0, 0.6] }",
        )
        .replace("\npressure = \"hydrostatic\"", "");
    let bench = bench!(&scene);
    bench.done("run scene.toml -q --threads 1 --out a");
    let all = distances(&bench, "a/fields/fluid_000000.vtu");
    assert!(all.iter().all(|(_, d)| d.is_nan()));
    let told = bench.done("explain scene.toml").out;
    assert!(!told.contains("surface distance"), "{told}");
    let near = bench.call("check scene.toml --set output.fields=['surface_distanc']");
    near.says("did you mean `surface_distance`?");
}

#[test]
fn streamlines_profiles_and_tracks_of_a_dam_break_are_drawn() {
    let bench = bench!(DAM_BREAK);
    bench.done("run scene.toml -q --threads 1 --set run.end=0.2 --set output.every=0.05 --out a");
    let told = bench
        .done("draw streamlines a --out lines.png --time 0.2")
        .out;
    told.says("lines in lines.png and lines.csv");
    bench.done("draw profile a --from 0,0.02 --to 0.5,0.02 --field pressure --time 0,0.1,0.2 --out line.svg");
    let svg = bench.read("line.svg");
    svg.says("pressure [Pa] | t = 0.1 s");
    bench.done("draw tracks a --near 0.01,0.01 --identity 5 --out tracks.png");
    let rows = sph_io::read_table(bench.path("tracks.csv")).expect("a table");
    assert_eq!(
        rows.column("time"),
        Some(&[0.0, 0.05, 0.1, 0.15000000000000002, 0.2].repeat(2)[..])
    );
    for wrong in [
        "draw tracks a --identity 4000000",
        "draw profile a --from 0,0 --to 0,0",
        "draw profile a --from 0,0 --to 1,1 --field vorticity",
        "draw streamlines a --out lines.gif",
        "draw streamlines gone",
        "draw streamlines a --apart 0",
    ] {
        assert_eq!(bench.call(wrong).code, Some(2), "{wrong}");
    }
}
