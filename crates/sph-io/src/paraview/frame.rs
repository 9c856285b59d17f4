//! One output time as plain data: points, cells and named fields.
//!
//! Everything may be borrowed, so that writing copies nothing that the solver already holds in the right shape.

use std::borrow::Cow;

/// All pieces at one time.
#[derive(Clone, Debug)]
pub struct Frame<'a> {
    /// Simulated time in seconds.
    pub time: f64,
    /// Number of the output, from 0; it names the files.
    pub index: usize,
    /// For instance `fluid` and `walls`; every name once.
    pub pieces: Vec<Piece<'a>>,
}

/// Points with fields, written as one file.
#[derive(Clone, Debug)]
pub struct Piece<'a> {
    /// Name of the part in ParaView and in the file name.
    pub name: Cow<'a, str>,
    /// Positions in metres; in 2D the third coordinate is zero.
    pub points: Cow<'a, [[f64; 3]]>,
    /// Connections of the points.
    pub cells: Cells<'a>,
    /// Columns at points or cells.
    pub fields: Vec<FieldData<'a>>,
}

/// Cells over the points of a piece.
#[derive(Clone, Debug)]
pub enum Cells<'a> {
    /// One vertex per point: particles.
    Vertices,
    /// Pairs of point numbers: walls in 2D.
    Segments(Cow<'a, [[u32; 2]]>),
    /// Triples of point numbers: walls in 3D.
    Triangles(Cow<'a, [[u32; 3]]>),
    /// Fours of point numbers: pores.
    Tetrahedra(Cow<'a, [[u32; 4]]>),
}

/// The place of the values of a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Location {
    /// One tuple per point.
    Point,
    /// One tuple per cell.
    Cell,
}

/// Sections of the fields of a file.
pub(crate) const SECTIONS: [(&str, Location); 2] =
    [("PointData", Location::Point), ("CellData", Location::Cell)];

/// A named column.
#[derive(Clone, Debug)]
pub struct FieldData<'a> {
    /// Name in ParaView, the same word as in a scene.
    pub name: Cow<'a, str>,
    /// SI unit such as `Pa`; empty for a pure number.
    pub unit: Cow<'a, str>,
    /// At points or at cells.
    pub location: Location,
    /// Numbers per tuple: 1 scalar, 3 vector, 6 symmetric tensor in the order
    /// xx, yy, zz, xy, yz, xz (VTK's), 9 full tensor.
    pub components: usize,
    /// Tuple after tuple.
    pub data: FieldValues<'a>,
}

/// The numbers of a field.
#[derive(Clone, Debug)]
pub enum FieldValues<'a> {
    /// Reals.
    F64(Cow<'a, [f64]>),
    /// Identities, colours, flags.
    U32(Cow<'a, [u32]>),
    /// Signed or large integers.
    I64(Cow<'a, [i64]>),
}

impl FieldValues<'_> {
    pub(crate) fn len(&self) -> usize {
        match self {
            Self::F64(v) => v.len(),
            Self::U32(v) => v.len(),
            Self::I64(v) => v.len(),
        }
    }

    /// All of them as reals.
    pub fn reals(&self) -> Vec<f64> {
        match self {
            Self::F64(v) => v.to_vec(),
            Self::U32(v) => v.iter().map(|x| f64::from(*x)).collect(),
            Self::I64(v) => v.iter().map(|x| *x as f64).collect(),
        }
    }

    pub(crate) fn kind(&self) -> &'static str {
        match self {
            Self::F64(_) => "Float64",
            Self::U32(_) => "UInt32",
            Self::I64(_) => "Int64",
        }
    }
}

impl<'a> FieldData<'a> {
    /// One real per point.
    pub fn scalar(
        name: impl Into<Cow<'a, str>>,
        unit: impl Into<Cow<'a, str>>,
        data: impl Into<Cow<'a, [f64]>>,
    ) -> Self {
        Self::tensor(name, unit, 1, data)
    }

