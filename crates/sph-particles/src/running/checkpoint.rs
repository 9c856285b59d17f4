//! Checkpoints: all state columns, the lists' reference positions, the clocks and counters.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize, de::DeserializeOwned};
use sph_boundary::{Wall, WallStates};
use sph_core::{Inserted, Plain, Role, Vect, fields};
use sph_io::{Checkpoint, Column, ColumnData};
use sph_neighbours::WallForce;
use sph_run::{CHECKPOINT, Identity, RunOptions, Start, Watch};
use sph_scene::Scene;
use sph_solver::Flow;
use sph_solver::step::Hooked;

use crate::failure::error::{Result, RunError};
use crate::running::counters::{Counters, MOST};

const REFERENCE: &str = "list_reference";
const WALL_REFERENCE: &str = "wall_list_reference";
const WALL_STATES: &str = "wall_states";
const WALL_LIST_STATES: &str = "wall_list_states";
const WALL_LOADS: &str = "wall_loads";

/// The clock, as bits, so that nothing is lost on the way through JSON.
#[derive(Serialize, Deserialize)]
struct Clock {
    time: u64,
    dt: u64,
    list_builds: u64,
    /// Identities that were given, mass as bits and number of the particles that came in. Runs of before births were known have none.
    born: Option<(u32, u64, u64)>,
    /// Of the last build of the lists. Runs of before it was kept go on with walls where they were saved.
    list_time: Option<u64>,
}

#[derive(Serialize, Deserialize)]
struct Meta<T> {
    #[serde(flatten)]
    identity: Identity,
    dimension: usize,
    clock: Clock,
    run: T,
}

/// Writes the state of a flow with its walls; `run` is the data of the driver.
pub fn save<const D: usize, T: Serialize>(
    (flow, walls): (&Flow<D>, Option<&dyn Wall<D>>),
    path: &Path,
    identity: &Identity,
    run: &T,
) -> Result<()> {
    let world = &flow.world;
    let column = |name: &str, components, data| Column {
        name: name.into(),
        components,
        data,
    };
    let mut columns = Vec::new();
    for (name, _, role, components, values) in world.free.columns() {
        if role == Role::State {
            let data = match values {
                Plain::Real(v) => ColumnData::F64(v.into_owned()),
                Plain::Index(v) => ColumnData::U32(v.to_vec()),
            };
            columns.push(column(name, components, data));
        }
    }
    for (name, positions) in [
        (REFERENCE, &world.lists.reference),
        (WALL_REFERENCE, &world.lists.reference_points),
    ] {
        let numbers = positions.iter().flatten().copied().collect();
        columns.push(column(name, D, ColumnData::F64(numbers)));
    }
    if let Some(walls) = walls {
        let states = walls.states();
        let listed = states.listed.unwrap_or_default();
        // Steps that drift first drift with the forces of the step before.
        let loads = flow.loads.iter().flat_map(WallForce::numbers).collect();
        let all = [
            (WALL_STATES, states.now),
            (WALL_LIST_STATES, listed),
            (WALL_LOADS, loads),
        ];
        let all = all.into_iter().filter(|(_, n)| !n.is_empty());
        columns.extend(all.map(|(name, numbers)| column(name, 1, ColumnData::F64(numbers))));
    }
    let born = world.free.inserted;
    let meta = Meta {
        identity: identity.clone(),
        dimension: D,
        clock: Clock {
            time: world.time.to_bits(),
            dt: world.dt.to_bits(),
            list_builds: world.lists.builds,
            born: Some((born.identities, born.mass.to_bits(), born.particles)),
            list_time: Some(world.lists.time.to_bits()),
        },
        run,
    };
    let meta = serde_json::to_value(&meta).map_err(|e| refused(path, e.to_string()))?;
    Ok(Checkpoint { meta, columns }.save(path)?)
}

fn refused(path: &Path, reason: impl Into<String>) -> RunError {
    RunError::Resume {
        path: PathBuf::from(path),
        reason: reason.into(),
    }
}

/// Puts the flow where the run begins, and returns the counts until there.
pub fn begin<const D: usize>(
    scene: &Scene,
    options: &RunOptions,
    flow: &mut Flow<D>,
    observer: &mut Watch<'_>,
) -> Result<Counters> {
    let (start, own) = (&options.start, options.out.join(CHECKPOINT));
    let mut counters = Counters::begin();
    if start.goes_on() {
        let identity = (*start == Start::Resumed).then_some(&options.identity);
        counters = load(flow, scene, &own, identity)?;
        flow.recount(&counters.left);
        for Hooked { hook, .. } in &mut flow.hooks.all {
            if let Some(counts) = counters.works.remove(&hook.name()) {
                hook.resume(counts);
            }
        }
        let (time, step) = (flow.world.time, counters.steps);
        observer.message(&format!("resuming at t = {time:.6} s, step {step}"));
    }
    if let Start::From(other) = start {
        start_from(flow, scene, other)?;
        let (time, from) = (flow.world.time, other.display());
        observer.message(&format!("starting at t = {time:.6} s from {from}"));
        counters.started_at = Some(time.to_bits());
    }
    Ok(counters)
}

