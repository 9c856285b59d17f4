//! Both triangular solves with a supernodal factor.
//!
//! faer's own go through its products of matrices; for one right side the columns are passed over here, four at a time.

use faer::sparse::linalg::cholesky::supernodal::SymbolicSupernodalCholesky;

/// Columns that are passed over together.
const TOGETHER: usize = 4;
/// Sums of a product that go side by side.
const LANES: usize = 4;

/// The columns of a supernode: a lower triangle, and below it the rows that are named.
struct Node<'a> {
    begin: usize,
    width: usize,
    /// Column by column, triangle and rows below.
    values: &'a [f64],
    below: &'a [u32],
}

impl<'a> Node<'a> {
    fn new(symbolic: &'a SymbolicSupernodalCholesky<u32>, values: &'a [f64], s: usize) -> Self {
        let [begin, end] = [symbolic.supernode_begin()[s], symbolic.supernode_end()[s]];
        let starts = symbolic.col_ptr_for_val();
        let range = starts[s] as usize..starts[s + 1] as usize;
        Self {
            begin: begin as usize,
            width: (end - begin) as usize,
            values: &values[range],
            below: symbolic.supernode(s).pattern(),
        }
    }

    fn column(&self, j: usize) -> (&'a [f64], &'a [f64]) {
        let rows = self.width + self.below.len();
        self.values[j * rows..][..rows].split_at(self.width)
    }

    /// Finds the unknowns of the node, and subtracts their effect on those below from the right side.
    fn forward(&self, x: &mut [f64], sums: &mut [f64]) {
        let own = &mut x[self.begin..][..self.width];
        for j in 0..self.width {
            let (triangle, _) = self.column(j);
            let value = own[j] / triangle[j];
            own[j] = value;
            for (y, l) in own[j + 1..].iter_mut().zip(&triangle[j + 1..]) {
                *y -= l * value;
            }
        }
        let sums = &mut sums[..self.below.len()];
        sums.fill(0.0);
        let whole = self.width - self.width % TOGETHER;
        for j in (0..whole).step_by(TOGETHER) {
            let columns: [_; TOGETHER] = std::array::from_fn(|k| self.column(j + k).1);
            add_all(columns, std::array::from_fn(|k| own[j + k]), sums);
        }
        for (j, known) in own.iter().enumerate().skip(whole) {
            add(self.column(j).1, *known, sums);
        }
        for (row, sum) in self.below.iter().zip(sums) {
            x[*row as usize] -= *sum;
        }
    }

    /// Finds the unknowns of the node from those below.
    fn backward(&self, x: &mut [f64], known: &mut [f64]) {
        let known = &mut known[..self.below.len()];
        for (value, row) in known.iter_mut().zip(self.below) {
            *value = x[*row as usize];
        }
        let own = &mut x[self.begin..][..self.width];
        let whole = self.width - self.width % TOGETHER;
        for j in (0..whole).step_by(TOGETHER) {
            let columns: [_; TOGETHER] = std::array::from_fn(|k| self.column(j + k).1);
            let products = products(columns, known);
            own[j..].iter_mut().zip(products).for_each(|(y, p)| *y -= p);
        }
        for (j, value) in own.iter_mut().enumerate().skip(whole) {
            let [product] = products([self.column(j).1], known);
            *value -= product;
        }
        for j in (0..self.width).rev() {
            let (triangle, _) = self.column(j);
            let [product] = products([&triangle[j + 1..]], &own[j + 1..]);
            own[j] = (own[j] - product) / triangle[j];
        }
    }
}

/// Adds a column times a factor.
fn add(column: &[f64], factor: f64, sums: &mut [f64]) {
    for (sum, l) in sums.iter_mut().zip(column) {
        *sum += l * factor;
    }
}

/// Adds four columns times their factors.
fn add_all([a, b, c, d]: [&[f64]; TOGETHER], [p, q, r, s]: [f64; TOGETHER], sums: &mut [f64]) {
    for ((((sum, a), b), c), d) in sums.iter_mut().zip(a).zip(b).zip(c).zip(d) {
        *sum += a * p + b * q + c * r + d * s;
    }
}

/// Scalar products of columns with a vector.
fn products<const N: usize>(columns: [&[f64]; N], vector: &[f64]) -> [f64; N] {
    let mut sums = [[0.0; LANES]; N];
    let mut chunks = columns.map(|c| c.chunks_exact(LANES));
    let parts = vector.chunks_exact(LANES);
    let rest = parts.remainder();
    for part in parts {
        for (sum, chunks) in sums.iter_mut().zip(&mut chunks) {
            let column = chunks.next().unwrap_or_default();
            for ((s, l), x) in sum.iter_mut().zip(column).zip(part) {
                *s += l * x;
            }
        }
    }
    let mut products = sums.map(|sum| sum.iter().sum::<f64>());
    for (product, column) in products.iter_mut().zip(columns) {
        let last = &column[vector.len() - rest.len()..];
        *product += last.iter().zip(rest).map(|(l, x)| l * x).sum::<f64>();
    }
    products
}

/// Solves L Lᵀ x = b in the order of elimination; x holds b at first. `room` is memory that is used again.
pub fn solve(
    symbolic: &SymbolicSupernodalCholesky<u32>,
    values: &[f64],
    x: &mut [f64],
    room: &mut Vec<f64>,
) {
    let nodes = || (0..symbolic.n_supernodes()).map(|s| Node::new(symbolic, values, s));
    room.resize(x.len(), 0.0);
    for node in nodes() {
        node.forward(x, room);
    }
    for node in nodes().rev() {
        node.backward(x, room);
    }
}
