//! `sph check`.

use std::path::Path;
use std::time::Duration;

use serde::Serialize;
use serde_json::json;
use sph_particles::setup::Examination;
use sph_particles::{ZoneSize, draw_scene, examine_and_try};

use crate::arguments::CheckArguments;
use crate::commands::{draw, grains, mesh};
use crate::number;
use crate::scene_file::{AnyScene, OpenScene, open};
use crate::terminal::layout::{memory, row, sections};
use crate::terminal::output::CommandOutput;
use crate::terminal::trouble::Trouble;

/// Above this Mach number the fluid is not nearly incompressible; the default is on it, but for rounding.
const MACH: f64 = 0.1 * (1.0 + 1e-9);
/// Time that the first steps of a scene may take, for an estimate of all of them.
const TRIAL: Duration = Duration::from_secs(2);

/// Lists sizes, costs and remarks of a scene, without running it.
pub fn command(arguments: &CheckArguments) -> Result<(), Trouble> {
    let picture = arguments.picture.as_deref();
    let picture = picture
        .map(|out| draw::picture("picture", out, &["png"]))
        .transpose()?;
    if mesh::is_mesh(&arguments.scene.scene) {
        if picture.is_some() {
            return Err(Trouble::usage("--picture: it draws scenes, no meshes"));
        }
        mesh::output(&arguments.scene.scene)?.print(arguments.json);
        return Ok(());
    }
    let opened = open(&arguments.scene)?;
    let drawn = picture.map(|path| drawn(&opened, path)).transpose()?;
    let mut told = output(&opened, arguments.threads.map(usize::from))?;
    if let Some(path) = drawn {
        told.text
            .push_str(&format!("\npicture\n  {}\n", path.display()));
        told.json["picture"] = json!(path);
    }
    told.print(arguments.json);
    Ok(())
}

/// Draws the scene before any run.
fn drawn<'a>(opened: &OpenScene, path: &'a Path) -> Result<&'a Path, Trouble> {
    let AnyScene::Particles(loaded) = &opened.scene else {
        let text = "--picture: grains have no place before they are prepared; `output.picture` of a run draws them";
        return Err(Trouble::usage(text));
    };
    draw_scene(&loaded.scene, path).map_err(|e| Trouble::in_scene(e, &loaded.source))?;
    Ok(path)
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
    let too_fast = too_fast(&examined);
    examined.warnings.extend(too_fast);
    // Threads beyond the cores of this machine are taken to share a step evenly.
    let share = on as f64 / threads as f64;
    let (mut hours, mut without_zones) = (None, None);
    let time = match tried {
        Ok(Some(trial)) => {
            let steps = (loaded.scene.run.end / trial.dt).ceil();
            examined.estimate.steps = steps;
            without_zones = trial.without_zones;
            hours = Some(steps * trial.seconds * share / 3600.0);
            let time = number::duration(steps * trial.seconds * share);
            let first = number::count(trial.steps as f64);
            format!("about {time} on {threads} threads, by {first} of its first steps on {on}")
                .replace(" 1 threads", " 1 thread")
        }
        Ok(None) => "that of a few steps".into(),
        Err(why) => {
            examined
                .warnings
                .push(format!("the run fails in its first steps: {why}"));
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
        format!(
            "the Mach number of `{phase}` is {}, above 0.1: density will vary by about {} ; \
             raise `phase.{phase}.speed_of_sound`, or check `velocity_scale`",
            number::plain(*value),
            number::percent(value * value)
        )
        .replace(" ;", ";")
    };
    machs.map(remark).collect()
}

fn text(e: &Examination, file: &str, time: &str, alternatives: Option<&Alternatives>) -> String {
    let mut text = format!(
        "{}\n{file} is a good scene in {} dimensions\n",
        e.scene, e.dimension
    );
    let size = [
        row("particles", number::count(e.particles as f64)),
        row("wall points", number::count(e.wall_points as f64)),
        row("wall elements", number::count(e.wall_elements as f64)),
        row("neighbours of a particle", format!("{:.1}", e.neighbours)),
        row(
            "bytes per particle",
            format!(
                "{:.0}, of these {} in {} columns",
                e.memory.total() / e.particles.max(1) as f64,
                e.bytes_per_particle,
                e.fields.len()
            ),
        ),
    ];
    let derived = e.derived.iter().map(|(name, value, unit)| {
        let unit = if unit == "1" { "" } else { unit.as_str() };
        row(name, format!("{} {unit}", number::plain(*value)))
    });
    let limits = e
        .step_limits
        .iter()
        .map(|(name, dt)| row(name, seconds(*dt)));
    let zones = e.zones.iter().map(zone_row);
    let estimate = estimate_rows(e, time, alternatives);
    let percent = |part: f64| format!("{:.2} %", 100.0 * part);
    let relaxation = e.relaxation.iter().flat_map(|r| {
        [
            row("steps", number::count(r.steps as f64)),
            row(
                "largest error",
                format!("{} → {}", percent(r.largest_before), percent(r.largest)),
            ),
            row(
                "rms error",
                format!("{} → {}", percent(r.rms_before), percent(r.rms)),
            ),
            row(
                "particles away from surfaces",
                number::count(r.counted as f64),
            ),
        ]
    });
    let relaxation: Vec<_> = relaxation.collect();
    let parts = [
        ("size", size.to_vec()),
        ("zones", zones.collect()),
        ("derived", derived.collect()),
        ("largest stable time step at the start", limits.collect()),
        ("relaxed density", relaxation),
        ("estimate", estimate),
    ];
    text.push_str(&sections(parts, &e.warnings));
    text
}

/// Particles of a zone.
fn zone_row(zone: &ZoneSize) -> Vec<String> {
    let particles = number::count(zone.particles as f64);
    let spacing = number::plain(zone.spacing);
    let dry = match zone.particles {
        0 => ": dry at the start, of which the estimate is",
        _ => "",
    };
    row(
        &zone.name,
        format!("{particles} particles of {spacing} m{dry}"),
    )
}

/// Steps, times, memory and disk.
fn estimate_rows(
    e: &Examination,
    time: &str,
    alternatives: Option<&Alternatives>,
) -> Vec<Vec<String>> {
    let cost = &e.estimate;
    let mut rows = vec![
        row("steps", number::count(cost.steps)),
        row("wall time", time),
    ];
    if let Some(a) = alternatives {
        let without = number::duration(3600.0 * a.hours_without_zones);
        let finest = number::duration(3600.0 * a.hours_of_finest);
        let particles = number::count(a.particles_of_finest);
        rows.extend([
            row("without zones", format!("about {without}")),
            row(
                &format!("{} m everywhere", number::plain(a.finest)),
                format!("about {finest}, {particles} particles"),
            ),
        ]);
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
