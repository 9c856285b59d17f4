//! Groups of numbers that pairs join.

/// Groups of numbers that pairs join, each named by its lowest number.
pub struct Sets(Vec<u32>);

impl Sets {
    /// As many groups of one number.
    pub fn new(numbers: usize) -> Self {
        Sets((0..numbers as u32).collect())
    }

    /// The lowest number of a number's group.
    pub fn root(&mut self, number: usize) -> usize {
        let mut at = number;
        while self.0[at] as usize != at {
            self.0[at] = self.0[self.0[at] as usize];
            at = self.0[at] as usize;
        }
        at
    }

    /// Makes the groups of two numbers one.
    pub fn join(&mut self, [a, b]: [usize; 2]) {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b)] = a.min(b) as u32;
    }
}
