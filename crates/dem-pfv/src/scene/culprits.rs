//! Names in the scene of the grains and walls that a refusal numbers.

use crate::grains::{GrainError, Partner};
use crate::scene::error::DemError;
use crate::scene::names::planes;
use crate::scene::read::Loaded;

/// A refusal at the start with the names of its walls, and with the lines of its grains if they come from a file.
pub fn at_start(loaded: &Loaded, error: GrainError) -> DemError {
    let file = loaded.scene.start.file.as_ref();
    let message = format!("{error}{}", named(loaded, &error));
    DemError::at(file.map_or("start", |_| "start.file"), message)
}

/// The names of the walls and the lines of the grains that an error numbers, in brackets; empty if it has none.
pub fn named(loaded: &Loaded, error: &GrainError) -> String {
    let mut names = Vec::new();
    if let GrainError::InWall { wall, .. }
    | GrainError::BadWall(wall, _)
    | GrainError::TooDeep {
        body: Partner::Wall(wall),
        ..
    } = error
        && let Some(name) = planes(&loaded.scene).get(*wall)
    {
        names.push(format!("wall {wall} is `{name}`"));
    }
    if let Some(file) = &loaded.scene.start.file {
        for grain in error.grains() {
            if let Some(line) = line(loaded, file, grain) {
                names.push(format!("grain {grain} is line {line} of `{file}`"));
            }
        }
    }
    match names.is_empty() {
        true => String::new(),
        false => format!(" ({})", names.join(", ")),
    }
}

/// Line of the file in which a grain stands, from 1.
fn line(loaded: &Loaded, file: &str, grain: usize) -> Option<usize> {
    let path = loaded.source.resolve("start.file", file).ok()?;
    let text = scene_text::read_text(&path).ok()?;
    rows(&text).nth(grain).map(|(line, _)| line)
}

/// Rows of a file of spheres with the numbers of their lines, from 1; without comments and empty lines.
pub fn rows(text: &str) -> impl Iterator<Item = (usize, &str)> {
    text.lines().enumerate().filter_map(|(line, row)| {
        let row = row.split('#').next().unwrap_or_default().trim();
        (!row.is_empty()).then_some((line + 1, row))
    })
}
