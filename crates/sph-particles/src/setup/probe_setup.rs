//! Preparation of probes by the scene, and check of the fields that outputs name.

use sph_core::{SceneProblem, StepError, fields, parse_unit, suggestion};
use sph_probes::{Probe, ProbeScene};
use sph_scene::Scene;
use sph_solver::setup::own_accounts;
use sph_solver::step::term_accelerations;
use sph_solver::{Flow, SolverError};

use crate::setup::reference_table::LONGEST;

/// Gives the probes the names of the phases and the contents of their files, and refuses references to columns that no probe has.
pub fn prepare<const D: usize>(
    scene: &Scene,
    probes: &mut [(String, Box<dyn Probe<D>>)],
) -> Result<(), SolverError> {
    let phases: Vec<String> = scene.phase.keys().cloned().collect();
    let strangers = own_accounts(scene);
    let known = ProbeScene {
        phases: &phases,
        strangers: &strangers,
    };
    let mut problems = Vec::new();
    let mut columns = Vec::new();
    for (name, probe) in probes {
        let kind = scene.table_of_probe(name);
        if let Err(why) = probe.prepare(&known) {
            problems.push(SceneProblem::new(format!("{kind}.{name}.phase"), why));
        }
        if let Err(why) = load_reference(scene, name, &mut **probe) {
            problems.push(SceneProblem::new(format!("{kind}.{name}.file"), why));
        }
        let suffixes = probe.columns().into_iter().map(|c| c.suffix);
        columns.extend(suffixes.map(|suffix| format!("{name}{suffix}")));
    }
    for (name, reference) in &scene.reference {
        if let Some(probe) = reference.probe.as_ref().filter(|p| !columns.contains(p)) {
            let near = suggestion(probe, columns.iter().map(String::as_str));
            let why = format!("no probe has a column `{probe}`{near}");
            problems.push(SceneProblem::new(format!("reference.{name}.probe"), why));
        }
    }
    SolverError::refuse(problems)
}

/// Reads the file that a probe compares with, and hands it over.
fn load_reference<const D: usize>(
    scene: &Scene,
    name: &str,
    probe: &mut dyn Probe<D>,
) -> Result<(), String> {
    let Some(file) = probe.file().map(String::from) else {
        return Ok(());
    };
    let path = scene.probe_files.get(name);
    let path = path.ok_or_else(|| format!("`{file}` is not the value of the key `file`"))?;
    let read = sph_io::readable(path, LONGEST).and_then(|()| sph_io::read_table(path));
    let table = read.map_err(|e| e.to_string())?;
    let [x, y, ..] = table.columns.as_slice() else {
        return Err(format!("`{file}` has one column where two are expected"));
    };
    // Heads may have units, which name the quantity themselves.
    let factor = |unit: &str| parse_unit(unit).map_or(1.0, |(factor, _)| factor);
    let factors = [x, y].map(|column| factor(&column.unit));
    let rows = x.values.iter().zip(&y.values);
    let rows = rows.map(|(x, y)| [factors[0] * x, factors[1] * y]);
    let loaded = probe.load_reference(rows.collect());
    loaded.map_err(|why| format!("`{file}` {why}"))
}

/// Probes by name.
pub type Probes<const D: usize> = [(String, Box<dyn Probe<D>>)];

/// Measures once without writing, so that a wrong probe is found before anything exists.
pub fn rehearse<const D: usize>(
    scene: &Scene,
    flow: &mut Flow<D>,
    probes: &Probes<D>,
) -> Result<(), SolverError> {
    measure_walls(flow, probes)?;
    for (name, probe) in probes {
        let kind = scene.table_of_probe(name);
        let problem = |e: StepError| match e {
            StepError::Stage { reason, .. } => SolverError::at(format!("{kind}.{name}"), reason),
            other => other.into(),
        };
        probe.measure(&flow.world).map_err(problem)?;
    }
    Ok(())
}

