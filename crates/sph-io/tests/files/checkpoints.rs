//! Checkpoints come back bit for bit or not at all.

use std::fs;
use std::path::{Path, PathBuf};

use proptest::prelude::*;
use serde_json::json;
use sph_io::{Checkpoint, CheckpointFault as Fault, Column, ColumnData, IoError};

fn column(name: &str, components: usize, data: ColumnData) -> Column {
    Column {
        name: name.into(),
        components,
        data,
    }
}

fn sample() -> Checkpoint {
    let odd = vec![
        0.1,
        -0.0,
        f64::INFINITY,
        f64::from_bits(0x7ff8_dead_beef_0001),
        f64::from_bits(0xfff0_0000_0000_0001),
        5e-324,
    ];
    Checkpoint {
        meta: json!({"time": 0.1 + 0.2, "step": u64::MAX, "scene": "title = \"α\""}),
        columns: vec![
            column("position", 2, ColumnData::F64(odd)),
            column("phase", 1, ColumnData::U32(vec![0, 1, u32::MAX])),
            column("id", 1, ColumnData::U64(vec![u64::MAX, 7])),
            column("none", 3, ColumnData::F64(vec![])),
        ],
    }
}

/// Equality that tells NaNs and zeros apart.
fn same(a: &Checkpoint, b: &Checkpoint) -> bool {
    let bits = |c: &Column| match &c.data {
        ColumnData::F64(v) => v.iter().map(|x| x.to_bits()).collect(),
        ColumnData::U32(v) => v.iter().map(|&x| u64::from(x)).collect(),
        ColumnData::U64(v) => v.clone(),
    };
    let pairs = a.columns.iter().zip(&b.columns);
    a.meta == b.meta && a.columns.len() == b.columns.len() && { pairs }.all(|(a, b)| {
        let kinds = [&a.data, &b.data].map(std::mem::discriminant);
        a.name == b.name
            && a.components == b.components
            && kinds[0] == kinds[1]
            && bits(a) == bits(b)
    })
}

fn saved(folder: &Path) -> (PathBuf, Vec<u8>) {
    let path = folder.join("run.ckpt");
    sample().save(&path).unwrap();
    let bytes = fs::read(&path).unwrap();
    (path, bytes)
}

fn fault(path: &Path, bytes: &[u8]) -> Fault {
    fs::write(path, bytes).unwrap();
    match Checkpoint::load(path) {
        Err(IoError::Checkpoint(named, fault)) => {
            assert_eq!(named, path);
            fault
        }
        Err(other) => panic!("not a fault: {other}"),
        Ok(_) => panic!("a damaged checkpoint was accepted"),
    }
}

#[test]
fn a_saved_state_is_loaded_bit_for_bit() {
    let folder = tempfile::tempdir().unwrap();
    let (path, _) = saved(folder.path());
    let back = Checkpoint::load(&path).unwrap();
    assert!(same(&back, &sample()));
    assert_eq!(back.meta["time"].as_f64(), Some(0.1 + 0.2));
    assert_eq!(back.column("phase").map(|c| c.data.len()), Some(3));
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn columns_longer_than_the_buffers_survive() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("long.ckpt");
    let long = Checkpoint {
        meta: json!(null),
        columns: vec![
            column(
                "a",
                3,
                ColumnData::F64((0..99_999).map(f64::from).collect()),
            ),
            column("b", 1, ColumnData::U32((0..70_001).collect())),
        ],
    };
    long.save(&path).unwrap();
    assert!(same(&Checkpoint::load(&path).unwrap(), &long));
}

#[test]
fn every_truncation_is_noticed() {
    let folder = tempfile::tempdir().unwrap();
    let (path, bytes) = saved(folder.path());
    for length in 0..bytes.len() {
        match fault(&path, &bytes[..length]) {
            Fault::NotACheckpoint => assert!(length < 8),
            Fault::Length(_, found) => assert_eq!(found, length as u64),
            other => panic!("at {length}: {other}"),
        }
    }
    let longer = [&bytes[..], &[0]].concat();
    assert!(matches!(fault(&path, &longer), Fault::Length(..)));
}

#[test]
fn every_flipped_bit_is_noticed() {
    let folder = tempfile::tempdir().unwrap();
    let (path, bytes) = saved(folder.path());
    for i in 0..bytes.len() {
        let mut damaged = bytes.clone();
        damaged[i] ^= 1 << (i % 8);
        let found = fault(&path, &damaged);
        let expected = match i {
            0..8 => matches!(found, Fault::NotACheckpoint),
            8..12 => matches!(found, Fault::Version(_)),
            12..16 => matches!(found, Fault::HeaderChecksum(..)),
            16..24 => matches!(found, Fault::Length(..)),
            24..32 => matches!(found, Fault::Sizes(_) | Fault::HeaderChecksum(..)),
            _ => matches!(found, Fault::Checksum(..) | Fault::HeaderChecksum(..)),
        };
        assert!(expected, "byte {i}: {found}");
    }
}

