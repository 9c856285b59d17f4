//! What runs ask an allocator for: the peak against the estimate, and the blocks of a step.

use std::sync::Mutex;

mod estimates;
mod steps;

#[global_allocator]
static HEAP: dhat::Alloc = dhat::Alloc;

/// Held by each test, since the allocations of another would count.
static ALONE: Mutex<()> = Mutex::new(());
