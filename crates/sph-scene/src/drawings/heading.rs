//! Heads of columns, and which columns of a file count.

use sph_core::{suggestion, unit_factor};

/// Keys of a scene for two columns of a file.
#[derive(Clone, Debug)]
pub(crate) struct Form {
    /// Their names, or their numbers from 1; the only two if left out.
    pub columns: Option<Vec<String>>,
    /// Factor from the numbers of each to SI; that of the unit in its head, else 1, if left out.
    pub factors: [Option<f64>; 2],
    /// SI units of the columns.
    pub alike: [&'static str; 2],
}

impl Form {
    /// Two coordinates.
    pub fn places(columns: &Option<Vec<String>>, factor: Option<f64>) -> Self {
        Form {
            columns: columns.clone(),
            factors: [factor; 2],
            alike: ["m"; 2],
        }
    }
}

/// The columns of a file that count.
#[derive(Debug)]
pub(crate) struct ColumnChoice {
    /// Their places, from 0.
    pub at: [usize; 2],
    /// Factor from the numbers of each to SI.
    pub factors: [f64; 2],
    /// True if there are no others.
    pub only: bool,
}

impl ColumnChoice {
    /// Of a file with these heads, which may be none.
    ///
    /// # Errors
    /// A column that is not there, or a unit that is none of what it holds.
    pub fn from_heads(form: &Form, cells: &[&str]) -> Result<Self, String> {
        let heads: Vec<Head> = cells.iter().map(|c| Head::parse(c)).collect();
        let place = |name: &String| {
            let found = heads.iter().position(|h| h.name == *name);
            let number = name.parse::<usize>().ok().filter(|n| *n > 0);
            found.or(number.map(|n| n - 1)).ok_or_else(|| {
                let near = suggestion(name, heads.iter().map(|h| h.name.as_str()));
                format!("there is no column `{name}`{near}")
            })
        };
        let at = match form.columns.as_deref() {
            Some([a, b]) => [place(a)?, place(b)?],
            _ => [0, 1],
        };
        let mut factors = [1.0; 2];
        for k in 0..2 {
            let unit = heads.get(at[k]).and_then(|h| h.unit.as_deref());
            factors[k] = match (form.factors[k], unit) {
                (Some(factor), _) => factor,
                (None, Some(unit)) => unit_factor(unit, form.alike[k])?,
                (None, None) => 1.0,
            };
        }
        Ok(ColumnChoice {
            at,
            factors,
            only: form.columns.is_none(),
        })
    }
}

/// A name with its unit: `x [mm]`, `x (mm)` or `x / mm`.
struct Head {
    name: String,
    unit: Option<String>,
}

impl Head {
    fn parse(cell: &str) -> Self {
        let cell = cell.trim().trim_matches('"');
        let cut = cell.find(['[', '(']).or(cell.find('/'));
        let (name, unit) = cut.map_or((cell, ""), |k| cell.split_at(k));
        let unit = unit.trim_matches(['[', ']', '(', ')', '/', ' ']);
        Head {
            name: name.trim().to_string(),
            unit: (!unit.is_empty()).then(|| unit.to_string()),
        }
    }
}

/// The cells of a head whose columns are separated by blanks: a unit in brackets belongs to the name before it.
pub(crate) fn joined<'t>(line: &'t str) -> Vec<&'t str> {
    let mut cells: Vec<&'t str> = Vec::new();
    let mut from = 0;
    let ends = line.char_indices().filter(|(_, c)| c.is_whitespace());
    for end in ends.map(|(k, _)| k).chain([line.len()]) {
        let (word, rest) = (&line[from..end], line[end..].trim_start());
        let open =
            word.contains('[') && !word.contains(']') || word.contains('(') && !word.contains(')');
        if word.trim().is_empty() || open || rest.starts_with(['[', '(']) {
            continue;
        }
        cells.push(word.trim());
        from = end;
    }
    cells
}
