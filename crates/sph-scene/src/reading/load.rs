//! From a file to a validated scene, or to all its mistakes.

use std::collections::BTreeMap;
use std::fmt;
use std::io::Read;
use std::path::{Path, PathBuf};

use sph_core::{MOST_PROBLEMS, SceneProblem, conform, kinds};
use thiserror::Error;
use toml::de::DeTable;
use toml::{Table, Value};

use crate::checks::whole;
use crate::reading::columns;
use crate::reading::diagnostic::{Diagnostic, Origin, line_and_column};
use crate::reading::limits::{self, FILE_BYTES};
use crate::reading::plugins::Plugins;
use crate::reading::remarks;
use crate::reading::schema;
use crate::{Override, Scene, Source};

/// A valid scene and the text it came from.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// The scene.
    pub scene: Scene,
    /// Its text, to show mistakes in that are found later.
    pub source: Source,
}

impl Loaded {
    /// The scene as a table: overrides applied, quantities of the scene's own keys in SI.
    ///
    /// Two scenes with the same table are the same scene, however they are written.
    pub fn resolved(&self) -> Table {
        match resolved(&self.source) {
            Ok((Value::Table(table), _)) => table,
            // It has been read from this source before.
            _ => Table::new(),
        }
    }
}

/// A scene that is not valid.
#[derive(Clone, Debug)]
pub struct Refused {
    /// Every mistake found, sorted by position.
    pub diagnostics: Vec<Diagnostic>,
    /// The text they stand in.
    pub source: Source,
}

impl fmt::Display for Refused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (k, diagnostic) in self.diagnostics.iter().enumerate() {
            let line = if k == 0 { "" } else { "\n" };
            write!(f, "{line}{diagnostic}")?;
        }
        Ok(())
    }
}

impl std::error::Error for Refused {}

/// Why a scene cannot be had from a file.
#[derive(Debug, Error)]
pub enum LoadError {
    /// The file cannot be read.
    #[error("cannot read `{file}`: {reason}")]
    Unreadable {
        /// Name of the file.
        file: String,
        /// What the system says.
        reason: String,
    },
    /// The scene has mistakes.
    #[error(transparent)]
    Refused(Box<Refused>),
}

/// Reads a scene file, with overrides put on top.
///
/// # Errors
/// If the file cannot be read, or with every mistake in it.
pub fn load(path: &Path, overrides: &[Override]) -> Result<Loaded, LoadError> {
    load_allowing(path, overrides, &[])
}

/// Reads a scene file that may name files in further folders than its own.
///
/// # Errors
/// As [`load`].
pub fn load_allowing(
    path: &Path,
    overrides: &[Override],
    folders: &[PathBuf],
) -> Result<Loaded, LoadError> {
    let file = path.display().to_string();
    let text = read_text(path).map_err(|reason| LoadError::Unreadable {
        file: file.clone(),
        reason,
    })?;
    let source = Source::new(&text, &file, overrides).allowing(folders);
    read(source).map_err(|refused| LoadError::Refused(Box::new(refused)))
}

/// Whether a path is that of an open file of this process: `/dev/stdin`, or `<(command)` of a shell. Opening
/// another pipe would wait for its writer, for ever if there is none.
fn is_given(path: &Path) -> bool {
    let open = ["/dev/stdin", "/dev/fd", "/proc/self/fd"];
    open.iter().any(|p| path.starts_with(p))
}

/// Reads a file of the size that a scene may have.
///
/// # Errors
/// What the system says, or that it is too long or no text.
pub fn read_text(path: &Path) -> Result<String, String> {
    let known = std::fs::metadata(path).map_err(|e| e.to_string())?;
    if !known.is_file() && !is_given(path) {
        return Err("it is not a file (a pipe of the shell or /dev/stdin is taken as well)".into());
    }
    let file = std::fs::File::open(path).map_err(|e| e.to_string())?;
    let mut bytes = Vec::new();
    let most = FILE_BYTES as u64 + 1;
    file.take(most)
        .read_to_end(&mut bytes)
        .map_err(|e| e.to_string())?;
    if bytes.len() > FILE_BYTES {
        return Err(format!("it is longer than {} MiB", FILE_BYTES >> 20));
    }
    String::from_utf8(bytes).map_err(|e| {
        let at = e.utf8_error().valid_up_to();
        let before = String::from_utf8_lossy(&e.as_bytes()[..at]);
        let (line, column) = line_and_column(&before, at);
        format!("byte {at}, in line {line}, is not UTF-8 text (column {column})")
    })
}

/// Reads a scene from a text; `name` is its file name, against which it names other files.
///
/// # Errors
/// Every mistake found.
pub fn parse(text: &str, name: &str, overrides: &[Override]) -> Result<Loaded, Refused> {
    read(Source::new(text, name, overrides))
}

