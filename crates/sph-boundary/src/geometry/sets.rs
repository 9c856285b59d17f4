//! Things that hang together.

/// Numbers that hang together, each set by its lowest.
pub(crate) struct Sets(Vec<u32>);

impl Sets {
    /// So many numbers, each by itself.
    pub fn new(numbers: usize) -> Self {
        Sets((0..numbers as u32).collect())
    }

    /// The lowest number of the set of one.
    pub fn root(&mut self, number: usize) -> usize {
        let mut at = number;
        while self.0[at] as usize != at {
            self.0[at] = self.0[self.0[at] as usize];
            at = self.0[at] as usize;
        }
        at
    }

    pub fn join(&mut self, [a, b]: [usize; 2]) {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b)] = a.min(b) as u32;
    }
}
