//! Drawings as large as the limits allow, or of a size that only near-linear work gets through.

use sph_tests::{Bench, Outcome, bench, binary_stl};
use std::fmt::Write as _;

use crate::bad_files::limited;

/// Address space of a check, KiB: twice the gigabyte that no drawing of these sizes may take.
const MEMORY: u32 = 2_000_000;

fn scene(dimension: usize, body: &str, wall: &str) -> String {
    let gravity = ["[0, -9.81]", "[0, 0, -9.81]"][dimension - 2];
    format!(
        "title = \"t\"\ndimension = {dimension}\nrun.end = 0.1\nnumerics = {{ spacing = 1, gravity = {gravity} }}\n\
         [walls.usaw]\n[phase.water]\ndensity = 1000\nvelocity_scale = 2\nrheology.newtonian = {{ viscosity = 1 }}\n\
         [body.water]\nphase = \"water\"\nbox = {body}\n[wall.w]\n{wall}\n"
    )
}

/// `sph check` of a scene, in the memory that it may have.
fn checked(bench: &Bench, scene: &str) -> Outcome {
    bench.write("scene.toml", scene);
    limited(bench, "check scene.toml", MEMORY)
}

fn good(bench: &Bench, scene: &str) {
    checked(bench, scene).ended(0);
}

#[test]
fn a_drawing_of_eight_thousand_sub_paths() {
    let bench = bench!();
    let squares = (0..8000).fold(String::new(), |mut all, k| {
        let _ = write!(all, "M{} {}h5v5h-5z", k % 90 * 10, k / 90 * 10);
        all
    });
    bench.write(
        "w.svg",
        format!("<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 900 900'><path d='{squares}'/></svg>"),
    );
    let body = "[[-100, -100], [-50, -50]]";
    for fluid in ["as-drawn", "outside"] {
        let wall = format!("file = \"w.svg\"\nfluid = \"{fluid}\"");
        good(&bench, &scene(2, body, &wall));
    }
    // The motion is one for all of them.
    let rows = (0..200_000).fold(String::new(), |mut all, k| {
        let _ = writeln!(all, "{k},{}", k % 2);
        all
    });
    bench.write("m.csv", &rows);
    let moved = "file = \"w.svg\"\nmotion.translate = { along = [0.01, 0], file = \"m.csv\" }";
    good(&bench, &scene(2, body, moved));
}

#[test]
fn polylines_of_twenty_thousand_corners() {
    let bench = bench!();
    let body = "[[-100, -100], [-50, -50]]";
    for tooth in [[1, 0], [0, 1]] {
        let corners = (0..20_000).fold(String::new(), |mut all, k| {
            let [along, out] = [k, k % 2 * 3];
            let _ = match tooth {
                [1, _] => write!(all, "[{along}, {out}],"),
                _ => write!(all, "[{out}, {along}],"),
            };
            all
        });
        good(&bench, &scene(2, body, &format!("polyline = [{corners}]")));
    }
    // Each within all that came after it; the innermost has no room for a particle.
    let rings = (10..8010).fold(String::new(), |mut all, k| {
        let _ = write!(all, "{k},{k}\n-{k},{k}\n-{k},-{k}\n{k},-{k}\n{k},{k}\n\n");
        all
    });
    bench.write("w.csv", &rings);
    let wall = "file = \"w.csv\"\nfluid = \"inside\"\nscale = 0.001";
    let full = scene(2, "[[-0.5, -0.5], [0.5, 0.5]]", wall);
    checked(&bench, &full).ended(2).says("body.water");
}

#[test]
fn facets_by_the_ten_thousand() {
    let bench = bench!();
    let mut state = 1_u64;
    let mut random = || {
        state = state
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (state >> 40) as f32 / (1 << 24) as f32
    };
    let tangle: Vec<[[f32; 3]; 3]> = (0..200_000)
        .map(|_| std::array::from_fn(|_| std::array::from_fn(|_| 10.0 * random())))
        .collect();
    bench.write("w.stl", binary_stl(&tangle));
    let body = "[[-10, -10, -10], [-5, -5, -5]]";
    let tangled = scene(3, body, "file = \"w.stl\"");
    checked(&bench, &tangled).ended(2).says("cross");
    // A sheet of 20,000, of which each has a dozen beside it.
    let height = |i: usize, j: usize| (0.1 * i as f32).sin() + (0.13 * j as f32).cos();
    let at = |i: usize, j: usize| [i as f32, j as f32, height(i, j)];
    let sheet: Vec<_> = (0..10_000)
        .flat_map(|k| {
            let (i, j) = (k % 100, k / 100);
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            [[a, b, c], [a, c, d]]
        })
        .collect();
    bench.write("w.stl", binary_stl(&sheet));
    let body = "[[10, 10, 10], [15, 15, 15]]";
    good(&bench, &scene(3, body, "file = \"w.stl\""));
}
