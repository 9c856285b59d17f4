//! Files of results as named columns whose rows have keys, and differences of two of them.

use std::collections::HashMap;

use serde::Serialize;
use sph_core::{comma_list, number, unit_suffix};
use sph_io::{Checkpoint, Location, Piece};

/// Columns whose rows are matched by a key.
#[derive(Default)]
pub struct Table {
    pub columns: Vec<Column>,
    /// By row: the identity of its particle, or the bits of its time.
    pub keys: Vec<u64>,
    /// By row: the place of its particle, m.
    pub places: Vec<Vec<f64>>,
    pub time: Option<f64>,
    pub over_time: bool,
}

pub struct Column {
    pub name: String,
    /// SI unit, empty if none is known.
    pub unit: String,
    pub components: usize,
    /// Row after row.
    pub values: Vec<f64>,
}

impl Column {
    fn new(name: String, unit: String, components: usize, values: Vec<f64>) -> Self {
        Column {
            name,
            unit,
            components,
            values,
        }
    }
}

impl Table {
    pub fn of_series(table: sph_io::Table) -> Self {
        let times = table.column("time").unwrap_or_default();
        let keys = times.iter().map(|t| t.to_bits()).collect();
        let columns = table.columns.into_iter();
        let columns = columns.map(|c| Column::new(c.name, c.unit, 1, c.values));
        Table {
            columns: columns.collect(),
            keys,
            over_time: true,
            ..Table::default()
        }
    }

    /// All columns of the particles of a checkpoint; those of walls and lists have other lengths, and no keys.
    pub fn of_checkpoint(checkpoint: Checkpoint) -> Self {
        let columns = checkpoint.columns.into_iter();
        let columns =
            columns.map(|c| Column::new(c.name, String::new(), c.components, c.data.reals()));
        Table::keyed(columns.collect(), None)
    }

