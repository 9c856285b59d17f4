//! `report.html`: all of a study on one page that needs no other file.

use std::fmt::Write as _;

use sph_core::number;
use sph_io::{IoError, escape};

use crate::pages::grid::{grid, plain_grid};
use crate::pages::{matrix, plots, table};
use crate::results::Results;
use crate::running::machine::Origin;
use crate::running::record::Status;

/// Style of the page, on paper too.
const STYLE: &str = include_str!("../../templates/report.css");

/// The page.
///
/// # Errors
/// If a plot cannot be drawn.
pub fn html(results: &Results) -> Result<String, IoError> {
    let mut page = String::new();
    let title = escape(&results.title);
    let _ = writeln!(
        page,
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width\">\n<title>{title}</title>\n\
         <style>\n{STYLE}</style>\n</head>\n<body>\n<h1>{title}</h1>",
    );
    if let Some(description) = &results.description {
        let _ = writeln!(page, "<p>{}</p>", marked(&words(description)));
    }
    page.push_str(&facts(results));
    match results.frontiers.is_empty() {
        true => page.push_str(&compared(results)?),
        false => page.push_str(&matrix::body(results)?),
    }
    let _ = writeln!(
        page,
        "<h2>Study file</h2>\n<pre>{}</pre>\n</body>\n</html>",
        lines(&results.definition)
    );
    Ok(page)
}

/// Errors, times and orders of variants of one scene.
fn compared(results: &Results) -> Result<String, IoError> {
    let mut page = String::new();
    if !results.errors.is_empty() {
        let plot = plots::work_precision(results);
        page.push_str(&headed("Error against run time", &plot.to_svg()?));
    }
    if let Some(plot) = plots::means(results) {
        page.push_str(&headed("Means", &plot.to_svg()?));
    }
    if let Some(plot) = plots::convergence(results) {
        page.push_str(&headed("Convergence", &plot.to_svg()?));
        page.push_str(&orders(results));
    }
    if let Some(scale) = &results.scale {
        let plot = scale.plot(&results.title);
        page.push_str(&headed("Cost against size", &plot.to_svg()?));
        for line in scale.lines() {
            let _ = writeln!(page, "<p>{}</p>", escape(&line));
        }
    }
    if !results.errors.is_empty() {
        let title = "Pareto line: not beaten in both error and time";
        page.push_str(&headed(title, &best(results)));
    }
    page.push_str(&headed("Variants", &variants(results)));
    page.push_str(&failures(results));
    page.push_str(&stages(results));
    Ok(page)
}

fn headed(title: &str, body: &str) -> String {
    format!("<h2>{title}</h2>\n{body}")
}

