//! Holds a TOML value against a JSON schema: unknown keys, types, ranges, units. Schemas in a form for editors.
//!
//! One walk serves the scene and every plugin: it turns "10 kPa" into 10000.0 where the schema
//! names a unit, and reports every problem with the path of its key and the nearest valid name.

use serde_json::{Value as Json, json};
use toml::Value;

use crate::plausible::{Quantity, Verdict};
use crate::problem::describe;
use crate::{MOST_PROBLEMS, SceneProblem, comma_list, parse_quantity, suggestion};

/// Checks `value` against `schema` and converts quantities to SI in place; returns remarks on numbers outside the range
/// of nature ([`plausible`](crate::plausible)), at most [`MOST_PROBLEMS`].
///
/// # Errors
/// The problems found, each with its path relative to `value`, at most [`MOST_PROBLEMS`].
pub fn conform(value: &mut Value, schema: &Json) -> Result<Vec<SceneProblem>, Vec<SceneProblem>> {
    let mut walk = Walk {
        root: schema,
        problems: Vec::new(),
        remarks: Vec::new(),
    };
    walk.value(value, schema, "", None);
    match walk.problems.is_empty() {
        true => Ok(walk.remarks),
        false => Err(walk.problems),
    }
}

/// The part of a schema that a part refers to; the part itself if it refers to none.
pub fn resolved<'s>(root: &'s Json, part: &'s Json) -> &'s Json {
    let target = part.get("$ref").and_then(Json::as_str);
    let target = target.and_then(|r| root.pointer(r.strip_prefix('#')?));
    target.unwrap_or(part)
}

struct Walk<'s> {
    root: &'s Json,
    problems: Vec<SceneProblem>,
    remarks: Vec<SceneProblem>,
}

impl<'s> Walk<'s> {
    fn problem(&mut self, path: &str, message: String) {
        self.problems.push(SceneProblem::new(path, message));
    }

    fn expected(&mut self, path: &str, wanted: &str, value: &Value) {
        let found = describe(value);
        self.problem(path, format!("expected {wanted}, found {found}"));
    }

    /// True if no further problem is reported.
    fn full(&self) -> bool {
        self.problems.len() >= MOST_PROBLEMS
    }

    fn value(&mut self, value: &mut Value, schema: &'s Json, path: &str, unit: Option<&'s str>) {
        if self.full() {
            return;
        }
        let unit = schema.get("unit").and_then(Json::as_str).or(unit);
        let schema = resolved(self.root, schema);
        let unit = schema.get("unit").and_then(Json::as_str).or(unit);
        for key in ["anyOf", "oneOf"] {
            if let Some(options) = schema.get(key).and_then(Json::as_array) {
                return self.one_of(value, options, path, unit);
            }
        }
        if let Some(allowed) = schema.get("enum").and_then(Json::as_array) {
            let names = allowed.iter().filter_map(Json::as_str);
            return self.one_of_names(value, names.collect(), path);
        }
        if let Some(name) = schema.get("const").and_then(Json::as_str) {
            return self.one_of_names(value, vec![name], path);
        }
        let kind = match schema.get("type") {
            Some(Json::String(kind)) => Some(kind.as_str()),
            Some(Json::Array(kinds)) => {
                kinds.iter().filter_map(Json::as_str).find(|k| *k != "null")
            }
            _ => None,
        };
        match kind {
            Some("number") => self.number(value, schema, path, unit),
            Some("integer") => self.integer(value, schema, path),
            Some("boolean") if value.as_bool().is_none() => {
                self.problem(path, "expected true or false".into());
            }
            Some("string") if value.as_str().is_none() => self.expected(path, "a string", value),
            Some("array") => self.array(value, schema, path, unit),
            Some("object") => self.object(value, schema, path),
            _ => {}
        }
    }

    fn one_of(
        &mut self,
        value: &mut Value,
        options: &'s [Json],
        path: &str,
        unit: Option<&'s str>,
    ) {
        let names = options.iter().map(|o| o.get("const")?.as_str());
        if let Some(names) = names.collect::<Option<Vec<_>>>() {
            return self.one_of_names(value, names, path);
        }
        if let Some(tagged) = options.iter().map(tag).collect::<Option<Vec<_>>>()
            && let Value::Table(_) = value
        {
            return self.tagged(value, &tagged, path);
        }
        let before = self.problems.len();
        let mut first = None;
        let mut wanted = Vec::new();
        for option in options {
            if option.get("type").and_then(Json::as_str) == Some("null") {
                continue;
            }
            let mut attempt = value.clone();
            let remarked = self.remarks.len();
            self.value(&mut attempt, option, path, unit);
            let found = self.problems.split_off(before);
            if found.is_empty() {
                *value = attempt;
                return;
            }
            self.remarks.truncate(remarked);
            wanted.push(wanted_in_its_place(&found, path));
            // The option that gets furthest (deepest path) has the most telling message.
            let depth = |p: &Vec<SceneProblem>| p.iter().map(|q| q.path.len()).max();
            if first.as_ref().is_none_or(|f| depth(&found) > depth(f)) {
                first = Some(found);
            }
        }
        // No alternative fits: the message has the expected value of each.
        match wanted.into_iter().collect::<Option<Vec<_>>>() {
            Some(mut all) if all.len() > 1 => {
                all.dedup();
                self.expected(path, &all.join(" or "), value);
            }
            _ => self.problems.extend(first.unwrap_or_default()),
        }
    }

