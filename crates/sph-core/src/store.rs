//! Columns by name: the fields that this run needs and no other.

use std::borrow::Cow;

use crate::field::{AnyField, Column};
use crate::field_list::Columns;
use crate::watch::Watch;
use crate::{Access, Field, FieldError, FieldList, Kind, StepError, Vect};

/// Treatment of a column over a time step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Carries history: sorted with the particles, written to checkpoints.
    State,
    /// Computed anew at every evaluation.
    Derived,
}

#[derive(Clone)]
pub(crate) struct Entry<const D: usize> {
    pub field: AnyField,
    pub role: Role,
    pub column: Column<D>,
}

impl<const D: usize> Entry<D> {
    /// The entries of these slots, in this order.
    pub fn picked(&self, slots: &[u32]) -> Column<D> {
        let mut picked = self.field.shape.column(0);
        picked.copy(&self.column, Some(slots));
        picked
    }

    /// Overwrites its column with that of another entry, or with its entries in some places.
    ///
    /// # Errors
    /// If the other has another type.
    pub fn copy(&mut self, from: &Self, places: Option<&[u32]>) -> Result<(), FieldError> {
        let same = self.column.copy(&from.column, places);
        same.then_some(()).ok_or(FieldError::Type(self.field.name))
    }
}

/// The columns of one set of particles.
#[derive(Default)]
pub struct Store<const D: usize> {
    pub(crate) len: usize,
    pub(crate) entries: Vec<Entry<D>>,
    /// Particles taken out so far, by outlet and phase.
    pub removed: Vec<Removed>,
    /// Particles born so far.
    pub inserted: Inserted,
    pub(crate) watch: Watch,
    /// A column of each type to sort into: allocated when particles of such a column are first sorted.
    pub(crate) spare: Vec<Column<D>>,
}

/// Particles of one phase that one outlet has taken out of a store.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Removed {
    /// Number of the outlet.
    pub outlet: u32,
    /// Number of the phase.
    pub phase: u32,
    /// Mass, kg (per metre of depth in 2D).
    pub mass: f64,
    /// Number of particles.
    pub particles: u64,
}

/// Particles that came into a store after the start.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Inserted {
    /// Identities that were given so far, those of the start included: none of them is given again.
    pub identities: u32,
    /// Mass that came in after the start, kg (per metre of depth in two dimensions).
    pub mass: f64,
    /// Particles that came in after the start.
    pub particles: u64,
}

