//! Writes what the fuzzers start from into `fuzz/corpus`: the shipped files, scenes of them so coarse
//! that they are assembled, small files of the other forms, and a dictionary of words of scenes.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use sph_io::{Checkpoint, Column, ColumnData};

type Done = Result<(), Box<dyn std::error::Error>>;

/// Particles of a coarse scene.
const PARTICLES: f64 = 300.0;
/// Longest shipped file that is a seed, bytes: fuzzers are slow with long ones.
const LONGEST: u64 = 16 << 10;

fn main() -> Done {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let corpus = |target: &str| -> std::io::Result<PathBuf> {
        let folder = root.join("corpus").join(target);
        fs::create_dir_all(&folder)?;
        Ok(folder)
    };
    let home = root.join("..");
    for folder in ["scenes", "tests/scenes"] {
        for path in files(&home.join(folder), "toml")? {
            scene(&path, &corpus("scene")?)?;
        }
    }
    copy(&home.join("studies"), "toml", &corpus("study")?)?;
    copy(&home.join("scenes/data"), "csv", &corpus("csv")?)?;
    copy(&home.join("scenes/data"), "stl", &corpus("stl")?)?;
    surfaces(&corpus("stl")?)?;
    drawings(&corpus("svg")?)?;
    checkpoints(&corpus("checkpoint")?)?;
    fs::write(root.join("corpus/scene.dict"), dictionary())?;
    Ok(())
}

fn files(folder: &Path, ending: &str) -> std::io::Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.extension().is_some_and(|e| e == ending) && path.metadata()?.len() <= LONGEST {
            found.push(path);
        }
    }
    Ok(found)
}

fn copy(from: &Path, ending: &str, to: &Path) -> std::io::Result<()> {
    for path in files(from, ending)? {
        fs::copy(&path, to.join(path.file_name().unwrap_or_default()))?;
    }
    Ok(())
}

/// A scene as it is, and with a spacing of few particles.
fn scene(path: &Path, corpus: &Path) -> Done {
    let text = fs::read_to_string(path)?;
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    fs::write(corpus.join(format!("{name}.toml")), &text)?;
    let Ok(loaded) = sph_scene::parse(&text, sph_fuzz::FILE, &[]) else {
        return Ok(());
    };
    let scene = &loaded.scene;
    let Ok(size) = sph_particles::setup::size(scene) else {
        return Ok(());
    };
    let wider = (size.particles / PARTICLES).powf(1.0 / scene.dimension as f64);
    let line = |line: &str| match line.trim_start().starts_with("spacing") {
        true => format!("spacing = {:.3e}", scene.numerics.spacing * wider.max(1.0)),
        false => line.to_string(),
    };
    let coarse: Vec<String> = text.lines().map(line).collect();
    fs::write(
        corpus.join(format!("{name}-coarse.toml")),
        coarse.join("\n"),
    )?;
    Ok(())
}

/// A tetrahedron in both forms.
fn surfaces(corpus: &Path) -> Done {
    let x: [[f32; 3]; 4] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let facets = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    let mut binary = vec![0; 80];
    binary.extend(4u32.to_le_bytes());
    let mut text = String::from("solid t\n");
    for facet in facets {
        binary.extend([0; 12]);
        text.push_str("facet normal 0 0 0\nouter loop\n");
        for corner in facet {
            let [a, b, c] = x[corner];
            binary.extend([a, b, c].map(f32::to_le_bytes).as_flattened());
            text.push_str(&format!("vertex {a} {b} {c}\n"));
        }
        binary.extend([0; 2]);
        text.push_str("endloop\nendfacet\n");
    }
    text.push_str("endsolid t\n");
    fs::write(corpus.join("binary.stl"), binary)?;
    fs::write(corpus.join("ascii.stl"), text)?;
    Ok(())
}

fn drawings(corpus: &Path) -> Done {
    let path = "M0 0h9v9H0zm2 2C3 1 4 1 5 2S7 3 8 2Q7 5 5 5T3 4A2 1 30 0 1 1 1l-1 1Z";
    fs::write(corpus.join("path"), path)?;
    let all = format!(
        "<svg width='10cm' height='8cm' viewBox='0 0 100 80'><g transform='rotate(30)'>\
         <path transform='translate(1 2) scale(.5)' d='{path}'/></g>\
         <rect x='1' y='1' width='9' height='5' rx='1' ry='2'/><circle cx='4' cy='5' r='2'/>\
         <ellipse cx='4' cy='5' rx='2' ry='1'/><line x1='0' x2='5mm' y1='1in' y2='0'/>\
         <polygon points='0,0 1,0 1,1'/><polyline style='display:none' points='0 0 1 1'/></svg>"
    );
    fs::write(corpus.join("all.svg"), all)?;
    Ok(())
}

fn checkpoints(corpus: &Path) -> Done {
    let column = |name: &str, components, data| Column {
        name: name.into(),
        components,
        data,
    };
    let meta = serde_json::json!({
        "scene": "title = 't'", "dimension": 2, "clock": {"time": 0, "dt": 1, "list_builds": 2},
        "run": {"steps": 3, "limited": {}}
    });
    let columns = vec![
        column("position", 2, ColumnData::F64(vec![0.0, -0.0, 1e300, 0.5])),
        column("identity", 1, ColumnData::U32(vec![0, 1])),
        column("large", 1, ColumnData::U64(vec![u64::MAX])),
    ];
    let whole = Checkpoint { meta, columns };
    whole.save(corpus.join("three.sph"))?;
    Checkpoint::default().save(corpus.join("empty.sph"))?;
    Ok(())
}

/// The names of all keys, plugins and choices in the schema of scenes.
fn dictionary() -> String {
    let mut words = BTreeSet::new();
    let mut waiting = vec![sph_scene::schema()];
    while let Some(value) = waiting.pop() {
        if let serde_json::Value::Object(map) = &value {
            let keys = |key: &str| map.get(key).and_then(|v| v.as_object());
            words.extend(
                keys("properties")
                    .into_iter()
                    .flatten()
                    .map(|(k, _)| k.clone()),
            );
            let choices = map.get("enum").and_then(|v| v.as_array());
            let choices = choices.into_iter().flatten().chain(map.get("const"));
            words.extend(choices.filter_map(|v| v.as_str()).map(String::from));
        }
        match value {
            serde_json::Value::Object(map) => waiting.extend(map.into_iter().map(|(_, v)| v)),
            serde_json::Value::Array(all) => waiting.extend(all),
            _ => {}
        }
    }
    let pieces = [
        "nan", "inf", "1e308", "1e-308", "-1", "0", "[[", "]]", " = ", "mm", "\\x0a[",
    ];
    words.extend(pieces.map(String::from));
    words.iter().map(|w| format!("\"{w}\"\n")).collect()
}
