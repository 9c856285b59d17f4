//! The commands as a person or a script meets them.

use std::path::Path;

use rayon::prelude::*;
use serde_json::Value;
use sph_tests::{DAM_BREAK, Outcome, PERIODIC, Says, bench, close, one_line};

fn json(outcome: &Outcome) -> Value {
    serde_json::from_str(&outcome.out).unwrap_or_else(|e| panic!("{e}\n{}", outcome.out))
}

fn text(value: &Value) -> &str {
    value.as_str().unwrap_or_default()
}

#[test]
fn every_command_has_help_with_what_it_leaves_behind() {
    let bench = bench!();
    let all = bench.done("--help");
    assert!(all.out.contains("Exit codes"), "{}", all.out);
    for command in [
        "run", "study", "check", "explain", "plugins", "schema", "scenes", "new",
    ] {
        assert!(all.out.contains(command), "{command} is not in the help");
        let help = bench.done(&format!("{command} --help"));
        assert!(help.out.contains("Usage:"), "{}", help.out);
    }
    let run = bench.done("run --help").out;
    run.says("series.csv | summary.json | checkpoint.sph | --resume | Exit codes");
}

#[test]
fn plugins_are_listed_by_kind_and_shown_with_their_parameters() {
    let bench = bench!();
    let kinds = json(&bench.done("plugins --json"));
    for kind in kinds.as_array().expect("kinds") {
        let kind_name = text(&kind["kind"]);
        let list = bench.done(&format!("plugins {kind_name}")).out;
        for plugin in kind["plugins"].as_array().expect("plugins") {
            let name = text(&plugin["name"]);
            assert!(list.contains(name) && list.contains(text(&plugin["provider"])));
            let shown = bench.done(&format!("plugins {kind_name} {name}")).out;
            for parameter in plugin["parameters"].as_array().expect("parameters") {
                shown.says(text(&parameter["name"]));
                assert_ne!(text(&parameter["meaning"]), "", "{name}: {parameter}");
            }
        }
    }
    let tait = bench.done("plugins equation-of-state tait").out;
    tait.says("[phase.NAME.equation-of-state.tait]");
    let refused = bench.refused("plugins kernel wendland-c3");
    refused.says("did you mean `wendland-c2`");
    bench.call("plugins kernl").says("did you mean `kernel`");
}

#[test]
fn laws_are_drawn_whatever_they_are_and_mistakes_leave_no_file() {
    let bench = bench!();
    let kind = json(&bench.done("plugins rheology --json"));
    for law in kind["plugins"].as_array().expect("plugins") {
        let name = text(&law["name"]);
        bench.done(&format!("plugins rheology {name} --picture {name}.svg"));
        let drawn = bench.read(&format!("{name}.svg"));
        drawn.says(&format!("shear stress [Pa] | {name}"));
    }
    bench.done("plugins kernel wendland-c2 cubic-spline --picture kernels.svg");
    let drawn = bench.read("kernels.svg");
    assert!(drawn.contains("wendland-c2") && drawn.contains("w h²"));
    let two = "plugins rheology bingham casson --set casson.yield_stress=3 --picture two.png";
    bench.done(two);
    assert!(bench.path("two.png").exists());
    let vary = "plugins rheology bingham --vary yield_stress=[1,7] --picture vary.svg";
    bench.done(vary);
    let drawn = bench.read("vary.svg");
    drawn.says(">yield_stress = 7<");
    let not_so = bench.refused("plugins rheology bingham --picture no.gif");
    not_so.says(".svg or .png");
    for (arguments, word) in [
        ("rheology binham", "did you mean `bingham`"),
        ("rheology bingham --set yeild_stress=1", "`yield_stress`"),
        (
            "rheology bingham casson --set csson.viscosity=1",
            "`casson`",
        ),
        ("rheology bingham elastic", "draw them apart"),
        ("rheology bingham --vary yield_stress=1", "expected a list"),
        ("rheology bingham --strain-rates=-1,1", "1e-12"),
        ("rheology mu-i --pressure 3kg", "Pa"),
        ("walls usaw", "only laws and kernels"),
        ("kernel wendland-c2 --set a=1", "for laws"),
    ] {
        let refused = bench.refused(&format!("plugins {arguments} --picture no.svg"));
        refused.says(word);
        assert!(!bench.path("no.svg").exists() && !bench.path("no.gif").exists());
    }
}

#[test]
fn the_schema_is_json_and_mentions_every_plugin() {
    let bench = bench!();
    let of_particles = bench.done("schema");
    let of_grains = bench.done("schema --grains");
    assert!(json(&of_particles)["properties"]["numerics"].is_object());
    assert!(json(&of_grains)["properties"]["grains"].is_object());
    for kind in json(&bench.done("plugins --json"))
        .as_array()
        .expect("kinds")
    {
        let grains = ["contact-law", "conductance"].contains(&text(&kind["kind"]));
        let schema = if grains { &of_grains } else { &of_particles };
        for plugin in kind["plugins"].as_array().expect("plugins") {
            let quoted = format!("\"{}\"", text(&plugin["name"]));
            assert!(schema.out.contains(&quoted), "no {quoted} in it");
        }
    }
}

