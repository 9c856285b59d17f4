//! The MPI job that this process is part of, and its ranks.

use std::sync::Arc;

use mpi::Threading;
use mpi::collective::SystemOperation;
use mpi::environment::Universe;
use mpi::point_to_point::{Destination, Source};
use mpi::topology::SimpleCommunicator;
use mpi::traits::{Communicator, CommunicatorCollectives};
use sph_neighbours::decomposition::{Transport, TransportError};

/// Variables that launchers set for the processes that they start: Open MPI, MPICH and its kin, Slurm.
const SIGNS: &str = "OMPI_COMM_WORLD_SIZE PMIX_RANK PMI_SIZE MPI_LOCALNRANKS";

/// The job; MPI ends with it.
pub struct Job {
    rank: Arc<MpiRank>,
    /// Ends MPI when it is dropped.
    _universe: Universe,
}

impl Job {
    /// Joins the job that `mpirun` or its like has started; `None` where this process was started without.
    ///
    /// Threads of the process may call MPI in turns (`MPI_THREAD_SERIALIZED`). A panic ends the whole job.
    pub fn join() -> Option<Self> {
        if SIGNS
            .split(' ')
            .all(|sign| std::env::var_os(sign).is_none())
        {
            return None;
        }
        let (universe, _) = mpi::initialize_with_threading(Threading::Serialized)?;
        let (rank, ranks) = (world().rank() as usize, world().size() as usize);
        let told = std::panic::take_hook();
        std::panic::set_hook(Box::new(move |panic| {
            told(panic);
            // Others would wait for ever.
            world().abort(101);
        }));
        Some(Job {
            rank: Arc::new(MpiRank { rank, ranks }),
            _universe: universe,
        })
    }

    /// This process among all.
    pub fn rank(&self) -> Arc<MpiRank> {
        self.rank.clone()
    }
}

/// Bytes of a message that are sent at once: MPI counts in 31 bits.
const PIECE: usize = 1 << 30;

/// A process of an MPI job. An error of MPI ends the job, as is its default.
#[derive(Debug)]
pub struct MpiRank {
    rank: usize,
    ranks: usize,
}

/// All processes of the job. Handles of MPI may not go from thread to thread, this one is everywhere.
fn world() -> SimpleCommunicator {
    SimpleCommunicator::world()
}

impl MpiRank {
    /// A message of any length: pieces, the last of which is shorter than the others.
    fn receive(&self, from: usize) -> Vec<u8> {
        let world = world();
        let source = world.process_at_rank(from as i32);
        let (mut message, _) = source.receive_vec::<u8>();
        let mut last = message.len();
        while last == PIECE {
            let (piece, _) = source.receive_vec::<u8>();
            last = piece.len();
            message.extend_from_slice(&piece);
        }
        message
    }
}

/// Pieces of a message, in the order of sending.
fn pieces(message: &[u8]) -> impl Iterator<Item = &[u8]> {
    let whole = message.len().is_multiple_of(PIECE);
    let last: Option<&[u8]> = whole.then_some(&[]);
    message.chunks(PIECE).chain(last)
}

impl Transport for MpiRank {
    fn rank(&self) -> usize {
        self.rank
    }

    fn ranks(&self) -> usize {
        self.ranks
    }

    fn swap_during(
        &self,
        out: Vec<(usize, Vec<u8>)>,
        from: &[usize],
        work: &mut dyn FnMut(),
    ) -> Result<Vec<Vec<u8>>, TransportError> {
        let out = out.iter();
        let pieces = out.flat_map(|(rank, all)| pieces(all).map(|piece| (*rank as i32, piece)));
        let pieces: Vec<(i32, &[u8])> = pieces.collect();
        let world = world();
        Ok(mpi::request::multiple_scope(pieces.len(), |scope, sent| {
            for (rank, piece) in &pieces {
                let to = world.process_at_rank(*rank);
                sent.add(to.immediate_send(scope, *piece));
            }
            work();
            let received = from.iter().map(|rank| self.receive(*rank)).collect();
            sent.wait_all(&mut Vec::new());
            received
        }))
    }

    fn largest(&self, values: &mut [f64]) -> Result<(), TransportError> {
        let number = |v: &f64| if v.is_nan() { f64::INFINITY } else { *v };
        let own: Vec<f64> = values.iter().map(number).collect();
        let largest = SystemOperation::max();
        world().all_reduce_into(&own[..], values, largest);
        Ok(())
    }

    fn total(&self, numbers: &mut [u64]) -> Result<(), TransportError> {
        let own = numbers.to_vec();
        let sum = SystemOperation::sum();
        world().all_reduce_into(&own[..], numbers, sum);
        Ok(())
    }

    fn all_to_all(&self, numbers: &[u64]) -> Result<Vec<u64>, TransportError> {
        let mut all = vec![0; numbers.len()];
        world().all_to_all_into(numbers, &mut all[..]);
        Ok(all)
    }
}
