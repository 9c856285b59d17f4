//! The state in which a run ended, to be compared bit for bit.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use sph_io::{Checkpoint, ColumnData, FieldValues, Piece};

/// Everything of a results folder that a resumed run must reproduce.
#[derive(Debug, PartialEq)]
pub struct FinalState {
    /// Bits of the simulated time and the step.
    pub clock: [u64; 2],
    /// Columns of the checkpoint, reals as bits.
    pub columns: BTreeMap<String, Vec<u64>>,
    /// The time series.
    pub series: String,
    /// Every piece of every frame, by its name and time: numbers as bits, those of particles in the order of their identities,
    /// since ranks write them in another.
    pub fields: BTreeMap<String, BTreeMap<String, Vec<u64>>>,
    /// Every file of fields, by name.
    pub files: BTreeMap<PathBuf, Vec<u8>>,
}

impl FinalState {
    /// Reads a results folder.
    pub fn read(folder: &Path) -> Self {
        let checkpoint = Checkpoint::load(folder.join("checkpoint.sph")).expect("a checkpoint");
        let clock = &checkpoint.meta["clock"];
        let bits = |name: &str| clock[name].as_u64().expect("a clock");
        let columns = checkpoint.columns.iter().map(|column| {
            let bits = match &column.data {
                ColumnData::F64(v) => v.iter().map(|x| x.to_bits()).collect(),
                ColumnData::U32(v) => v.iter().map(|x| u64::from(*x)).collect(),
                ColumnData::U64(v) => v.clone(),
            };
            (column.name.clone(), bits)
        });
        let list = folder.join("fields.pvd");
        let frames = match list.exists() {
            true => sph_io::list_pvd(list).expect("a list of frames"),
            false => Vec::new(),
        };
        let frames = frames.into_iter().map(|listed| {
            let (piece, _) = sph_io::read_piece(&listed.path).expect("a piece of a frame");
            let name = format!("{} at {:?} s", listed.name, listed.time);
            (name, arrays(&piece))
        });
        let files = files_with_extension(folder, "vtu").into_iter().map(|path| {
            let name = path.strip_prefix(folder).expect("below the folder");
            let bytes = std::fs::read(&path).expect("a file of fields");
            (name.to_path_buf(), bytes)
        });
        FinalState {
            files: files.collect(),
            clock: [bits("time"), bits("dt")],
            columns: columns.collect(),
            series: std::fs::read_to_string(folder.join("series.csv")).expect("a series"),
            fields: frames.collect(),
        }
    }

    /// A column of reals of the checkpoint.
    #[track_caller]
    pub fn reals(&self, name: &str) -> Vec<f64> {
        let bits = self.columns.get(name);
        let bits = bits.unwrap_or_else(|| panic!("no column `{name}`"));
        bits.iter().map(|bits| f64::from_bits(*bits)).collect()
    }

    /// Fails with the name of what differs.
    pub fn assert_same(&self, other: &Self, what: &str) {
        let names = |s: &Self| s.columns.keys().cloned().collect::<Vec<_>>();
        assert_eq!(names(self), names(other), "{what}: columns");
        for (name, column) in &self.columns {
            let there = &other.columns[name];
            let differ = column.iter().zip(there).filter(|(a, b)| a != b).count();
            assert_eq!(column.len(), there.len(), "{what}: length of {name}");
            assert_eq!(
                differ,
                0,
                "{what}: {differ} of {} numbers of {name}",
                column.len()
            );
        }
        assert_eq!(self.clock, other.clock, "{what}: clock");
        let lines = self.series.lines().zip(other.series.lines());
        for (k, (a, b)) in lines.enumerate() {
            assert_eq!(a, b, "{what}: line {} of series.csv", k + 1);
        }
        assert_eq!(
            self.series.len(),
            other.series.len(),
            "{what}: length of series.csv"
        );
        let names = |s: &Self| s.fields.keys().cloned().collect::<Vec<_>>();
        assert_eq!(names(self), names(other), "{what}: pieces of frames");
        for (name, arrays) in &self.fields {
            let there = &other.fields[name];
            let differ = arrays.iter().find(|(k, v)| there.get(*k) != Some(v));
            let differ = differ.map(|(array, _)| array);
            assert_eq!(differ, None, "{what}: an array of {name}");
            assert_eq!(arrays.len(), there.len(), "{what}: arrays of {name}");
        }
        // Only what one process wrote has the same bytes: particles are in another order in files of several.
        let alone = [self, other].iter().all(|s| s.is_of_one_process());
        let compared = |name: &PathBuf| alone || !is_of_particles(name);
        let names = |s: &Self| {
            let names = s.files.keys().filter(|name| compared(name));
            names.cloned().collect::<Vec<_>>()
        };
        assert_eq!(names(self), names(other), "{what}: files of fields");
        for name in names(self) {
            let same = self.files[&name] == other.files[&name];
            assert!(same, "{what}: {} differs", name.display());
        }
    }
}

impl FinalState {
    /// Whether no rank has written a share of a frame, `fluid_000003_r1.vtu`.
    fn is_of_one_process(&self) -> bool {
        let stems = self.files.keys().filter_map(|name| name.file_stem());
        let mut last = stems.filter_map(|stem| stem.to_str()?.rsplit_once('_'));
        !last.any(|(_, last)| last.starts_with('r'))
    }
}

fn is_of_particles(name: &Path) -> bool {
    let stem = name.file_stem().and_then(|stem| stem.to_str());
    stem.is_some_and(|stem| stem.starts_with("fluid_"))
}

/// The arrays of a piece by their names, as bits, in the order of identities where it has them.
fn arrays(piece: &Piece<'_>) -> BTreeMap<String, Vec<u64>> {
    let bits = |data: &FieldValues<'_>| -> Vec<u64> {
        match data {
            FieldValues::F64(v) => v.iter().map(|x| x.to_bits()).collect(),
            FieldValues::U32(v) => v.iter().map(|x| u64::from(*x)).collect(),
            FieldValues::I64(v) => v.iter().map(|x| *x as u64).collect(),
        }
    };
    let identities = piece.fields.iter().find(|f| f.name == "identity");
    let order = identities.map(|f| {
        let identities = bits(&f.data);
        let mut order: Vec<usize> = (0..identities.len()).collect();
        order.sort_by_key(|k| identities[*k]);
        order
    });
    let sorted = |values: Vec<u64>, each: usize| match &order {
        None => values,
        Some(order) => {
            let tuple = |k: &usize| values[k * each..(k + 1) * each].to_vec();
            order.iter().flat_map(tuple).collect()
        }
    };
    let places = piece.points.as_flattened().iter().map(|x| x.to_bits());
    let mut all = BTreeMap::from([("position".to_string(), sorted(places.collect(), 3))]);
    for field in &piece.fields {
        all.insert(
            field.name.to_string(),
            sorted(bits(&field.data), field.components),
        );
    }
    all
}

/// All files below a folder with an extension, sorted.
pub fn files_with_extension(folder: &Path, extension: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut open = vec![folder.to_path_buf()];
    while let Some(folder) = open.pop() {
        for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
            let path = entry.path();
            if path.is_dir() {
                open.push(path);
            } else if path.extension().is_some_and(|e| e == extension) {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}
