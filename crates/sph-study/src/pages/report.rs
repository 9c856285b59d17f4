//! Files that a study leaves: `report.html` has all of it on one page that needs no other file.

use std::collections::BTreeSet;
use std::path::Path;

use sph_core::{comma_list, number};
use sph_io::{IoError, Plot, escape, write_whole};

use crate::pages::plots::{grid, plain_grid};
use crate::pages::{matrix, plots, table};
use crate::reading::combine::safe;
use crate::{Origin, Results, Scale, Status};

/// Style of the page, on paper too.
const STYLE: &str = include_str!("../../templates/report.css");

fn html(results: &Results) -> Result<String, IoError> {
    let title = escape(&results.title);
    let mut page = format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width\">\n<title>{title}</title>\n\
         <style>\n{STYLE}</style>\n</head>\n<body>\n<h1>{title}</h1>\n",
    );
    if let Some(description) = &results.description {
        page += &format!("<p>{}</p>\n", marked(&words(description)));
    }
    page.push_str(&facts(results));
    match results.frontiers.is_empty() {
        true => page.push_str(&compared(results)?),
        false => page.push_str(&matrix::body(results)?),
    }
    let lines = lines(&results.definition);
    Ok(page + &format!("<h2>Study file</h2>\n<pre>{lines}</pre>\n</body>\n</html>\n"))
}

