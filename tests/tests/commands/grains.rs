//! Scenes of grains through the program: results, bits, failures, bad input.

use sph_tests::{Bench, bench, files_with_extension, refusals};

/// Sixty grains that fall into a box.
const DRY: &str = include_str!("dry.toml");

/// The same in a fluid that drains through the top.
fn wet() -> String {
    format!("{DRY}[fluid]\nviscosity = \"5 Pa s\"\ndensity = 1000\n[wall.top]\npressure = 0\n")
}

/// Columns of the series and the last file of fields, as they are.
fn bytes(bench: &Bench, folder: &str) -> [Vec<u8>; 2] {
    let path = bench.path(folder);
    let fields = files_with_extension(&path.join("fields"), "vtu");
    let last = fields.iter().max().expect("a file of fields");
    [
        std::fs::read(path.join("series.csv")).expect("a series"),
        std::fs::read(last).expect("fields"),
    ]
}

#[test]
fn threads_and_a_stop_change_no_bit_of_dry_and_wet_grains() {
    for (scene, end) in [(DRY.to_string(), "0.2"), (wet(), "0.05")] {
        let bench = bench!(&scene);
        let set = format!("--quiet --set run.end={end}");
        for threads in [1, 2, 4] {
            bench.done(&format!(
                "run scene.toml {set} --threads {threads} --out r{threads}"
            ));
        }
        let half = bench.summary("r1")["steps"].as_u64().expect("steps") / 2;
        // The stop is a change of the scene, and nothing else is.
        bench.done(&format!(
            "run scene.toml {set} --out stopped --set run.max_steps={half}"
        ));
        assert_eq!(bench.summary("stopped")["steps"], half);
        bench.done(&format!(
            "run scene.toml {set} --out stopped --resume --changed --threads 2"
        ));
        let one = bytes(&bench, "r1");
        for other in ["r2", "r4"] {
            assert!(one == bytes(&bench, other), "{other} differs from 1 thread");
        }
        // The stop wrote no row of its own: the rows are those of the run in one go.
        let [series, fields] = bytes(&bench, "stopped");
        assert!(series == one[0], "the series after a stop differs");
        assert!(fields == one[1], "the fields after a stop differ");
    }
}

#[test]
fn a_scene_of_grains_carries_no_particles_and_the_reverse() {
    let bench = bench!(&wet());
    let explained = bench.done("explain scene.toml").out;
    for word in ["smoothing", "kernel", "formulation", "density_rate"] {
        assert!(!explained.contains(word), "`{word}` in\n{explained}");
    }
    assert!(explained.contains("linear-elastic") && explained.contains("hydraulic-radius"));
    let particles = bench.done("explain hydrostatic-tank").out;
    for word in ["contact", "throat", "grain"] {
        assert!(!particles.contains(word), "`{word}` in\n{particles}");
    }
}

/// A scene beside a file `spheres.txt` is refused, and nothing is written.
fn refused(scene: &str, spheres: &str, told: &str) {
    let bench = bench!(scene);
    bench.write("spheres.txt", spheres);
    bench.refused("run scene.toml --quiet").says(told);
    let written = bench.path("results").exists();
    assert!(!written, "{told}: something was written");
}

#[test]
fn mistakes_are_reported_with_their_line_and_nothing_is_written() {
    // Rows of the file have semicolons between them.
    for case in refusals(include_str!("grains.refused")) {
        refused(&case.of(&wet()), &case.at.replace(';', "\n"), case.said[0]);
    }
    let spheres = "0.05 0.05 0.05 0.01\n0.05 0.05 0.065 0.01\n";
    let from_file = DRY
        .replace("count = 60\nradius = [\"9 mm\", \"11 mm\"]\n", "")
        .replace("[start.cloud]", "[start]\nfile = \"spheres.txt\"");
    let line = "overlap | grain 1 is line 2 of `spheres.txt`";
    refused(&from_file, spheres, line);
    refused(&from_file, "0.05 0.05 -0.05 0.01\n", "wall 4 is `bottom`");
    refused(&from_file, "", "holds no spheres");
}

#[test]
fn a_recorded_pressure_acts_as_the_one_it_records() {
    let bench = bench!(&wet());
    let table = "time,a,b\n0,130,130\n0.01,130,130\n9,130,130\n";
    bench.write("load.csv", table);
    let load = "{file=\"load.csv\",places=[0.0,0.1],columns=[\"a\",\"b\"],less=30.0}";
    let recorded = wet().replace("pressure = 0\n", &format!("recorded = {load}\n"));
    bench.write("recorded.toml", &recorded);
    bench.write(
        "given.toml",
        wet().replace("pressure = 0\n", "pressure = 100\n"),
    );
    let set = "--quiet --set run.end=0.02";
    bench.done(&format!("run given.toml {set} --out given"));
    bench.done(&format!("run recorded.toml {set} --out recorded"));
    assert!(bytes(&bench, "given") == bytes(&bench, "recorded"));
}

#[test]
fn a_failed_run_names_the_grain_and_leaves_its_picture() {
    // Grains so soft that their own weight presses them through the floor.
    let soft = wet().replace("1 MPa", "20 Pa");
    let bench = bench!(&soft);
    bench.failed("run scene.toml --quiet --out r").says("grain");
    for file in ["bad_state.vtu", "bad_state.png", "summary.json"] {
        assert!(bench.path("r").join(file).is_file(), "{file} is missing");
    }
    assert_eq!(bench.summary("r")["status"], "failed");
}

/// `immersed-deposition` of the method's page: weight within 1 %.
#[test]
fn settled_grains_rest_on_the_floor_with_their_buoyant_weight() {
    let bench = bench!();
    bench.done("run grains-immersed-deposition --quiet --out r");
    let summary = bench.summary("r");
    for (reference, name) in [("floor-at-last", "floor"), ("fluid-at-last", "fluid")] {
        let error = summary["errors"][reference]["value"].as_f64();
        let error = error.expect("an error");
        assert!(error < 0.01, "{name}: {error}, 0.01 asked");
    }
}

#[test]
fn colours_of_a_field_that_is_not_there_are_told_with_the_nearest_name() {
    let bench = bench!(DRY);
    let checked = |range: &str| {
        bench.call(&format!(
            "check scene.toml --set output.picture_range={range}"
        ))
    };
    let refused = |range: &str, told: &str| checked(range).ended(2).says(told);
    let near = "output.picture_range.sped | did you mean `speed`?";
    refused("{sped=[0,1]}", near);
    let falls = "── output.picture_range.speed\n | less than the second";
    refused("{speed=[1,0]}", falls);
    refused("[1,1]", "── output.picture_range\n | less than the second");
    assert_eq!(checked("{speed=[0,1]}").code, Some(0));
    assert_eq!(checked("[0,1]").code, Some(0));
}