/// A column as plain numbers, for files.
#[derive(Clone, Debug)]
pub enum Plain<'a> {
    /// Reals, `components` per particle.
    Real(Cow<'a, [f64]>),
    /// Unsigned integers.
    Index(&'a [u32]),
}

impl<const D: usize> Columns<D> for Store<D> {
    fn column<K: Kind>(&self, field: Field<K>) -> Result<&[K::Item<D>], FieldError> {
        self.get(field)
    }
}

impl<const D: usize> Store<D> {
    /// An empty store for `len` particles.
    pub fn new(len: usize) -> Self {
        Store {
            len,
            ..Store::default()
        }
    }

    /// Holds the following work to the columns of all that is `declared`, in builds with debug assertions alone;
    /// several may be at work within each other.
    pub fn watch<'a>(&self, declared: impl IntoIterator<Item = &'a Access>) {
        if cfg!(debug_assertions) {
            self.watch.begin(declared);
        }
    }

    /// Ends the last [`watch`](Self::watch), of the work called `name`.
    ///
    /// # Errors
    /// If it touched a column that it had not declared.
    pub fn unwatch(&self, name: impl FnOnce() -> String) -> Result<(), StepError> {
        if !cfg!(debug_assertions) {
            return Ok(());
        }
        let undeclared = self.watch.end().join(" and ");
        match undeclared.is_empty() {
            true => Ok(()),
            false => {
                let why = format!("it {undeclared} without declaring it");
                Err(StepError::stage(name(), why))
            }
        }
    }

    pub(crate) fn entry(&self, name: &'static str) -> Result<&Entry<D>, FieldError> {
        let found = self.entries.iter().find(|e| e.field.name == name);
        found.ok_or(FieldError::Missing(name))
    }

    fn column_mut(&mut self, name: &'static str) -> Result<&mut Column<D>, FieldError> {
        let found = self.entries.iter_mut().find(|e| e.field.name == name);
        Ok(&mut found.ok_or(FieldError::Missing(name))?.column)
    }

    /// Number of particles.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Cuts or lengthens all columns; new entries are zeros.
    pub fn set_len(&mut self, len: usize) {
        self.entries.iter_mut().for_each(|e| e.column.resize(len));
        self.len = len;
    }

    /// True if there is no particle.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// Allocates a column of zeros unless it is there; a state column stays one.
    pub fn add<K: Kind>(&mut self, field: Field<K>, role: Role) {
        self.add_any(field.any(), role);
    }

    /// The same for a field whose type is forgotten.
    pub fn add_any(&mut self, field: AnyField, role: Role) {
        match self.entries.iter_mut().find(|e| e.field == field) {
            Some(entry) if role == Role::State => entry.role = Role::State,
            Some(_) => {}
            None => self.entries.push(Entry {
                field,
                role,
                column: field.shape.column(self.len),
            }),
        }
    }

    /// True if a column of that name is allocated.
    pub fn has(&self, name: &str) -> bool {
        self.entries.iter().any(|e| e.field.name == name)
    }

    /// The entries of a column.
    ///
    /// # Errors
    /// If the column was not declared, or it has another type; as everywhere below.
    pub fn get<K: Kind>(&self, field: Field<K>) -> Result<&[K::Item<D>], FieldError> {
        let found = self.unwatched(field)?;
        self.watch.read(field.name);
        Ok(found)
    }

    /// The entries of the columns of several fields in a tuple.
    pub fn all<F: FieldList>(&self, fields: F) -> Result<F::Items<'_, D>, FieldError> {
        fields.items(self)
    }

    /// The entries of a column for the division of a flow, which no work declares.
    pub fn unwatched<K: Kind>(&self, field: Field<K>) -> Result<&[K::Item<D>], FieldError> {
        let items = K::items(&self.entry(field.name)?.column);
        items.map(Vec::as_slice).ok_or(FieldError::Type(field.name))
    }

    /// The entries of a column, to be changed.
    pub fn get_mut<K: Kind>(
        &mut self,
        field: Field<K>,
    ) -> Result<&mut Vec<K::Item<D>>, FieldError> {
        if self.has(field.name) {
            self.watch.write(field.name);
        }
        K::items_mut(self.column_mut(field.name)?).ok_or(FieldError::Type(field.name))
    }

    /// Takes a column out so that it can be written while others are read.
    pub fn take<K: Kind>(&mut self, field: Field<K>) -> Result<Vec<K::Item<D>>, FieldError> {
        self.get_mut(field).map(std::mem::take)
    }

    /// Puts a taken column back.
    ///
    /// # Errors
    /// If, besides, the length has changed, as below.
    pub fn put<K: Kind>(
        &mut self,
        field: Field<K>,
        items: Vec<K::Item<D>>,
    ) -> Result<(), FieldError> {
        if items.len() != self.len {
            return Err(FieldError::Length(field.name, items.len(), self.len));
        }
        *self.get_mut(field)? = items;
        Ok(())
    }

    /// Sorts all columns of a role: entry `k` becomes the old entry `order[k]`. Derived ones are mostly left as they are,
    /// to be computed anew.
    pub fn permute(&mut self, role: Role, order: &[u32]) {
        for entry in self.entries.iter_mut().filter(|e| e.role == role) {
            let spare = &mut self.spare;
            let place = (0..spare.len()).find(|k| spare[*k].copy(&entry.column, Some(order)));
            let place = place.unwrap_or_else(|| {
                spare.push(entry.picked(order));
                spare.len() - 1
            });
            std::mem::swap(&mut entry.column, &mut spare[place]);
        }
    }

    /// The fields that have a column, in order of allocation.
    pub fn fields(&self) -> impl Iterator<Item = AnyField> {
        self.entries.iter().map(|e| e.field)
    }

    /// Name, unit, role, components and numbers of every column, in order of allocation.
    pub fn columns(
        &self,
    ) -> impl Iterator<Item = (&'static str, &'static str, Role, usize, Plain<'_>)> {
        self.entries.iter().map(|e| {
            let (components, plain) = match &e.column {
                Column::Scalar(v) => (1, Plain::Real(Cow::Borrowed(v.as_slice()))),
                Column::Vector(v) => (D, Plain::Real(v.iter().flatten().copied().collect())),
                Column::Index(v) => (1, Plain::Index(v.as_slice())),
                Column::Tensor(v) => {
                    // Row by row, while nalgebra keeps columns.
                    let rows = v
                        .iter()
                        .flat_map(|g| (0..D * D).map(move |k| g[(k / D, k % D)]));
                    (D * D, Plain::Real(rows.collect()))
                }
                Column::SymmetricTensor(v) => {
                    (6, Plain::Real(v.iter().flat_map(|t| t.0).collect()))
                }
            };
            (e.field.name, e.field.unit, e.role, components, plain)
        })
    }

    /// Overwrites a column by name with plain reals.
    pub fn set_real(&mut self, name: &'static str, values: &[f64]) -> Result<(), FieldError> {
        let len = self.len;
        match self.column_mut(name)? {
            Column::Scalar(v) if values.len() == len => v.copy_from_slice(values),
            Column::Vector(v) if values.len() == D * len => {
                for (item, chunk) in v.iter_mut().zip(values.chunks_exact(D)) {
                    *item = Vect::from_column_slice(chunk);
                }
            }
            Column::Tensor(v) if values.len() == D * D * len => {
                for (item, chunk) in v.iter_mut().zip(values.chunks_exact(D * D)) {
                    *item = nalgebra::SMatrix::from_row_slice(chunk);
                }
            }
            Column::SymmetricTensor(v) if values.len() == 6 * len => {
                for (item, chunk) in v.iter_mut().zip(values.chunks_exact(6)) {
                    item.0.copy_from_slice(chunk);
                }
            }
            Column::Index(_) => return Err(FieldError::Type(name)),
            _ => return Err(FieldError::Length(name, values.len(), len)),
        }
        Ok(())
    }

    /// Overwrites a column by name with unsigned integers.
    pub fn set_index(&mut self, name: &'static str, values: &[u32]) -> Result<(), FieldError> {
        let len = self.len;
        match self.column_mut(name)? {
            Column::Index(v) if values.len() == len => v.copy_from_slice(values),
            Column::Index(_) => return Err(FieldError::Length(name, values.len(), len)),
            _ => return Err(FieldError::Type(name)),
        }
        Ok(())
    }

    /// Bytes of one particle over all columns.
    pub fn bytes_per_particle(&self) -> usize {
        self.parcel_bytes(|_| true)
    }
}