fn compared(results: &Results) -> Result<String, IoError> {
    let mut page = String::new();
    let lines = results.scale.iter().flat_map(Scale::lines);
    let lines = lines.map(|line| format!("<p>{}</p>\n", escape(&line)));
    let (error, none) = (plots::work_precision(results), String::new);
    let plots = [
        ("Error against run time", error, none()),
        ("Means", plots::means(results), none()),
        ("Convergence", plots::convergence(results), orders(results)),
        ("Cost against size", plots::costs(results), lines.collect()),
    ];
    for (title, plot, below) in plots {
        if let Some(plot) = plot {
            page.push_str(&headed(title, &(plot.to_svg()? + &below)));
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

/// A body below its title; nothing for an empty one.
fn headed(title: &str, body: &str) -> String {
    match body {
        "" => String::new(),
        body => format!("<h2>{title}</h2>\n{body}"),
    }
}

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
    let lines = text.lines().map(|l| l.replace('\t', "    "));
    let escaped = lines.map(|l| escape(&l).into_owned());
    escaped.collect::<Vec<_>>().join("\n")
}

fn facts(results: &Results) -> String {
    use Status::{Done, Failed, Interrupted, OverLimit, Pending, Skipped};
    let all = || results.variants.iter();
    let count = |status| all().filter(|v| v.status == status).count();
    let states = [Done, Failed, OverLimit, Interrupted, Skipped, Pending].map(|s| (count(s), s));
    let states = states.iter().filter(|(count, _)| *count > 0);
    let states = comma_list(states.map(|(count, status)| format!("{count} {}", status.name())));
    let manner = match results.serial {
        true => "one variant at a time",
        false => "variants side by side",
    };
    let row = |name: &str, value: String| vec![name.to_string(), value];
    let origin = &results.origin;
    let mut rows = vec![
        row("scene", results.scene.clone()),
        row("judged by", results.errors.join(", ")),
        row("variants", states),
        row("machine", origin.machine.to_string()),
        row("threads", format!("{}; {manner}", results.threads())),
        row("version", format!("sph {}", origin.version)),
        row("commit", origin.commit.clone().unwrap_or("unknown".into())),
        row("built with", origin.built_with.clone()),
    ];
    rows.retain(|row| !row[1].is_empty());
    let unlike: [(&str, PartOfOrigin); 3] = [
        ("variants ran at", |o| o.commit.clone()),
        ("variants ran on", |o| Some(o.machine.to_string())),
        ("variants ran with", |o| Some(o.built_with.clone())),
    ];
    for (name, of) in unlike {
        let ran = all().filter(|v| v.size.steps > 0);
        let each: BTreeSet<String> = ran.filter_map(|v| of(&v.origin)).collect();
        if each.len() > 1 {
            rows.push(row(name, Vec::from_iter(each).join("; ")));
        }
    }
    if !results.set.is_empty() {
        rows.push(row("set for all", results.set.join(", ")));
    }
    plain_grid(&[], &rows)
}

/// A text of where and with what a variant has run, if it is known.
type PartOfOrigin = fn(&Origin) -> Option<String>;

fn orders(results: &Results) -> String {
    let two = |o: &f64| format!("{o:.2}");
    let mut rows = Vec::new();
    for series in &results.series {
        let all = series.orders.iter().filter(|(_, o)| !o.between.is_empty());
        rows.extend(all.map(|(error, orders)| {
            let between = comma_list(orders.between.iter().map(two));
            let finest = orders.finest_three.as_ref().map_or("–".into(), two);
            vec![series.name.clone(), error.clone(), between, finest]
        }));
    }
    let heads = ["series", "error", "orders, coarse to fine", "three finest"];
    some_grid(&heads, &rows)
}

fn some_grid(heads: &[&str], rows: &[Vec<String>]) -> String {
    match rows.is_empty() {
        true => String::new(),
        false => plain_grid(heads, rows),
    }
}

fn best(results: &Results) -> String {
    let heads = ["variant", results.judged(), "wall seconds"];
    let row = |name: &String| {
        let variant = results.variant(name)?;
        let error = variant.error(results.judged())?;
        let seconds = variant.wall_seconds.min?;
        let [error, seconds] = [error, seconds].map(number::plain);
        Some(vec![name.clone(), error, seconds])
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
    let grid = some_grid(&["variant", "status", "reason"], &bad);
    headed("What did not end well", &grid)
}

/// Parts of the time, of the variants that nothing beats.
fn stages(results: &Results) -> String {
    let mut rows = Vec::new();
    for variant in results.pareto.iter().filter_map(|n| results.variant(n)) {
        let all: f64 = variant.wall_seconds_by_stage.values().sum();
        let mut stages: Vec<_> = variant.wall_seconds_by_stage.iter().collect();
        stages.sort_by(|a, b| b.1.total_cmp(a.1));
        for (k, (stage, seconds)) in stages.into_iter().take(4).enumerate() {
            let name = if k == 0 { variant.name.as_str() } else { "" };
            let (share, seconds) = (number::percent(seconds / all), number::plain(*seconds));
            rows.push(vec![name.to_string(), stage.clone(), seconds, share]);
        }
    }
    let grid = some_grid(&["variant", "stage", "seconds", "share"], &rows);
    headed("Where the time goes", &grid)
}

/// Writes `study.json`, `study.csv`, the plots and `report.html` into a folder.
///
/// # Errors
/// The first file that cannot be written.
pub fn publish(results: &Results, folder: &Path) -> Result<(), IoError> {
    sph_io::write_json(folder.join("study.json"), results)?;
    table::write_csv(results, &folder.join("study.csv"))?;
    for (lines, plot) in matrix::axes(results) {
        write_both(&plot, folder, &format!("axis-{}", safe(&lines[0].axis)))?;
    }
    if results.frontiers.is_empty() {
        let plots = [
            ("error-against-time", plots::work_precision(results)),
            ("cost-against-size", plots::costs(results)),
            ("means", plots::means(results)),
            ("error-against-refinement", plots::convergence(results)),
        ];
        for (name, plot) in plots {
            plot.map_or(Ok(()), |plot| write_both(&plot, folder, name))?;
        }
    }
    write_whole(folder.join("report.html"), html(results)?)
}

fn write_both(plot: &Plot, folder: &Path, name: &str) -> Result<(), IoError> {
    plot.save(folder.join(format!("{name}.svg")))?;
    plot.save(folder.join(format!("{name}.png")))
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
        let both = "<code>a&lt;b</code> and <code>c</code>";
        assert_eq!(marked("`a<b` and `c`"), both);
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