    /// Some reals per point: a tensor, as its components stand in the data.
    pub fn tensor(
        name: impl Into<Cow<'a, str>>,
        unit: impl Into<Cow<'a, str>>,
        components: usize,
        data: impl Into<Cow<'a, [f64]>>,
    ) -> Self {
        Self {
            name: name.into(),
            unit: unit.into(),
            location: Location::Point,
            components,
            data: FieldValues::F64(data.into()),
        }
    }

    /// One identity per point.
    pub fn integer(name: impl Into<Cow<'a, str>>, data: impl Into<Cow<'a, [u32]>>) -> Self {
        Self {
            data: FieldValues::U32(data.into()),
            ..Self::scalar(name, "", &[][..])
        }
    }

    /// The same values understood as belonging to cells.
    pub fn at_cells(mut self) -> Self {
        self.location = Location::Cell;
        self
    }
}

impl Cells<'_> {
    /// Number of cells over `points` points.
    pub fn len(&self, points: usize) -> usize {
        match self.corners() {
            (_, 1, _) => points,
            (_, each, all) => all.len() / each,
        }
    }

    /// VTK's number of the type, the number of corners of a cell, and the corners of all cells in turn; those of
    /// vertices are not kept.
    pub(crate) fn corners(&self) -> (u8, usize, &[u32]) {
        match self {
            Self::Vertices => (1, 1, &[]),
            Self::Segments(cells) => (3, 2, cells.as_flattened()),
            Self::Triangles(cells) => (5, 3, cells.as_flattened()),
            Self::Tetrahedra(cells) => (10, 4, cells.as_flattened()),
        }
    }
}

impl Piece<'_> {
    /// The contradiction between parts, in words; `Ok` if the piece can be written.
    pub(crate) fn check(&self) -> Result<(), String> {
        let points = self.points.len();
        let cells = self.cells.len(points);
        let piece = &self.name;
        let (_, _, corners) = self.cells.corners();
        if let Some(last) = corners.iter().max().filter(|&&p| p as usize >= points) {
            return Err(format!(
                "a cell of piece `{piece}` uses point {last} but there are only {points} points"
            ));
        }
        for (i, field) in self.fields.iter().enumerate() {
            let name = &field.name;
            if name.is_empty() {
                return Err(format!("field {i} of piece `{piece}` has no name"));
            }
            let twin = |f: &FieldData| f.name == *name && f.location == field.location;
            if self.fields[..i].iter().any(twin) {
                return Err(format!("piece `{piece}` has two fields named `{name}`"));
            }
            let at_points = field.location == Location::Point;
            let tuples = if at_points { points } else { cells };
            let (found, per) = (field.data.len(), field.components);
            if per == 0 || tuples.checked_mul(per) != Some(found) {
                let wanted = format!("expected {tuples} tuples of {per}");
                return Err(format!(
                    "field `{name}` of piece `{piece}` holds {found} numbers, {wanted}"
                ));
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn piece(cells: Cells<'static>, fields: Vec<FieldData<'static>>) -> Piece<'static> {
        Piece {
            name: "fluid".into(),
            points: vec![[0.0; 3]; 3].into(),
            cells,
            fields,
        }
    }

    #[test]
    fn misfits_are_named() {
        let short = FieldData::scalar("pressure", "Pa", vec![0.0; 2]);
        let said = piece(Cells::Vertices, vec![short]).check().unwrap_err();
        let named = said.contains("`pressure`") && said.contains("3 tuples");
        assert!(named, "{said}");

        let id = FieldData::integer("id", vec![1, 2, 3]);
        let said = piece(Cells::Vertices, vec![id.clone(), id]).check();
        assert!(said.unwrap_err().contains("two fields"));

        let outside = Cells::Segments(vec![[0, 3]].into());
        let said = piece(outside, vec![]).check().unwrap_err();
        assert!(said.contains("point 3"), "{said}");
    }
}
