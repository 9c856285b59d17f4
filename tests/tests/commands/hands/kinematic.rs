//! A viscosity that is given as a kinematic one.

use sph_tests::{DAM_BREAK, Says, bench};

#[test]
fn a_kinematic_viscosity_is_that_of_the_phase_with_its_density() {
    let dynamic = DAM_BREAK
        .replace("density = 1000.0", "density = 1260.0")
        .replace("1 mPa s", "1.134 Pa s");
    let kinematic = dynamic.replace("1.134 Pa s", "9 cm^2/s");
    assert_ne!(dynamic, kinematic);
    let bench = bench!(&dynamic);
    bench.write("kinematic.toml", &kinematic);
    let explained = bench.done("explain kinematic.toml --json").out;
    let json: serde_json::Value = serde_json::from_str(&explained).expect("JSON");
    let plugins = json["plugins"].as_array().expect("plugins");
    let law = plugins
        .iter()
        .find(|p| p["kind"] == "rheology")
        .expect("a law");
    let viscosity = law["parameters"]["viscosity"].as_f64().expect("a number");
    assert!((viscosity - 1.134).abs() < 1e-12, "{viscosity} Pa s");
    let dynamic = bench.done("explain scene.toml").out;
    dynamic.says("viscosity = \"1.134 Pa s\"");
}

#[test]
fn a_unit_that_is_no_viscosity_is_still_refused_at_its_line() {
    let bench = bench!(&DAM_BREAK.replace("1 mPa s", "1 m/s"));
    let refused = bench.refused("check scene.toml");
    refused.says(
        "`m/s` does not measure what is asked for | phase.water.rheology.newtonian.viscosity",
    );
}
