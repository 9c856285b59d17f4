//! Valid files with a few bytes changed: read without a panic, or refused with file and place.

use std::path::Path;
use std::sync::OnceLock;

use proptest::prelude::*;
use proptest::sample::Index;
use sph_io::{Checkpoint, Column, ColumnData, IoError, Table, read_table};
use sph_scene::{Facets, Line, LoadError, load};
use sph_tests::{DAM_BREAK, PADDLE, PERIODIC, SOIL, Says};

/// What is done to a file at a place.
#[derive(Clone, Debug)]
enum Edit {
    Flip(Index, u8),
    Delete(Index, usize),
    Double(Index, usize),
    Cut(Index),
    Swap(Index, Index, usize),
    Insert(Index, &'static [u8]),
    /// Another number in the place of the next one.
    Number(Index, &'static str),
}

const PIECES: [&[u8]; 10] = [
    b"[",
    b"]",
    b"\"",
    b"=",
    b"\n",
    b",",
    b"\xff",
    b"\xc3\x28",
    b"\0",
    b"1e",
];
const NUMBERS: &str = "0 -1 1e308 1e-308 nan inf 1e999 9223372036854775807 99999999999999999999 1e12 1e-12 4294967296";

fn edit() -> impl Strategy<Value = Edit> {
    let at = any::<Index>;
    let length = 1..40_usize;
    let numbers: Vec<_> = NUMBERS.split(' ').collect();
    prop_oneof![
        1 => (at(), 1..=255_u8).prop_map(|(i, x)| Edit::Flip(i, x)),
        1 => (at(), length.clone()).prop_map(|(i, n)| Edit::Delete(i, n)),
        1 => (at(), length.clone()).prop_map(|(i, n)| Edit::Double(i, n)),
        1 => at().prop_map(Edit::Cut),
        1 => (at(), at(), length).prop_map(|(i, j, n)| Edit::Swap(i, j, n)),
        1 => (at(), 0..PIECES.len()).prop_map(|(i, k)| Edit::Insert(i, PIECES[k])),
        3 => (at(), prop::sample::select(numbers)).prop_map(|(i, x)| Edit::Number(i, x)),
    ]
}

fn edits() -> impl Strategy<Value = Vec<Edit>> {
    prop::collection::vec(edit(), 1..4)
}

fn mutated(whole: &[u8], edits: &[Edit]) -> Vec<u8> {
    let mut bytes = whole.to_vec();
    for edit in edits {
        if bytes.is_empty() {
            break;
        }
        let count = bytes.len();
        let place = |i: &Index| i.index(count);
        let end = |start: usize, n: usize| (start + n).min(count);
        match edit {
            Edit::Flip(i, x) => bytes[place(i)] ^= x,
            Edit::Delete(i, n) => drop(bytes.drain(place(i)..end(place(i), *n))),
            Edit::Double(i, n) => {
                let piece = bytes[place(i)..end(place(i), *n)].to_vec();
                bytes.splice(place(i)..place(i), piece);
            }
            Edit::Cut(i) => bytes.truncate(place(i)),
            Edit::Swap(i, j, n) => {
                for k in 0..*n {
                    bytes.swap(
                        end(place(i), k).min(count - 1),
                        end(place(j), k).min(count - 1),
                    );
                }
            }
            Edit::Insert(i, piece) => drop(bytes.splice(place(i)..place(i), piece.iter().copied())),
            Edit::Number(i, number) => {
                let digits = |b: &u8| b.is_ascii_digit() || b".eE+-".contains(b);
                let Some(start) = (place(i)..count).find(|k| bytes[*k].is_ascii_digit()) else {
                    continue;
                };
                let length = bytes[start..].iter().take_while(|b| digits(b)).count();
                bytes.splice(start..start + length, number.bytes());
            }
        }
    }
    bytes
}

/// Most particles and wall points of a scene that is assembled.
const SMALL: f64 = 600.0;

/// As `sph check` does it. Returns whether it was assembled.
fn checked(path: &Path) -> bool {
    match load(path, &[]) {
        Ok(loaded) => match sph_particles::setup::size(&loaded.scene) {
            Ok(size) if size.particles + size.wall_points <= SMALL => {
                let mut scene = loaded.scene;
                if let Some(relax) = &mut scene.numerics.relax {
                    relax.steps = 1;
                }
                if let Err(e) = sph_particles::setup::examine(&scene) {
                    assert!(!e.to_string().is_empty());
                }
                true
            }
            _ => false,
        },
        Err(LoadError::Refused(refused)) => {
            assert!(!refused.diagnostics.is_empty());
            for d in &refused.diagnostics {
                let shown = d.to_string();
                let at = format!("{}:{}:{}:", path.display(), d.line, d.column);
                assert!(shown.starts_with(&at), "{shown}");
                let lines = 1 + refused.source.text().matches('\n').count();
                assert!((1..=lines).contains(&d.line), "{shown}");
            }
            false
        }
        Err(e) => {
            let told = e.to_string();
            told.says("scene.toml | line");
            false
        }
    }
}

/// Files that scenes with files are mutated beside.
fn beside(folder: &Path) {
    std::fs::write(folder.join("tank.csv"), TANK).expect("a file");
    std::fs::write(folder.join("front.csv"), "t,x\n0,0.2\n0.1,0.25\n").expect("a file");
}

const TANK: &str = "x,y\n0,0\n0.6,0\n0.6,0.6\n0,0.6\n0,0\n";

fn scenes() -> [String; 5] {
    let polyline = "polyline = [[0.0, 0.0], [0.6, 0.0], [0.6, 0.6], [0.0, 0.6]]\nclosed = true\n";
    let filed = DAM_BREAK.replace(polyline, "file = \"tank.csv\"\n")
        + "[reference.front]\nprobe = \"front\"\nfile = \"front.csv\"\n";
    assert!(filed.contains("tank.csv"));
    [DAM_BREAK, PADDLE, PERIODIC, SOIL, &filed].map(String::from)
}

fn few(cases: u32) -> ProptestConfig {
    ProptestConfig {
        cases,
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

proptest! {
    #![proptest_config(few(400))]

    #[test]
    fn scenes_are_checked_or_refused(which in 0..5_usize, edits in edits()) {
        let folder = tempfile::tempdir()?;
        beside(folder.path());
        let path = folder.path().join("scene.toml");
        std::fs::write(&path, mutated(scenes()[which].as_bytes(), &edits))?;
        checked(&path);
    }

    #[test]
    fn data_of_scenes_are_read_or_refused(which in 0..2_usize, edits in edits()) {
        let folder = tempfile::tempdir()?;
        beside(folder.path());
        let name = ["tank.csv", "front.csv"][which];
        let whole = std::fs::read(folder.path().join(name))?;
        std::fs::write(folder.path().join(name), mutated(&whole, &edits))?;
        let path = folder.path().join("scene.toml");
        std::fs::write(&path, &scenes()[4])?;
        let scene = load(&path, &[]).expect("the scene itself is good").scene;
        // What is wrong is wrong in the walls or the references, and says so.
        let read = sph_particles::setup::size(&scene).and_then(|size| {
            let small = size.particles + size.wall_points <= SMALL;
            small.then(|| sph_particles::setup::examine(&scene)).transpose()
        });
        if let Err(e) = read {
            let told = e.to_string();
            let keys = ["wall.tank", "reference.front", "body.column", "numerics"];
            prop_assert!(keys.iter().any(|k| told.contains(k)), "{told}");
        }
    }
}

const PERCENTILES: &str =
    "time[s],low,high\n# of 100 runs\n0.0,1e3,2e3\n0.1,1.5e3,2.25e3\n\n0.2,-3,4\n";

fn refused_by(error: &impl std::fmt::Display, name: &str) {
    let told = error.to_string();
    told.says(name);
}

proptest! {
    #![proptest_config(few(4000))]

    #[test]
    fn tables_name_file_and_line(edits in edits()) {
        let bytes = mutated(PERCENTILES.as_bytes(), &edits);
        let text = String::from_utf8_lossy(&bytes);
        match Table::parse(&text, "p.csv") {
            Ok(table) => prop_assert!(table.columns.iter().all(|c| c.values.len() == table.rows())),
            Err(IoError::Table(path, line, _)) => {
                prop_assert!(path == Path::new("p.csv"));
                prop_assert!((1..=1 + text.lines().count()).contains(&line));
            }
            Err(other) => panic!("{other}"),
        }
        if let Err(e) = Line::from_csv(&text, "p.csv") {
            refused_by(&e, "p.csv");
            let told = e.to_string();
            prop_assert!(told.contains("line ") || told.contains("holds no numbers"), "{told}");
        }
    }

    #[test]
    fn surfaces_are_read_or_refused(binary in any::<bool>(), edits in edits()) {
        let bytes = mutated(if binary { BINARY } else { ASCII.as_bytes() }, &edits);
        let room = bytes.len() / 20;
        match Facets::from_stl(bytes, "s.stl") {
            Ok(facets) => {
                prop_assert!(facets.triangles.len() <= room, "more than the file holds");
                prop_assert!(facets.points.iter().flatten().all(|x| x.is_finite()));
                let count = facets.points.len() as u32;
                prop_assert!(facets.triangles.iter().flatten().all(|k| *k < count));
            }
            Err(e) => refused_by(&e, "s.stl"),
        }
    }

    #[test]
    fn drawings_are_read_or_refused(edits in edits()) {
        let bytes = mutated(SVG.as_bytes(), &edits);
        if let Err(e) = Line::from_svg(&String::from_utf8_lossy(&bytes), "d.svg", 0.1) {
            refused_by(&e, "d.svg");
        }
    }

    #[test]
    fn checkpoints_come_back_whole_or_not_at_all(edits in edits()) {
        let whole = checkpoint();
        let bytes = mutated(whole, &edits);
        prop_assert!(bytes == whole || Checkpoint::from_bytes(&bytes).is_err());
    }
}

const ASCII: &str = "solid t\nfacet normal 0 0 -1\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 1 0 0\n\
                     endloop\nendfacet\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n\
                     vertex 0 0 1e0\nendloop\nendfacet\nendsolid t\n";
/// Two facets after 80 bytes and the count.
const BINARY: &[u8] = &{
    let mut bytes = [0; 184];
    bytes[80] = 2;
    // 1.0 in the corners 1, 2 and 4, 5.
    let ones = [84 + 24, 84 + 40, 134 + 28, 134 + 44];
    let mut k = 0;
    while k < ones.len() {
        bytes[ones[k] + 2] = 0x80;
        bytes[ones[k] + 3] = 0x3f;
        k += 1;
    }
    bytes
};
const SVG: &str = "<svg viewBox='0 0 9 9'><g transform='rotate(30) scale(2)'><path d='M0 0h9v9zm2 2C3 1 4 1 5 \
                   2S7 3 8 2Q7 5 5 5T3 4A2 1 30 0 1 1 1Z'/></g><rect x='1' y='1' width='9mm' height='5' rx='1'/>\
                   <circle cx='4' cy='5' r='2'/><polygon points='0,0 1,0 1,1'/></svg>";

/// Saving waits for the disk, so it is done once.
fn checkpoint() -> &'static [u8] {
    static WHOLE: OnceLock<Vec<u8>> = OnceLock::new();
    WHOLE.get_or_init(saved)
}

fn saved() -> Vec<u8> {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("c.sph");
    let column = |name: &str, components, data| Column {
        name: name.into(),
        components,
        data,
    };
    let whole = Checkpoint {
        meta: serde_json::json!({"scene": DAM_BREAK, "clock": {"time": 0.1}}),
        columns: vec![
            column(
                "position",
                2,
                ColumnData::F64((0..40).map(f64::from).collect()),
            ),
            column("identity", 1, ColumnData::U32((0..20).collect())),
        ],
    };
    whole.save(&path).expect("saved");
    std::fs::read(&path).expect("read")
}

#[test]
fn files_that_are_no_text_name_the_line() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("latin.csv");
    std::fs::write(&path, b"t,x\n0,1\n1,2 # gr\xfc\xdfe\n").expect("a file");
    let told = read_table(&path).expect_err("no text").to_string();
    told.says("latin.csv, line 3: this is no UTF-8 text (column 9)");
    std::fs::write(folder.path().join("scene.toml"), &scenes()[4]).expect("a file");
    std::fs::write(folder.path().join("tank.csv"), b"0,0\n1,\xff\n").expect("a file");
    let scene = load(&folder.path().join("scene.toml"), &[])
        .expect("a scene")
        .scene;
    let told = sph_particles::setup::size(&scene)
        .expect_err("no text")
        .to_string();
    told.says("tank.csv`, line 2: this is no UTF-8 text");
}

/// What is mutated is good, and mutations leave some of it good: else nothing would be tested.
#[test]
fn unmutated_input_is_valid() {
    let folder = tempfile::tempdir().expect("a folder");
    beside(folder.path());
    let path = folder.path().join("scene.toml");
    for scene in scenes() {
        std::fs::write(&path, &scene).expect("a file");
        assert!(checked(&path), "{scene}");
        let loaded = load(&path, &[]).expect("a scene");
        sph_particles::setup::examine(&loaded.scene).unwrap_or_else(|e| panic!("{e}"));
    }
    for surface in [BINARY.to_vec(), ASCII.into()] {
        let facets = Facets::from_stl(surface, "s").expect("a surface");
        assert_eq!(facets.triangles.len(), 2);
    }
    assert_eq!(Table::parse(PERCENTILES, "p").expect("a table").rows(), 3);
    assert!(Line::from_svg(SVG, "d", 0.1).expect("a drawing").len() >= 4);
    assert!(Checkpoint::from_bytes(checkpoint()).is_ok());
}