/// Files of the workspace's folder of scenes.
fn shipped() -> Vec<std::path::PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
    let entries = std::fs::read_dir(folder).expect("the folder of scenes");
    let files = entries.map(|e| e.expect("an entry").path());
    files
        .filter(|p| p.extension().is_some_and(|e| e == "toml"))
        .collect()
}

/// As a file, and from the program, where its data have to be found; every eighth with a trial of its first steps.
#[test]
fn every_shipped_scene_explains_itself_as_a_file_and_from_the_program() {
    let bench = bench!();
    let files = shipped();
    assert!(!files.is_empty());
    files.par_iter().enumerate().for_each(|(k, file)| {
        let command = if k % 8 == 0 {
            "check --threads 1"
        } else {
            "explain"
        };
        bench.done(&format!("{command} {}", file.display()));
        let name = file.file_stem().and_then(|s| s.to_str()).expect("a name");
        bench.done(&format!("explain {name}"));
    });
    assert_eq!(bench.names().len(), 0);
}

#[test]
fn scenes_lists_every_shipped_scene_under_its_theme_with_its_time() {
    let bench = bench!();
    let listed = json(&bench.done("scenes --json"));
    let listed = listed.as_array().expect("an array");
    assert_eq!(listed.len(), shipped().len());
    let lines = bench.done("scenes").out;
    for scene in listed {
        let [name, theme, time, shows] =
            ["name", "theme", "time", "shows"].map(|key| text(&scene[key]));
        assert!(!text(&scene["title"]).is_empty(), "{name}");
        let (_, block) = lines
            .split_once(&format!("{theme}\n"))
            .unwrap_or_else(|| panic!("{theme} is no heading"));
        let (block, _) = block.split_once("\n\n").expect("blocks");
        let row = block
            .lines()
            .find(|row| row.split_whitespace().next() == Some(name));
        let row = row.unwrap_or_else(|| panic!("{name} is not under {theme}"));
        // All of it: nothing is cut at the stop of an abbreviation.
        assert!(row.contains(time) && row.ends_with(shows), "{row}");
    }
    // A scene of one's own in ./scenes has its title.
    std::fs::create_dir(bench.path("scenes")).expect("a folder");
    bench.write("scenes/own.toml", DAM_BREAK);
    let lines = bench.done("scenes").out;
    assert!(lines.starts_with("Others\n  own  "), "{lines}");
}

/// Water in a tank that a file draws.
const DRAWN: &str = r#"
title = "Drawn"
dimension = 2
run.end = 0.1
numerics = { spacing = "5 cm", gravity = [0.0, -9.81] }
wall.tank.file = "tank.csv"
phase.water = { density = 1000.0, rheology.newtonian.viscosity = 1e-3 }
body.water = { phase = "water", box = [[0.0, 0.0], [0.5, 0.5]] }
"#;

#[test]
fn a_new_scene_is_good_and_never_overwrites() {
    let bench = bench!();
    bench.done("new pool");
    bench.done("check pool.toml");
    bench.done("run pool.toml --quiet --set run.end=0.05");
    bench.refused("new pool.toml").says("exists already");
    // A copy brings the data that it is compared with.
    bench.done("new copy --from dam-break-koshizuka");
    bench.done("check copy.toml");
    // A copy of a file brings its drawings.
    std::fs::create_dir(bench.path("far")).expect("a folder");
    bench.write("far/tank.csv", "x,y\n0,1\n0,0\n1,0\n1,1\n");
    bench.write("far/drawn.toml", DRAWN);
    bench.done("new near --from far/drawn.toml");
    bench.done("check near.toml");
    assert_eq!(bench.call("new other --from nosuch").code, Some(2));
    assert!(!bench.path("other.toml").exists());
}

#[test]
fn a_run_tells_a_program_what_the_summary_says() {
    let bench = bench!(DAM_BREAK);
    let outcome = bench.done("run scene.toml --json --set run.end=0.02");
    let told = json(&outcome);
    let keys = "schema_version scene status plugins dimension particles steps simulated_seconds wall_seconds \
                wall_seconds_by_stage particle_steps_per_second bytes_per_particle dt_limiters dt_limits advice \
                drift errors warnings";
    for key in keys.split(' ') {
        assert!(!told[key].is_null(), "`{key}` is missing");
    }
    assert_eq!(told["status"], "done");
    let shares = told["dt_limiters"].as_object().expect("a table");
    let shares = shares.values().map(|v| v.as_f64().expect("a share"));
    close(shares.sum(), 1.0, 1e-12, "sum of the shares of limiters");
    let written: Value = bench.summary("results/scene");
    assert_eq!(told, written);
}

