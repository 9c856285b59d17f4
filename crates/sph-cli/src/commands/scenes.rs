//! `sph scenes`.

use serde_json::{Value as Json, json};
use sph_scene::{Source, read_text};

use crate::arguments::JsonArguments;
use crate::scene_file::{self, AnyScene};
use crate::shipped::{self, Shipped};
use crate::telling::layout::{columns, paragraph};
use crate::telling::trouble::Trouble;
use crate::telling::{console, diagnostics};

/// Lists the shipped scenes.
pub fn command(arguments: &JsonArguments) -> Result<(), Trouble> {
    let all = shipped::all();
    match arguments.json {
        true => console::json(&all.iter().map(entry).collect()),
        false => console::out(&text(&all)),
    }
    Ok(())
}

fn read(shipped: &Shipped) -> Result<AnyScene, String> {
    let (text, file) = match (&shipped.file, shipped.text) {
        (Some(file), _) => (read_text(file)?, file.display().to_string()),
        (None, text) => {
            let name = format!("{}.toml", shipped.name);
            (text.unwrap_or_default().to_string(), name)
        }
    };
    let scene = scene_file::read(Source::new(&text, &file, &[]));
    scene.map_err(|trouble| match trouble {
        Trouble::Scene(all) => diagnostics::render(&all, false),
        _ => "cannot be read".into(),
    })
}

/// The first sentence of a description.
fn sentence(description: Option<&str>) -> String {
    let words = description.unwrap_or_default();
    let words = words.split_whitespace().collect::<Vec<_>>().join(" ");
    match words.split_once(". ") {
        Some((first, _)) => format!("{first}."),
        None => words,
    }
}

fn entry(shipped: &Shipped) -> Json {
    let file = shipped.file.as_ref().map(|f| f.display().to_string());
    match read(shipped) {
        Ok(scene) => {
            let (title, description, dimension) = scene.card();
            json!({
                "name": shipped.name, "file": file, "title": title,
                "description": description, "dimension": dimension,
            })
        }
        Err(problem) => json!({ "name": shipped.name, "file": file, "problem": problem }),
    }
}

fn text(all: &[Shipped]) -> String {
    let mut text = String::new();
    for shipped in all {
        let (title, sentence) = match read(shipped) {
            Ok(scene) => {
                let (title, description, _) = scene.card();
                (title.to_string(), sentence(description))
            }
            Err(_) => (
                "has mistakes".into(),
                format!("sph check {} tells them", shipped.name),
            ),
        };
        text.push_str(&columns(0, &[vec![shipped.name.clone(), title]]));
        text.push_str(&paragraph(4, 98, &sentence));
    }
    match all.is_empty() {
        true => "there is no scene in ./scenes, and none was compiled in\n".into(),
        false => format!("{text}\nsph run NAME runs one of them\n"),
    }
}
