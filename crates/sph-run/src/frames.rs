//! Numbered files of a run: fields for ParaView, pictures, films.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use sph_io::{ColourRanges, Frame, IoError, Piece, PvdSeries};

/// All columns of the state in which a run failed.
pub const BAD_STATE: &str = "bad_state.vtu";
/// A picture of that state.
pub const BAD_STATE_PICTURE: &str = "bad_state.png";
/// A picture of the surroundings of the place at fault.
pub const BAD_STATE_NEAR: &str = "bad_state_near.png";

/// Folders of numbered files.
const FOLDERS: [&str; 3] = ["pictures", "fields", "curves"];

/// Files of a run's fields; by default those for ParaView.
#[derive(Clone, Debug)]
pub struct Outlay {
    /// True if files for ParaView are written.
    pub vtk: bool,
    /// Names of quantities with pictures, of which films are made.
    pub pictures: Vec<String>,
    /// Digits of the number in the name of a picture.
    pub digits: usize,
    /// Pictures per second of films; none for no film.
    pub animation: Option<f64>,
    /// Folders that are needed besides.
    pub folders: Vec<&'static str>,
}

impl Default for Outlay {
    fn default() -> Self {
        Outlay {
            vtk: true,
            pictures: Vec::new(),
            digits: 4,
            animation: None,
            folders: Vec::new(),
        }
    }
}

/// Writes the fields of a run into its folder.
pub struct Frames {
    folder: PathBuf,
    outlay: Outlay,
    list: Option<PvdSeries>,
    /// Ranges of the colours of pictures so far.
    pub colours: ColourRanges,
    /// Outputs written so far: the number in the names of the next files.
    pub written: usize,
}

impl Frames {
    /// Starts anew, or goes on after `written` outputs. With `changed_at` the outputs may be others than before:
    /// the list of fields goes on with what there is of it until that time, s, or begins there.
    pub(crate) fn open(
        folder: &Path,
        outlay: Outlay,
        written: Option<usize>,
        changed_at: Option<f64>,
        colours: ColourRanges,
    ) -> Result<Self, IoError> {
        if written.is_none() {
            forget_earlier_run(folder);
        }
        // A failure that was is not one that is.
        for name in [BAD_STATE, BAD_STATE_PICTURE, BAD_STATE_NEAR] {
            let _ = std::fs::remove_file(folder.join(name));
        }
        let path = folder.join("fields.pvd");
        let list = match (outlay.vtk, written, changed_at) {
            (false, ..) => None,
            (true, None, _) => Some(PvdSeries::create(path)?),
            (true, _, Some(time)) => Some(PvdSeries::open_until(path, time)?),
            (true, Some(frames), None) => Some(PvdSeries::open_at(path, frames)?),
        };
        for sub in &outlay.folders {
            sph_io::writable(folder.join(sub))?;
        }
        Ok(Frames {
            folder: folder.to_path_buf(),
            outlay,
            list,
            colours,
            written: written.unwrap_or(0),
        })
    }

    /// Adds a frame for ParaView, if there are files for it; `ranks` processes write its first piece together.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn add(&mut self, time: f64, pieces: Vec<Piece<'_>>, ranks: usize) -> Result<(), IoError> {
        let Some(list) = &mut self.list else {
            return Ok(());
        };
        let frame = Frame {
            time,
            index: self.written,
            pieces,
        };
        list.write(&frame, ranks).map(|_| ())
    }

    /// True if there are files for ParaView.
    pub fn lists(&self) -> bool {
        self.list.is_some()
    }

    /// The picture of a name at the present output.
    pub fn picture(&self, name: &str) -> PathBuf {
        self.file("pictures", name, "png", self.written)
    }

    /// The table of a name at the present output, in a folder of the outlay.
    pub fn table(&self, folder: &str, name: &str) -> PathBuf {
        self.file(folder, name, "csv", self.written)
    }

    fn file(&self, folder: &str, name: &str, extension: &str, number: usize) -> PathBuf {
        let digits = self.outlay.digits;
        let file = format!("{name}_{number:0digits$}.{extension}");
        self.folder.join(folder).join(file)
    }

    /// Joins the pictures of every name to a film, unless none is wanted.
    pub(crate) fn film(&self) -> Result<(), IoError> {
        let Some(speed) = self.outlay.animation else {
            return Ok(());
        };
        for name in &self.outlay.pictures {
            // A scene that was changed on the way may have drawn other fields before.
            let files = (0..self.written).map(|k| self.file("pictures", name, "png", k));
            sph_io::write_film(&self.folder, name, files, speed)?;
        }
        Ok(())
    }
}

/// Removes the numbered files of an earlier run, which would pass for this one's.
fn forget_earlier_run(folder: &Path) {
    let numbered = |path: &Path| {
        let [stem, kind] = [path.file_stem(), path.extension()]
            .map(|part| part.and_then(OsStr::to_str).unwrap_or_default());
        // The share of a rank has its number behind that of the frame.
        let (before, last) = stem.rsplit_once('_').unwrap_or_default();
        let rank = last.strip_prefix('r').is_some_and(is_number);
        let number = match rank {
            true => before.rsplit_once('_').map_or("", |(_, n)| n),
            false => last,
        };
        matches!(kind, "png" | "vtu" | "pvtu" | "csv") && number.len() >= 4 && is_number(number)
    };
    let _ = std::fs::remove_dir_all(folder.join("animations"));
    for sub in FOLDERS {
        let entries = std::fs::read_dir(folder.join(sub)).into_iter();
        let entries = entries.flatten().flatten();
        for path in entries.map(|e| e.path()).filter(|p| numbered(p)) {
            // A file that cannot go is overwritten or stays; the run does not depend on it.
            let _ = std::fs::remove_file(path);
        }
    }
}

fn is_number(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit())
}