/// Puts a saved state into the assembled flow of a scene, which must be the same as before if an identity is given;
/// returns the driver's saved state. A flow that had no lists gets none.
pub fn load<const D: usize>(
    flow: &mut Flow<D>,
    scene: &Scene,
    path: &Path,
    identity: Option<&Identity>,
) -> Result<Counters> {
    let blank = flow.is_blank();
    let (checkpoint, meta) = read::<D, Counters>(path)?;
    let mut counters = meta.run;
    if let Some(why) = identity.and_then(|now| now.differs_from(&meta.identity)) {
        let why = format!(
            "{why}; restore what it was, go on from it all the same with --changed, or take its state alone \
             into another folder with --from"
        );
        return Err(refused(path, why));
    }
    believable(&meta.clock, scene, path)?;
    let time = f64::from_bits(meta.clock.time);
    if identity.is_none() {
        counters.recount(scene, time);
    }
    if let Some(why) = counters.nonsense(scene, time) {
        return Err(refused(path, why));
    }
    fill(flow, &checkpoint, &meta.clock, path)?;
    let reference: Vec<Vect<D>> = positions(&checkpoint, path, REFERENCE)?;
    let wall_reference: Vec<Vect<D>> = positions(&checkpoint, path, WALL_REFERENCE)?;
    if reference.len() != flow.world.free.len()
        || wall_reference.len() != flow.world.walls.points.position.len()
    {
        return Err(refused(path, "its number of particles is not the scene's"));
    }
    set_clock(flow, &meta.clock, &checkpoint, true, path)?;
    let list_time = meta.clock.list_time.map_or(flow.world.time, f64::from_bits);
    let world = &mut flow.world;
    match blank {
        true => world.lists_would_be_of(reference, wall_reference, list_time),
        false => world.build_lists_from(reference, wall_reference, list_time),
    }
    flow.world.lists.builds = meta.clock.list_builds;
    flow.restored = true;
    Ok(counters)
}

/// Puts the particles of another run of the same bodies, with its time, into an assembled flow of other settings.
///
/// The whole memory of the flow must be in the checkpoint; more is ignored.
pub fn start_from<const D: usize>(flow: &mut Flow<D>, scene: &Scene, path: &Path) -> Result<()> {
    let blank = flow.is_blank();
    let (checkpoint, meta) = read::<D, serde::de::IgnoredAny>(path)?;
    believable(&meta.clock, scene, path)?;
    let there = identities(&checkpoint).map_or(0, <[u32]>::len);
    let here = flow.world.free.len();
    if (there > here && flow.nursery.is_none()) || (there < here && flow.outlets.is_empty()) {
        let why = format!("it has {there} particles, the scene {here}");
        return Err(refused(path, why));
    }
    fill(flow, &checkpoint, &meta.clock, path)?;
    set_clock(flow, &meta.clock, &checkpoint, false, path)?;
    match blank {
        true => flow.world.sort()?,
        false => flow.world.rebuild_lists()?,
    }
    Ok(())
}

fn read<const D: usize, T: DeserializeOwned>(path: &Path) -> Result<(Checkpoint, Meta<T>)> {
    let checkpoint = Checkpoint::load(path)?;
    let meta: Meta<T> = serde_json::from_value(checkpoint.meta.clone())
        .map_err(|e| refused(path, format!("its header is not one of this version ({e})")))?;
    if meta.dimension != D {
        let why = format!("it has {} dimensions, the scene {D}", meta.dimension);
        return Err(refused(path, why));
    }
    Ok((checkpoint, meta))
}

/// The identities of the particles in a checkpoint, if it has them.
fn identities(checkpoint: &Checkpoint) -> Option<&[u32]> {
    match &checkpoint.column(fields::IDENTITY.name)?.data {
        ColumnData::U32(identities) => Some(identities),
        _ => None,
    }
}

/// Sets all columns that carry the state; takes out particles that left by an outlet.
fn fill<const D: usize>(
    flow: &mut Flow<D>,
    checkpoint: &Checkpoint,
    clock: &Clock,
    path: &Path,
) -> Result<()> {
    if let Some((identities, mass, particles)) = clock.born {
        let mass = f64::from_bits(mass);
        let known = flow.world.free.inserted.identities;
        let sound = identities == known || flow.nursery.is_some() && identities > known;
        if !(sound && mass >= 0.0 && mass.is_finite()) {
            return Err(refused(path, "its births are not the scene's"));
        }
        flow.world.free.inserted = Inserted {
            identities,
            mass,
            particles,
        };
    }
    let comes_or_goes = !flow.outlets.is_empty() || flow.nursery.is_some();
    if let Some(v) = identities(checkpoint).filter(|_| comes_or_goes) {
        flow.world.free.set_len(v.len());
    }
    for name in flow.state_columns() {
        let column = checkpoint.column(name);
        let column =
            column.ok_or_else(|| refused(path, format!("it lacks the column `{name}`")))?;
        match &column.data {
            ColumnData::F64(v) => flow.world.free.set_real(name, v)?,
            ColumnData::U32(v) => flow.world.free.set_index(name, v)?,
            ColumnData::U64(_) => {
                return Err(refused(path, format!("`{name}` has a foreign type")));
            }
        }
    }
    match nonsense(flow)? {
        Some(why) => Err(refused(path, why)),
        None => Ok(()),
    }
}

