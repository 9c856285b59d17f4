//! Values put on top of a scene: `--set numerics.spacing=0.01`.

use toml::{Table, Value};

use crate::SceneProblem;

/// Deepest path of an override.
const DEEPEST: usize = 32;

/// A list of tables that hold exactly one plugin, as the keys that lead to them; `*` stands for any key.
///
/// Readers of scenes submit theirs with `inventory`: setting another plugin there replaces the present one.
pub struct OnePlugin(pub fn() -> Vec<Vec<&'static str>>);
inventory::collect!(OnePlugin);

/// A value for a key of the scene in place of that of the file.
///
/// The value is TOML; text that is not TOML is taken as a string, so that a shell needs no second pair of quotes.
/// Setting another plugin where a scene has exactly one replaces the present one: `kernel.wendland-c4={}`.
///
/// ```
/// use scene_text::Override;
///
/// let set = Override::parse("wall.tank.polyline[0][1]=30 cm").unwrap();
/// assert_eq!(set.path, "wall.tank.polyline[0][1]");
/// assert_eq!(set.value.as_str(), Some("30 cm"));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Override {
    /// The override as it was written.
    pub text: String,
    /// Dotted path of the key.
    pub path: String,
    segments: Vec<Segment>,
    /// The value.
    pub value: Value,
    /// True if it stood on the command line.
    pub(crate) users: bool,
}

#[derive(Clone, Debug, PartialEq)]
enum Segment {
    Key(String),
    Index(usize),
}

impl Override {
    /// Reads `path.to.key=value` from the command line; a file that it names is the user's own choice.
    ///
    /// # Errors
    /// If there is no `=`, the path is not one, or the value is broken TOML.
    pub fn parse(text: &str) -> Result<Self, SceneProblem> {
        let none = || SceneProblem::new(text, "expected `path.to.key=value`, found no `=`");
        let (path, value) = text.split_once('=').ok_or_else(none)?;
        let (path, value) = (path.trim(), value.trim());
        let value = match value.parse::<Value>() {
            Ok(value) => value,
            Err(why) if value.starts_with(['[', '{', '"', '\'']) => {
                return Err(SceneProblem::new(path, why.message()));
            }
            Err(_) => Value::String(value.to_string()),
        };
        Ok(Override {
            text: text.to_string(),
            users: true,
            ..Override::new(path, value)?
        })
    }

    /// The value for a dotted path, for programs that vary scenes; it may name no files but those of the scene.
    ///
    /// # Errors
    /// If the path is not one.
    pub fn new(path: &str, value: Value) -> Result<Self, SceneProblem> {
        let segments = segments(path).map_err(|why| SceneProblem::new(path, why))?;
        Ok(Override {
            text: format!("{path}={value}"),
            path: path.to_string(),
            segments,
            value,
            users: false,
        })
    }

    /// Sets the value in a scene's table, making tables on the way where there are none.
    ///
    /// # Errors
    /// If a key on the way is no table, or a list has no such entry.
    pub fn apply(&self, table: &mut Table) -> Result<(), SceneProblem> {
        let problem = |why: String| SceneProblem::new(self.path.clone(), why);
        let mut root = Value::Table(std::mem::take(table));
        let result = self.set(&mut root).map_err(problem);
        if let Value::Table(changed) = root {
            *table = changed;
        }
        result
    }

    fn set(&self, root: &mut Value) -> Result<(), String> {
        let mut here = root;
        for (depth, segment) in self.segments.iter().enumerate() {
            here = match (segment, here) {
                (Segment::Key(key), Value::Table(table)) => {
                    if self.replaces(depth) {
                        table.retain(|name, _| name == key);
                    }
                    if depth + 1 == self.segments.len() {
                        table.insert(key.clone(), self.value.clone());
                        return Ok(());
                    }
                    let inner = table.entry(key.clone());
                    inner.or_insert_with(|| Value::Table(Table::new()))
                }
                (Segment::Key(key), _) => {
                    return Err(format!("there is no key `{key}` in what is not a table"));
                }
                (Segment::Index(k), Value::Array(items)) => {
                    let count = items.len();
                    let why = format!("there is no entry {k} in a list of {count}, counted from 0");
                    items.get_mut(*k).ok_or(why)?
                }
                (Segment::Index(k), _) => {
                    return Err(format!("there is no entry {k} in what is not a list"));
                }
            };
        }
        *here = self.value.clone();
        Ok(())
    }

