//! One output time as plain data: points, cells and named fields.
//!
//! Everything may be borrowed, so that writing copies nothing that the solver
//! already holds in the right shape.

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
    /// Number of values.
    pub fn len(&self) -> usize {
        match self {
            Self::F64(v) => v.len(),
            Self::U32(v) => v.len(),
            Self::I64(v) => v.len(),
        }
    }

    /// True if there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

impl<'a> FieldData<'a> {
    /// One real per point.
    pub fn scalar(
        name: impl Into<Cow<'a, str>>,
        unit: impl Into<Cow<'a, str>>,
        data: impl Into<Cow<'a, [f64]>>,
    ) -> Self {
        Self::new(name, unit, 1, FieldValues::F64(data.into()))
    }

    /// Three reals per point.
    pub fn vector(
        name: impl Into<Cow<'a, str>>,
        unit: impl Into<Cow<'a, str>>,
        data: &'a [[f64; 3]],
    ) -> Self {
        Self::new(name, unit, 3, FieldValues::F64(data.as_flattened().into()))
    }

    /// Two reals per point, padded with a zero: ParaView takes vectors of three.
    pub fn planar_vector(
        name: impl Into<Cow<'a, str>>,
        unit: impl Into<Cow<'a, str>>,
        data: &[[f64; 2]],
    ) -> Self {
        let padded: Vec<f64> = data.iter().flat_map(|v| [v[0], v[1], 0.0]).collect();
        Self::new(name, unit, 3, FieldValues::F64(padded.into()))
    }

    /// Some reals per point: a tensor, as its components stand in the data.
    pub fn tensor(
        name: impl Into<Cow<'a, str>>,
        unit: impl Into<Cow<'a, str>>,
        components: usize,
        data: impl Into<Cow<'a, [f64]>>,
    ) -> Self {
        Self::new(name, unit, components, FieldValues::F64(data.into()))
    }

    /// One identity per point.
    pub fn integer(name: impl Into<Cow<'a, str>>, data: impl Into<Cow<'a, [u32]>>) -> Self {
        Self::new(name, "", 1, FieldValues::U32(data.into()))
    }

    /// The same values understood as belonging to cells.
    pub fn at_cells(mut self) -> Self {
        self.location = Location::Cell;
        self
    }

    fn new(
        name: impl Into<Cow<'a, str>>,
        unit: impl Into<Cow<'a, str>>,
        components: usize,
        data: FieldValues<'a>,
    ) -> Self {
        Self {
            name: name.into(),
            unit: unit.into(),
            location: Location::Point,
            components,
            data,
        }
    }
}

impl Cells<'_> {
    /// Number of cells over `points` points.
    pub fn len(&self, points: usize) -> usize {
        match self {
            Self::Vertices => points,
            Self::Segments(cells) => cells.len(),
            Self::Triangles(cells) => cells.len(),
            Self::Tetrahedra(cells) => cells.len(),
        }
    }

    /// The largest point number used.
    fn last_point(&self) -> Option<u32> {
        match self {
            Self::Vertices => None,
            Self::Segments(cells) => cells.as_flattened().iter().max().copied(),
            Self::Triangles(cells) => cells.as_flattened().iter().max().copied(),
            Self::Tetrahedra(cells) => cells.as_flattened().iter().max().copied(),
        }
    }
}

impl Piece<'_> {
    /// The contradiction between parts, in words; `Ok` if the piece can be written.
    pub(crate) fn check(&self) -> Result<(), String> {
        let points = self.points.len();
        let cells = self.cells.len(points);
        let piece = &self.name;
        if let Some(last) = self.cells.last_point().filter(|&p| p as usize >= points) {
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
            let tuples = match field.location {
                Location::Point => points,
                Location::Cell => cells,
            };
            let (found, per) = (field.data.len(), field.components);
            if per == 0 || tuples.checked_mul(per) != Some(found) {
                return Err(format!(
                    "field `{name}` of piece `{piece}` holds {found} numbers, \
                     expected {tuples} tuples of {per}"
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
        assert!(
            said.contains("`pressure`") && said.contains("3 tuples"),
            "{said}"
        );

        let id = FieldData::integer("id", vec![1, 2, 3]);
        let said = piece(Cells::Vertices, vec![id.clone(), id]).check();
        assert!(said.unwrap_err().contains("two fields"));

        let outside = Cells::Segments(vec![[0, 3]].into());
        let said = piece(outside, vec![]).check().unwrap_err();
        assert!(said.contains("point 3"), "{said}");
    }

    #[test]
    fn planar_vectors_get_a_third_component() {
        let field = FieldData::planar_vector("velocity", "m/s", &[[1.0, 2.0], [3.0, 4.0]]);
        let FieldValues::F64(data) = &field.data else {
            panic!("reals expected")
        };
        assert_eq!(data[..], [1.0, 2.0, 0.0, 3.0, 4.0, 0.0]);
    }
}
