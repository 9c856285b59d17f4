//! `sph check FILE.stl`.

use std::path::Path;

use serde_json::{Value as Json, json};
use sph_core::number;
use sph_scene::{Facets, Topology, sense};

use crate::terminal::{CommandOutput, Trouble, columns, headed, remarks, row};

const SHOWN: usize = 10;
/// A surface whose [`sense`] is smaller has no inside.
const NO_INSIDE: f64 = 0.02;
/// Numbers of a larger extent than the first are hardly metres, of a smaller one than the second hardly millimetres.
const UNITS: [f64; 2] = [20.0, 2.0];
/// Shares of its own size by which a coordinate in single precision is rounded.
const SINGLE: f64 = 6e-8;

pub fn is_mesh(argument: &str) -> bool {
    let ending = Path::new(argument).extension();
    ending.is_some_and(|e| e.eq_ignore_ascii_case("stl"))
}

pub fn output(file: &str) -> Result<CommandOutput, Trouble> {
    let (facets, odd) = Facets::read(Path::new(file))?;
    let topology = facets.topology();
    let [low, high] = facets.bounds();
    let mesh = Mesh {
        facing: facing(&facets, &topology),
        extent: std::array::from_fn(|k| high[k] - low[k]),
        low,
        high,
        topology,
        facets,
        odd,
    };
    let said = mesh.said();
    let rows = columns(2, mesh.rows());
    let text = format!("{file} is a surface of facets, in the unit of its file\n{rows}")
        + &headed("\nremarks", remarks(&said));
    let mut json = mesh.json();
    json["file"] = json!(file);
    json["remarks"] = json!(said);
    Ok(CommandOutput { json, text })
}

/// Orientation of a surface, once its facets are turned to face one way.
fn facing(facets: &Facets, topology: &Topology) -> &'static str {
    let aligned = facets.clone().turned(&topology.flipped);
    let found = match topology.openings.is_empty() {
        true => 0.5 * aligned.volume().signum(),
        false => sense(&aligned),
    };
    match found {
        s if s.abs() < NO_INSIDE => "has no inside",
        s if s > 0.0 => "outwards",
        _ => "inwards",
    }
}

fn place(x: &[f64; 3]) -> String {
    format!("({})", x.map(number::plain).join(", "))
}

struct Mesh {
    facets: Facets,
    topology: Topology,
    odd: Option<usize>,
    low: [f64; 3],
    high: [f64; 3],
    extent: [f64; 3],
    facing: &'static str,
}

impl Mesh {
    fn largest(&self) -> f64 {
        self.extent.iter().fold(0.0, |m: f64, x| m.max(*x))
    }

    fn unit(&self) -> &'static str {
        match self.largest() {
            x if x > UNITS[0] => "mm",
            x if x < UNITS[1] => "m",
            _ => "m or mm",
        }
    }

    fn rows(&self) -> Vec<Vec<String>> {
        let (topology, all) = (&self.topology, self.facets.triangles.len());
        let orientation = match topology.flipped.as_slice() {
            [] => format!("consistent, {}", self.facing),
            flipped => {
                let (count, first, facing) = (flipped.len(), flipped[0] + 1, self.facing);
                format!(
                    "{count} of {all} facets flipped, the first is facet {first}; the others {facing}"
                )
            }
        };
        let mut rows = vec![
            row("facets", number::count(all as f64)),
            row("pieces", number::count(topology.parts as f64)),
            row("lowest corner", place(&self.low)),
            row("extent", self.extent.map(number::plain).join(" \u{d7} ")),
            row("unit", format!("{}, by its extent", self.unit())),
            row("area", number::plain(self.facets.area())),
            row("orientation", orientation),
            row("openings", topology.openings.len().to_string()),
        ];
        rows.extend(topology.openings.iter().take(SHOWN).map(|o| {
            let (edges, size, around) = (o.edges, number::plain(o.size), place(&o.centre));
            row("", format!("{edges} edges, {size} across, around {around}"))
        }));
        rows
    }

    fn said(&self) -> Vec<String> {
        let mut said = Vec::new();
        if !self.topology.flipped.is_empty() {
            let turned = "`align = true` in the table of the wall turns the flipped facets round";
            said.push(turned.to_string());
        }
        if self.facing != "has no inside" {
            let side = match self.facing {
                "outwards" => "outside",
                _ => "inside",
            };
            let turned = "`flip = true` puts it on the other side, `fluid = \"inside\"` or \"outside\" on one";
            said.push(format!("as drawn, the fluid is {side}: {turned}"));
        }
        if let Some(facet) = self.odd {
            said.push(format!(
                "the normal of facet {facet} contradicts the order of its corners"
            ));
        }
        if self.topology.crowded > 0 {
            let edges = self.topology.crowded;
            said.push(format!("more than two facets meet in {edges} edges"));
        }
        let corners = self.low.iter().chain(&self.high);
        let far = corners.fold(0.0, |m: f64, x| m.max(x.abs()));
        if far > 1e3 * self.largest() {
            let [far, step] = [far, SINGLE * far].map(number::plain);
            said.push(format!(
                "it lies {far} from the origin, where single precision resolves {step}: move it before it is written"
            ));
        }
        said
    }

    fn json(&self) -> Json {
        let topology = &self.topology;
        let openings = topology.openings.iter();
        let openings =
            openings.map(|o| json!({ "edges": o.edges, "size": o.size, "centre": o.centre }));
        json!({
            "facets": self.facets.triangles.len(),
            "pieces": topology.parts,
            "low": self.low,
            "high": self.high,
            "extent": self.extent,
            "unit": self.unit(),
            "area": self.facets.area(),
            "openings": openings.collect::<Vec<_>>(),
            "flipped": topology.flipped.iter().map(|f| f + 1).collect::<Vec<_>>(),
            "facing": self.facing,
            "crowded_edges": topology.crowded,
            "odd_normal": self.odd,
        })
    }
}
