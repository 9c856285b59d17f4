//! Several fields at a time.

use crate::field::AnyField;
use crate::{Field, FieldError, Kind};

/// A holder of columns.
pub trait Columns<const D: usize> {
    /// The entries of a column.
    ///
    /// # Errors
    /// If the column was not declared, or it has another type; as everywhere below.
    fn column<K: Kind>(&self, field: Field<K>) -> Result<&[K::Item<D>], FieldError>;
}

/// A field, a tuple of lists of fields, or a list that may be left out.
pub trait FieldList {
    /// The entries of their columns.
    type Items<'a, const D: usize>;
    /// Calls `each` for every field, in order.
    fn for_each(self, each: impl FnMut(AnyField));
    /// Looks their columns up, in the same order.
    fn items<const D: usize>(
        self,
        columns: &impl Columns<D>,
    ) -> Result<Self::Items<'_, D>, FieldError>;
}

impl<K: Kind> FieldList for Field<K> {
    type Items<'a, const D: usize> = &'a [K::Item<D>];
    fn for_each(self, mut each: impl FnMut(AnyField)) {
        each(self.any());
    }
    fn items<const D: usize>(
        self,
        columns: &impl Columns<D>,
    ) -> Result<Self::Items<'_, D>, FieldError> {
        columns.column(self)
    }
}

impl<F: FieldList> FieldList for Option<F> {
    type Items<'a, const D: usize> = Option<F::Items<'a, D>>;
    fn for_each(self, each: impl FnMut(AnyField)) {
        if let Some(fields) = self {
            fields.for_each(each);
        }
    }
    fn items<const D: usize>(
        self,
        columns: &impl Columns<D>,
    ) -> Result<Self::Items<'_, D>, FieldError> {
        self.map(|fields| fields.items(columns)).transpose()
    }
}

macro_rules! tuple {
    ($($kind:ident $field:ident),+) => {
        impl<$($kind: FieldList),+> FieldList for ($($kind),+) {
            type Items<'a, const D: usize> = ($($kind::Items<'a, D>),+);
            fn for_each(self, mut each: impl FnMut(AnyField)) {
                let ($($field),+) = self;
                $($field.for_each(&mut each);)+
            }
            fn items<const D: usize>(
                self,
                columns: &impl Columns<D>,
            ) -> Result<Self::Items<'_, D>, FieldError> {
                let ($($field),+) = self;
                Ok(($($field.items(columns)?),+))
            }
        }
    };
}

tuple!(A a, B b);
tuple!(A a, B b, C c);
tuple!(A a, B b, C c, H h);
