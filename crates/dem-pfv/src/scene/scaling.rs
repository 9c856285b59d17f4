//! Power laws of an aspect ratio from a table.

use std::path::Path;

/// C aⁿ in ranges of a.
#[derive(Debug)]
pub struct Scaling {
    rows: Vec<Row>,
}

#[derive(Debug)]
struct Row {
    /// True for a bound from above, false for one from below.
    below: bool,
    bound: f64,
    factor: f64,
    exponent: f64,
}

impl Scaling {
    /// The law at an aspect ratio.
    pub fn at(&self, aspect: f64) -> Option<f64> {
        let fits = |row: &&Row| (aspect < row.bound) == row.below;
        let row = self.rows.iter().find(fits)?;
        Some(row.factor * aspect.powf(row.exponent))
    }
}

/// The rows of a geometry and a quantity in a table with the columns geometry, quantity, range (`a<2.3`), C, n (`2/3`).
pub fn read(path: &Path, geometry: &str, quantity: &str) -> Result<Scaling, String> {
    let text = scene_text::read_text(path)?;
    let rows = text.lines().filter(|l| !l.starts_with('#')).skip(1);
    let mut found = Vec::new();
    for line in rows {
        let cells: Vec<&str> = line.split(',').map(str::trim).collect();
        if let [g, q, range, factor, exponent, ..] = cells.as_slice()
            && *g == geometry
            && *q == quantity
        {
            let row = row(range, factor, exponent);
            found.push(row.ok_or_else(|| format!("cannot read the row `{line}`"))?);
        }
    }
    match found.is_empty() {
        true => Err(format!("there is no row of `{quantity}` for `{geometry}`")),
        false => Ok(Scaling { rows: found }),
    }
}

fn row(range: &str, factor: &str, exponent: &str) -> Option<Row> {
    let (below, bound) = match (range.strip_prefix("a<"), range.strip_prefix("a>")) {
        (Some(bound), _) => (true, bound),
        (_, Some(bound)) => (false, bound),
        _ => return None,
    };
    Some(Row {
        below,
        bound: bound.parse().ok()?,
        factor: factor.parse().ok()?,
        exponent: fraction(exponent)?,
    })
}

/// `0.65` or `2/3`.
fn fraction(text: &str) -> Option<f64> {
    match text.split_once('/') {
        Some((over, under)) => Some(over.parse::<f64>().ok()? / under.parse::<f64>().ok()?),
        None => text.parse().ok(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn laws_hold_in_their_ranges() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("laws.csv");
        let text = "# a table\ngeometry,quantity,range,C,n,note\nchannel,run-out,a<2.3,1.2,1,x\nchannel,run-out,a>2.3,1.9,2/3,y\n";
        std::fs::write(&path, text).unwrap();
        let law = read(&path, "channel", "run-out").unwrap();
        assert!((law.at(1.0).unwrap() - 1.2).abs() < 1e-12);
        assert!((law.at(8.0).unwrap() - 7.6).abs() < 1e-12);
        assert!(
            read(&path, "round", "run-out")
                .unwrap_err()
                .contains("no row")
        );
    }
}
