//! `sph scenes`.

mod page;

use serde_json::{Value as Json, json};
use sph_scene::{Source, read_text};

use crate::arguments::ScenesArguments;
use crate::gallery::{GALLERY, Gallery};
use crate::scene_file::{self, AnyScene};
use crate::shipped::{self, Content, Shipped};
use crate::terminal::layout::columns;
use crate::terminal::trouble::Trouble;
use crate::terminal::{console, diagnostics};

/// Lists the shipped scenes.
pub fn command(arguments: &ScenesArguments) -> Result<(), Trouble> {
    let gallery = &*GALLERY;
    if arguments.markdown {
        console::out(&page::markdown(gallery));
        return Ok(());
    }
    let all = shipped::all();
    match arguments.json {
        true => console::json(&all.iter().map(|s| entry(gallery, s)).collect()),
        false => console::out(&text(gallery, &all)),
    }
    Ok(())
}

fn read(shipped: &Shipped) -> Result<AnyScene, String> {
    let (text, file) = match &shipped.content {
        Content::File(file) => (read_text(file)?, file.display().to_string()),
        Content::CompiledIn(text) => ((*text).to_string(), format!("{}.toml", shipped.name)),
    };
    let scene = scene_file::read(Source::new(&text, &file, &[]));
    scene.map_err(|trouble| match trouble {
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
        let rows: Vec<_> = scenes.into_iter().map(row).collect();
        match rows.is_empty() {
            true => String::new(),
            false => format!("{title}\n{}\n", columns(2, &rows)),
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
    let start = gallery.start.iter().map(|start| start.to_vec());
    let start = columns(2, &start.collect::<Vec<_>>());
    format!(
        "{text}Start here\n{start}\nsph run NAME runs one of them. {}\n",
        gallery.times
    )
}
