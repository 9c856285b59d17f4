//! The modules of a crate stand in an order: no two import from each other, not even by way of others.
//! Only a module within another may take from that what it gives to it, and tests may import what they like.
//!
//! It is read from the text: names are followed through re-exports, but macros are not expanded, and a method that is
//! called on a value does not tell which file it is in.

mod source;

use std::collections::{BTreeMap, BTreeSet};

use crate::{crates, name, sources};
use source::{Module, Names, module};

/// The modules of a crate, each in a file.
struct Modules(BTreeMap<Names, Module>);

/// Where a path leads: to a module as a whole, or to something that is defined in it.
struct Target {
    module: Names,
    whole: bool,
}

impl Modules {
    /// From files by their names within `src`.
    fn read<'a>(files: impl IntoIterator<Item = (&'a str, &'a str)>) -> Self {
        let mut modules = BTreeMap::new();
        for (name, text) in files {
            let name = name.trim_end_matches(".rs");
            let place = name.strip_suffix("/mod").unwrap_or(name);
            let place: Names = place.split('/').map(String::from).collect();
            match name {
                "main" => continue,
                "lib" => modules.insert(Names::new(), module(text)),
                _ => modules.insert(place, module(text)),
            };
        }
        let all: Vec<Names> = modules.keys().cloned().collect();
        for place in all.iter().filter(|place| !place.is_empty()) {
            let (name, parent) = place.split_last().expect("not the root");
            let parent = modules.get(parent);
            if parent.is_some_and(|m| m.for_tests.contains(name)) {
                modules.retain(|other, _| !other.starts_with(place));
            }
        }
        Self(modules)
    }

    /// What a name is within a module; nothing if it comes from outside the crate.
    fn member(&self, module: &[String], name: &String, depth: usize) -> Option<Target> {
        let inner = [module, std::slice::from_ref(name)].concat();
        if self.0.contains_key(&inner) {
            let (module, whole) = (inner, true);
            return Some(Target { module, whole });
        }
        let here = self.0.get(module)?;
        if here.items.contains(name) {
            let (module, whole) = (module.to_vec(), false);
            return Some(Target { module, whole });
        }
        if let Some(path) = here.imports.get(name) {
            return self.target(module, path, depth + 1);
        }
        here.globs.iter().find_map(|glob| {
            let of = self.target(module, glob, depth + 1).filter(|of| of.whole)?;
            self.member(&of.module, name, depth + 1)
        })
    }

    /// Where a path of a module leads within the crate. Imports may lead in a ring: `depth` ends it.
    fn target(&self, from: &[String], path: &[String], depth: usize) -> Option<Target> {
        if depth > 20 {
            return None;
        }
        let mut target = Target {
            module: from.to_vec(),
            whole: true,
        };
        for (at, name) in path.iter().enumerate() {
            match name.as_str() {
                "crate" => target.module.clear(),
                "self" => {}
                "super" => drop(target.module.pop()),
                _ if !target.whole => break,
                _ => match self.member(&target.module, name, depth) {
                    Some(next) => target = next,
                    None if at == 0 => return None,
                    // Such as what a macro defines there.
                    None => target.whole = false,
                },
            }
        }
        Some(target)
    }

    /// Which modules each imports from, but for those around it.
    fn arrows(&self) -> BTreeMap<&Names, BTreeSet<Names>> {
        let all = self.0.iter().map(|(from, module)| {
            let targets = module.paths.iter().filter_map(|p| self.target(from, p, 0));
            let targets = targets.map(|t| t.module).filter(|to| !from.starts_with(to));
            (from, targets.collect())
        });
        all.collect()
    }

    /// The arrows that lie on circles, in words.
    fn circles(&self) -> Vec<String> {
        let arrows = self.arrows();
        let mut found = Vec::new();
        for (from, targets) in &arrows {
            for to in targets {
                let mut reached = BTreeSet::from([to]);
                let mut open = vec![to];
                while let Some(place) = open.pop() {
                    let further = arrows.get(place).into_iter().flatten();
                    open.extend(further.filter(|n| reached.insert(n)));
                }
                if reached.contains(from) {
                    found.push(format!("{} -> {}", from.join("::"), to.join("::")));
                }
            }
        }
        found
    }
}

#[test]
fn no_circle_of_imports_stands_between_modules() {
    let (mut count, mut found) = (0, Vec::new());
    for path in crates() {
        let folder = path.join("src");
        let files = sources(&folder);
        let modules = Modules::read(files.iter().map(|(path, text)| {
            let place = path.strip_prefix(&folder).expect("below the folder");
            (place.to_str().expect("plain"), text.as_str())
        }));
        count += modules.arrows().values().map(BTreeSet::len).sum::<usize>();
        let circles = modules.circles().into_iter();
        found.extend(circles.map(|arrow| format!("{}: {arrow}", name(&path))));
    }
    assert!(count > 1000, "only {count} arrows were read");
    found.sort();
    let found = found.join("\n");
    assert!(found.is_empty(), "on circles of imports:\n{found}");
}

#[test]
fn a_circle_is_found_through_re_exports_and_not_in_tests() {
    let circles = |low: &str| {
        let lib = "mod high; mod low; mod shelf; pub use high::Top; pub(crate) use shelf::*;";
        let high =
            "use crate::{low::{self, Below as B}, Other}; struct Top; struct Mark { low: B }";
        let shelf = "mod inner; pub(crate) use inner::Deep; fn of_all() { inner::each() }";
        let inner = "use super::super::high::Mark; struct Deep;";
        let files = [
            ("lib.rs", lib),
            ("high.rs", high),
            ("low.rs", low),
            ("shelf/mod.rs", shelf),
            ("shelf/inner.rs", inner),
        ];
        Modules::read(files).circles()
    };
    let ring = ["high -> low", "low -> high"];
    assert_eq!(circles("use crate::Top; struct Below;"), ring);
    let quoting = "struct Below; fn f() -> char { crate::high::g('\"'); '\"' }";
    assert_eq!(circles(quoting), ring);
    let long_way = ["high -> low", "low -> shelf::inner", "shelf::inner -> high"];
    assert_eq!(circles("use super::Deep; struct Below;"), long_way);
    let by_the_parent = [
        "high -> low",
        "low -> shelf",
        "shelf -> shelf::inner",
        "shelf::inner -> high",
    ];
    let low = "use crate::shelf::of_all; struct Below;";
    assert_eq!(circles(low), by_the_parent);
    let fine = "struct Below<'a>; // crate::Top\n const A: &str = \"super::Top\";\
        #[cfg(test)] #[allow(unused)] mod tests { use super::super::Top; }";
    assert_eq!(circles(fine), Vec::<String>::new());
}
