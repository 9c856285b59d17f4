//! Fields: a name, a unit, a meaning, and the type of one entry.

use nalgebra::SMatrix;

use crate::{Symmetric, Vect};

/// The types of columns: as a column, as a value, and as a name for columns of the type.
macro_rules! types {
    ($($(#[$doc:meta])+ $kind:ident: $item:ty;)+) => {
        /// A column of one of the supported types.
        #[derive(Clone, Debug, PartialEq)]
        pub enum Column<const D: usize> {
            $($kind(Vec<$item>),)+
        }

        /// The type of a column as a value.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Shape {
            $($(#[$doc])+ $kind,)+
        }

        impl Shape {
            /// A column of `n` zero entries.
            pub fn column<const D: usize>(self, n: usize) -> Column<D> {
                match self {
                    $(Shape::$kind => Column::$kind(vec![Item::zero(); n]),)+
                }
            }
        }

        impl<const D: usize> Column<D> {
            /// Overwrites it with the entries of another column of its type, or with those in some places of the other;
            /// false if the other has another type.
            pub(crate) fn copy(&mut self, from: &Self, places: Option<&[u32]>) -> bool {
                match (self, from) {
                    $((Column::$kind(to), Column::$kind(from)) => put(to, from, places),)+
                    _ => false,
                }
            }
        }

        $(
            $(#[$doc])+
            #[derive(Clone, Copy, Debug, PartialEq, Eq)]
            pub struct $kind;
            impl Kind for $kind {
                type Item<const D: usize> = $item;
                fn items<const D: usize>(column: &Column<D>) -> Option<&Vec<$item>> {
                    match column {
                        Column::$kind(items) => Some(items),
                        _ => None,
                    }
                }
                fn items_mut<const D: usize>(column: &mut Column<D>) -> Option<&mut Vec<$item>> {
                    match column {
                        Column::$kind(items) => Some(items),
                        _ => None,
                    }
                }
                const SHAPE: Shape = Shape::$kind;
            }
        )+
    };
}
types! {
    /// One real number per particle.
    Scalar: f64;
    /// One vector of D components per particle.
    Vector: Vect<D>;
    /// One unsigned integer per particle (identity, phase).
    Index: u32;
    /// One D × D tensor per particle (a velocity gradient).
    Tensor: SMatrix<f64, D, D>;
    /// One symmetric tensor in space per particle, for any D (a stress in plane strain has a component out of the plane).
    SymmetricTensor: Symmetric;
}

fn put<T: Copy>(to: &mut Vec<T>, from: &[T], places: Option<&[u32]>) -> bool {
    to.clear();
    match places {
        None => to.extend_from_slice(from),
        Some(places) => to.extend(places.iter().map(|&p| from[p as usize])),
    }
    true
}

/// The same work on the entries of a column of any type.
macro_rules! each_type {
    ($column:expr, $items:ident => $work:expr) => {
        match $column {
            $crate::field::Column::Scalar($items) => $work,
            $crate::field::Column::Vector($items) => $work,
            $crate::field::Column::Index($items) => $work,
            $crate::field::Column::Tensor($items) => $work,
            $crate::field::Column::SymmetricTensor($items) => $work,
        }
    };
}
pub(crate) use each_type;

/// One entry of a column.
pub(crate) trait Item: Copy {
    fn zero() -> Self;
    /// Writes it behind other bytes.
    fn pack(&self, to: &mut Vec<u8>);
    /// Takes it off a message; zero behind the end.
    fn unpack(from: &mut &[u8]) -> Self;
}

macro_rules! number {
    ($number:ty) => {
        impl Item for $number {
            fn zero() -> Self {
                Default::default()
            }
            fn pack(&self, to: &mut Vec<u8>) {
                to.extend_from_slice(&self.to_le_bytes());
            }
            fn unpack(from: &mut &[u8]) -> Self {
                let bytes = from.split_off(..size_of::<Self>()).unwrap_or_default();
                Self::from_le_bytes(bytes.try_into().unwrap_or_default())
            }
        }
    };
}
number!(f64);
number!(u32);

impl<const R: usize, const C: usize> Item for SMatrix<f64, R, C> {
    fn zero() -> Self {
        SMatrix::zeros()
    }
    fn pack(&self, to: &mut Vec<u8>) {
        self.iter().for_each(|x| x.pack(to));
    }
    fn unpack(from: &mut &[u8]) -> Self {
        SMatrix::from_fn(|_, _| f64::unpack(from))
    }
}

impl Item for Symmetric {
    fn zero() -> Self {
        Symmetric::ZERO
    }
    fn pack(&self, to: &mut Vec<u8>) {
        self.0.iter().for_each(|x| x.pack(to));
    }
    fn unpack(from: &mut &[u8]) -> Self {
        Symmetric(std::array::from_fn(|_| f64::unpack(from)))
    }
}

impl<const D: usize> Column<D> {
    pub(crate) fn size(&self) -> [usize; 2] {
        fn size<T>(items: &[T]) -> [usize; 2] {
            [items.len(), size_of::<T>()]
        }
        each_type!(self, items => size(items))
    }

    pub(crate) fn resize(&mut self, n: usize) {
        each_type!(self, items => items.resize(n, Item::zero()));
    }
}

/// The type of a field's entries.
pub trait Kind: Copy + 'static {
    /// One entry of the column in D dimensions.
    type Item<const D: usize>: Copy + Send + Sync + std::fmt::Debug + 'static;
    /// The entries, if the column has this type.
    fn items<const D: usize>(column: &Column<D>) -> Option<&Vec<Self::Item<D>>>;
    /// The entries, if the column has this type.
    fn items_mut<const D: usize>(column: &mut Column<D>) -> Option<&mut Vec<Self::Item<D>>>;
    /// The type as a value.
    const SHAPE: Shape;
}

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
    /// Type of the column.
    pub shape: Shape,
}

/// A unit behind a number: with a space before it, and nothing for pure numbers.
pub fn unit_suffix(unit: &str) -> String {
    some_unit(unit).map_or(String::new(), |unit| format!(" {unit}"))
}

/// A name with its unit in brackets, which pure numbers lack.
pub fn labelled(name: &str, unit: &str) -> String {
    some_unit(unit).map_or_else(|| name.to_string(), |unit| format!("{name} [{unit}]"))
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
