//! The schema of scenes with plugins registered in this binary.

use sph_core::{contract, parameters, plugin};
use sph_scene::{Norm, schema};

/// Kernels of this test.
pub trait Kernel {}
contract!(
    /// Kernels of this test.
    pub KernelEntry, "kernel", One, "weights neighbours", Kernel
);

/// Probes of this test.
pub trait Probe {}
contract!(
    /// Probes of this test.
    pub ProbeEntry, "probe", Probe, "measures", Probe
);

/// Laws of this test.
pub trait Law {}
contract!(
    /// Laws of this test.
    pub LawEntry, "rheology", InPhase, "flows", Law
);

macro_rules! plugin_of {
    ($role:ident, $entry:ident, $name:literal, $type:ident) => {
        /// Parameters with a shared definition.
        #[plugin($entry, $name, "one of this test", source: "nobody 2000")]
        struct $type {
            /// Dynamic viscosity.
            #[parameter(unit: "Pa s")]
            #[allow(dead_code)]
            viscosity: f64,
            /// How it shears.
            #[allow(dead_code)]
            mode: Option<Mode>,
        }
        impl $role for $type {}
    };
}
plugin_of!(Kernel, KernelEntry, "smooth", Smooth);
plugin_of!(Probe, ProbeEntry, "front", Front);
plugin_of!(Law, LawEntry, "newtonian", Newtonian);

/// A definition that is shared.
#[parameters]
enum Mode {
    /// One.
    One,
    /// Two.
    Two,
}

#[test]
fn plugins_stand_under_their_tables() {
    let schema = schema();
    let at = |pointer: &str| {
        schema
            .pointer(pointer)
            .unwrap_or_else(|| panic!("{pointer}"))
    };
    assert_eq!(at("/title"), "SPH scene");
    let viscosity =
        at("/$defs/Phase/properties/rheology/properties/newtonian/properties/viscosity");
    assert_eq!(viscosity["unit"], "Pa s");
    assert_eq!(viscosity["type"], serde_json::json!(["number", "string"]));
    assert_eq!(at("/properties/kernel/maxProperties"), 1);
    assert_eq!(at("/properties/kernel/additionalProperties"), false);
    assert_eq!(at("/properties/kernel/properties/smooth/title"), "smooth");
    assert_eq!(
        at("/properties/gauge/additionalProperties/oneOf/0/properties/kind/const"),
        "front"
    );
    at("/$defs/rheology.newtonian.Mode");
}

#[test]
fn every_reference_in_the_schema_leads_somewhere() {
    fn visit(node: &serde_json::Value, root: &serde_json::Value) {
        if let Some(target) = node.get("$ref").and_then(|r| r.as_str()) {
            assert!(root.pointer(&target[1..]).is_some(), "{target}");
        }
        match node {
            serde_json::Value::Object(o) => o.values().for_each(|v| visit(v, root)),
            serde_json::Value::Array(a) => a.iter().for_each(|v| visit(v, root)),
            _ => {}
        }
    }
    let schema = schema();
    visit(&schema, &schema);
}

#[test]
fn every_key_is_described() {
    fn visit(name: &str, node: &serde_json::Value) {
        for (key, property) in node["properties"].as_object().into_iter().flatten() {
            let described = property["description"]
                .as_str()
                .is_some_and(|d| !d.is_empty());
            assert!(described, "{name}.{key}");
        }
    }
    let schema = sph_core::schema_of::<sph_scene::Scene>();
    visit("scene", &schema);
    for (name, def) in schema["$defs"].as_object().unwrap() {
        visit(name, def);
    }
}

#[test]
fn norms_have_the_names_of_the_schema() {
    let names = [Norm::RmsOverRange, Norm::L2Mean, Norm::Linf].map(Norm::name);
    assert_eq!(names, ["rms-over-range", "l2-mean", "linf"]);
}

#[test]
fn keys_of_a_scene_have_units() {
    let unit = |key| sph_scene::unit(key).unwrap_or_default();
    assert_eq!(unit("numerics.spacing"), "m");
    assert_eq!(unit("phase.water.density"), "kg/m³");
    assert_eq!(unit("numerics.spcing"), "");
    assert_eq!(unit("smoother.rhie-chow.strength"), "");
}
