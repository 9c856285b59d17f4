//! Tests of tables against schemas.

use super::*;

fn schema() -> Json {
    json!({
        "type": "object", "additionalProperties": false, "required": ["density"],
        "properties": {
            "density": {"type": "number", "unit": "kg/m³", "exclusiveMinimum": 0.0},
            "gravity": {"type": "array", "items": {"type": "number"}, "minItems": 2, "unit": "m/s²"},
            "mode": {"enum": ["no-slip", "free-slip"]},
            "range": {"anyOf": [{"type": "array", "items": {"type": "number"}}, {"type": "object"}]},
        }
    })
}

fn problems(text: &str) -> Vec<String> {
    let mut value: Value = Value::Table(toml::from_str(text).unwrap());
    match conform(&mut value, &schema()) {
        Ok(remarks) => remarks.iter().map(ToString::to_string).collect(),
        Err(all) => all.iter().map(ToString::to_string).collect(),
    }
}

#[test]
fn quantities_become_si_numbers() {
    let mut value: Value =
        Value::Table(toml::from_str("density = '1 g/cm^3'\ngravity = [0, '-9.81 m/s^2']").unwrap());
    conform(&mut value, &schema()).unwrap();
    assert_eq!(value["density"].as_float(), Some(1000.0));
    assert_eq!(value["gravity"][1].as_float(), Some(-9.81));
}

#[test]
fn implausible_values_are_remarked_on_and_overflows_refused() {
    assert!(problems("density = 1e12")[0].contains("white dwarfs"));
    assert!(problems("density = 1e12\ngravity = [0, 1e30]")[1].contains("gravity[1]"));
    assert!(problems("density = 1e-60")[0].contains("no run can be right"));
}

#[test]
fn no_more_problems_are_kept_than_are_told() {
    let keys: String = (0..20_000).map(|k| format!("k{k} = 1\n")).collect();
    assert_eq!(problems(&keys).len(), MOST_PROBLEMS);
    let list = vec!["'x'"; 20_000].join(",");
    let found = problems(&format!("density = 1\ngravity = [{list}]"));
    assert_eq!(found.len(), MOST_PROBLEMS);
}

#[test]
fn all_that_may_stand_in_a_place_is_told() {
    let told = problems("density = 1\nrange = 'big'");
    let wanted = "range: expected a list or a table, found the string \"big\"";
    assert_eq!(told, [wanted]);
    let deeper = &problems("density = 1\nrange = [1, 'x']")[0];
    let wanted = "range[1]: `x` does not start";
    assert!(deeper.starts_with(wanted), "{deeper}");
}

#[test]
fn every_problem_is_named_with_its_path() {
    assert!(problems("density = 1").is_empty());
    assert!(problems("densty = 1")[0].contains("did you mean `density`?"));
    assert!(problems("densty = 1")[1].contains("`density` is missing"));
    assert!(problems("density = -1")[0].contains("more than 0 kg/m³"));
    assert!(problems("density = nan")[0].contains("finite"));
    assert!(problems("density = '3 m'")[0].contains("kg/m³"));
    assert!(problems("density = 1\ngravity = [1]")[0].contains("at least 2"));
    assert!(problems("density = 1\nmode = 'noslip'")[0].contains("did you mean `no-slip`?"));
}

#[test]
fn a_key_distinguishes_the_kinds_of_a_table() {
    let kind = |name: &str, key: &str| {
        json!({
            "type": "object", "additionalProperties": false, "required": ["kind", key],
            "properties": {"kind": {"const": name}, key: {"type": "number", "unit": "m"}},
        })
    };
    let schema = json!({
        "type": "object",
        "properties": {"probe": {"additionalProperties": {"oneOf": [kind("level", "from"), kind("at", "x")]}, "type": "object"}},
    });
    let told = |text: &str| {
        let mut value: Value = Value::Table(toml::from_str(text).unwrap());
        let told = conform(&mut value, &schema).map_err(|all| all[0].to_string());
        told.map(|_| value)
    };
    let right = told("probe.p = { kind = 'at', x = '2 cm' }").unwrap();
    assert_eq!(right["probe"]["p"]["x"].as_float(), Some(0.02));
    let levl =
        ".kind: there is no probe of the kind `levl`, did you mean `level`? (there are: at, level)";
    let missing = ": the key `kind` is missing: one of at, level";
    for (wrong, message) in [
        ("{ kind = 'levl', from = 1 }", levl),
        ("{ from = 1 }", missing),
        ("{ kind = 'level', x = 1 }", ".x: `x` is not a known key"),
        ("{ kind = 'at' }", ": the key `x` is missing"),
        ("3", ": expected a table, found 3"),
    ] {
        let error = told(&format!("probe.p = {wrong}")).unwrap_err();
        let begins = error.starts_with(&format!("probe.p{message}"));
        assert!(begins, "{error}");
    }
}
