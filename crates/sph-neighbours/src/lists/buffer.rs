//! Buffers that are used again and again.

pub(crate) fn grow<T: Copy + Default>(buffer: &mut Vec<T>, needed: usize) {
    if buffer.len() < needed {
        buffer.resize(needed.next_power_of_two(), T::default());
    }
}

/// Puts candidates into a buffer that is at most a quarter too large: vectors that grow by doubling would be by half,
/// in the mean, and lists are most of a run's memory.
pub(crate) fn keep_all(held: &mut Vec<u32>, candidates: &[u32]) {
    let (needed, room) = (candidates.len(), held.capacity());
    if needed > room || needed + needed / 4 < room {
        *held = Vec::with_capacity(needed + needed / 16);
    }
    held.clear();
    held.extend_from_slice(candidates);
}
