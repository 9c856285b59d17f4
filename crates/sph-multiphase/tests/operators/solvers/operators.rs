//! Operators that are no matrices: products without entries, rows in two hands.

use std::sync::{Barrier, Mutex};

use sph_core::Vect;
use sph_multiphase::linear::{
    Automatic, Bicgstab, Cholesky, ConjugateGradient, Entries, LinearSolver, Matrix, Operator,
    Pattern, Preconditioner, SolveError,
};
use sph_neighbours::inner;

use super::systems::{apart, dense, right};

/// Rows of one hand.
const ROWS: usize = 40;
const DIAGONAL: f64 = 2.1;

/// What two hands tell each other: the ends of their parts, and sums.
struct Board {
    barrier: Barrier,
    ends: Mutex<[[Vect<2>; 2]; 2]>,
    sums: Mutex<[f64; 2]>,
}

/// Half of a ring of particles, each coupled to the next; the last two rows are copies of the ends of the other half.
struct HalfRing<'b> {
    rank: usize,
    board: &'b Board,
    own: Option<Matrix<2>>,
}

impl Operator<2> for HalfRing<'_> {
    fn rows(&self) -> usize {
        ROWS + 2
    }

    fn import(&self, x: &mut [Vect<2>]) {
        self.board.ends.lock().expect("ends")[self.rank] = [x[0], x[ROWS - 1]];
        self.board.barrier.wait();
        let [first, last] = self.board.ends.lock().expect("ends")[1 - self.rank];
        (x[ROWS], x[ROWS + 1]) = (last, first);
        self.board.barrier.wait();
    }

    fn inner(&self, x: &[Vect<2>], y: &[Vect<2>]) -> f64 {
        self.board.sums.lock().expect("sums")[self.rank] = inner(&x[..ROWS], &y[..ROWS]);
        self.board.barrier.wait();
        let [a, b] = *self.board.sums.lock().expect("sums");
        self.board.barrier.wait();
        a + b
    }

    fn is_whole(&self) -> bool {
        false
    }

    fn multiply(&self, x: &[Vect<2>], y: &mut [Vect<2>]) {
        for (i, y) in y[..ROWS].iter_mut().enumerate() {
            let before = if i == 0 { x[ROWS] } else { x[i - 1] };
            let after = if i + 1 == ROWS { x[ROWS + 1] } else { x[i + 1] };
            *y = x[i] * DIAGONAL - before - after;
        }
        self.import(y);
    }

    fn assembled(&self) -> Option<&Matrix<2>> {
        self.own.as_ref()
    }
}

/// The entries of a chain, or of a ring, and of rows without neighbours after it.
fn chain(rows: u32, closed: bool, alone: usize) -> Matrix<2> {
    let neighbours = |i: u32| {
        let mut row: Vec<u32> = [i.checked_sub(1), (i + 1 < rows).then_some(i + 1)]
            .into_iter()
            .flatten()
            .collect();
        if closed && i == 0 {
            row.push(rows - 1);
        } else if closed && i + 1 == rows {
            row.insert(0, 0);
        }
        row
    };
    let alone = std::iter::repeat_n(Vec::new(), alone);
    let rows: Vec<_> = (0..rows).map(neighbours).chain(alone).collect();
    let others = rows.iter().map(Vec::len).sum();
    let entries = Entries::scalar(vec![DIAGONAL; rows.len()], vec![-1.0; others]);
    Matrix::new(Pattern::from_rows(&rows), entries)
}

/// Solves with two hands at once; each half with its iterations.
fn solved(
    solver: impl Fn() -> Box<dyn LinearSolver<2>> + Sync,
    assembled: bool,
) -> (Vec<Vect<2>>, [usize; 2]) {
    let board = Board {
        barrier: Barrier::new(2),
        ends: Mutex::new([[Vect::zeros(); 2]; 2]),
        sums: Mutex::new([0.0; 2]),
    };
    let b = right(2 * ROWS);
    let half = |rank: usize| {
        let own = assembled.then(|| chain(ROWS as u32, false, 2));
        let half = HalfRing {
            rank,
            board: &board,
            own,
        };
        let mut x = vec![Vect::zeros(); ROWS + 2];
        let mut b = [&b[rank * ROWS..(rank + 1) * ROWS], &[Vect::zeros(); 2]].concat();
        half.import(&mut b);
        let report = solver().solve(&half, &b, &mut x).expect("a solution");
        x.truncate(ROWS);
        (x, report.iterations)
    };
    std::thread::scope(|threads| {
        let other = threads.spawn(|| half(1));
        let (mut x, mine) = half(0);
        let (rest, theirs) = other.join().expect("the other half");
        x.extend(rest);
        (x, [mine, theirs])
    })
}

#[test]
fn two_hands_with_half_of_the_rows_each_find_the_solution_of_the_whole() {
    let matrix = chain(2 * ROWS as u32, true, 0);
    let exact = dense(&matrix, &right(2 * ROWS));
    let plain = ConjugateGradient {
        preconditioner: Preconditioner::None,
        tolerance: 1e-12,
        ..ConjugateGradient::default()
    };
    let factored = ConjugateGradient {
        preconditioner: Preconditioner::IncompleteCholesky,
        ..plain.clone()
    };
    let bicgstab = Bicgstab {
        preconditioner: Preconditioner::None,
        tolerance: 1e-12,
        ..Bicgstab::default()
    };
    let automatic = || Box::new(Automatic::default()) as Box<dyn LinearSolver<2>>;
    let runs = [
        ("plain", solved(|| Box::new(plain.clone()), false)),
        (
            "factored by halves",
            solved(|| Box::new(factored.clone()), true),
        ),
        ("BiCGSTAB", solved(|| Box::new(bicgstab), false)),
        ("automatic, no entries", solved(automatic, false)),
        ("automatic, entries by halves", solved(automatic, true)),
    ];
    for (name, (x, iterations)) in &runs {
        let error = apart(x, &exact);
        assert!(error < 1e-6, "{name}: {error:e} from the dense solution");
        assert_eq!(iterations[0], iterations[1], "{name}");
    }
    // The halves are factored exactly, so that only what couples them is left to iterate on.
    let [plain, factored] = [0, 1].map(|k| runs[k].1.1[0]);
    assert!(factored < plain / 3, "{factored} and {plain}");
}

#[test]
fn a_solver_that_needs_entries_refuses_an_operator_without() {
    struct TwiceIdentity;
    impl Operator<2> for TwiceIdentity {
        fn rows(&self) -> usize {
            3
        }
        fn multiply(&self, x: &[Vect<2>], y: &mut [Vect<2>]) {
            y.iter_mut().zip(x).for_each(|(y, x)| *y = x * 2.0);
        }
    }
    let b = right::<2>(3);
    let mut x = vec![Vect::zeros(); 3];
    let jacobi = ConjugateGradient {
        preconditioner: Preconditioner::Jacobi,
        ..ConjugateGradient::default()
    };
    let both: [Box<dyn LinearSolver<2>>; 2] = [Box::new(Cholesky::default()), Box::new(jacobi)];
    for mut solver in both {
        let solved = solver.solve(&TwiceIdentity, &b, &mut x);
        let refused = matches!(solved, Err(SolveError::NotWhole { .. }));
        assert!(refused, "{solved:?}");
    }
    let solved = Automatic::default().solve(&TwiceIdentity, &b, &mut x);
    solved.expect("a product is enough");
    assert!(x.iter().zip(&b).all(|(x, b)| (x * 2.0 - b).norm() < 1e-7));
}
