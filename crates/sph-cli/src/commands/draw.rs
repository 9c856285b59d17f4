//! `sph draw`: streamlines, profiles along a line and tracks, from the frames of a run.

use std::path::Path;

use sph_core::parse_quantity;
use sph_io::curves::{Frames, Line};

use crate::terminal::{Trouble, console};
use crate::tool_arguments::{DrawCommand, ProfileArguments, StreamlineArguments, TrackArguments};

pub fn command(asked: &DrawCommand) -> Result<(), Trouble> {
    match asked {
        DrawCommand::Streamlines(a) => streamlines(a),
        DrawCommand::Profile(a) => profile(a),
        DrawCommand::Tracks(a) => tracks(a),
    }
}

fn streamlines(arguments: &StreamlineArguments) -> Result<(), Trouble> {
    let path = picture("out", &arguments.out, &["png"])?;
    let frames = frames(&arguments.results)?;
    let optional = |option, text: &Option<String>, unit| {
        let given = text.as_deref();
        given.map(|text| quantity(option, text, unit)).transpose()
    };
    let time = optional("time", &arguments.time, "s")?;
    let apart = optional("apart", &arguments.apart, "m")?;
    if let Some(wrong) = apart.filter(|a| *a <= 0.0) {
        return Err(format!("--apart {wrong}: expected a distance above zero").into());
    }
    let how = (apart, optional("slice", &arguments.slice, "m")?);
    let lines = sph_io::curves::draw_streamlines(&frames, time, &arguments.field, how, path)?;
    report(&format!("{lines} lines"), path);
    Ok(())
}

fn profile(arguments: &ProfileArguments) -> Result<(), Trouble> {
    let path = picture("out", &arguments.out, &["png", "svg"])?;
    let line = Line {
        from: vector("from", &arguments.from, "m")?,
        to: vector("to", &arguments.to, "m")?,
        points: arguments.points as usize,
    };
    if line.from == line.to {
        return Err(Trouble::usage("--to: the line has no length"));
    }
    let times = arguments.time.iter();
    let times = times.map(|text| quantity("time", text, "s").map(Some));
    let mut times = times.collect::<Result<Vec<_>, _>>()?;
    if times.is_empty() {
        times.push(None);
    }
    let frames = frames(&arguments.results)?;
    sph_io::curves::draw_profile(&frames, &line, &arguments.field, &times, path)?;
    report(&format!("{} profiles", times.len()), path);
    Ok(())
}

fn tracks(arguments: &TrackArguments) -> Result<(), Trouble> {
    let path = picture("out", &arguments.out, &["png"])?;
    let frames = frames(&arguments.results)?;
    let mut identities = arguments.identity.clone();
    let first = &frames.entries[0];
    if !arguments.near.is_empty() || identities.is_empty() {
        let start = frames.read(first)?;
        for text in &arguments.near {
            identities.push(sph_io::curves::nearest(&start, vector("near", text, "m")?)?);
        }
        if identities.is_empty() {
            identities = sph_io::curves::evenly(&start, arguments.count as usize)?;
        }
    }
    let tracks = sph_io::curves::tracks(&frames, &identities)?;
    sph_io::curves::draw_tracks(&frames, &tracks, &arguments.field, path)?;
    report(&format!("{} tracks", tracks.len()), path);
    Ok(())
}

fn report(what: &str, path: &Path) {
    let table = path.with_extension("csv");
    let (path, table) = (path.display(), table.display());
    console::out(&format!("{what} in {path} and {table}\n"));
}

pub fn frames(folder: &Path) -> Result<Frames, Trouble> {
    if !folder.join("fields.pvd").is_file() {
        let folder = folder.display();
        let need = "name the folder of a run that writes fields (output.vtk)";
        return Err(format!("there is no fields.pvd in {folder}: {need}").into());
    }
    Ok(Frames::from_folder(folder)?)
}

pub fn picture<'a>(option: &str, out: &'a Path, kinds: &[&str]) -> Result<&'a Path, Trouble> {
    match kinds.contains(&out.extension().and_then(|e| e.to_str()).unwrap_or_default()) {
        true => Ok(out),
        false => {
            let (out, kinds) = (out.display(), kinds.join(" or ."));
            Err(format!("--{option} {out}: it must end in .{kinds}").into())
        }
    }
}

/// The number of a quantity, in SI.
pub fn quantity(option: &str, text: &str, unit: &str) -> Result<f64, Trouble> {
    Ok(parse_quantity(text, unit).map_err(|why| format!("--{option}: {why}"))?)
}

/// Two or three components, in SI.
pub fn vector(option: &str, text: &str, unit: &str) -> Result<[f64; 3], Trouble> {
    let mut vector = [0.0; 3];
    let parts: Vec<&str> = text.split(',').collect();
    if !(2..=3).contains(&parts.len()) {
        return Err(format!("--{option} {text}: expected X,Y or X,Y,Z").into());
    }
    for (component, part) in vector.iter_mut().zip(parts) {
        *component = quantity(option, part.trim(), unit)?;
    }
    Ok(vector)
}