#[test]
fn a_run_tells_a_person_what_came_out_and_where_it_is() {
    let bench = bench!(DAM_BREAK);
    let set = "--set run.end=0.02 --set output.picture=pressure";
    let outcome = bench.done(&format!("run scene.toml {set}"));
    outcome
        .out
        .says("done | Δt limited by | results/scene | series.csv | pictures/pressure_0000");
    outcome.says("100.0 %");
    let quiet = bench.done("run scene.toml --quiet --set run.end=0.02");
    assert_eq!((quiet.out.as_str(), quiet.err.as_str()), ("", ""));
}

#[test]
fn check_counts_and_estimates_without_writing() {
    let bench = bench!(DAM_BREAK);
    let told = json(&bench.done("check scene.toml --json --threads 3"));
    assert_eq!(told["threads"], 3);
    assert!(told["particles"].as_u64() > Some(100) && told["wall_points"].as_u64() > Some(50));
    for key in ["steps", "hours", "memory_bytes", "disk_bytes"] {
        assert!(told["estimate"][key].as_f64() > Some(0.0), "{told:#}");
    }
    let fast = bench
        .done("check scene.toml --set phase.water.speed_of_sound=10")
        .out;
    fast.says("Mach number of `water`");
    assert_eq!(bench.names().len(), 1);
}

#[test]
fn explain_shows_that_nothing_unused_is_allocated() {
    let bench = bench!(PERIODIC);
    let told = json(&bench.done("explain scene.toml --json"));
    let columns = told["fields"].as_array().expect("columns");
    let columns: Vec<&str> = columns.iter().map(|f| text(&f["name"])).collect();
    for unused in "renormalisation viscosity phase density_constant_rate".split(' ') {
        assert!(!columns.contains(&unused), "a column `{unused}`");
    }
    let bytes: u64 = told["fields"]
        .as_array()
        .expect("columns")
        .iter()
        .map(|f| f["bytes"].as_u64().expect("a number"))
        .sum();
    assert_eq!(Some(bytes), told["bytes_per_particle"].as_u64());
    let shown = bench.done("explain scene.toml").out;
    shown.lacks("renormalisation | wall geometry | wall state");
    shown.says("Morris viscosity | reads at neighbours | limits of the time step | hu-adams");
}

/// A tank with two bodies of water side by side.
const TWO_BODIES: &str = r#"title = "Two bodies"
dimension = 2
run.end = 0.1
numerics = { spacing = 0.02, gravity = [0.0, -9.81] }
smoother.brezzi-pitkaranta = {}
walls.usaw.vertices = true
phase.water = { density = 1000.0, velocity_scale = 2.0, rheology.newtonian = { viscosity = 1e-3 } }
wall.tank = { box = [[0.0, 0.0], [0.6, 0.6]], open = ["y+"] }
body.left = { phase = "water", box = [[0.0, 0.0], [0.2, 0.3]] }
body.right = { phase = "water", box = [[0.2, 0.0], [0.4, 0.3]] }
"#;

#[test]
fn bodies_a_third_of_a_spacing_off_are_remarked_upon() {
    let bench = bench!(TWO_BODIES);
    let told = |right: &str| {
        let outcome = bench.done(&format!("check scene.toml --set body.right.box={right}"));
        one_line(&outcome.out)
    };
    let fits = told("[[0.2,0.0],[0.4,0.3]]");
    assert!(!fits.contains("into place"), "{fits}");
    let apart = told("[[0.2066,0.0],[0.4,0.3]]");
    let gap = "the particles of `left` and `right` are 1.33 spacings apart";
    apart.says(gap);
    let high = told("[[0.2,0.007],[0.4,0.3]]");
    let row = "the first row of `right` is 1.35 spacings from the wall `tank`";
    high.says(row);
}

#[test]
fn check_draws_a_scene_before_any_run_and_says_where() {
    let bench = bench!(DAM_BREAK);
    let told = bench.done("check scene.toml --picture drawn.png").out;
    assert!(told.ends_with("picture\n  drawn.png\n"), "{told}");
    let png = std::fs::read(bench.path("drawn.png")).expect("a picture");
    assert!(png.starts_with(b"\x89PNG"));
    let json = json(&bench.done("check scene.toml --picture drawn.png --json"));
    assert_eq!(json["picture"], "drawn.png");
    for (scene, file, word) in [
        ("scene.toml", "drawn.jpg", "it must end in .png"),
        ("grains-column-collapse", "drawn-2.png", "output.picture"),
    ] {
        let refused = bench.refused(&format!("check {scene} --picture {file}"));
        refused.says(word);
        assert!(!bench.path(file).exists());
    }
}