/// A text without its line breaks.
fn words(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// A text, escaped, with the text between backticks as code.
fn marked(text: &str) -> String {
    let pieces: Vec<_> = text.split('`').map(escape).collect();
    if pieces.len() % 2 == 0 {
        return pieces.join("`");
    }
    let marked = pieces.iter().enumerate().map(|(k, piece)| match k % 2 {
        0 => piece.to_string(),
        _ => format!("<code>{piece}</code>"),
    });
    marked.collect()
}

/// A text with its line breaks, escaped.
fn lines(text: &str) -> String {
    let escaped = text
        .lines()
        .map(|l| escape(&l.replace('\t', "    ")).into_owned());
    escaped.collect::<Vec<_>>().join("\n")
}

fn facts(results: &Results) -> String {
    let all = || results.variants.iter().map(|v| v.status);
    let count = |status: Status| all().filter(|s| *s == status).count();
    let states = [
        Status::Done,
        Status::Failed,
        Status::OverLimit,
        Status::Interrupted,
        Status::Skipped,
        Status::Pending,
    ];
    let states = states.iter().filter(|s| count(**s) > 0);
    let states: Vec<String> = states
        .map(|s| format!("{} {}", count(*s), s.name()))
        .collect();
    let manner = match results.serial {
        true => "one variant at a time",
        false => "variants side by side",
    };
    let row = |name: &str, value: String| vec![name.to_string(), value];
    let origin = &results.origin;
    let mut rows = vec![
        row("scene", results.scene.clone()),
        row("judged by", results.errors.join(", ")),
        row("variants", states.join(", ")),
        row("machine", origin.machine.to_string()),
        row("threads", format!("{}; {manner}", results.threads())),
        row("version", format!("sph {}", origin.version)),
        row("commit", origin.commit.clone().unwrap_or("unknown".into())),
        row("built with", origin.built_with.clone()),
    ];
    rows.retain(|row| !row[1].is_empty());
    let unlike = [
        ("variants ran at", differing(results, |o| o.commit.clone())),
        (
            "variants ran on",
            differing(results, |o| Some(o.machine.to_string())),
        ),
        (
            "variants ran with",
            differing(results, |o| Some(o.built_with.clone())),
        ),
    ];
    for (name, all) in unlike {
        if all.len() > 1 {
            rows.push(row(name, all.join("; ")));
        }
    }
    if !results.set.is_empty() {
        rows.push(row("set for all", results.set.join(", ")));
    }
    plain_grid(&[], &rows)
}

/// Keys in which the variants that have run differ.
fn differing(results: &Results, of: fn(&Origin) -> Option<String>) -> Vec<String> {
    let ran = results.variants.iter().filter(|v| v.steps > 0);
    let mut all: Vec<String> = ran.filter_map(|v| of(&v.origin)).collect();
    all.sort();
    all.dedup();
    all
}

fn orders(results: &Results) -> String {
    let heads = ["series", "error", "orders, coarse to fine", "three finest"].map(String::from);
    let mut rows = Vec::new();
    for series in &results.series {
        for (error, orders) in &series.orders {
            if orders.between.is_empty() {
                continue;
            }
            let between: Vec<String> = orders.between.iter().map(|o| format!("{o:.2}")).collect();
            rows.push(vec![
                series.name.clone(),
                error.clone(),
                between.join(", "),
                orders
                    .finest_three
                    .map_or("–".into(), |o| format!("{o:.2}")),
            ]);
        }
    }
    match rows.is_empty() {
        true => String::new(),
        false => plain_grid(&heads, &rows),
    }
}

fn best(results: &Results) -> String {
    let heads = ["variant", results.judged(), "wall seconds"].map(String::from);
    let row = |name: &String| {
        let variant = results.variant(name)?;
        let error = variant.error(results.judged())?;
        let seconds = variant.wall_seconds.min?;
        Some(vec![
            name.clone(),
            number::plain(error),
            number::plain(seconds),
        ])
    };
    let rows: Vec<_> = results.pareto.iter().filter_map(row).collect();
    plain_grid(&heads, &rows)
}

fn variants(results: &Results) -> String {
    let rows = table::rows(results);
    let (heads, rows) = rows.split_at(1);
    grid(&heads[0], rows, |k| {
        let variant = &results.variants[k];
        match (variant.status, results.pareto.contains(&variant.name)) {
            (Status::Done, true) => "pareto".into(),
            (Status::Done, false) => String::new(),
            (status, _) => status.name().replace(' ', "-"),
        }
    })
}

fn failures(results: &Results) -> String {
    let bad = results.variants.iter().filter_map(|v| {
        let reason = v.reason.clone()?;
        Some(vec![v.name.clone(), v.status.name().into(), reason])
    });
    let bad: Vec<Vec<String>> = bad.collect();
    let heads = ["variant", "status", "reason"].map(String::from);
    match bad.is_empty() {
        true => String::new(),
        false => headed("What did not end well", &plain_grid(&heads, &bad)),
    }
}

/// Parts of the time, of the variants that nothing beats.
fn stages(results: &Results) -> String {
    let heads = ["variant", "stage", "seconds", "share"].map(String::from);
    let mut rows = Vec::new();
    for variant in results.pareto.iter().filter_map(|n| results.variant(n)) {
        let all: f64 = variant.wall_seconds_by_stage.values().sum();
        let mut stages: Vec<_> = variant.wall_seconds_by_stage.iter().collect();
        stages.sort_by(|a, b| b.1.total_cmp(a.1));
        for (k, (stage, seconds)) in stages.into_iter().take(4).enumerate() {
            let name = if k == 0 { variant.name.as_str() } else { "" };
            rows.push(vec![
                name.to_string(),
                stage.clone(),
                number::plain(*seconds),
                number::percent(seconds / all),
            ]);
        }
    }
    match rows.is_empty() {
        true => String::new(),
        false => headed("Where the time goes", &plain_grid(&heads, &rows)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A page of a study that has not run.
    fn page(title: &str, definition: &str) -> String {
        let results = serde_json::json!({
            "schema_version": 1, "study": "s", "title": title, "description": null,
            "scene": "a", "definition": definition, "set": [], "errors": ["e"], "axes": ["n"],
            "refinement": "numerics.spacing", "serial": true,
            "machine": { "cpu": "c", "cores": 2, "os": "o" }, "version": "0", "commit": null,
            "variants": [{
                "name": "n-1", "values": { "n": "1" }, "refinement": 0.1, "status": "failed",
                "reason": "a < b", "errors": {}, "order": null,
                "wall_seconds": { "min": null, "spread": null, "all": [] }, "threads": 1,
                "particles": 0, "steps": 7, "steps_rolled_back": 0, "simulated_seconds": 0.5,
                "dt_limiter": null, "dt_limiters": {}, "wall_seconds_by_stage": {},
                "version": "0", "commit": null, "fingerprint": "f",
            }],
            "series": [{ "name": "", "variants": ["n-1"], "orders": {} }], "pareto": [],
        });
        html(&serde_json::from_value(results).unwrap()).unwrap()
    }

    #[test]
    fn text_between_backticks_is_code() {
        assert_eq!(
            marked("`a<b` and `c`"),
            "<code>a&lt;b</code> and <code>c</code>"
        );
        assert_eq!(marked("one ` alone"), "one ` alone");
    }

    #[test]
    fn texts_are_escaped_and_failures_have_their_reasons() {
        let page = page("a <b> & c", "x = \"<i>\"\ny = 1");
        assert!(page.contains("<title>a &lt;b&gt; &amp; c</title>") && !page.contains("<b>"));
        assert!(page.contains("x = &quot;&lt;i&gt;&quot;\ny = 1</pre>"));
        assert!(page.contains("What did not end well") && page.contains("<td>a &lt; b</td>"));
        assert!(page.contains("<tr class=\"failed\">"));
        assert_eq!(page.matches("<svg").count(), 2, "empty plots do no harm");
    }
}