    /// A table whose kind a key distinguishes: that key, the name of each kind, its schema.
    fn tagged(&mut self, value: &mut Value, kinds: &[(&str, &str, &'s Json)], path: &str) {
        let key = kinds[0].0;
        let mut names: Vec<_> = kinds.iter().map(|(_, name, _)| *name).collect();
        names.sort_unstable();
        let known = names.join(", ");
        let Some(kind) = value.get(key).and_then(Value::as_str) else {
            return self.problem(path, format!("the key `{key}` is missing: one of {known}"));
        };
        match kinds.iter().find(|(_, name, _)| *name == kind) {
            Some((_, _, schema)) => self.object(value, schema, path),
            None => {
                let near = suggestion(kind, names.iter().copied());
                // `probe.NAME` is a probe.
                let what = path.split('.').next().filter(|root| !root.is_empty());
                let what = what.unwrap_or("table");
                let message =
                    format!("there is no {what} of the {key} `{kind}`{near} (there are: {known})");
                self.problem(&joined(path, key), message);
            }
        }
    }

    fn one_of_names(&mut self, value: &Value, names: Vec<&str>, path: &str) {
        let expected = comma_list(names.iter().map(|n| format!("`{n}`")));
        match value.as_str() {
            Some(text) if names.contains(&text) => {}
            Some(text) => {
                let near = suggestion(text, names);
                self.problem(path, format!("`{text}` is not one of {expected}{near}"));
            }
            None => self.problem(path, format!("expected one of {expected}")),
        }
    }

    fn number(&mut self, value: &mut Value, schema: &Json, path: &str, unit: Option<&str>) {
        let of = unit.map_or(String::new(), |u| format!(" in {u}"));
        let number = match value {
            Value::Float(x) => *x,
            Value::Integer(i) => *i as f64,
            Value::String(text) => match parse_quantity(text, unit.unwrap_or("1")) {
                Ok(x) => x,
                Err(why) => return self.problem(path, why),
            },
            other => return self.expected(path, &format!("a number{of}"), other),
        };
        if !number.is_finite() {
            let message = format!("expected a finite number{of}, found {number}");
            return self.problem(path, message);
        }
        *value = Value::Float(number);
        let before = self.problems.len();
        self.range(number, schema, path, unit);
        if self.problems.len() == before {
            self.plausible(number, schema, path, unit);
        }
    }

    fn integer(&mut self, value: &mut Value, schema: &Json, path: &str) {
        match value {
            Value::Integer(i) => self.range(*i as f64, schema, path, None),
            other => self.expected(path, "a whole number", other),
        }
    }

    fn range(&mut self, x: f64, schema: &Json, path: &str, unit: Option<&str>) {
        let bound = |key: &str| schema.get(key).and_then(Json::as_f64);
        let unit = unit.filter(|u| *u != "1");
        let unit = unit.map_or(String::new(), |u| format!(" {u}"));
        type Violated = fn(f64, f64) -> bool;
        let checks: [(&str, Violated, &str); 4] = [
            ("minimum", |x, b| x < b, "at least"),
            ("exclusiveMinimum", |x, b| x <= b, "more than"),
            ("maximum", |x, b| x > b, "at most"),
            ("exclusiveMaximum", |x, b| x >= b, "less than"),
        ];
        for (key, violated, words) in checks {
            if let Some(bound) = bound(key).filter(|b| violated(x, *b)) {
                return self.problem(path, format!("must be {words} {bound}{unit}, found {x}"));
            }
        }
    }

    /// Bounds by quantity, for values within the range of their keys.
    fn plausible(&mut self, x: f64, schema: &Json, path: &str, unit: Option<&str>) {
        let name = schema.get("quantity").and_then(Json::as_str);
        match Quantity::find(name, unit).map(|q| q.judge(x)) {
            Some(Verdict::Impossible(why)) => self.problem(path, why),
            Some(Verdict::Odd(why)) if self.remarks.len() < MOST_PROBLEMS => {
                self.remarks.push(SceneProblem::new(path, why));
            }
            _ => {}
        }
    }

    fn array(&mut self, value: &mut Value, schema: &'s Json, path: &str, unit: Option<&'s str>) {
        let Value::Array(items) = value else {
            return self.expected(path, "a list", value);
        };
        let count = |key: &str| schema.get(key).and_then(Json::as_u64).map(|n| n as usize);
        let (least, most) = (count("minItems"), count("maxItems"));
        if least.is_some_and(|n| items.len() < n) || most.is_some_and(|n| items.len() > n) {
            let wanted = match (least, most) {
                (Some(a), Some(b)) if a == b => format!("{a}"),
                (Some(a), None) => format!("at least {a}"),
                (a, Some(b)) => format!("{} to {b}", a.unwrap_or(0)),
                _ => String::new(),
            };
            let found = items.len();
            self.problem(path, format!("expected {wanted} entries, found {found}"));
        }
        if let Some(schema) = schema.get("items") {
            for (k, item) in items.iter_mut().enumerate() {
                if self.full() {
                    return;
                }
                self.value(item, schema, &format!("{path}[{k}]"), unit);
            }
        }
    }

    fn object(&mut self, value: &mut Value, schema: &'s Json, path: &str) {
        let Value::Table(table) = value else {
            return self.expected(path, "a table", value);
        };
        let join = |key: &str| joined(path, key);
        let properties = schema.get("properties").and_then(Json::as_object);
        let others = schema.get("additionalProperties");
        for (key, item) in table.iter_mut() {
            if self.full() {
                return;
            }
            match (properties.and_then(|p| p.get(key)), others) {
                (Some(property), _) => self.value(item, property, &join(key), None),
                (None, Some(Json::Bool(false))) => {
                    let names = || properties.into_iter().flatten().map(|(n, _)| n.as_str());
                    let near = suggestion(key, names());
                    let known = match comma_list(names()).as_str() {
                        "" => "none is taken here".to_string(),
                        list => format!("valid here: {list}"),
                    };
                    let message = format!("`{key}` is not a known key{near} ({known})");
                    self.problem(&join(key), message);
                }
                (None, Some(schema @ Json::Object(_))) => {
                    self.value(item, schema, &join(key), None)
                }
                _ => {}
            }
        }
        let required = schema.get("required").and_then(Json::as_array);
        for name in required.into_iter().flatten() {
            let name = name.as_str().unwrap_or_default();
            if !table.contains_key(name) {
                let meaning = properties
                    .and_then(|p| p.get(name)?.get("description")?.as_str())
                    .map_or(String::new(), |d| format!(": {d}"));
                self.problem(path, format!("the key `{name}` is missing{meaning}"));
            }
        }
    }
}

fn joined(path: &str, key: &str) -> String {
    match path {
        "" => key.to_string(),
        _ => format!("{path}.{key}"),
    }
}

/// The key of an alternative that has one value only, and that value.
fn tag(option: &Json) -> Option<(&str, &str, &Json)> {
    let mut properties = option.get("properties")?.as_object()?.iter();
    properties.find_map(|(key, p)| Some((key.as_str(), p.get("const")?.as_str()?, option)))
}

/// The expected type of a value of another type.
fn wanted_in_its_place(problems: &[SceneProblem], path: &str) -> Option<String> {
    let [problem] = problems else { return None };
    let wanted = problem.message.strip_prefix("expected ")?;
    let (wanted, _) = wanted.split_once(", found ")?;
    let kinds = ["list", "table", "string", "whole number", "number"];
    let kind = wanted.strip_prefix("a ");
    let kind = kind.is_some_and(|wanted| kinds.iter().any(|kind| wanted.starts_with(kind)));
    (problem.path == path && kind).then(|| wanted.to_string())
}

/// Changes the schema of a scene into that of its text: numbers may be strings with a unit, and TOML has no null.
///
/// ```
/// use serde_json::json;
///
/// let mut schema = json!({ "type": ["number", "null"] });
/// scene_text::for_editors(&mut schema);
/// assert_eq!(schema, json!({ "type": ["number", "string"] }));
/// ```
pub fn for_editors(schema: &mut Json) {
    match schema {
        Json::Object(object) => {
            for key in ["anyOf", "oneOf"] {
                if let Some(Json::Array(options)) = object.get_mut(key) {
                    options.retain(|o| o.get("type") != Some(&json!("null")));
                }
            }
            if let Some(kind) = object.get_mut("type") {
                let kinds: Vec<Json> = match &*kind {
                    Json::Array(kinds) => kinds.iter().filter(|k| **k != "null").cloned().collect(),
                    one => vec![one.clone()],
                };
                *kind = match kinds.as_slice() {
                    [one] if one == "number" => json!(["number", "string"]),
                    [one] => one.clone(),
                    several => json!(several),
                };
            }
            object.values_mut().for_each(for_editors);
        }
        Json::Array(items) => items.iter_mut().for_each(for_editors),
        _ => {}
    }
}

/// The default of every property that has one, by name.
pub fn defaults(schema: &Json) -> Vec<(String, Json)> {
    let properties = schema.get("properties").and_then(Json::as_object);
    let default = |(name, p): (&String, &Json)| Some((name.clone(), p.get("default")?.clone()));
    properties
        .into_iter()
        .flatten()
        .filter_map(default)
        .collect()
}

#[cfg(test)]
mod tests;
