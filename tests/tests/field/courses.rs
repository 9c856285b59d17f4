//! Courses and tables that are read from files.

use sph_tests::{Says, below, close, near};

use crate::Field;

/// A coarse tank for a short time.
const SHORT: &str = "--set numerics.spacing=0.025 --set run.end=0.2 \
                     --set numerics.relax={steps=20,tolerance=0.01} --threads 1";

/// The scene of a tank whose course is in a file, with further keys of the course.
fn course(field: &Field, name: &str, file: &str, keys: &str) {
    let scene = field.read("shake.toml");
    let scene = scene.replace("file = \"shake.dat\"", &format!("file = \"{file}\"{keys}"));
    field.write(&format!("{name}.toml"), &scene);
}

#[test]
fn a_course_in_a_wrong_unit_is_refused_at_its_line() {
    let field = Field::new();
    for ending in ["dat", "csv", "txt"] {
        field.write(&format!("s.{ending}"), field.read("shake.dat"));
        course(&field, "s", &format!("s.{ending}"), "");
        let place = format!("wall.tank.motion.translate.file | `s.{ending}`, line ");
        field.refuses("s", "", &place);
        field.refuses("s", "", "the speed of sound is 14 | unit = \"mm\"");
    }
    // A vessel may go as fast as it likes, as long as it gets there slowly enough: 30 m/s in 100 s.
    let slow: String = (0..=100)
        .map(|t| format!("{t} {}\n", 0.15 * f64::from(t * t)))
        .collect();
    field.write("slow.csv", &slow);
    course(&field, "slow", "slow.csv", "");
    let told = field.check("slow", "--set run.end=100").ended(0);
    told.out.says("changes its speed by");
}

#[test]
fn angles_in_degrees_without_a_word_press_the_fluid_together() {
    let field = Field::new();
    let rows: String = (0..=200)
        .map(|k| f64::from(k) * 0.01)
        .map(|t| format!("{t},{}\n", 20.0 * (std::f64::consts::PI * t).sin()))
        .collect();
    field.write("tilt.csv", &rows);
    let tilt = |keys: &str| {
        let scene = field.read("shake.toml");
        let from = "translate = { along = [1.0, 0.0], file = \"shake.dat\" }";
        let to = format!("rotate = {{ centre = [0.3, 0.0], file = \"tilt.csv\"{keys} }}");
        field.write("tilt.toml", scene.replace(from, &to));
        field.check("tilt", "--set run.end=2")
    };
    assert!(tilt("").err.contains("wall.tank.motion.rotate.file"));
    let degrees = tilt(", unit = \"deg\"").ended(0);
    assert!(!degrees.out.contains("the vessel"), "{}", degrees.out);
}

#[test]
fn a_course_says_its_unit_its_columns_or_has_them_in_its_head() {
    let field = Field::new();
    let rows = field.read("shake.dat");
    let pairs = || {
        rows.lines()
            .filter_map(|l| l.split_once(' '))
            .map(|(t, x)| (t, x.trim()))
    };
    let milliseconds = |t: &str| 1000.0 * t.parse::<f64>().expect("a time");
    let write = |name: &str, head: &str, row: &dyn Fn(&str, &str) -> String| {
        let rows: Vec<String> = pairs().map(|(t, x)| row(t, x)).collect();
        field.write(name, format!("{head}{}\n", rows.join("\n")));
    };
    write("head.csv", "n; time [ms]; shift (mm)\n", &|t, x| {
        format!("1; {}; {x}", milliseconds(t))
    });
    write("note.txt", "# recorded\n# t[s] x [mm]\n", &|t, x| {
        format!("{t} {x}")
    });
    write("bare.dat", "", &|t, x| format!("{x}\t7\t{t}"));
    let mut found: Vec<Vec<f64>> = Vec::new();
    for (file, keys) in [
        ("shake-m.csv", ""),
        ("shake.dat", ", unit = \"mm\""),
        ("shake.dat", ", scale = 1e-3"),
        ("head.csv", ", columns = [\"time\", \"shift\"]"),
        (
            "head.csv",
            ", columns = [\"time\", \"shift\"], unit = \"mm\", time_unit = \"ms\"",
        ),
        ("note.txt", ""),
        ("bare.dat", ", columns = [\"3\", \"1\"], unit = \"mm\""),
    ] {
        course(&field, "c", file, keys);
        found.push(field.ran("c", SHORT).column("tank.x").to_vec());
    }
    for (k, force) in found.iter().enumerate() {
        let apart = force.iter().zip(&found[0]).map(|(a, b)| (a - b).abs());
        below(apart.fold(0.0, f64::max), 1e-3, &format!("{k}: N"));
    }
}

#[test]
fn keys_of_a_course_are_held_against_it() {
    let field = Field::new();
    for (keys, word) in [
        (", unit = \"kg\"", "`kg` is no unit of length"),
        (", time_unit = \"mm\"", "`mm` is no unit of time"),
        (", unit = \"mm\", scale = 2.0", "not both"),
        (", columns = [\"1\", \"3\"]", "2 columns only"),
    ] {
        course(&field, "k", "shake.dat", keys);
        field.refuses("k", "", &format!("wall.tank.motion.translate | {word}"));
    }
    field.write("kg.csv", "t [s], x [kg]\n0,0\n1,0.1\n");
    course(&field, "k", "kg.csv", "");
    field.refuses("k", "", "line 1 | `kg` is no unit of length");
}

#[test]
fn the_default_domain_goes_along_with_a_tank_on_a_recorded_course() {
    let field = Field::new();
    let coarse = "--set numerics.spacing=0.02 --threads 1";
    let series = field.ran("shake2", coarse);
    let mean = |name: &str| {
        let column = series.column(name);
        let last = &column[column.len() - 20..];
        last.iter().sum::<f64>() / last.len() as f64
    };
    // The level leans by a/g under 1 m/s² of acceleration; the gauges are 0.5 m apart.
    let lean = mean("left") - mean("right");
    close(lean, 0.5 / 9.81, 0.02 / 4.0, "lean in m");
    // It is not stopped in the last interval of its table.
    let mass = 900.0 * 0.6 * 0.2;
    near(series.last("tank.x"), -mass, 0.1, "force in N/m");
}

#[test]
fn the_default_domain_goes_along_with_a_tank_that_is_carried_round() {
    let field = Field::new();
    let scene = "title = \"t\"\ndimension = 2\nrun.end = 3.0\nnumerics.spacing = 0.025\nnumerics.smoothing_ratio = 2\n\
                 walls.usaw.vertices = false\nwall.tank.box = [[0, 0], [0.2, 0.2]]\n\
                 wall.tank.motion = { angular_velocity = 1.0, centre = [-2.0, 0.0] }\n\
                 phase.oil = { density = 900, speed_of_sound = 20.0, rheology.newtonian = { viscosity = 10.0 } }\n\
                 viscous-operator.morris = {}\nsmoother.brezzi-pitkaranta.strength = 0.1\n\
                 output.every = 1.0\nbody.oil.phase = \"oil\"\nbody.oil.fill = \"walls\"\n\
                 body.oil.initial.rigid-rotation = { angular_velocity = 1.0, centre = [-2.0, 0.0] }\n";
    field.write("round.toml", scene);
    field.ran("round", "--threads 1");
    let summary = field.summary();
    assert_eq!(summary["status"], "done", "{summary}");
}
