//! `sph scenes`.

use serde_json::{Value as Json, json};
use sph_scene::{Scene, load, parse};

use crate::arguments::JsonArguments;
use crate::console;
use crate::layout::{columns, paragraph};
use crate::shipped::{self, Shipped};
use crate::trouble::Trouble;

/// Lists the shipped scenes.
pub fn command(arguments: &JsonArguments) -> Result<(), Trouble> {
    let all = shipped::all();
    match arguments.json {
        true => console::json(&all.iter().map(entry).collect()),
        false => console::out(&text(&all)),
    }
    Ok(())
}

fn read(shipped: &Shipped) -> Result<Scene, String> {
    match (&shipped.file, shipped.text) {
        (Some(file), _) => load(file, &[]).map(|l| l.scene).map_err(|e| e.to_string()),
        (None, text) => {
            let name = format!("{}.toml", shipped.name);
            let parsed = parse(text.unwrap_or_default(), &name, &[]);
            parsed.map(|l| l.scene).map_err(|e| e.to_string())
        }
    }
}

/// The first sentence of a description.
fn sentence(scene: &Scene) -> String {
    let words = scene.description.as_deref().unwrap_or_default();
    let words = words.split_whitespace().collect::<Vec<_>>().join(" ");
    match words.split_once(". ") {
        Some((first, _)) => format!("{first}."),
        None => words,
    }
}

fn entry(shipped: &Shipped) -> Json {
    let file = shipped.file.as_ref().map(|f| f.display().to_string());
    match read(shipped) {
        Ok(scene) => json!({
            "name": shipped.name, "file": file, "title": scene.title,
            "description": scene.description, "dimension": scene.dimension,
        }),
        Err(problem) => json!({ "name": shipped.name, "file": file, "problem": problem }),
    }
}

fn text(all: &[Shipped]) -> String {
    let mut text = String::new();
    for shipped in all {
        let (title, sentence) = match read(shipped) {
            Ok(scene) => (scene.title.clone(), sentence(&scene)),
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
