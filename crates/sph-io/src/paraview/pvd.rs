//! ParaView's `.pvd`: the list of files that make a time series.
//!
//! The list is rewritten all or nothing after every output, so that a running or killed job can be opened at any time.
//! Its data files lie in a folder of the same stem beside it, and paths in it are relative, so that both can be moved
//! together.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use roxmltree::{Document, Node};

use crate::error::{IoError, Result};
use crate::files::clean::escape;
use crate::files::disk::{beside, writable, write_whole};
use crate::paraview::frame::Frame;
use crate::paraview::pvtu::{file_name, write_pvtu, write_share};
use crate::paraview::vtu::write_vtu;

/// A time series being written: `fields.pvd` and `fields/fluid_000000.vtu`, …
#[derive(Debug)]
pub struct PvdSeries {
    path: PathBuf,
    /// The files seen from the folder of the list.
    entries: Vec<SeriesEntry>,
}

/// A file of a series that has been written.
#[derive(Clone, Debug, PartialEq)]
pub struct SeriesEntry {
    /// Simulated time, s.
    pub time: f64,
    /// Name of the piece: `fluid`, `walls`.
    pub name: String,
    /// Its file.
    pub path: PathBuf,
}

/// The files that a `.pvd` lists, in the order of their times.
///
/// # Errors
/// If it cannot be read, is not one of [`PvdSeries`], or names a file outside its folder.
pub fn list_pvd(path: impl AsRef<Path>) -> Result<Vec<SeriesEntry>> {
    let path = path.as_ref();
    let listed = |entry: SeriesEntry| {
        let path = beside(path, &entry.path)?;
        Ok(SeriesEntry { path, ..entry })
    };
    // A list that is not there is none, not an empty one.
    load(path, 1)?.into_iter().map(listed).collect()
}

impl PvdSeries {
    /// Starts a series at `path` (ending in `.pvd`); the first frame replaces an earlier list.
    pub fn create(path: impl AsRef<Path>) -> Result<Self> {
        let series = Self {
            path: path.as_ref().to_path_buf(),
            entries: Vec::new(),
        };
        writable(series.folder())?;
        Ok(series)
    }

    /// Continues a series after its first `frames` output times; later ones,
    /// which the interrupted run wrote after its last checkpoint, are dropped.
    pub fn open_at(path: impl AsRef<Path>, frames: usize) -> Result<Self> {
        let mut series = Self::create(path)?;
        let found = load(&series.path, frames)?;
        let times = distinct_times(&found);
        if times.len() < frames {
            let (found, wanted) = (times.len() as u64, frames as u64);
            let path = series.path;
            return Err(IoError::TooShort(path, found, "output times", wanted));
        }
        let end = frames
            .checked_sub(1)
            .map_or(f64::NEG_INFINITY, |last| times[last]);
        series.keep(found, end)?;
        Ok(series)
    }

    /// Continues a series after `time` (s); later entries are dropped.
    pub fn open_until(path: impl AsRef<Path>, time: f64) -> Result<Self> {
        let mut series = Self::create(path)?;
        let found = load(&series.path, 0)?;
        series.keep(found, time)?;
        Ok(series)
    }

    /// Writes the pieces of `frame`, lists them, and returns their paths. The time must be later than that of the frame
    /// before.
    ///
    /// Where several `ranks` write the first piece together, this one's share of it is in the frame; those of the others
    /// are theirs to [write](crate::write_share).
    ///
    /// # Errors
    /// A file that cannot be written; pieces that do not fit together.
    pub fn write(&mut self, frame: &Frame, ranks: usize) -> Result<Vec<PathBuf>> {
        let refuse = |problem: String| Err(IoError::input(&self.path, problem));
        if let Some(last) = self.entries.last()
            && frame.time.partial_cmp(&last.time) != Some(std::cmp::Ordering::Greater)
        {
            let (time, before) = (frame.time, last.time);
            return refuse(format!("time {time} s does not come after {before} s"));
        }
        if frame.pieces.is_empty() {
            return refuse(format!("frame {} has no pieces", frame.index));
        }
        let (folder, prefix) = (self.folder(), self.stem());
        let mut added = Vec::with_capacity(frame.pieces.len());
        let mut written = Vec::with_capacity(frame.pieces.len());
        for (number, piece) in frame.pieces.iter().enumerate() {
            let name = piece.name.to_string();
            let shared = number == 0 && ranks > 1;
            let kind = if shared { "pvtu" } else { "vtu" };
            let file = format!("{}_{:06}.{kind}", file_name(&name), frame.index);
            let path = folder.join(&file);
            if written.contains(&path) {
                return refuse(format!("two pieces are named `{name}`"));
            }
            match shared {
                false => write_vtu(&path, piece, frame.time)?,
                true => {
                    write_share(&folder, piece, (frame.index, 0), frame.time)?;
                    write_pvtu(&path, piece, frame.index, ranks)?;
                }
            }
            added.push(SeriesEntry {
                time: frame.time,
                name,
                path: format!("{prefix}/{file}").into(),
            });
            written.push(path);
        }
        let before = self.entries.len();
        self.entries.extend(added);
        let listed = self.list();
        if listed.is_err() {
            self.entries.truncate(before);
        }
        listed.map(|()| written)
    }

