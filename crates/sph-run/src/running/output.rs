//! Fields for ParaView, pictures and the curves of probes.

use std::path::{Path, PathBuf};

use sph_core::fields;
use sph_io::{ColourMap, FieldData, Frame, IoError, Picture, PvdSeries, View};
use sph_probes::{SURFACE_DISTANCE, surface_distance};
use sph_scene::Scene;
use sph_setup::Probes;
use sph_solver::Flow;

use crate::failure::bad_pictures;
use crate::failure::error::RunError;
use crate::running::colours::Colours;
use crate::running::drawn_flow::{column_of, drawn_walls};
use crate::running::pieces::{own_particles, particles, points, walls};

/// All columns of the state in which a run failed.
pub const BAD_STATE: &str = "bad_state.vtu";

/// Folders of numbered files.
const FOLDERS: [&str; 3] = ["pictures", "fields", "curves"];

/// Whether outputs show how far particles are from the surface, which is found from lists and contacts.
pub(crate) fn shows_depths(scene: &Scene) -> bool {
    let mut shown = scene.output.fields.iter().chain(&scene.output.picture);
    shown.any(|name| name == SURFACE_DISTANCE.name)
}

/// Writes frames, pictures and curves into a run's folder.
pub struct Outputs {
    folder: PathBuf,
    series: Option<PvdSeries>,
    fields: Vec<String>,
    pictures: Vec<String>,
    pub(crate) colours: Colours,
    title: String,
    /// Names of the phases, for pictures of them.
    phases: Vec<String>,
    /// Pictures per second of animations.
    animation: Option<f64>,
    /// Outputs written so far, for the names of pictures.
    pub written: usize,
}

impl Outputs {
    /// Starts anew, or goes on after `written` outputs. With `changed_at` the scene's outputs may be others than before:
    /// the list of fields goes on with what there is of it until that time, s, or begins there.
    pub(crate) fn open<const D: usize>(
        scene: &Scene,
        probes: &Probes<D>,
        folder: &Path,
        written: Option<usize>,
        changed_at: Option<f64>,
        colours: Colours,
    ) -> Result<Self, IoError> {
        if written.is_none() {
            forget_earlier_run(folder);
        }
        // A failure that was is not one that is.
        for name in [BAD_STATE, bad_pictures::WHOLE, bad_pictures::NEAR] {
            let _ = std::fs::remove_file(folder.join(name));
        }
        let path = folder.join("fields.pvd");
        let series = match (scene.output.vtk, written, changed_at) {
            (false, ..) => None,
            (true, None, _) => Some(PvdSeries::create(path)?),
            (true, _, Some(time)) => Some(PvdSeries::open_until(path, time)?),
            (true, Some(frames), None) => Some(PvdSeries::open_at(path, frames)?),
        };
        let curves = || probes.iter().filter_map(|(_, p)| p.as_curves());
        let drawn = curves().any(|c| c.drawn_column().is_some());
        if drawn || !scene.output.picture.is_empty() {
            sph_io::writable(folder.join("pictures"))?;
        }
        if curves().next().is_some() {
            sph_io::writable(folder.join("curves"))?;
        }
        Ok(Outputs {
            folder: folder.to_path_buf(),
            series,
            fields: scene.output.fields.clone(),
            pictures: scene.output.picture.clone(),
            colours,
            title: scene.title.clone(),
            phases: scene.phase.keys().cloned().collect(),
            animation: scene.output.pictures_per_second(),
            written: written.unwrap_or(0),
        })
    }

    /// Writes everything the scene asks for at the flow's present time; `among` has this process' part of it and the number of
    /// ranks, where these write frames together. Tells what changes in the pictures.
    pub fn write<const D: usize>(
        &mut self,
        flow: &Flow<D>,
        probes: &Probes<D>,
        among: Option<(&Flow<D>, usize)>,
    ) -> Result<Vec<String>, RunError> {
        let mut remarks = Vec::new();
        let points = points(flow)?;
        // No column: nobody but an output has a use for it.
        let depth = SURFACE_DISTANCE;
        let asked = self.fields.iter().chain(&self.pictures);
        let depths = match asked.into_iter().any(|name| name == depth.name) {
            true => surface_distance(&flow.world)?,
            false => Vec::new(),
        };
        self.write_frame(flow, (&points, &depths), among)?;
        for name in &self.pictures {
            let drawn = match name == depth.name {
                true => Some(("surface distance [m]".to_string(), depths.clone())),
                false => column_of(flow, name),
            };
            let Some(drawn) = drawn else { continue };
            let file = format!("pictures/{name}_{:04}.png", self.written);
            let classes = match name == fields::PHASE.name {
                true => &self.phases[..],
                false => &[],
            };
            let range = match classes {
                [] => self.colours.range(name, &drawn.1),
                _ => (None, None),
            };
            remarks.extend(range.1);
            picture(
                flow,
                (&points, classes),
                drawn,
                range.0,
                &self.title,
                &self.folder.join(file),
            )?;
        }
        for (name, probe) in probes {
            let Some(curves) = probe.as_curves() else {
                continue;
            };
            let columns = curves.curve_columns();
            let rows = curves.curves(&flow.world)?;
            let table = columns.iter().map(|c| (&c.suffix, c.unit));
            let file = format!("curves/{name}_{:04}.csv", self.written);
            sph_io::write_table(self.folder.join(file), table, &rows)?;
            if let Some(drawn) = curves.drawn_column() {
                let label = format!("{} [{}]", columns[drawn].suffix, columns[drawn].unit);
                let file = format!("pictures/{name}_{:04}.png", self.written);
                let values: Vec<f64> = rows.iter().map(|row| row[drawn]).collect();
                let (range, told) = self.colours.range(name, &values);
                remarks.extend(told);
                map(
                    flow,
                    &rows,
                    (&label, &values),
                    range,
                    &self.title,
                    &self.folder.join(file),
                )?;
            }
        }
        self.written += 1;
        Ok(remarks)
    }

