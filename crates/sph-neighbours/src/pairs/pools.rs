//! Buffers of the walks over lists, and of their construction.

use std::ops::Range;

use sph_core::{Pool, Vect};

use crate::pairs::cluster::Buffers;
use crate::{CellGrid, Rates, Rows};

/// Buffers of the tasks that walk over lists, and of those that build them.
#[derive(Default)]
pub(crate) struct Pools<const D: usize> {
    pub sweeps: Pool<(Buffers<D>, Vec<Rates<D>>)>,
    /// Rows, with kernel values of free particles and wall points.
    pub walks: Pool<(Rows<D>, [Vec<f64>; 2])>,
    pub numbers: Pool<Vec<f64>>,
    /// Of kernel sums and means, with the candidates within the support.
    pub sums: Pool<(Buffers<D>, Vec<u32>)>,
    pub clusters: Pool<(Vec<u32>, Vec<Range<usize>>)>,
    pub grids: Pool<CellGrid<D>>,
    pub centres: Pool<Vec<Vect<D>>>,
}