    /// Number of listed output times; give it to [`open_at`](Self::open_at) to continue from here.
    pub fn frames(&self) -> usize {
        distinct_times(&self.entries).len()
    }

    fn stem(&self) -> String {
        let stem = self.path.file_stem().unwrap_or_default();
        let stem = stem.to_string_lossy().into_owned();
        // Without an extension the folder would take the list's own name.
        if self.path.extension().is_none() {
            return stem + "_files";
        }
        stem
    }

    fn folder(&self) -> PathBuf {
        self.path.with_file_name(self.stem())
    }

    /// Takes over the entries up to `end`, and lists only that.
    fn keep(&mut self, mut found: Vec<SeriesEntry>, end: f64) -> Result<()> {
        let before = found.len();
        found.retain(|e| e.time <= end);
        self.entries = found;
        if self.entries.len() < before {
            self.list()?;
        }
        Ok(())
    }

    fn list(&self) -> Result<()> {
        let mut xml = String::from(
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" \
             byte_order=\"LittleEndian\">\n  <Collection>\n",
        );
        // Parts are numbered in the order in which their names appear.
        let mut names: Vec<&str> = Vec::new();
        for e in &self.entries {
            let known = names.iter().position(|name| *name == e.name);
            let part = known.unwrap_or(names.len());
            if known.is_none() {
                names.push(&e.name);
            }
            let file = e.path.to_string_lossy();
            let (time, name, file) = (e.time, escape(&e.name), escape(&file));
            xml.push_str(&format!(
                "    <DataSet timestep=\"{time:?}\" part=\"{part}\" name=\"{name}\" file=\"{file}\"/>\n"
            ));
        }
        xml.push_str("  </Collection>\n</VTKFile>\n");
        write_whole(&self.path, xml)
    }
}

/// The entries on disk; no file is as good as an empty one if none are wanted.
fn load(path: &Path, wanted: usize) -> Result<Vec<SeriesEntry>> {
    let text = match fs::read_to_string(path) {
        Ok(text) => text,
        Err(e) if e.kind() == io::ErrorKind::NotFound && wanted == 0 => return Ok(vec![]),
        Err(e) => return Err(IoError::read(path, e)),
    };
    parse(&text).map_err(|problem| IoError::Malformed(path.into(), problem))
}

/// The entries of a list as this module writes it.
fn parse(text: &str) -> std::result::Result<Vec<SeriesEntry>, String> {
    let whole = Document::parse(text).ok();
    let whole = whole.filter(|d| d.root_element().attribute("type") == Some("Collection"));
    let whole = whole.ok_or("it is not a whole VTK collection")?;
    let mut entries: Vec<SeriesEntry> = Vec::new();
    let listed = whole.descendants().filter(|n| n.has_tag_name("DataSet"));
    for (i, node) in listed.enumerate() {
        let entry = entry(node).ok_or_else(|| format!("entry {} cannot be read", i + 1))?;
        if entries.last().is_some_and(|last| last.time > entry.time) {
            return Err(format!("entry {} goes back in time", i + 1));
        }
        entries.push(entry);
    }
    Ok(entries)
}

fn entry(node: Node<'_, '_>) -> Option<SeriesEntry> {
    let time = node.attribute("timestep")?.parse().ok();
    Some(SeriesEntry {
        time: time.filter(|t: &f64| t.is_finite())?,
        name: node.attribute("name")?.into(),
        path: node.attribute("file")?.into(),
    })
}

fn distinct_times(entries: &[SeriesEntry]) -> Vec<f64> {
    let mut times: Vec<f64> = entries.iter().map(|e| e.time).collect();
    times.dedup();
    times
}
