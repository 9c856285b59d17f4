//! Fields: a name, a unit, a meaning, and the type of one entry.

use nalgebra::SMatrix;

use crate::{Symmetric, Vect};

/// One real number per particle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Scalar;

/// One vector of D components per particle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Vector;

/// One unsigned integer per particle (identity, phase).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Index;

/// One D × D tensor per particle (a velocity gradient).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tensor;

/// One symmetric tensor in space per particle, for any D (a stress in plane strain has a component out of the plane).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SymmetricTensor;

/// A column of one of the supported types.
#[derive(Clone, Debug, PartialEq)]
pub enum Column<const D: usize> {
    Scalar(Vec<f64>),
    Vector(Vec<Vect<D>>),
    Index(Vec<u32>),
    Tensor(Vec<SMatrix<f64, D, D>>),
    SymmetricTensor(Vec<Symmetric>),
}

impl<const D: usize> Column<D> {
    /// Number of entries, and bytes of each.
    pub(crate) fn size(&self) -> [usize; 2] {
        fn size<T>(items: &[T]) -> [usize; 2] {
            [items.len(), size_of::<T>()]
        }
        match self {
            Column::Scalar(items) => size(items),
            Column::Vector(items) => size(items),
            Column::Index(items) => size(items),
            Column::Tensor(items) => size(items),
            Column::SymmetricTensor(items) => size(items),
        }
    }

    /// The entries of these slots, in this order.
    pub(crate) fn picked(&self, slots: &[u32]) -> Self {
        fn pick<T: Copy>(items: &[T], slots: &[u32]) -> Vec<T> {
            slots.iter().map(|s| items[*s as usize]).collect()
        }
        match self {
            Column::Scalar(items) => Column::Scalar(pick(items, slots)),
            Column::Vector(items) => Column::Vector(pick(items, slots)),
            Column::Index(items) => Column::Index(pick(items, slots)),
            Column::Tensor(items) => Column::Tensor(pick(items, slots)),
            Column::SymmetricTensor(items) => Column::SymmetricTensor(pick(items, slots)),
        }
    }

    /// Cuts or lengthens it; new entries are zeros.
    pub(crate) fn resize(&mut self, n: usize) {
        match self {
            Column::Scalar(items) => items.resize(n, 0.0),
            Column::Vector(items) => items.resize(n, Vect::zeros()),
            Column::Index(items) => items.resize(n, 0),
            Column::Tensor(items) => items.resize(n, SMatrix::zeros()),
            Column::SymmetricTensor(items) => items.resize(n, Symmetric::ZERO),
        }
    }
}

/// The type of a field's entries.
pub trait Kind: Copy + 'static {
    /// One entry of the column in D dimensions.
    type Item<const D: usize>: Copy + Send + Sync + std::fmt::Debug + 'static;
    /// A column of `n` zero entries.
    fn column<const D: usize>(n: usize) -> Column<D>;
    /// The entries, if the column has this type.
    fn items<const D: usize>(column: &Column<D>) -> Option<&Vec<Self::Item<D>>>;
    /// The entries, if the column has this type.
    fn items_mut<const D: usize>(column: &mut Column<D>) -> Option<&mut Vec<Self::Item<D>>>;
    /// Real components per entry in D dimensions.
    fn components(dimension: usize) -> usize;
    /// The type as a value.
    const SHAPE: Shape;
}

/// The type of a column as a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// Reals.
    Scalar,
    /// Vectors.
    Vector,
    /// Unsigned integers.
    Index,
    /// D × D tensors.
    Tensor,
    /// Symmetric tensors in space.
    SymmetricTensor,
}

impl Shape {
    /// A column of `n` zero entries.
    pub fn column<const D: usize>(self, n: usize) -> Column<D> {
        match self {
            Shape::Scalar => Scalar::column(n),
            Shape::Vector => Vector::column(n),
            Shape::Index => Index::column(n),
            Shape::Tensor => Tensor::column(n),
            Shape::SymmetricTensor => SymmetricTensor::column(n),
        }
    }
}

macro_rules! kind {
    ($kind:ident, $item:ty, $zero:expr, $components:expr) => {
        impl Kind for $kind {
            type Item<const D: usize> = $item;
            fn column<const D: usize>(n: usize) -> Column<D> {
                Column::$kind(vec![$zero; n])
            }
            fn items<const D: usize>(column: &Column<D>) -> Option<&Vec<Self::Item<D>>> {
                match column {
                    Column::$kind(items) => Some(items),
                    _ => None,
                }
            }
            fn items_mut<const D: usize>(
                column: &mut Column<D>,
            ) -> Option<&mut Vec<Self::Item<D>>> {
                match column {
                    Column::$kind(items) => Some(items),
                    _ => None,
                }
            }
            const SHAPE: Shape = Shape::$kind;
            fn components(dimension: usize) -> usize {
                let components: fn(usize) -> usize = $components;
                components(dimension)
            }
        }
    };
}
kind!(Scalar, f64, 0.0, |_| 1);
kind!(Vector, Vect<D>, Vect::<D>::zeros(), |d| d);
kind!(Index, u32, 0, |_| 1);
kind!(Tensor, SMatrix<f64, D, D>, SMatrix::<f64, D, D>::zeros(), |d| d * d);
kind!(SymmetricTensor, Symmetric, Symmetric::ZERO, |_| 6);

/// A typed name for a column: `Field<Scalar>`, `Field<Vector>` and so on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Field<K> {
    /// Name in scene files, VTK arrays and the book.
    pub name: &'static str,
    /// SI unit, "1" where there is none.
    pub unit: &'static str,
    /// One sentence.
    pub meaning: &'static str,
    kind: std::marker::PhantomData<K>,
}

impl<K: Kind> Field<K> {
    /// Names a field.
    pub const fn new(name: &'static str, unit: &'static str, meaning: &'static str) -> Self {
        Field {
            name,
            unit,
            meaning,
            kind: std::marker::PhantomData,
        }
    }

    /// Drops the type, for declarations and listings.
    pub const fn any(self) -> AnyField {
        AnyField {
            name: self.name,
            unit: self.unit,
            meaning: self.meaning,
            components: K::components,
            shape: K::SHAPE,
        }
    }
}

/// A field whose type is forgotten; compared by name.
#[derive(Clone, Copy, Debug)]
pub struct AnyField {
    /// Name in scene files, VTK arrays and the book.
    pub name: &'static str,
    /// SI unit.
    pub unit: &'static str,
    /// One sentence.
    pub meaning: &'static str,
    /// Real components per entry in the given dimension.
    pub components: fn(usize) -> usize,
    /// Type of the column.
    pub shape: Shape,
}

/// A unit behind a number: with a space before it, and nothing for pure numbers.
pub fn unit_suffix(unit: &str) -> String {
    some_unit(unit).map_or(String::new(), |unit| format!(" {unit}"))
}

/// The unit, unless it is that of pure numbers.
pub fn some_unit(unit: &str) -> Option<&str> {
    Some(unit).filter(|unit| !["", "1"].contains(unit))
}

impl AnyField {
    /// As a scalar field; a store refuses it if its column is none.
    pub fn scalar(self) -> Field<Scalar> {
        Field::new(self.name, self.unit, self.meaning)
    }

    /// As a vector field; a store refuses it if its column is none.
    pub fn vector(self) -> Field<Vector> {
        Field::new(self.name, self.unit, self.meaning)
    }
}

impl PartialEq for AnyField {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}
