//! One frame with its columns.

use sph_core::{Corners, bounds};

use crate::curves::{Cloud, DrawError, Result};
use crate::{FieldData, FieldValues, Location, Picture, Piece, View};

/// Particles at one time.
pub struct Snapshot {
    pub(crate) piece: Piece<'static>,
    /// Simulated time, s.
    pub time: f64,
    /// Walls in the plane, by their ends, m.
    pub walls: Vec<[[f64; 3]; 2]>,
    /// Distance of particles at the start, m.
    pub spacing: f64,
}

/// The box around points, whose coordinates that are not finite do not count; zero along an axis where there is none.
pub(crate) fn finite_bounds<'p>(points: impl Iterator<Item = &'p [f64; 3]>) -> Corners<3> {
    let finite = |x: f64| if x.is_finite() { x } else { f64::NAN };
    let ends = bounds(points.map(|point| point.map(finite)));
    ends.map(|corner| corner.map(|x| if x.is_finite() { x } else { 0.0 }))
}

/// One number per particle.
pub struct Column {
    /// The request, with spaces and its unit: `velocity x [m/s]`.
    pub label: String,
    /// Unit.
    pub unit: String,
    /// The numbers.
    pub values: Vec<f64>,
}

impl Snapshot {
    /// Positions of the particles, m.
    pub fn points(&self) -> &[[f64; 3]] {
        &self.piece.points
    }

    pub(crate) fn bounds(&self) -> Corners<3> {
        finite_bounds(self.points().iter())
    }

    /// The particles sorted for values between them.
    pub fn cloud(&self) -> Cloud<'_> {
        Cloud::new(self.points(), self.spacing)
    }

    /// Identities of the particles.
    ///
    /// # Errors
    /// If identities were not written.
    pub fn identities(&self) -> Result<Vec<u32>> {
        match &self.field("identity")?.data {
            FieldValues::U32(v) => Ok(v.to_vec()),
            _ => Err(self.missing("identity")),
        }
    }

    /// The three components of the velocity, m/s, particle after particle.
    ///
    /// # Errors
    /// If the velocity was not written.
    pub fn velocity(&self) -> Result<Vec<f64>> {
        let field = self.field("velocity")?;
        match field.components {
            3 => Ok(field.data.reals()),
            _ => Err(self.missing("velocity")),
        }
    }

    /// A field, of vectors and tensors the length; or a component of it, `velocity.x` or `strain.4`. `speed` is there
    /// wherever the velocity is.
    ///
    /// # Errors
    /// If no such field was written, or it has no such component.
    pub fn column(&self, asked: &str) -> Result<Column> {
        let (name, component) = asked.split_once('.').unzip();
        let name = name.unwrap_or(asked);
        let field = match (name, self.field(name)) {
            ("speed", Err(_)) => self.field("velocity"),
            (_, found) => found,
        }?;
        let all = field.data.reals();
        let per = field.components;
        let one = |component: &str| {
            let axis = ["x", "y", "z"].iter().position(|a| *a == component);
            let place = axis.or_else(|| component.parse().ok());
            let none = || format!("`{name}` has {per} components, and no `{component}`");
            let place = place.filter(|k| *k < per);
            place.ok_or_else(|| DrawError::Unfit(none()))
        };
        let values = match component.map(one).transpose()? {
            Some(k) => all.chunks(per).map(|c| c[k]).collect(),
            None if per == 1 => all,
            None => {
                let size = |c: &[f64]| c.iter().map(|x| x * x).sum::<f64>().sqrt();
                all.chunks(per).map(size).collect()
            }
        };
        let (unit, name) = (field.unit.to_string(), asked.replace(['_', '.'], " "));
        let label = match unit.as_str() {
            "1" | "" => name,
            unit => format!("{name} [{unit}]"),
        };
        Ok(Column {
            label,
            unit,
            values,
        })
    }

    fn field(&self, name: &str) -> Result<&FieldData<'static>> {
        let at_points = |f: &&FieldData| f.name == name && f.location == Location::Point;
        let found = self.piece.fields.iter().find(at_points);
        found.ok_or_else(|| self.missing(name))
    }

    fn missing(&self, name: &str) -> DrawError {
        let known: Vec<&str> = self.piece.fields.iter().map(|f| f.name.as_ref()).collect();
        DrawError::Unfit(format!(
            "no field `{name}` was written (there are: {}); name it in output.fields and run again",
            known.join(", ")
        ))
    }

    /// The picture of points with values between the walls, to be completed.
    pub(crate) fn picture<'a>(&'a self, points: &'a [[f64; 3]], values: &'a [f64]) -> Picture<'a> {
        let planar = self.points().iter().all(|p| p[2] == 0.0);
        Picture {
            time: Some(self.time),
            diameter: self.spacing,
            walls: &self.walls,
            view: if planar { View::Plane } else { View::Front },
            ..Picture::new(points, values)
        }
    }
}
