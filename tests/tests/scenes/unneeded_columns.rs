//! A scene carries what its plugins ask for and nothing else.

use std::path::Path;

use sph_particles::setup::{Examination, examine};
use sph_scene::{Override, load};

fn examined(name: &str, overrides: &[&str]) -> Examination {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../scenes/{name}.toml"));
    let overrides = overrides.iter().map(|text| Override::parse(text));
    let overrides: Vec<_> = overrides.map(|o| o.expect("an override")).collect();
    let loaded = load(&path, &overrides).unwrap_or_else(|e| panic!("{e}"));
    examine(&loaded.scene).unwrap_or_else(|e| panic!("{name}: {e}"))
}

fn columns(examined: &Examination) -> Vec<&str> {
    examined.fields.iter().map(|f| f.name.as_str()).collect()
}

#[test]
fn water_alone_carries_nothing_of_phases_laws_and_solves() {
    let water = examined("dam-break-koshizuka", &[]);
    let expected = [
        "position",
        "velocity",
        "mass",
        "identity",
        "density_constant",
        "renormalisation",
        "density",
        "volume",
        "pressure",
        "free_surface",
        "acceleration",
        "density_constant_rate",
    ];
    assert_eq!(columns(&water), expected);
    assert_eq!(water.bytes_per_particle, 116);
    assert_eq!(water.stages.len(), 6);
    let limits: Vec<&str> = water.step_limits.keys().map(String::as_str).collect();
    assert_eq!(limits, ["force", "smoother", "sound", "viscosity"]);
}

/// Densities that follow a rate have no constant that could be wrong: the table that relaxes it may stay, and costs nothing.
#[test]
fn surfaces_are_not_looked_for_where_densities_do_not_remember_them() {
    let over = ["formulation.colagrossi-landrini={}"];
    let water = examined("dam-break-koshizuka", &over);
    assert!(!columns(&water).contains(&"free_surface"));
    assert!(
        water.pruned.contains(&"free surface".to_string()),
        "{:?}",
        water.pruned
    );
}

#[test]
fn a_law_brings_what_it_feels_and_no_more() {
    let channel = examined("bingham-poiseuille-bn0p1", &[]);
    let columns = columns(&channel);
    for wanted in ["velocity_gradient", "strain_rate", "viscosity"] {
        assert!(columns.contains(&wanted), "{columns:?}");
    }
    for unwanted in [
        "elastic_stress",
        "carried_stress",
        "effective_pressure",
        "phase",
    ] {
        assert!(!columns.contains(&unwanted), "{columns:?}");
    }
    // Without its yield stress the mud is a Newtonian fluid, and feels nothing.
    let thin = examined(
        "bingham-poiseuille-bn0p1",
        &[
            "phase.mud.rheology.bingham.yield_stress=0",
            "output.picture=[\"velocity\"]",
        ],
    );
    let names: Vec<&str> = thin.fields.iter().map(|f| f.name.as_str()).collect();
    for unwanted in ["velocity_gradient", "strain_rate", "viscosity"] {
        assert!(!names.contains(&unwanted), "{names:?}");
    }
}
