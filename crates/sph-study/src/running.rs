//! Variants run one after the other, and the records of each.

pub mod execute;
pub mod machine;
pub mod record;
pub mod repeat;
pub mod verdict;
