//! `sph scenes` and `sph schema`.

mod gallery;

use serde_json::{Value as Json, json};
use sph_scene::{Source, read_text};

use crate::scene_file::AnyScene;
use crate::shipped::{Content, Shipped};
use crate::terminal::{Trouble, columns, console, diagnostics};
use crate::{scene_file, shipped};
use gallery::{GALLERY, Gallery};

pub fn command(markdown: bool, json: bool) -> Result<(), Trouble> {
    let gallery = &*GALLERY;
    if markdown {
        console::out(&gallery::markdown(gallery));
        return Ok(());
    }
    let all = shipped::all();
    match json {
        true => console::json(&all.iter().map(|s| entry(gallery, s)).collect()),
        false => console::out(&text(gallery, &all)),
    }
    Ok(())
}

/// Prints the JSON schema of scenes with all plugins of this binary.
pub fn schema(grains: bool) -> Result<(), Trouble> {
    console::json(&match grains {
        true => dem_pfv::scene::editor_schema(),
        false => sph_scene::schema(),
    });
    Ok(())
}

fn read(shipped: &Shipped) -> Result<AnyScene, String> {
    let (text, file) = match &shipped.content {
        Content::File(file) => (read_text(file)?, file.display().to_string()),
        Content::CompiledIn(text) => ((*text).to_string(), format!("{}.toml", shipped.name)),
    };
    scene_file::read(Source::new(&text, &file, &[])).map_err(|trouble| match trouble {
        Trouble::Scene(all) => diagnostics::render(&all, false),
        _ => "cannot be read".into(),
    })
}

fn entry(gallery: &Gallery, shipped: &Shipped) -> Json {
    let file = match &shipped.content {
        Content::File(file) => Some(file.display().to_string()),
        Content::CompiledIn(_) => None,
    };
    let mut all = json!({ "name": shipped.name, "file": file });
    match read(shipped) {
        Ok(scene) => {
            let (title, description, dimension) = scene.card();
            all["title"] = json!(title);
            all["description"] = json!(description);
            all["dimension"] = json!(dimension);
        }
        Err(problem) => all["problem"] = json!(problem),
    }
    if let Some((theme, entry)) = gallery.find(&shipped.name) {
        all["theme"] = json!(theme.title);
        all["shows"] = json!(entry.shows);
        all["time"] = json!(entry.scenes[&shipped.name]);
    }
    all
}

fn text(gallery: &Gallery, all: &[Shipped]) -> String {
    let row = |shipped: &Shipped| {
        let found = gallery.find(&shipped.name).map(|(_, entry)| entry);
        let time = found.map(|entry| entry.scenes[&shipped.name].clone());
        let told = match (read(shipped), found) {
            (Err(_), _) => format!("has mistakes: `sph check {}` lists them", shipped.name),
            (Ok(_), Some(entry)) => entry.shows.clone(),
            (Ok(scene), None) => scene.card().0.to_string(),
        };
        vec![shipped.name.clone(), time.unwrap_or_default(), told]
    };
    let block = |title: &str, scenes: Vec<&Shipped>| {
        let rows = columns(2, scenes.into_iter().map(row));
        match rows.as_str() {
            "" => rows,
            rows => format!("{title}\n{rows}\n"),
        }
    };
    let of = |theme: &str| {
        let own = |s: &&Shipped| gallery.find(&s.name).map_or("", |(t, _)| &t.title) == theme;
        all.iter().filter(own).collect()
    };
    let themes = gallery.theme.iter().map(|t| block(&t.title, of(&t.title)));
    let text = themes.collect::<String>() + &block("Others", of(""));
    if text.is_empty() {
        return "there is no scene in ./scenes, and none was compiled in\n".into();
    }
    let start = columns(2, gallery.start.iter().map(|start| start.to_vec()));
    let times = &gallery.times;
    format!("{text}Start here\n{start}\nsph run NAME runs one of them. {times}\n")
}
