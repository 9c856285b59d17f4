//! `sph check`.

use std::path::Path;
use std::time::Duration;

use serde::Serialize;
use serde_json::json;
use sph_core::number;
use sph_particles::setup::Examination;
use sph_particles::{ZoneSize, draw_scene, examine_and_try};

use crate::arguments::CheckArguments;
use crate::commands::draw::picture;
use crate::commands::outcome::wall_time;
use crate::commands::{grains, mesh};
use crate::scene_file::{AnyScene, OpenScene, open};
use crate::terminal::{CommandOutput, Rows, Trouble, memory, quantities, row, sections};

/// Above this Mach number the fluid is not nearly incompressible; the default is on it, but for rounding.
const MACH: f64 = 0.1 * (1.0 + 1e-9);
/// Time that the first steps of a scene may take, for an estimate of all of them.
const TRIAL: Duration = Duration::from_secs(2);

pub fn command(arguments: &CheckArguments) -> Result<(), Trouble> {
    let file = arguments.picture.as_deref();
    let picture = file.map(|out| picture("picture", out, &["png"]));
    let picture = picture.transpose()?;
    if mesh::is_mesh(&arguments.scene.scene) {
        if picture.is_some() {
            return Err(Trouble::usage("--picture: it draws scenes, no meshes"));
        }
        mesh::output(&arguments.scene.scene)?.print(arguments.json);
        return Ok(());
    }
    let opened = open(&arguments.scene)?;
    if let Some(path) = picture {
        draw(&opened, path)?;
    }
    let mut told = output(&opened, arguments.threads.map(usize::from))?;
    if let Some(path) = picture {
        told.text
            .push_str(&format!("\npicture\n  {}\n", path.display()));
        told.json["picture"] = json!(path);
    }
    told.print(arguments.json);
    Ok(())
}

fn draw(opened: &OpenScene, path: &Path) -> Result<(), Trouble> {
    let AnyScene::Particles(loaded) = &opened.scene else {
        let text = "--picture: grains have no place before they are prepared; `output.picture` of a run draws them";
        return Err(Trouble::usage(text));
    };
    draw_scene(&loaded.scene, path).map_err(|e| Trouble::in_scene(e, &loaded.source))
}

/// Derived quantities of a scene, for a number of threads.
pub fn output(opened: &OpenScene, threads: Option<usize>) -> Result<CommandOutput, Trouble> {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let threads = threads.unwrap_or(cores);
    let loaded = match &opened.scene {
        AnyScene::Particles(loaded) => loaded,
        AnyScene::Grains(loaded) => return grains::check(loaded, &opened.shown),
    };
    let on = threads.min(cores);
    let examined = examine_and_try(&loaded.scene, on, TRIAL);
    let (mut examined, tried) = examined.map_err(|e| Trouble::in_scene(e, &loaded.source))?;
    examined.warnings.extend(too_fast(&examined));
    // Threads beyond the cores of this machine are taken to share a step evenly.
    let share = on as f64 / threads as f64;
    let (mut hours, mut without_zones) = (None, None);
    let time = match tried {
        Ok(Some(trial)) => {
            let steps = (loaded.scene.run.end / trial.dt).ceil();
            examined.estimate.steps = steps;
            without_zones = trial.without_zones;
            let seconds = steps * trial.seconds * share;
            hours = Some(seconds / 3600.0);
            let time = wall_time(seconds, threads);
            let first = number::count(trial.steps as f64);
            format!("about {time}, by {first} of its first steps on {on}")
        }
        Ok(None) => "that of a few steps".into(),
        Err(why) => {
            let warning = format!("the run fails in its first steps: {why}");
            examined.warnings.push(warning);
            "not known: the first steps fail".into()
        }
    };
    let alternatives = without_zones.map(|pace| {
        let hours = pace * loaded.scene.run.end * share / 3600.0;
        Alternatives::new(&examined, loaded.scene.numerics.spacing, hours)
    });
    let text = text(&examined, &opened.shown, &time, alternatives.as_ref());
    let mut told = CommandOutput::new(&examined, text);
    told.json["threads"] = json!(threads);
    told.json["estimate"]["hours"] = json!(hours);
    if let Some(alternatives) = &alternatives {
        told.json["estimate"]["alternatives"] = json!(alternatives);
    }
    Ok(told)
}

/// Cost of a scene with zones without these, and of its finest spacing everywhere.
#[derive(Serialize)]
struct Alternatives {
    /// Wall-clock time without zones, h.
    hours_without_zones: f64,
    /// The finest spacing, m.
    finest: f64,
    /// Particles of that spacing everywhere.
    particles_of_finest: f64,
    /// Wall-clock time with these, h: particles and steps in proportion.
    hours_of_finest: f64,
}

