//! What a scene or a study names lies in its folder, unless the command line says otherwise.

use std::os::unix::fs::symlink;

use sph_tests::{Bench, DAM_BREAK, Says, bench};

const POLYLINE: &str =
    "polyline = [[0.0, 0.0], [0.6, 0.0], [0.6, 0.6], [0.0, 0.6]]\nclosed = true\n";
const TANK: &str = "0,0\n0.6,0\n0.6,0.6\n0,0.6\n0,0\n";
const SVG: &str = "<svg viewBox='0 0 0.6 0.6'><rect width='0.6' height='0.6'/></svg>";

/// Scenes that name a file in each of the ways there are, with the key.
fn scenes(file: &str) -> Vec<(&'static str, String)> {
    assert!(DAM_BREAK.contains(POLYLINE));
    let add = |more: &str| DAM_BREAK.to_string() + &more.replace("FILE", file);
    let wall = |ending: &str| {
        let named = format!("file = \"{file}.{ending}\"\nfluid = \"inside\"\n");
        DAM_BREAK.replace(POLYLINE, &named)
    };
    vec![
        ("wall.tank.file", wall("csv")),
        ("wall.tank.file", wall("svg")),
        (
            "reference.r.file",
            add("[reference.r]\nprobe = \"front\"\nfile = \"FILE.csv\"\n"),
        ),
        (
            "probe.surface.file",
            add("[probe.surface]\nkind = \"line\"\nfile = \"FILE.csv\"\n"),
        ),
        (
            "wall.tank.motion.translate.file",
            DAM_BREAK.replace(
                "condition = \"free-slip\"",
                &format!("condition = \"free-slip\"\nmotion.translate = {{ along = [1, 0], file = \"{file}.csv\" }}"),
            ),
        ),
    ]
}

/// home/scenes/scene.toml and, outside its folder, home/data.
fn home() -> Bench {
    let bench = bench!();
    for folder in ["scenes", "scenes/sub", "data"] {
        std::fs::create_dir(bench.path(folder)).expect("a folder");
    }
    bench.write("data/x.csv", TANK);
    bench.write("data/x.svg", SVG);
    symlink(bench.path("data"), bench.path("scenes/linked")).expect("a link");
    bench
}

#[test]
fn no_file_of_a_scene_is_out_of_its_folder() {
    let bench = home();
    let absolute = bench.path("data/x").display().to_string();
    for (named, word) in [
        ("../data/x", "lies outside"),
        ("sub/../../data/x", "lies outside"),
        ("linked/x", "leads to"),
        (absolute.as_str(), "is an absolute path"),
    ] {
        for (key, scene) in scenes(named) {
            bench.write("scenes/scene.toml", &scene);
            let refused = bench.refused("check scenes/scene.toml");
            refused.says(&format!("{word} | {key} | --allow-path"));
            // The folder may be allowed; then it is read, and what is wrong is another thing.
            let outcome = bench.call("check scenes/scene.toml --allow-path data");
            outcome.err.lacks("--allow-path | cannot read");
            bench.refused("check scenes/scene.toml --allow-path scenes");
        }
    }
    let refused = bench.refused("check scenes/scene.toml --allow-path nowhere");
    refused.says("no such folder");
}

#[test]
fn a_path_of_the_command_line_is_the_users_own() {
    let bench = home();
    let (_, scene) = scenes("y").swap_remove(0);
    bench.write("scenes/scene.toml", &scene);
    bench.write("scenes/y.csv", TANK);
    bench.done("check scenes/scene.toml");
    bench.done("check scenes/scene.toml --set wall.tank.file=../data/x.csv");
    bench.done("check scenes/scene.toml --set wall.tank.file=linked/x.csv");
    let absolute = bench.path("data/x.csv").display().to_string();
    bench.done(&format!(
        "check scenes/scene.toml --set wall.tank.file={absolute}"
    ));
    // It frees that path alone.
    let both = scene + "[reference.r]\nprobe = \"front\"\nfile = \"../data/x.csv\"\n";
    bench.write("scenes/scene.toml", &both);
    let refused = bench.refused("check scenes/scene.toml --set wall.tank.file=../data/x.csv");
    refused.says("reference.r.file");
}

#[test]
fn nor_is_what_a_study_names() {
    let bench = home();
    std::fs::create_dir(bench.path("studies")).expect("a folder");
    let (_, scene) = scenes("y").swap_remove(2);
    bench.write("scenes/scene.toml", &scene);
    bench.write("scenes/y.csv", "t,x\n0,0.2\n0.1,0.3\n");
    let study = |scene: &str, file: &str| {
        format!(
            "title = \"t\"\nscene = \"{scene}\"\nerror = \"r\"\n[[vary]]\nname = \"v\"\nkey = \"reference.r.file\"\n\
             values = [\"{file}\"]\n"
        )
    };
    let refused = |text: &str, call: &str, words: &[&str]| {
        bench.write("studies/s.toml", text);
        let outcome = bench.refused(&format!(
            "study studies/s.toml --set run.end=0.001 --quiet --out o {call}"
        ));
        for word in words {
            outcome.says(word);
        }
    };
    let out = "lies outside";
    refused(&study("../scenes/scene.toml", "y.csv"), "", &["scene", out]);
    let absolute = bench.path("scenes/scene.toml").display().to_string();
    refused(&study(&absolute, "y.csv"), "", &["is an absolute path"]);
    // A value of the study is no more the user's than one of the scene.
    let allowed = "--allow-path scenes";
    let data = bench.path("data/x.csv").display().to_string();
    refused(
        &study("../scenes/scene.toml", &data),
        allowed,
        &["absolute"],
    );
    refused(
        &study("../scenes/scene.toml", "../data/x.csv"),
        allowed,
        &[out],
    );
    bench.write("studies/s.toml", study("../scenes/scene.toml", "y.csv"));
    bench.done(&format!(
        "study studies/s.toml --set run.end=0.001 --quiet --out o {allowed}"
    ));
}
