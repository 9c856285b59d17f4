//! The scenes and studies that come with the program.

use std::path::{Path, PathBuf};

include!(concat!(env!("OUT_DIR"), "/shipped.rs"));

/// Folder in which scenes are looked for before the compiled-in ones.
const FOLDER: &str = "scenes";

#[derive(Clone, Debug)]
pub struct Shipped {
    /// Name without extension.
    pub name: String,
    pub content: Content,
}

/// A file in ./scenes or ./studies, or a text in the program.
#[derive(Clone, Debug)]
pub enum Content {
    File(PathBuf),
    /// The text that is compiled in.
    CompiledIn(&'static str),
}

/// The scenes of ./scenes if there are any, else those compiled in; sorted by name.
pub fn all() -> Vec<Shipped> {
    let entries = std::fs::read_dir(FOLDER).into_iter().flatten().flatten();
    let files = entries.map(|e| e.path());
    let files = files.filter(|p| p.extension().is_some_and(|e| e == "toml"));
    let scene = |p: PathBuf| {
        let name = p.file_stem()?.to_str()?.to_string();
        let content = Content::File(p);
        Some(Shipped { name, content })
    };
    let mut found: Vec<Shipped> = files.filter_map(scene).collect();
    if found.is_empty() {
        found = compiled_in();
    }
    found.sort_by(|a, b| a.name.cmp(&b.name));
    found
}

fn compiled_in() -> Vec<Shipped> {
    let scene = |(name, text): &(&str, &'static str)| Shipped {
        name: name.to_string(),
        content: Content::CompiledIn(text),
    };
    SCENES.iter().map(scene).collect()
}

/// The shipped scene of that name, in ./scenes or compiled in.
pub fn find(name: &str) -> Option<Shipped> {
    let name = name.trim_end_matches(".toml");
    let mut listed = all().into_iter().chain(compiled_in());
    listed.find(|s| s.name == name)
}

/// The question for the shipped scene of the most similar name; empty if no name is similar.
pub fn suggestion(name: &str) -> String {
    sph_core::suggestion(name, all().iter().map(|s| s.name.as_str()))
}

/// Folder in which studies are looked for before the compiled-in ones.
const STUDY_FOLDER: &str = "studies";

/// The shipped study of that name, in ./studies or compiled in.
pub fn find_study(name: &str) -> Option<Shipped> {
    let name = name.trim_end_matches(".toml");
    // By the folder that it would lie in, it is a shipped one, too.
    let short = ["studies/", "scenes/"].map(|folder| name.strip_prefix(folder));
    let name = short.into_iter().flatten().next().unwrap_or(name);
    let file = Path::new(STUDY_FOLDER).join(format!("{name}.toml"));
    let content = match file.is_file() {
        true => Content::File(file),
        false => Content::CompiledIn(STUDIES.iter().find(|(n, _)| *n == name)?.1),
    };
    let name = name.to_string();
    Some(Shipped { name, content })
}

pub fn studies() -> impl Iterator<Item = &'static str> {
    STUDIES.iter().map(|(name, _)| *name)
}

/// A compiled-in data file, with the path by which scenes name it.
pub type Data = (&'static str, &'static [u8]);

/// Compiled-in data files that one of some texts mentions; without texts all of them.
pub fn data_of(texts: Option<&[&str]>) -> Vec<Data> {
    let mentioned =
        |(path, _): &&Data| texts.is_none_or(|all| all.iter().any(|t| t.contains(path)));
    DATA.iter().filter(mentioned).copied().collect()
}

/// Writes files below a folder by their paths there, but for those that are there already; returns the new ones.
///
/// # Errors
/// The reason of the system, with the file.
pub fn unpack<P: AsRef<Path>, T>(
    files: impl IntoIterator<Item = (P, T)>,
    folder: &Path,
    write: impl Fn(&Path, T) -> std::io::Result<()>,
) -> Result<Vec<PathBuf>, String> {
    let mut written = Vec::new();
    for (path, content) in files {
        let target = folder.join(path);
        if target.exists() {
            continue;
        }
        let told = |e: std::io::Error| format!("cannot write {}: {e}", target.display());
        if let Some(parent) = target.parent() {
            std::fs::create_dir_all(parent).map_err(told)?;
        }
        write(&target, content).map_err(told)?;
        written.push(target);
    }
    Ok(written)
}
