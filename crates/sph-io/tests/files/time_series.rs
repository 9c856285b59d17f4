//! The list of a time series is whole at every moment and survives a resume.

use std::fs;
use std::path::Path;

use sph_io::{Cells, FieldData, Frame, IoError, Piece, PvdSeries};

fn frame(index: usize) -> Frame<'static> {
    let piece = |name: &'static str| Piece {
        name: name.into(),
        points: vec![[0.0; 3], [1.0, 0.0, 0.0]].into(),
        cells: Cells::Vertices,
        fields: vec![FieldData::scalar("pressure", "Pa", vec![0.0, index as f64])],
    };
    Frame {
        time: 0.1 * index as f64,
        index,
        pieces: vec![piece("fluid"), piece("walls")],
    }
}

/// The `file` attributes, after checking that tags are closed and files there.
fn listed(path: &Path) -> Vec<String> {
    let text = fs::read_to_string(path).unwrap();
    assert!(text.starts_with("<?xml version=\"1.0\"?>\n<VTKFile "));
    let mut open = Vec::new();
    let mut files = Vec::new();
    for tag in text.split('<').skip(1) {
        let (tag, rest) = tag.split_once('>').expect("a closed tag");
        assert!(rest.trim().is_empty(), "text between tags");
        if let Some(name) = tag.strip_prefix('/') {
            assert_eq!(open.pop(), Some(name));
        } else if let Some(attributes) = tag.strip_suffix('/') {
            assert_eq!(open, ["VTKFile", "Collection"]);
            let file = attributes.split("file=\"").nth(1).unwrap();
            files.push(file.trim_end_matches('"').to_string());
        } else if !tag.starts_with('?') {
            open.push(tag.split(' ').next().unwrap());
        }
    }
    assert!(open.is_empty());
    for file in &files {
        assert!(path.with_file_name(file).is_file(), "{file}");
    }
    files
}

#[test]
fn the_list_is_whole_after_every_output() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("fields.pvd");
    let mut series = PvdSeries::create(&path).unwrap();
    for index in 0..4 {
        let written = series.write(&frame(index), 1).unwrap();
        assert_eq!(written.len(), 2);
        let files = listed(&path);
        assert_eq!(files.len(), 2 * (index + 1));
        assert_eq!(files[0], "fields/fluid_000000.vtu");
        assert_eq!(series.frames(), index + 1);
    }
    let text = fs::read_to_string(&path).unwrap();
    assert!(text.contains("timestep=\"0.30000000000000004\" part=\"1\" name=\"walls\""));
    let names = fs::read_dir(folder.path().join("fields")).unwrap();
    assert!({ names }.all(|n| n.unwrap().path().extension().unwrap() == "vtu"));
}

#[test]
fn a_resumed_series_is_the_uninterrupted_one() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("fields.pvd");
    let mut series = PvdSeries::create(&path).unwrap();
    for index in 0..4 {
        series.write(&frame(index), 1).unwrap();
    }
    let whole = fs::read(&path).unwrap();

    let mut resumed = PvdSeries::open_at(&path, 2).unwrap();
    assert_eq!((resumed.frames(), listed(&path).len()), (2, 4));
    for index in 2..4 {
        resumed.write(&frame(index), 1).unwrap();
    }
    assert_eq!(fs::read(&path).unwrap(), whole);

    let mut resumed = PvdSeries::open_until(&path, 0.1).unwrap();
    assert_eq!(resumed.frames(), 2);
    assert!(resumed.write(&frame(1), 1).is_err(), "time must go on");
    resumed.write(&frame(2), 1).unwrap();

    let beyond = PvdSeries::open_at(&path, 9).unwrap_err();
    assert!(matches!(beyond, IoError::TooShort(_, 3, ..)), "{beyond}");
    assert_eq!(PvdSeries::open_at(&path, 0).unwrap().frames(), 0);
    assert_eq!(listed(&path).len(), 0);
}

#[test]
fn a_foreign_or_cut_list_is_an_error_not_a_loss() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("fields.pvd");
    let mut series = PvdSeries::create(&path).unwrap();
    series.write(&frame(0), 1).unwrap();
    let whole = fs::read_to_string(&path).unwrap();
    let cuts = (0..whole.trim_end().len()).filter(|&i| whole.is_char_boundary(i));
    for cut in cuts {
        fs::write(&path, &whole[..cut]).unwrap();
        let error = PvdSeries::open_at(&path, 1).unwrap_err();
        assert!(matches!(error, IoError::Malformed(..)), "{cut}: {error}");
        assert_eq!(fs::read_to_string(&path).unwrap(), whole[..cut]);
    }
    let absent = folder.path().join("absent.pvd");
    assert!(PvdSeries::open_at(&absent, 1).is_err());
    assert_eq!(PvdSeries::open_at(&absent, 0).unwrap().frames(), 0);
}

#[test]
fn frames_that_cannot_be_told_apart_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("fields.pvd");
    let mut series = PvdSeries::create(&path).unwrap();
    let mut twins = frame(0);
    twins.pieces[1].name = "fluid".into();
    assert!(matches!(series.write(&twins, 1), Err(IoError::Input(..))));
    let none = Frame {
        pieces: vec![],
        ..frame(0)
    };
    assert!(matches!(series.write(&none, 1), Err(IoError::Input(..))));
    let mut timeless = frame(0);
    timeless.time = f64::NAN;
    assert!(matches!(
        series.write(&timeless, 1),
        Err(IoError::Input(..))
    ));
    assert!(!path.exists());
}
