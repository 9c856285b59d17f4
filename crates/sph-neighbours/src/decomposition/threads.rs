//! Ranks that are threads of one process: for tests, and to see how a scene splits without a cluster.

use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Mutex, PoisonError};

use crate::decomposition::{Transport, TransportError};

/// A rank among the threads of this process.
#[derive(Debug)]
pub struct Thread {
    rank: usize,
    to: Vec<Sender<Vec<u8>>>,
    from: Vec<Mutex<Receiver<Vec<u8>>>>,
}

impl Thread {
    /// A number of connected ranks. A dropped rank has ended; ranks that wait for it get an error.
    pub fn communicator(ranks: usize) -> Vec<Thread> {
        let channels = || (0..ranks).map(|_| channel()).unzip();
        let rows: Vec<(Vec<Sender<Vec<u8>>>, Vec<_>)> = (0..ranks).map(|_| channels()).collect();
        // The senders of a receiver's row belong to the ranks that send to it.
        let to = |sender: usize| rows.iter().map(|(row, _)| row[sender].clone()).collect();
        let to: Vec<Vec<_>> = (0..ranks).map(to).collect();
        let ends = to.into_iter().zip(rows).enumerate();
        ends.map(|(rank, (to, (_, from)))| Thread {
            rank,
            to,
            from: from.into_iter().map(Mutex::new).collect(),
        })
        .collect()
    }
}

impl Transport for Thread {
    fn rank(&self) -> usize {
        self.rank
    }

    fn ranks(&self) -> usize {
        self.to.len()
    }

    fn swap_during(
        &self,
        out: Vec<(usize, Vec<u8>)>,
        from: &[usize],
        work: &mut dyn FnMut(),
    ) -> Result<Vec<Vec<u8>>, TransportError> {
        for (rank, message) in out {
            let sent = self.to[rank].send(message);
            sent.map_err(|_| TransportError::Gone(rank))?;
        }
        work();
        let receive = |rank: &usize| {
            let queue = &self.from[*rank];
            let queue = queue.lock().unwrap_or_else(PoisonError::into_inner);
            queue.recv().map_err(|_| TransportError::Gone(*rank))
        };
        from.iter().map(receive).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Results of every rank.
    fn on_each_rank<T: Send>(ranks: usize, work: impl Fn(&Thread) -> T + Sync) -> Vec<T> {
        std::thread::scope(|scope| {
            let communicator = Thread::communicator(ranks);
            let work = &work;
            let one = |rank: Thread| scope.spawn(move || work(&rank));
            let all: Vec<_> = communicator.into_iter().map(one).collect();
            all.into_iter().map(|t| t.join().expect("a rank")).collect()
        })
    }

    #[test]
    fn messages_arrive_where_they_are_sent_and_reductions_agree() {
        let found = on_each_rank(4, |at| {
            let rank = at.rank() as u64;
            let all = at.all(&[rank as u8]).expect("all");
            let mut largest = [
                rank as f64,
                -(rank as f64),
                if rank == 2 { f64::NAN } else { 0.0 },
            ];
            at.largest(&mut largest).expect("largest");
            let mut total = [rank, 1];
            at.total(&mut total).expect("total");
            let traded: Vec<u64> = (0..4).map(|to| 10 * rank + to).collect();
            let traded = at.all_to_all(&traded).expect("trade");
            let gathered = at.gather(vec![rank as u8; 2]).expect("gather");
            (all, largest, total, traded, gathered.len())
        });
        for (rank, (all, largest, total, traded, gathered)) in found.into_iter().enumerate() {
            assert_eq!(all, vec![vec![0], vec![1], vec![2], vec![3]]);
            assert_eq!(largest[..2], [3.0, 0.0]);
            assert_eq!(largest[2], f64::INFINITY);
            assert_eq!(total, [6, 4]);
            let rank64 = rank as u64;
            assert_eq!(
                traded,
                (0..4).map(|from| 10 * from + rank64).collect::<Vec<_>>()
            );
            assert_eq!(gathered, if rank == 0 { 4 } else { 0 });
        }
    }

    #[test]
    fn work_is_done_before_messages_are_waited_for() {
        let (done, is_done) = std::sync::mpsc::channel();
        let (done, is_done) = (std::sync::Mutex::new(done), std::sync::Mutex::new(is_done));
        let found = on_each_rank(2, |at| {
            if at.rank() == 1 {
                // Sends nothing until the other has done its work, which would never come if that waited first.
                let is_done = is_done.lock().expect("one rank");
                let waited = is_done.recv_timeout(std::time::Duration::from_secs(60));
                waited.expect("work of the other rank");
            }
            let other = 1 - at.rank();
            let out = vec![(other, vec![at.rank() as u8])];
            at.swap_during(out, &[other], &mut || {
                let _ = done.lock().expect("one at a time").send(());
            })
        });
        assert_eq!(found, [Ok(vec![vec![1]]), Ok(vec![vec![0]])]);
    }

    #[test]
    fn waiting_for_an_ended_rank_is_an_error() {
        let found = on_each_rank(3, |at| match at.rank() {
            1 => Ok(()),
            _ => at.total(&mut [1]),
        });
        assert_eq!(found[1], Ok(()));
        for rank in [0, 2] {
            assert!(
                matches!(found[rank], Err(TransportError::Gone(_))),
                "{found:?}"
            );
        }
    }
}
