//! A full disk is reported as such and costs nothing that was there before.

#![cfg(target_os = "linux")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::json;
use sph_io::{
    Cells, Checkpoint, Column, ColumnData, FieldData, Frame, IoError, Piece, PvdSeries,
    SeriesWriter, writable, write_json,
};

/// A file system of 256 KiB, unmounted when dropped.
struct Tiny {
    folder: tempfile::TempDir,
}

impl Tiny {
    fn mount() -> Option<Self> {
        let folder = tempfile::tempdir().ok()?;
        let mounted = Command::new("mount")
            .args(["-t", "tmpfs", "-o", "size=256k", "tmpfs"])
            .arg(folder.path())
            .output();
        match mounted {
            Ok(output) if output.status.success() => Some(Self { folder }),
            _ => {
                println!("skipped: mounting a tmpfs is not permitted here");
                None
            }
        }
    }

    fn file(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }
}

impl Drop for Tiny {
    fn drop(&mut self) {
        let _ = Command::new("umount").arg(self.folder.path()).output();
    }
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<String> = entries
        .map(|e| e.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

fn full<T: std::fmt::Debug>(result: sph_io::Result<T>) {
    let error = result.expect_err("the disk is full");
    assert!(matches!(error, IoError::DiskFull(..)), "{error}");
}

fn checkpoint(numbers: usize) -> Checkpoint {
    // Nothing that could be stored in less.
    let noise = (0..numbers as u64).map(|i| i.wrapping_mul(0x9e37_79b9_7f4a_7c15));
    Checkpoint {
        meta: json!({}),
        columns: vec![Column {
            name: "noise".into(),
            components: 1,
            data: ColumnData::U64(noise.collect()),
        }],
    }
}

fn frame(index: usize, points: usize) -> Frame<'static> {
    let noise = (0..points)
        .map(|i| (i as f64 * 12.9898).sin())
        .collect::<Vec<_>>();
    Frame {
        time: index as f64,
        index,
        pieces: vec![Piece {
            name: "fluid".into(),
            points: vec![[0.0; 3]; points].into(),
            cells: Cells::Vertices,
            fields: vec![FieldData::scalar("noise", "", noise)],
        }],
    }
}

#[test]
fn a_failed_replacement_keeps_the_former_content() {
    let Some(tiny) = Tiny::mount() else { return };
    let path = tiny.file("run.ckpt");
    checkpoint(1000).save(&path).unwrap();
    full(checkpoint(100_000).save(&path));
    assert_eq!(names(tiny.folder.path()), ["run.ckpt"]);
    assert_eq!(Checkpoint::load(&path).unwrap(), checkpoint(1000));

    let mut series = PvdSeries::create(tiny.file("fields.pvd")).unwrap();
    series.write(&frame(0, 10), 1).unwrap();
    let list = fs::read(tiny.file("fields.pvd")).unwrap();
    full(series.write(&frame(1, 100_000), 1));
    assert_eq!(fs::read(tiny.file("fields.pvd")).unwrap(), list);
    assert_eq!(series.frames(), 1);
    assert_eq!(names(&tiny.file("fields")), ["fluid_000000.vtu"]);
    // Once there is room again the run can go on. A busy kernel frees the pages of a removed file a moment later.
    let again = (0..100).any(|_| {
        std::thread::sleep(std::time::Duration::from_millis(10));
        series.write(&frame(1, 10), 1).is_ok()
    });
    assert!(again);

    full(write_json(
        tiny.file("summary.json"),
        &vec!["x".repeat(1 << 19)],
    ));
    assert!(!tiny.file("summary.json").exists());
}

#[test]
fn a_table_ends_after_its_last_whole_row() {
    let Some(tiny) = Tiny::mount() else { return };
    let path = tiny.file("series.csv");
    let mut series = SeriesWriter::create(&path, [("time", "s"), ("x", "m")]).unwrap();
    let mut rows = 0;
    let error = loop {
        match series.row(&[f64::from(rows) / 3.0, 1.0 / 7.0]) {
            Ok(()) => rows += 1,
            Err(error) => break error,
        }
    };
    assert!(matches!(error, IoError::DiskFull(..)), "{error}");
    assert_eq!(sph_io::read_table(&path).unwrap().rows(), rows as usize);
    assert_eq!(fs::metadata(&path).unwrap().len(), series.position());
    full(writable(tiny.file("new")));
}

#[test]
fn a_full_device_is_told_from_other_trouble() {
    let device = Path::new("/dev/full");
    if !device.exists() {
        println!("skipped: no /dev/full on this system");
        return;
    }
    full(SeriesWriter::create(device, [("time", "s")]));
}