impl Alternatives {
    /// Of a scene with a spacing, m, that takes `hours` without its zones.
    fn new(examined: &Examination, spacing: f64, hours: f64) -> Self {
        let spacings = examined.zones.iter().map(|zone| zone.spacing);
        let finest = spacings.fold(spacing, f64::min);
        let finer = (spacing / finest).powi(examined.dimension as i32);
        Alternatives {
            hours_without_zones: hours,
            finest,
            particles_of_finest: examined.particles as f64 * finer,
            hours_of_finest: hours * finer * spacing / finest,
        }
    }
}

/// A remark for every phase whose speed comes too near to that of sound.
fn too_fast(examined: &Examination) -> Vec<String> {
    let machs = examined.derived.iter();
    let machs = machs.filter(|(name, value, _)| name.contains("Mach number") && *value > MACH);
    let remark = |(name, value, _): &(String, f64, String)| {
        let phase = name.split(':').next().unwrap_or_default();
        let (mach, change) = (number::plain(*value), number::percent(value * value));
        format!(
            "the Mach number of `{phase}` is {mach}, above 0.1: density will vary by about {change}; \
             raise `phase.{phase}.speed_of_sound`, or check `velocity_scale`"
        )
    };
    machs.map(remark).collect()
}

fn text(e: &Examination, file: &str, time: &str, alternatives: Option<&Alternatives>) -> String {
    let count = |n: usize| number::count(n as f64);
    let bytes = e.memory.total() / e.particles.max(1) as f64;
    let (own, columns) = (e.bytes_per_particle, e.fields.len());
    let bytes = format!("{bytes:.0}, of these {own} in {columns} columns");
    let size = vec![
        row("particles", count(e.particles)),
        row("wall points", count(e.wall_points)),
        row("wall elements", count(e.wall_elements)),
        row("neighbours of a particle", format!("{:.1}", e.neighbours)),
        row("bytes per particle", bytes),
    ];
    let limits = e.step_limits.iter();
    let limits = limits.map(|(name, dt)| row(name, seconds(*dt)));
    let change = |a: f64, b: f64| format!("{:.2} % → {:.2} %", 100.0 * a, 100.0 * b);
    let relaxation = e.relaxation.iter().flat_map(|r| {
        [
            row("steps", count(r.steps)),
            row("largest error", change(r.largest_before, r.largest)),
            row("rms error", change(r.rms_before, r.rms)),
            row("particles away from surfaces", count(r.counted)),
        ]
    });
    let parts = [
        ("size", size),
        ("zones", e.zones.iter().map(zone_row).collect()),
        ("derived", quantities(&e.derived)),
        ("largest stable time step at the start", limits.collect()),
        ("relaxed density", relaxation.collect()),
        ("estimate", estimate_rows(e, time, alternatives)),
    ];
    let (scene, dimension) = (&e.scene, e.dimension);
    format!("{scene}\n{file} is a good scene in {dimension} dimensions\n")
        + &sections(parts, &e.warnings)
}

fn zone_row(zone: &ZoneSize) -> Vec<String> {
    let particles = number::count(zone.particles as f64);
    let spacing = number::plain(zone.spacing);
    let dry = match zone.particles {
        0 => ": dry at the start, of which the estimate is",
        _ => "",
    };
    let size = format!("{particles} particles of {spacing} m{dry}");
    row(&zone.name, size)
}

fn estimate_rows(e: &Examination, time: &str, alternatives: Option<&Alternatives>) -> Rows {
    let cost = &e.estimate;
    let mut rows = vec![
        row("steps", number::count(cost.steps)),
        row("wall time", time),
    ];
    if let Some(a) = alternatives {
        let [without, finest] = [a.hours_without_zones, a.hours_of_finest]
            .map(|hours| format!("about {}", number::duration(3600.0 * hours)));
        let particles = number::count(a.particles_of_finest);
        let everywhere = format!("{} m everywhere", number::plain(a.finest));
        rows.push(row("without zones", without));
        rows.push(row(&everywhere, format!("{finest}, {particles} particles")));
    }
    rows.extend([
        row("memory", format!("about {}", memory(&e.memory))),
        row("disk", format!("about {}", number::bytes(cost.disk_bytes))),
    ]);
    rows
}

/// A step limit; one that does not bind is infinite.
fn seconds(dt: f64) -> String {
    match dt.is_finite() {
        true => format!("{} s", number::plain(dt)),
        false => "none".into(),
    }
}
