//! A contract and its plugins as a stranger's crate would write them.

use sph_core::{Contract, PluginInfo, Registry, RegistryError, contract, parameters, plugin};

/// A law that maps a rate to a stress.
pub trait Law<const D: usize>: Send {
    /// Stress, Pa.
    fn stress(&self, rate: f64) -> f64;
}

contract!(
    /// Laws of this test.
    pub LawEntry, "law", Elsewhere, "maps a rate to a stress", Law<D>
);

/// τ = η γ̇
#[plugin(LawEntry [2], "newtonian", "linear law", source: "Newton 1687")]
struct Newtonian {
    /// Dynamic viscosity.
    #[parameter(unit: "Pa s", min: 0.0, source: "Newton 1687")]
    viscosity: f64,
}

impl<const D: usize> Law<D> for Newtonian {
    fn stress(&self, rate: f64) -> f64 {
        self.viscosity * rate
    }
}

/// Makes a law of another type.
#[parameters]
struct Wrapped(#[expect(dead_code, reason = "only its schema is asked for")] Newtonian);

/// A wrapper of a wrapper, with a choice beside it.
#[parameters]
struct Twice(#[expect(dead_code, reason = "only its schema is asked for")] Wrapped);

/// Parameters of all types.
#[parameters]
#[expect(dead_code, reason = "only its schema is asked for")]
struct Varied {
    form: Form,
    perhaps: Option<Form>,
    inner: Option<Newtonian>,
    number: Option<f64>,
}

/// One of two.
#[parameters]
enum Form {
    Rough,
    Smooth,
}

fn table(text: &str) -> toml::Table {
    toml::from_str(text).unwrap()
}

#[test]
fn a_registered_plugin_is_found_built_and_listed() {
    let registry = Registry::<LawEntry>::discovered().unwrap();
    let law = registry.find("newtonian").unwrap();
    let built = law.build::<2>(&table("viscosity = '2 mPa s'")).unwrap();
    assert!((built.stress(3.0) - 6e-3).abs() < 1e-15);
    let listed = sph_core::parameters(&(law.info().schema)());
    assert_eq!(listed[0].unit, "Pa s");
    assert_eq!(listed[0].source, "Newton 1687");
    let kind = sph_core::kind_of("law").unwrap();
    assert!((kind.plugins)().iter().any(|law| law.name == "newtonian"));
}

#[test]
fn mistakes_are_named() {
    let registry = Registry::<LawEntry>::discovered().unwrap();
    let unknown = registry.find("newtonain").err().unwrap().to_string();
    assert!(unknown.contains("did you mean `newtonian`?"), "{unknown}");
    assert!(unknown.contains("use my_plugin as _"), "{unknown}");
    let law = registry.find("newtonian").unwrap();
    let misspelt = law.build::<2>(&table("viscosty = 1")).err().unwrap();
    assert!(misspelt.to_string().contains("did you mean `viscosity`?"));
    let dimension = law.build::<3>(&table("viscosity = 1")).err().unwrap();
    assert!(matches!(dimension, RegistryError::Dimension(.., 3)));
}

#[test]
fn the_same_name_twice_is_refused() {
    static ONE: LawEntry = same("one");
    static TWO: LawEntry = same("two");
    let twice = Registry::from_entries(vec![&ONE, &TWO]).err().unwrap();
    assert!(matches!(
        twice,
        RegistryError::Duplicate { name: "same", .. }
    ));
}

/// The law `same` of a crate.
const fn same(provider: &'static str) -> LawEntry {
    LawEntry {
        info: PluginInfo {
            name: "same",
            summary: "the same",
            source: "nobody",
            provider,
            dimensions: &[],
            schema: sph_core::schema_of::<Newtonian>,
        },
        build_2d: None,
        build_3d: None,
    }
}

#[test]
fn a_wrapper_has_the_parameters_of_the_type_within_and_its_own_text() {
    for (schema, text) in [
        (
            sph_core::schema_of::<Wrapped>(),
            "Makes a law of another type.",
        ),
        (
            sph_core::schema_of::<Twice>(),
            "A wrapper of a wrapper, with a choice beside it.",
        ),
    ] {
        assert_eq!(schema["description"], text);
        let listed = sph_core::parameters(&schema);
        assert_eq!(
            (listed.len(), listed[0].name.as_str()),
            (1, "viscosity"),
            "{schema}"
        );
    }
}

#[test]
fn tables_and_choices_are_told_apart() {
    let listed = sph_core::parameters(&sph_core::schema_of::<Varied>());
    let kinds = listed.iter().map(|p| (p.name.as_str(), p.kind.as_str()));
    let expected = [
        ("form", "choice"),
        ("inner", "table"),
        ("number", "number"),
        ("perhaps", "choice"),
    ];
    assert_eq!(kinds.collect::<Vec<_>>(), expected);
}
