//! `sph explain`.

use serde_json::json;
use sph_core::comma_list;
use sph_particles::RunError;
use sph_particles::setup::{Examination, Ranks, StageUse, examine, ranks};
use sph_solver::PluginInForce;

use crate::arguments::ExplainArguments;
use crate::commands::grains;
use crate::scene_file::{AnyScene, OpenScene, open};
use crate::terminal::{
    CommandOutput, Trouble, columns, headed, listed, memory, paragraphs, parameters, row, table,
    table_and_below,
};

/// Machines that are listed.
const SHOWN: usize = 16;

pub fn command(arguments: &ExplainArguments) -> Result<(), Trouble> {
    let opened = open(&arguments.scene)?;
    let mut told = output(&opened)?;
    if let Some(count) = arguments.ranks {
        split(&opened, count.get(), &mut told)?;
    }
    told.print(arguments.json);
    Ok(())
}

/// Parts of a scene.
pub fn output(opened: &OpenScene) -> Result<CommandOutput, Trouble> {
    let loaded = match &opened.scene {
        AnyScene::Particles(loaded) => loaded,
        AnyScene::Grains(loaded) => return grains::explain(loaded),
    };
    let examined = examine(&loaded.scene);
    let examined = examined.map_err(|e| Trouble::in_scene(RunError::from(e), &loaded.source))?;
    let text = text(&examined) + &suited(&loaded.scene.suited);
    let mut told = CommandOutput::new(&examined, text);
    told.json["suited"] = json!(loaded.scene.suited);
    Ok(told)
}

fn split(opened: &OpenScene, count: usize, told: &mut CommandOutput) -> Result<(), Trouble> {
    let AnyScene::Particles(loaded) = &opened.scene else {
        let why = "--ranks splits scenes of particles, and this is one of grains";
        return Err(Trouble::usage(why));
    };
    let split = ranks(&loaded.scene, count);
    let split = split.map_err(|e| Trouble::in_scene(RunError::from(e), &loaded.source))?;
    told.json["ranks"] = json!(split);
    told.text.push_str(&ranks_text(&split));
    Ok(())
}

fn ranks_text(split: &Ranks) -> String {
    let count = split.ranks.len();
    let mut text = format!(
        "\nsplit over {count} machines at the start: the costliest has {:.1} % more than the mean\n",
        100.0 * split.imbalance
    );
    let heads = "rank, particles, cost, ghosts, sends per step, ghosts of";
    let rows = split.ranks.iter().enumerate().take(SHOWN);
    let rows = rows.map(|(rank, own)| {
        vec![
            rank.to_string(),
            own.particles.to_string(),
            format!("{:.3}", own.cost),
            own.ghosts.to_string(),
            format!("{:.1} kB", 1e-3 * (own.sent * split.bytes_per_ghost) as f64),
            comma_list(&own.partners),
        ]
    });
    text.push_str(&table(heads, rows));
    if count > SHOWN {
        let more = count - SHOWN;
        text.push_str(&format!("  … and {more} more (all of them with --json)\n"));
    }
    text.push_str(&format!(
        "\nsent to ghosts: {} bytes for each in an evaluation, all {} when it is new; in each iteration of a solve a vector \
         besides\n",
        split.bytes_per_ghost, split.bytes_per_newcomer
    ));
    let rows = split.exchanges.iter();
    let rows = rows.map(|e| vec![e.stage.clone(), e.bytes.to_string(), e.columns.join(", ")]);
    text + &table("after, bytes, columns", rows)
}

fn text(e: &Examination) -> String {
    let mut text = format!("{}\n\nplugins, with the parameters in force\n", e.scene);
    text.push_str(&plugins(&e.plugins));
    let (bytes, count) = (e.bytes_per_particle, e.fields.len());
    text.push_str(&format!(
        "\ncolumns: {bytes} bytes per particle in {count} columns (numbers are those of the stages below)\n"
    ));
    text.push_str(&fields(e));
    text.push_str(&format!("\nmemory: about {}\n", memory(&e.memory)));
    text.push_str("\nstages of an evaluation, in order\n");
    let stages = e.stages.iter().enumerate();
    text.extend(stages.map(|(k, stage)| stage_text(k, stage)));
    let pruned = listed(&e.pruned, "none");
    text.push_str(&format!("\nstages that are not needed here: {pruned}\n"));
    text + "\nlimits of the time step\n" + &paragraphs(2, &e.limit_formulas)
}

/// Choices that the scene leaves to its flow, with the reasons.
fn suited(choices: &[(&'static str, &'static str)]) -> String {
    let rows = choices.iter().map(|(key, reason)| row(key, *reason));
    headed("\nleft to the flow, with the reason", columns(2, rows))
}

fn plugins(plugins: &[PluginInForce]) -> String {
    let rows = plugins.iter().map(|p| {
        let names = [&p.kind, &p.name, &p.provider].map(String::clone);
        (names.to_vec(), parameters(&p.parameters))
    });
    table_and_below("kind, name, provider", rows)
}

fn fields(e: &Examination) -> String {
    let list = |names: &[String]| {
        let place = |n: &String| Some(e.stages.iter().position(|s| s.name == *n)? + 1);
        match names.is_empty() {
            true => "–".to_string(),
            false => comma_list(names.iter().filter_map(place)),
        }
    };
    let rows = e.fields.iter().map(|f| {
        let written = match (f.written_by.is_empty(), f.state) {
            (true, true) => "start, integrator".to_string(),
            _ => list(&f.written_by),
        };
        let role = if f.state { "state" } else { "derived" };
        vec![
            f.name.clone(),
            f.unit.clone(),
            f.bytes.to_string(),
            role.to_string(),
            written,
            list(&f.read_by),
        ]
    });
    table("name, unit, bytes, role, written by, read by", rows)
}

fn stage_text(k: usize, stage: &StageUse) -> String {
    let what = match stage.sweep {
        true => "a sweep over neighbours",
        false => "particle by particle",
    };
    let text = format!("  {}. {}: {what}\n", k + 1, stage.name);
    let all = [
        ("reads here", &stage.reads_here),
        ("reads at neighbours", &stage.reads_at_neighbours),
        ("writes", &stage.writes),
    ];
    let some = all.into_iter().filter(|(_, fields)| !fields.is_empty());
    text + &columns(5, some.map(|(name, fields)| row(name, fields.join(", "))))
}