/// Measures the forces on walls that probes read.
pub fn measure_walls<const D: usize>(
    flow: &mut Flow<D>,
    probes: &Probes<D>,
) -> Result<(), StepError> {
    let read = probes.iter().filter_map(|(_, p)| p.needs().force_on);
    let read: Vec<&str> = read.collect();
    match read.is_empty() {
        true => Ok(()),
        false => flow.measure_wall_forces(|name| read.contains(&name)),
    }
}

/// Refuses names of fields that no plugin of the scene has.
pub fn check_output_fields<const D: usize>(
    scene: &Scene,
    flow: &Flow<D>,
) -> Result<(), SolverError> {
    let free = &flow.world.free;
    let lists = [
        ("output.fields", &scene.output.fields),
        ("output.picture", &scene.output.picture),
    ];
    // Fields on request are listed with the others.
    let written = sph_probes::SURFACE_DISTANCE.name;
    let more = sph_probes::derived_fields().chain([fields::STRAIN_RATE.name, written]);
    let more = more.chain(term_accelerations::names());
    let more = more.filter(|name| !free.has(name));
    let names: Vec<&str> = free.fields().map(|f| f.name).chain(more).collect();
    let unknown = |path: &str, name: &str| {
        let near = suggestion(name, names.iter().copied());
        let known = names.join(", ");
        let message =
            format!("no plugin of this scene has a field `{name}`{near} (there are: {known})");
        SceneProblem::new(path, message)
    };
    let mut problems = Vec::new();
    for (path, wanted) in lists {
        let missing = wanted.iter().filter(|n| *n != written && !free.has(n));
        problems.extend(missing.map(|name| unknown(path, name)));
    }
    if let Some(colours) = &scene.output.picture_range {
        // Colours of a field that is not drawn now do no harm: pictures are changed with `--set`.
        let known = |name: &str| names.contains(&name) || name == fields::DISPLACEMENT.name;
        let missing = colours.fields().filter(|name| !known(name));
        problems.extend(missing.map(|name| unknown(&format!("output.picture_range.{name}"), name)));
    }
    SolverError::refuse(problems)
}

#[cfg(test)]
mod tests {
    use super::*;
    use sph_solver::setup::Choices;

    fn messages(keys: &str) -> String {
        let text = format!(
            "title = \"t\"\ndimension = 2\nrun.end = 1\nnumerics.spacing = 0.1\n\
             phase.air = {{ density = 1, rheology.newtonian = {{ viscosity = 1 }} }}\n\
             phase.water = {{ density = 1000, rheology.newtonian = {{ viscosity = 1 }} }}\n\
             body.a = {{ phase = \"water\", box = [[0, 0], [1, 1]] }}\n\
             reference.r = {{ probe = \"e.highest\", norm = \"mean\", value = 1 }}\n{keys}"
        );
        let scene = sph_scene::parse(&text, "t.toml", &[]);
        let scene = scene.unwrap_or_else(|e| panic!("{e}")).scene;
        let mut choices = Choices::<2>::from_scene(&scene).unwrap_or_else(|e| panic!("{e:?}"));
        let done = prepare(&scene, &mut choices.probes);
        done.err().map_or(String::new(), |e| e.to_string())
    }

    #[test]
    fn phases_and_columns_are_looked_up() {
        let right = messages("probe.e = { kind = \"extent\", phase = \"water\" }");
        assert_eq!(right, "");
        let wrong = messages("gauge.e = { kind = \"extent\", phase = \"wter\" }");
        let told = "gauge.e.phase: there is no phase called `wter`, did you mean `water`?";
        assert_eq!(wrong, told);
        let wrong = messages("probe.e = { kind = \"line\", file = \"nosuch.csv\" }");
        assert!(wrong.starts_with("probe.e.file: cannot read"), "{wrong}");
        let wrong = messages("probe.e = { kind = \"front\", phase = \"air\" }");
        assert!(wrong.starts_with("reference.r.probe: no probe has a column `e.highest`"));
    }
}