    /// The columns at the points of a frame.
    pub fn of_piece((piece, time): (Piece<'static>, f64)) -> Self {
        let places = piece.points.as_flattened().to_vec();
        let position = Column::new("position".into(), "m".into(), 3, places);
        let fields = piece.fields.into_iter();
        let at_points = fields.filter(|f| f.location == Location::Point);
        let named = |name: std::borrow::Cow<str>| name.into_owned();
        let columns = at_points
            .map(|f| Column::new(named(f.name), named(f.unit), f.components, f.data.reals()));
        let columns = std::iter::once(position).chain(columns).collect();
        Table::keyed(columns, Some(time))
    }

    /// Rows by the identity of their particles, or by their numbers where they have none.
    fn keyed(columns: Vec<Column>, time: Option<f64>) -> Self {
        let column = |name: &str| columns.iter().find(|c| c.name == name);
        let places: Vec<Vec<f64>> = column("position").map_or(Vec::new(), |c| {
            let rows = c.values.chunks(c.components.max(1));
            rows.map(<[f64]>::to_vec).collect()
        });
        let keys = match column("identity") {
            Some(identity) => identity.values.iter().map(|x| *x as u64).collect(),
            None => (0..places.len() as u64).collect(),
        };
        Table {
            columns,
            keys,
            places,
            time,
            over_time: false,
        }
    }
}

/// Difference of a column; numbers that are not finite are null in JSON.
#[derive(Default, Serialize)]
pub struct Difference {
    file: String,
    column: String,
    unit: String,
    pub same: bool,
    /// The largest |a − b|; infinite where one of them is no number.
    largest: f64,
    /// The same over the largest |a| of the column.
    relative: f64,
    /// The numbers that differ most.
    first: f64,
    second: f64,
    #[serde(flatten)]
    place: DifferencePlace,
}

#[derive(Clone, Default, Serialize)]
struct DifferencePlace {
    time: Option<f64>,
    /// Identity of the particle, or number of the row.
    particle: Option<u64>,
    component: Option<usize>,
    position: Vec<f64>,
}

/// Differences of all common columns of two tables; columns of only one, and the numbers of rows.
pub fn differences(file: &str, a: &Table, b: &Table) -> (Vec<Difference>, Vec<String>) {
    let mut remarks = Vec::new();
    let rows: HashMap<u64, usize> = b.keys.iter().copied().zip(0..).collect();
    let keys = a.keys.iter().enumerate();
    let pairs = keys.filter_map(|(k, key)| Some([k, *rows.get(key)?]));
    let pairs: Vec<[usize; 2]> = pairs.collect();
    let all = a.keys.len() + b.keys.len();
    let lone = all - 2 * pairs.len();
    if lone > 0 {
        remarks.push(format!("{file}: {lone} of {all} rows have no counterpart"));
    }
    let twin = |name: &str, of: &Table| of.columns.iter().position(|c| c.name == name);
    for (one, other, which) in [(a, b, "first"), (b, a, "second")] {
        let names = one.columns.iter().map(|c| &c.name);
        let alone = comma_list(names.filter(|name| twin(name, other).is_none()));
        if !alone.is_empty() {
            remarks.push(format!("{file}: the {which} alone has {alone}"));
        }
    }
    let mut found = Vec::new();
    for column in &a.columns {
        let Some(other) = twin(&column.name, b).map(|k| &b.columns[k]) else {
            continue;
        };
        let per = column.components.max(1);
        let by_rows = column.values.len() == per * a.keys.len()
            && other.values.len() == per * b.keys.len()
            && other.components == column.components;
        match by_rows {
            true => found.push(difference(file, column, other, &pairs, a)),
            // Walls and lists: number by number, or not at all.
            false if column.values.len() == other.values.len() => {
                let rows: Vec<_> = (0..column.values.len() / per).map(|k| [k; 2]).collect();
                found.push(difference(file, column, other, &rows, &Table::default()));
            }
            false => remarks.push(format!(
                "{file}: `{}` has {} numbers and {}",
                column.name,
                column.values.len(),
                other.values.len()
            )),
        }
    }
    (found, remarks)
}

fn difference(file: &str, a: &Column, b: &Column, pairs: &[[usize; 2]], of: &Table) -> Difference {
    let per = a.components.max(1);
    let mut found = Difference {
        file: file.to_string(),
        column: a.name.clone(),
        unit: a.unit.clone(),
        same: true,
        largest: -1.0,
        ..Difference::default()
    };
    let mut range: f64 = 0.0;
    for &[row, twin] in pairs {
        for k in 0..per {
            let (x, y) = (a.values[per * row + k], b.values[per * twin + k]);
            if x.is_finite() {
                range = range.max(x.abs());
            }
            if x.to_bits() == y.to_bits() {
                continue;
            }
            found.same = false;
            let apart = match (x - y).abs() {
                nan if nan.is_nan() => f64::INFINITY,
                apart => apart,
            };
            if apart > found.largest {
                (found.largest, found.first, found.second) = (apart, x, y);
                let key = of.keys.get(row).copied();
                let (time, particle) = match of.over_time {
                    true => (key.map(f64::from_bits), None),
                    false => (of.time, Some(key.unwrap_or(row as u64))),
                };
                found.place = DifferencePlace {
                    time,
                    particle,
                    component: (per > 1).then_some(k),
                    position: of.places.get(row).cloned().unwrap_or_default(),
                };
            }
        }
    }
    found.largest = found.largest.max(0.0);
    found.relative = found.largest / if range > 0.0 { range } else { 1.0 };
    found
}

impl Difference {
    pub fn is_of(&self, other: &Difference) -> bool {
        self.file == other.file && self.column == other.column
    }

    /// Takes the place of another one of the column if that is larger.
    pub fn keep_larger(&mut self, other: Difference) {
        let same = self.same && other.same;
        if !other.same && (self.same || other.largest > self.largest) {
            *self = other;
        }
        self.same = same;
    }

    pub fn row(&self) -> Vec<String> {
        let unit = unit_suffix(&self.unit);
        vec![
            self.file.clone(),
            self.column.clone(),
            format!("{}{unit}", four_digits(self.largest)),
            four_digits(self.relative),
            format!("{:?}", self.first),
            format!("{:?}", self.second),
            self.place.label(),
        ]
    }
}

fn four_digits(x: f64) -> String {
    match x.is_finite() {
        true => format!("{x:.2e}"),
        false => "no number".into(),
    }
}

impl DifferencePlace {
    fn label(&self) -> String {
        let mut parts = Vec::new();
        if let Some(time) = self.time {
            parts.push(format!("t = {} s", number::plain(time)));
        }
        if let Some(particle) = self.particle {
            parts.push(format!("particle {particle}"));
        }
        if let Some(component) = self.component {
            let axis = ["x", "y", "z"].get(component);
            parts.push(axis.map_or(format!("component {component}"), |a| (*a).to_string()));
        }
        if !self.position.is_empty() {
            let at = comma_list(self.position.iter().map(|x| number::plain(*x)));
            parts.push(format!("at ({at}) m"));
        }
        parts.join(", ")
    }
}
