//! Values put on top of a scene, and mistakes in them.

use sph_scene::{Diagnostic, Loaded, Origin, Override, Refused, parse};

const SCENE: &str = r#"title = "Pool"
dimension = 2
[run]
end = 1
[numerics]
spacing = 0.1
[kernel.cubic-spline]
[wall.tank]
polyline = [[0, 0], [1, 0]]
[phase.water]
density = 1000
[phase.water.rheology.newtonian]
viscosity = 1
[body.pool]
phase = "water"
box = [[0, 0], [1, 1]]
[probe.P1]
kind = "pressure"
at = [0, 0]
[reference.P1]
probe = "P1"
file = "p1.csv"
"#;

fn with(sets: &[&str]) -> Result<Loaded, Refused> {
    let sets: Vec<_> = sets.iter().map(|s| Override::parse(s).unwrap()).collect();
    parse(SCENE, "scenes/pool.toml", &sets)
}

fn only(sets: &[&str]) -> (Diagnostic, String) {
    let refused = with(sets).unwrap_err();
    assert_eq!(refused.diagnostics.len(), 1, "{refused}");
    let diagnostic = refused.diagnostics[0].clone();
    let text = refused.source.text_of(&diagnostic)[diagnostic.span.clone()].to_string();
    (diagnostic, text)
}

#[test]
fn values_reach_the_scene() {
    let sets = [
        "run.end=2 s",
        "probe.P1.at=[1.6,0.003]",
        "wall.tank.polyline[0][1]=0.3",
        "kernel.wendland-c4={}",
        "phase.water.rheology.bingham.yield_stress=10 kPa",
    ];
    let scene = with(&sets).unwrap().scene;
    assert_eq!(scene.run.end, 2.0);
    assert_eq!(scene.wall["tank"].polyline.as_ref().unwrap()[0], [0.0, 0.3]);
    assert_eq!(scene.choice("kernel").unwrap().name, "wendland-c4");
    let rheology = scene.choice_in("rheology", "water").unwrap();
    assert_eq!(rheology.name, "bingham");
    assert_eq!(rheology.table["yield_stress"].as_str(), Some("10 kPa"));
    let (name, probe) = &scene.probes()[0];
    assert_eq!((name.as_str(), probe.name.as_str()), ("P1", "pressure"));
    assert_eq!(probe.table["at"][0].as_float(), Some(1.6));
    assert_eq!(probe.inside("at[0]"), "probe.P1.at[0]");
}

#[test]
fn a_mistake_of_an_override_is_shown_in_the_override() {
    for (set, message) in [
        ("numerics.spacing=-1", "must be more than 0 m"),
        ("numerics.spcing=1", "did you mean `spacing`?"),
        ("numrics.spacing=1", "did you mean `numerics`?"),
        ("wall.tank.polyline[5]=[0,0]", "no entry 5 in a list of 2"),
        ("wall.tank.polyline[1]=[0,0,0]", "expected 2 numbers"),
        ("title.x=1", "what is not a table"),
        ("body.pool.phase=oil", "no phase called `oil`"),
        ("phase.oil.rheology.newtonian={}", "`density` is missing"),
        ("reference.P1.file=", "the name of the file is empty"),
    ] {
        let (diagnostic, text) = only(&["run.end=2", set]);
        assert_eq!(diagnostic.origin, Origin::Override(1), "{diagnostic}");
        assert!(diagnostic.message.contains(message), "{diagnostic}");
        assert_eq!(text, set);
        let place = (diagnostic.file.as_str(), diagnostic.line, diagnostic.column);
        assert_eq!(place, ("--set", 1, 1));
    }
}

#[test]
fn a_mistake_of_the_file_stays_in_the_file() {
    let bad = SCENE.replace("end = 1", "end = -1");
    let set = Override::parse("numerics.spacing=0.05").unwrap();
    let refused = parse(&bad, "pool.toml", &[set]).unwrap_err();
    let diagnostic = &refused.diagnostics[0];
    assert_eq!((diagnostic.origin, diagnostic.line), (Origin::File, 4));
    let text = refused.source.text_of(diagnostic);
    assert_eq!(&text[diagnostic.span.clone()], "end = -1");
}

#[test]
fn a_problem_found_later_is_shown_where_the_plugin_stands() {
    let loaded = with(&[]).unwrap();
    let choice = loaded.scene.choice_in("rheology", "water").unwrap();
    let error = sph_core::RegistryError::Parameters(vec![sph_core::SceneProblem::new(
        "viscosity",
        "must be more than 2",
    )]);
    let shown = loaded.source.diagnose(&choice.scene_problems(&error));
    assert_eq!(
        shown[0].to_string(),
        "scenes/pool.toml:13:1: phase.water.rheology.newtonian.viscosity: must be more than 2"
    );
}