    /// True if the key at that depth names a plugin where there is exactly one.
    fn replaces(&self, depth: usize) -> bool {
        let named = |(wanted, segment): (&&str, &Segment)| match segment {
            Segment::Key(key) => *wanted == "*" || wanted == key,
            Segment::Index(_) => false,
        };
        let fits = |pattern: Vec<&str>| {
            pattern.len() == depth && pattern.iter().zip(&self.segments).all(named)
        };
        let lists = inventory::iter::<OnePlugin>.into_iter();
        lists.flat_map(|list| (list.0)()).any(fits)
    }
}

/// `probe.P1.at[0]` as keys and indices; a key in double quotes may hold anything.
fn segments(path: &str) -> Result<Vec<Segment>, String> {
    let mut found = Vec::new();
    let mut rest = path;
    loop {
        let (key, after) = match rest.strip_prefix('"') {
            Some(quoted) => quoted.split_once('"').ok_or("a quote is not closed")?,
            None => rest.split_at(rest.find(['.', '[']).unwrap_or(rest.len())),
        };
        if key.trim().is_empty() {
            return Err("a key of the path is empty".to_string());
        }
        found.push(Segment::Key(key.to_string()));
        rest = after;
        while let Some(bracket) = rest.strip_prefix('[') {
            let (index, after) = bracket.split_once(']').ok_or("a bracket is not closed")?;
            let number = index.trim().parse();
            let number = number.map_err(|_| format!("`{index}` is not an index"))?;
            found.push(Segment::Index(number));
            rest = after;
        }
        if found.len() > DEEPEST {
            return Err(format!("the path is deeper than {DEEPEST} keys"));
        }
        match rest.strip_prefix('.') {
            Some(after) => rest = after,
            None if rest.is_empty() => return Ok(found),
            None => return Err(format!("expected `.` or `[` before `{rest}`")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    inventory::submit! {
        OnePlugin(|| vec![vec!["kernel"], vec!["phase", "*", "rheology"]])
    }

    fn after(scene: &str, set: &str) -> Result<Table, String> {
        let mut table: Table = toml::from_str(scene).unwrap();
        let set = Override::parse(set).map_err(|p| p.to_string())?;
        set.apply(&mut table).map_err(|p| p.to_string())?;
        Ok(table)
    }

    #[test]
    fn values_lists_and_plugin_tables_are_set() {
        let scene = "probe.P1.at = [1, 2]\nkernel.a.x = 1\nsmoother.b = {}";
        for (set, key, value) in [
            ("probe.P1.at=[3,4]", "probe", "{ P1 = { at = [3, 4] } }"),
            ("probe.P1.at[0]=5", "probe", "{ P1 = { at = [5, 2] } }"),
            ("run.end=10 s", "run", "{ end = \"10 s\" }"),
            ("kernel.a.x=2", "kernel", "{ a = { x = 2 } }"),
            ("smoother={}", "smoother", "{}"),
        ] {
            let value: Value = value.parse().unwrap();
            assert_eq!(after(scene, set).unwrap()[key], value);
        }
    }

    #[test]
    fn another_plugin_takes_the_place_of_the_present_one() {
        let table = after("[kernel.a]\nx = 1", "kernel.b={}").unwrap();
        assert_eq!(table["kernel"], "{ b = {} }".parse::<Value>().unwrap());
        let scene = "[phase.w.rheology.a]\n[phase.v.rheology.a]";
        let table = after(scene, "phase.w.rheology.b.k=1").unwrap();
        assert!(table["phase"]["w"]["rheology"].get("a").is_none());
        assert!(table["phase"]["v"]["rheology"].get("a").is_some());
    }

    #[test]
    fn mistakes_are_told() {
        let scene = "a = 1\nb = [1]";
        for (set, message) in [
            ("x", "found no `=`"),
            ("=1", "is empty"),
            ("a..b=1", "is empty"),
            ("a.b=1", "what is not a table"),
            ("b[3]=1", "no entry 3 in a list of 1"),
            ("a[0]=1", "what is not a list"),
            ("b[0=1", "bracket is not closed"),
            ("b[x]=1", "not an index"),
            ("b[0]c=1", "expected `.`"),
            ("\"a=1", "quote"),
            ("a=[1, ", "array"),
        ] {
            let told = after(scene, set).unwrap_err();
            assert!(told.contains(message), "{set}: {told}");
        }
    }
}