    /// Adds a frame for ParaView; `depths` are distances to the surface, if these are asked for.
    fn write_frame<const D: usize>(
        &mut self,
        flow: &Flow<D>,
        (points, depths): (&[[f64; 3]], &[f64]),
        among: Option<(&Flow<D>, usize)>,
    ) -> Result<(), RunError> {
        let Some(series) = &mut self.series else {
            return Ok(());
        };
        let wanted = |name: &str| self.fields.iter().any(|f| f == name);
        let mut fluid = match among {
            Some((part, _)) => own_particles(part, wanted)?,
            None => particles(&flow.world.free, points, wanted),
        };
        let depth = SURFACE_DISTANCE;
        if wanted(depth.name) {
            let field = FieldData::scalar(depth.name, depth.unit, depths);
            fluid.fields.push(field);
        }
        let mut pieces = vec![fluid];
        pieces.extend(walls(&flow.world));
        let frame = Frame {
            time: flow.world.time,
            index: self.written,
            pieces,
        };
        series.write_among(&frame, among.map_or(1, |(_, ranks)| ranks))?;
        Ok(())
    }

    /// Joins the pictures of every field to a film, unless the scene wants none.
    pub fn animate(&self) -> Result<(), IoError> {
        let Some(speed) = self.animation else {
            return Ok(());
        };
        for name in &self.pictures {
            let file = |k| self.folder.join(format!("pictures/{name}_{k:04}.png"));
            // A scene that was changed on the way may have drawn other fields before.
            sph_io::write_film(&self.folder, name, (0..self.written).map(file), speed)?;
        }
        Ok(())
    }
}

/// Removes the numbered files of an earlier run, which would pass for this one's.
fn forget_earlier_run(folder: &Path) {
    let numbered = |path: &Path| {
        let stem = path
            .file_stem()
            .and_then(|s| s.to_str())
            .unwrap_or_default();
        let kind = path
            .extension()
            .and_then(|e| e.to_str())
            .unwrap_or_default();
        // The share of a rank has its number behind that of the frame.
        let (before, last) = stem.rsplit_once('_').unwrap_or_default();
        let rank = last.strip_prefix('r').is_some_and(is_number);
        let number = match rank {
            true => before.rsplit_once('_').map_or("", |(_, n)| n),
            false => last,
        };
        matches!(kind, "png" | "vtu" | "pvtu" | "csv") && number.len() >= 4 && is_number(number)
    };
    let _ = std::fs::remove_dir_all(folder.join("animations"));
    for sub in FOLDERS {
        let entries = std::fs::read_dir(folder.join(sub))
            .into_iter()
            .flatten()
            .flatten();
        for path in entries.map(|e| e.path()).filter(|p| numbered(p)) {
            // A file that cannot go is overwritten or stays; the run does not depend on it.
            let _ = std::fs::remove_file(path);
        }
    }
}

fn is_number(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit())
}

/// A frame of all columns, for the state in which a run failed.
pub fn write_everything<const D: usize>(flow: &Flow<D>, path: &Path) -> Result<(), RunError> {
    let points = points(flow)?;
    let piece = particles(&flow.world.free, &points, |_| true);
    sph_io::write_vtu(path, &piece, flow.world.time)?;
    Ok(())
}

/// Values of a probe's table as a map over its first two columns.
fn map<const D: usize>(
    flow: &Flow<D>,
    rows: &[Vec<f64>],
    (label, values): (&str, &[f64]),
    range: Option<[f64; 2]>,
    title: &str,
    path: &Path,
) -> Result<(), RunError> {
    let world = &flow.world;
    let points: Vec<[f64; 3]> = rows.iter().map(|row| [row[0], row[1], 0.0]).collect();
    // Cells are as wide as the nearest ones are apart.
    let apart = |[a, b]: [&[f64; 3]; 2]| (a[0] - b[0]).abs() + (a[1] - b[1]).abs();
    let pairs = points.windows(2).map(|pair| apart([&pair[0], &pair[1]]));
    let diameter = pairs.fold(f64::INFINITY, f64::min);
    let picture = Picture {
        title,
        time: Some(world.time),
        label,
        diameter: if diameter.is_finite() {
            diameter
        } else {
            world.spacing
        },
        view: View::Plane,
        range,
        colours: ColourMap::Viridis,
        ..Picture::of(&points, values)
    };
    Ok(picture.save(path)?)
}

fn picture<const D: usize>(
    flow: &Flow<D>,
    (points, classes): (&[[f64; 3]], &[String]),
    (label, values): (String, Vec<f64>),
    range: Option<[f64; 2]>,
    title: &str,
    path: &Path,
) -> Result<(), RunError> {
    let world = &flow.world;
    let walls = drawn_walls(world);
    let picture = Picture {
        title,
        time: Some(world.time),
        label: &label,
        diameter: world.spacing,
        walls: &walls,
        classes,
        view: if D == 2 { View::Plane } else { View::Above },
        range,
        colours: ColourMap::Viridis,
        ..Picture::of(points, &values)
    };
    Ok(picture.save(path)?)
}
