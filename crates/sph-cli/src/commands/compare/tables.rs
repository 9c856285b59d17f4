//! Files of results as named columns whose rows have keys.

use sph_io::{Checkpoint, Location, Piece};

/// Columns whose rows are matched by a key.
#[derive(Default)]
pub struct Table {
    /// Columns in the order of the file.
    pub columns: Vec<Column>,
    /// By row: the identity of its particle, or the bits of its time.
    pub keys: Vec<u64>,
    /// By row: the place of its particle, m.
    pub places: Vec<Vec<f64>>,
    /// The time of a frame, s.
    pub time: Option<f64>,
    /// True if the keys are times.
    pub over_time: bool,
}

/// A column of a file.
pub struct Column {
    pub name: String,
    /// SI unit, empty if none is known.
    pub unit: String,
    /// Numbers per row.
    pub components: usize,
    /// Row after row.
    pub values: Vec<f64>,
}

impl Table {
    /// A table over time.
    pub fn of_series(table: sph_io::Table) -> Self {
        let times = table.column("time").unwrap_or_default();
        let keys = times.iter().map(|t| t.to_bits()).collect();
        let columns = table.columns.into_iter().map(|c| Column {
            name: c.name,
            unit: c.unit,
            components: 1,
            values: c.values,
        });
        Table {
            columns: columns.collect(),
            keys,
            over_time: true,
            ..Table::default()
        }
    }

    /// All columns of the particles of a checkpoint; those of walls and lists have other lengths, and no keys.
    pub fn of_checkpoint(checkpoint: Checkpoint) -> Self {
        let columns = checkpoint.columns.into_iter().map(|c| Column {
            values: c.data.reals(),
            unit: String::new(),
            components: c.components,
            name: c.name,
        });
        Table::keyed(columns.collect(), None)
    }

    /// The columns at the points of a frame.
    pub fn of_piece((piece, time): (Piece<'static>, f64)) -> Self {
        let position = Column {
            name: "position".into(),
            unit: "m".into(),
            components: 3,
            values: piece.points.as_flattened().to_vec(),
        };
        let fields = piece.fields.into_iter();
        let at_points = fields.filter(|f| f.location == Location::Point);
        let columns = at_points.map(|f| Column {
            values: f.data.reals(),
            name: f.name.into_owned(),
            unit: f.unit.into_owned(),
            components: f.components,
        });
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