fn positions<const D: usize>(
    checkpoint: &Checkpoint,
    path: &Path,
    name: &str,
) -> Result<Vec<Vect<D>>> {
    match checkpoint.column(name).map(|c| &c.data) {
        Some(ColumnData::F64(v)) if !v.iter().all(|x| x.is_finite()) => {
            Err(refused(path, "it has particles that are nowhere"))
        }
        Some(ColumnData::F64(v)) => Ok(v.chunks_exact(D).map(Vect::from_column_slice).collect()),
        _ => Err(refused(path, format!("it lacks the column `{name}`"))),
    }
}

/// Refuses a clock that no run of the scene can have had.
fn believable(clock: &Clock, scene: &Scene, path: &Path) -> Result<()> {
    let [time, dt] = [clock.time, clock.dt].map(f64::from_bits);
    let end = scene.run.end;
    let builds = clock.list_time.map_or(time, f64::from_bits);
    let why = if !time.is_finite() {
        "its time is not finite".to_string()
    } else if time < 0.0 {
        format!("its time, {time} s, is before the start")
    } else if time > end {
        format!("its time, {time} s, is past the end of the scene, {end} s")
    } else if !(dt >= 0.0 && dt <= end) {
        format!("its step, {dt} s, is impossible in a run of {end} s")
    } else if !(0.0..=time).contains(&builds) {
        format!("its lists are of t = {builds} s, which is not before its time")
    } else if clock.list_builds > MOST {
        format!(
            "its lists were built {} times, which no run reaches",
            clock.list_builds
        )
    } else {
        return Ok(());
    };
    Err(refused(path, why))
}

/// Time and step; walls go where they are at that time.
fn set_clock<const D: usize>(
    flow: &mut Flow<D>,
    clock: &Clock,
    checkpoint: &Checkpoint,
    same_lists: bool,
    path: &Path,
) -> Result<()> {
    flow.world.time = f64::from_bits(clock.time);
    flow.world.dt = f64::from_bits(clock.dt);
    if let Some(walls) = &mut flow.walls {
        let now = flow.world.time;
        let numbers = |name: &str| match checkpoint.column(name).map(|c| &c.data) {
            Some(ColumnData::F64(numbers)) => numbers.clone(),
            _ => Vec::new(),
        };
        let states = WallStates {
            now: numbers(WALL_STATES),
            listed: same_lists.then(|| numbers(WALL_LIST_STATES)),
        };
        let moved = walls.put_back(&mut flow.world.walls, &states, now);
        moved.map_err(|e| refused(path, e.to_string()))?;
        let loads = numbers(WALL_LOADS);
        if loads.len() == flow.world.walls.names.len() * WallForce::<D>::NUMBERS {
            let loads = loads.chunks_exact(WallForce::<D>::NUMBERS);
            flow.loads = loads.map(WallForce::from_numbers).collect();
        }
    }
    Ok(())
}

/// Errors of a state that is none of this scene, though the file is whole: numbers of particles and phases
/// that there are none of, places that are none.
fn nonsense<const D: usize>(flow: &Flow<D>) -> Result<Option<&'static str>> {
    let free = &flow.world.free;
    let mut seen = HashSet::new();
    let given = free.inserted.identities;
    let mut new = |id: &u32| *id < given && seen.insert(*id);
    let known = free.get(fields::IDENTITY)?.iter().all(&mut new);
    let mut phases = free.get(fields::PHASE).into_iter().flatten();
    let mut places = free.get(fields::POSITION)?.iter().flatten();
    let mut masses = free.get(fields::MASS)?.iter();
    let mut speeds = free.get(fields::VELOCITY)?.iter().flatten();
    Ok(if !known {
        Some("its particles are not the scene's")
    } else if phases.any(|p| *p as usize >= flow.laws.len()) {
        Some("its phases are not the scene's")
    } else if places.any(|x| !x.is_finite()) {
        Some("it has particles that are nowhere")
    } else if masses.any(|m| !(*m > 0.0 && m.is_finite())) {
        Some("it has particles without mass")
    } else if speeds.any(|u| !u.is_finite()) {
        Some("it has velocities that are not finite")
    } else {
        None
    })
}