/// Reads the scene of a text that knows where it comes from.
///
/// # Errors
/// Every mistake found.
pub fn read(source: Source) -> Result<Loaded, Refused> {
    match scene(&source) {
        Ok(scene) => Ok(Loaded { scene, source }),
        Err(diagnostics) => Err(Refused {
            diagnostics,
            source,
        }),
    }
}

fn scene(source: &Source) -> Result<Scene, Vec<Diagnostic>> {
    let diagnosed = |problems: Vec<SceneProblem>| source.diagnose(&problems);
    let unread = |e: toml::de::Error| diagnosed(vec![SceneProblem::new("", e.message())]);
    let (mut table, mut remarks) = resolved(source)?;
    let plugins = take_plugins(&mut table).map_err(unread)?;
    let mut scene: Scene = table.try_into().map_err(unread)?;
    scene.plugins = plugins;
    let problems = whole::scene(&mut scene, source);
    if !problems.is_empty() {
        return Err(diagnosed(problems));
    }
    remarks.extend(remarks::of_plugins(&scene));
    let remarks = source.diagnose(&remarks);
    scene.remarks = remarks.iter().map(Diagnostic::to_string).collect();
    Ok(scene)
}

/// Takes the tables out that name plugins: kinds are open, so that no type has them as fields.
fn take_plugins(scene: &mut Value) -> Result<BTreeMap<&'static str, Plugins>, toml::de::Error> {
    let mut all = BTreeMap::new();
    let Some(scene) = scene.as_table_mut() else {
        return Ok(all);
    };
    for kind in kinds().iter().filter(|k| k.is_open()) {
        if let Some(plugins) = scene.remove(kind.name) {
            all.insert(kind.name, plugins.try_into()?);
        }
    }
    Ok(all)
}

/// The table of the scene in the form of its schema, and remarks on its numbers.
fn resolved(source: &Source) -> Result<(Value, Vec<SceneProblem>), Vec<Diagnostic>> {
    let mut table = source.table()?;
    let diagnosed = |problems: Vec<SceneProblem>| source.diagnose(&problems);
    let mut problems = limits::check(&table);
    if !problems.is_empty() {
        return Err(diagnosed(problems));
    }
    problems.extend(whole::tables(&table));
    problems.extend(columns::convert(&mut table));
    let mut value = Value::Table(table);
    let remarks = conform(&mut value, &schema::of_scene()).unwrap_or_else(|found| {
        problems.extend(found);
        Vec::new()
    });
    match problems.is_empty() {
        true => Ok((value, remarks)),
        false => Err(diagnosed(problems)),
    }
}

/// The table of the file with the overrides applied.
pub(crate) fn table(source: &Source) -> Result<Table, Vec<Diagnostic>> {
    let text = source.text();
    let whole = |message: &str| vec![source.diagnostic(Origin::File, 0..0, "", message)];
    if text.len() > FILE_BYTES {
        return Err(whole(&format!(
            "the file is longer than {} MiB",
            FILE_BYTES >> 20
        )));
    }
    let syntax = |e: &toml::de::Error| {
        let span = e.span().unwrap_or_else(|| too_deep(text, e.message()));
        let message = match e.message() {
            long if long.contains("as i128") => "the integer does not fit into 64 bits",
            message => message,
        };
        source.diagnostic(Origin::File, span, "", message)
    };
    let (_, errors) = DeTable::parse_recoverable(text);
    if !errors.is_empty() {
        let told = errors.iter().take(MOST_PROBLEMS);
        let mut all: Vec<_> = told.map(syntax).collect();
        all.sort_by_key(|d| (d.span.start, d.span.end));
        all.dedup_by_key(|d| d.line);
        return Err(all);
    }
    let mut table: Table = toml::from_str(text).map_err(|e| vec![syntax(&e)])?;
    let apply = |o: &Override| o.apply(&mut table).err();
    let problems: Vec<_> = source.overrides().iter().filter_map(apply).collect();
    match problems.is_empty() {
        true => Ok(table),
        false => Err(source.diagnose(&problems)),
    }
}

/// Deepest nesting that the reader of TOML takes.
const DEEPEST: usize = 80;

/// Where a text is nested too deeply: the reader tells that without a place.
fn too_deep(text: &str, message: &str) -> std::ops::Range<usize> {
    if !message.contains("recursion") {
        return 0..0;
    }
    let mut depth = 0_usize;
    // Of a key in this place: `a.b.c` is nested as well.
    let mut dots = 0_usize;
    for (k, byte) in text.bytes().enumerate() {
        match byte {
            b'[' | b'{' => depth += 1,
            b']' | b'}' => depth = depth.saturating_sub(1),
            b'.' => dots += 1,
            b'-' | b'_' | b'"' | b'\'' => {}
            b if b.is_ascii_alphanumeric() => {}
            _ => dots = 0,
        }
        if depth + dots > DEEPEST {
            return k..k + 1;
        }
    }
    0..0
}