/// A file with right checksums around the header `text`.
fn forged(text: &str, data: &[u8]) -> Vec<u8> {
    let total = 32 + text.len() + data.len() + 4;
    let mut file = b"SPHCKPT\0\x01\0\0\0".to_vec();
    file.extend(crc32fast::hash(text.as_bytes()).to_le_bytes());
    file.extend((total as u64).to_le_bytes());
    file.extend((text.len() as u64).to_le_bytes());
    file.extend(text.as_bytes());
    file.extend(data);
    let sum = crc32fast::hash(&file);
    file.extend(sum.to_le_bytes());
    file
}

#[test]
fn absurd_headers_with_right_checksums_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("forged.ckpt");
    let shape = |components: u64, count: u64| {
        format!(
            r#"{{"meta":1,"columns":[{{"name":"a","type":"f64","components":{components},"count":{count}}}]}}"#
        )
    };
    let sizes = [
        (u64::MAX, u64::MAX),
        (1, u64::MAX / 8),
        (1, 1 << 60),
        (1, 2),
        (0, 5),
        (1, 0),
    ];
    for (components, count) in sizes {
        let file = forged(&shape(components, count), &[0; 8]);
        let found = fault(&path, &file);
        assert!(matches!(found, Fault::Sizes(_)), "{found}");
    }
    let twice = r#"{"meta":1,"columns":[{"name":"a","type":"u32","components":1,"count":1},{"name":"a","type":"u32","components":1,"count":1}]}"#;
    for text in [twice, "{", "[]", r#"{"meta":1}"#, &"[".repeat(100_000)] {
        let found = fault(&path, &forged(text, &[0; 8]));
        assert!(matches!(found, Fault::Header(_)), "{found}");
    }
    // What is declared empty costs no bytes of the file, and must cost no time either.
    let one = |k| format!(r#"{{"name":"{k}","type":"f64","components":1,"count":0}}"#);
    let many: Vec<String> = (0..200_000).map(one).collect();
    let text = format!(r#"{{"meta":1,"columns":[{}]}}"#, many.join(","));
    let found = fault(&path, &forged(&text, &[]));
    assert!(
        found
            .to_string()
            .contains("200000 columns, more than 10000")
    );
    let long = format!(r#"{{"meta":[{}1],"columns":[]}}"#, "1,".repeat(35 << 20));
    let found = fault(&path, &forged(&long, &[]));
    assert!(found.to_string().contains("more than 67108864"), "{found}");
    fs::write(&path, forged(&shape(1, 1), &[0; 8])).unwrap();
    assert!(Checkpoint::load(&path).is_ok());
}

#[test]
fn misfits_are_refused_before_anything_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let (path, bytes) = saved(folder.path());
    for (components, twin) in [(0, "b"), (2, "b"), (1, "a")] {
        let bad = Checkpoint {
            meta: json!({}),
            columns: vec![
                column("a", components, ColumnData::U32(vec![1, 2, 3])),
                column(twin, 1, ColumnData::U32(vec![])),
            ],
        };
        assert!(matches!(bad.save(&path), Err(IoError::Input(..))));
    }
    assert_eq!(fs::read(&path).unwrap(), bytes);
    let absent = Checkpoint::load(folder.path().join("absent"));
    assert!(matches!(absent, Err(IoError::Read(..))));
}

proptest! {
    #[test]
    fn any_bits_survive(bits in prop::collection::vec(any::<u64>(), 0..60), words in prop::collection::vec(any::<u32>(), 0..60)) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("any.ckpt");
        let reals = bits.iter().map(|&b| f64::from_bits(b)).collect();
        let any = Checkpoint {
            meta: json!({"words": words.len()}),
            columns: vec![
                column("reals", 1, ColumnData::F64(reals)),
                column("bits", 1, ColumnData::U64(bits)),
                column("words", 1, ColumnData::U32(words)),
            ],
        };
        any.save(&path).unwrap();
        prop_assert!(same(&Checkpoint::load(&path).unwrap(), &any));
    }

    #[test]
    fn random_damage_is_noticed(places in prop::collection::vec((any::<prop::sample::Index>(), 1..=255_u8), 1..6)) {
        let folder = tempfile::tempdir().unwrap();
        let (path, bytes) = saved(folder.path());
        let mut damaged = bytes.clone();
        for (place, change) in places {
            damaged[place.index(bytes.len())] ^= change;
        }
        fs::write(&path, &damaged).unwrap();
        prop_assert!(damaged == bytes || Checkpoint::load(&path).is_err());
    }
}
