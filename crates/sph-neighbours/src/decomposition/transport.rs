//! The trait of messages between ranks.

use std::fmt::Debug;

use thiserror::Error;

/// A message that did not get through.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum TransportError {
    /// A rank has ended.
    #[error("rank {0} has ended")]
    Gone(usize),
    /// The network or its library failed.
    #[error("messages between ranks fail: {0}")]
    Failed(String),
}

/// One of several ranks that run the same program in step. Every method is called by all ranks, in the same order.
pub trait Transport: Send + Sync + Debug {
    /// The number of this rank, from 0.
    fn rank(&self) -> usize;

    /// Number of ranks.
    fn ranks(&self) -> usize;

    /// Sends each message to its rank, and receives one from every rank of `from`, in their order. A rank that is sent
    /// a message must ask for it.
    ///
    /// # Errors
    /// If a rank has ended, or the network fails; as everywhere below.
    fn swap(
        &self,
        out: Vec<(usize, Vec<u8>)>,
        from: &[usize],
    ) -> Result<Vec<Vec<u8>>, TransportError> {
        self.swap_during(out, from, &mut || ())
    }

    /// As [`swap`](Self::swap); does some `work` while the messages are on their way.
    fn swap_during(
        &self,
        out: Vec<(usize, Vec<u8>)>,
        from: &[usize],
        work: &mut dyn FnMut(),
    ) -> Result<Vec<Vec<u8>>, TransportError>;

    /// The messages of all ranks, in their order.
    fn all(&self, own: &[u8]) -> Result<Vec<Vec<u8>>, TransportError> {
        let others = self.other_ranks();
        let mut all = self.swap(others.iter().map(|r| (*r, own.to_vec())).collect(), &others)?;
        all.insert(self.rank(), own.to_vec());
        Ok(all)
    }

    /// The messages of all ranks, in their order, at rank 0; nothing elsewhere.
    fn gather(&self, own: Vec<u8>) -> Result<Vec<Vec<u8>>, TransportError> {
        if self.rank() > 0 {
            self.swap(vec![(0, own)], &[])?;
            return Ok(Vec::new());
        }
        let mut all = vec![own];
        all.extend(self.swap(Vec::new(), &self.other_ranks())?);
        Ok(all)
    }

    /// Replaces each value by the largest that any rank has; NaN counts as infinite.
    fn largest(&self, values: &mut [f64]) -> Result<(), TransportError> {
        let own: Vec<u8> = values.iter().flat_map(|v| v.to_le_bytes()).collect();
        for other in self.all(&own)? {
            for (value, bytes) in values.iter_mut().zip(other.as_chunks::<8>().0) {
                *value = larger(*value, f64::from_le_bytes(*bytes));
            }
        }
        Ok(())
    }

    /// Replaces each number by its sum over all ranks.
    fn total(&self, numbers: &mut [u64]) -> Result<(), TransportError> {
        let own: Vec<u8> = numbers.iter().flat_map(|v| v.to_le_bytes()).collect();
        numbers.fill(0);
        for one in self.all(&own)? {
            for (number, bytes) in numbers.iter_mut().zip(one.as_chunks::<8>().0) {
                *number += u64::from_le_bytes(*bytes);
            }
        }
        Ok(())
    }

    /// Gives every rank a number, and takes one from each.
    fn all_to_all(&self, numbers: &[u64]) -> Result<Vec<u64>, TransportError> {
        let others = self.other_ranks();
        let message = |r: &usize| (*r, numbers[*r].to_le_bytes().to_vec());
        let out = others.iter().map(message);
        let mut all = vec![numbers[self.rank()]; self.ranks()];
        for (from, message) in others.iter().zip(self.swap(out.collect(), &others)?) {
            let bytes = message.try_into().map_err(|m: Vec<u8>| {
                TransportError::Failed(format!("{} bytes where a number was expected", m.len()))
            })?;
            all[*from] = u64::from_le_bytes(bytes);
        }
        Ok(all)
    }

    /// All ranks but this one, ascending.
    fn other_ranks(&self) -> Vec<usize> {
        (0..self.ranks()).filter(|r| *r != self.rank()).collect()
    }
}

fn larger(a: f64, b: f64) -> f64 {
    let number = |v: f64| if v.is_nan() { f64::INFINITY } else { v };
    number(a).max(number(b))
}
