//! Members of numbered groups.

/// Members of numbered groups, those of a group in the order in which they were given.
#[derive(Clone, Debug, Default)]
pub struct Groups {
    /// Begin of the members of each group, and the end of the last one.
    pub starts: Vec<u32>,
    /// Group by group.
    pub members: Vec<u32>,
}

impl Groups {
    /// Groups of pairs, each of the number of a group and a member.
    pub fn new(count: usize, pairs: impl Iterator<Item = (u32, u32)> + Clone) -> Self {
        let mut starts = vec![0; count + 1];
        for (group, _) in pairs.clone() {
            starts[group as usize + 1] += 1;
        }
        for group in 0..count {
            starts[group + 1] += starts[group];
        }
        let (mut next, mut members) = (starts.clone(), vec![0; starts[count] as usize]);
        for (group, member) in pairs {
            let at = &mut next[group as usize];
            members[*at as usize] = member;
            *at += 1;
        }
        Self { starts, members }
    }

    /// Places of the members of a group.
    pub fn range(&self, group: usize) -> std::ops::Range<usize> {
        self.starts[group] as usize..self.starts[group + 1] as usize
    }

    /// Members of a group.
    pub fn members(&self, group: usize) -> &[u32] {
        &self.members[self.range(group)]
    }
}
