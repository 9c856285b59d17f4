//! The widest lanes of the processor at hand, found when the program runs.

use std::sync::atomic::{AtomicU8, Ordering};

use crate::lanes::{Lane, Lanes};

/// Number of lanes, which are computed side by side.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Width {
    /// 2: available on every processor.
    Two = 2,
    /// 4: AVX2.
    Four = 4,
    /// 8: AVX-512.
    Eight = 8,
}

impl Width {
    /// As a number.
    pub fn lanes(self) -> usize {
        self as usize
    }
}

/// 0 for the widest there is, else the most lanes that are allowed.
static ALLOWED: AtomicU8 = AtomicU8::new(0);

/// Limits the lanes from here on; `None` allows all of the processor. For tests: results do not depend on it, to the
/// bit.
pub fn force_width(most: Option<Width>) {
    ALLOWED.store(most.map_or(0, |w| w.lanes() as u8), Ordering::Relaxed);
}

/// The width that [`dispatch`] takes.
pub fn width() -> Width {
    let allowed = match ALLOWED.load(Ordering::Relaxed) {
        2 => Width::Two,
        4 => Width::Four,
        _ => Width::Eight,
    };
    allowed.min(processor())
}

/// Work to be run with lanes of some width.
pub trait Body {
    /// Result of the work.
    type Output;
    /// Runs it; `#[inline(always)]`, as is all that it calls.
    fn call<L: Lane>(self) -> Self::Output;
}

#[cfg(target_arch = "x86_64")]
fn processor() -> Width {
    let eight = is_x86_feature_detected!("avx512f")
        && is_x86_feature_detected!("avx512dq")
        && is_x86_feature_detected!("avx512vl");
    match (eight, is_x86_feature_detected!("avx2")) {
        (true, true) => Width::Eight,
        (false, true) => Width::Four,
        _ => Width::Two,
    }
}

#[cfg(not(target_arch = "x86_64"))]
fn processor() -> Width {
    Width::Two
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,avx512f,avx512dq,avx512vl")]
fn with_avx512<B: Body>(body: B) -> B::Output {
    body.call::<Lanes<8>>()
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn with_avx2<B: Body>(body: B) -> B::Output {
    body.call::<Lanes<4>>()
}

/// Runs a body with the widest lanes that the processor has.
#[inline]
pub fn dispatch<B: Body>(body: B) -> B::Output {
    dispatch_at(width(), body)
}

/// Runs a body with lanes of a width, or the widest that the processor has if that is less.
#[inline]
#[allow(
    unsafe_code,
    reason = "functions for instructions that the processor may not have; it has been asked"
)]
pub fn dispatch_at<B: Body>(width: Width, body: B) -> B::Output {
    #[cfg(target_arch = "x86_64")]
    match width.min(processor()) {
        // SAFETY: `processor` returns `Eight` and `Four` only where it found the instructions.
        Width::Eight => return unsafe { with_avx512(body) },
        Width::Four => return unsafe { with_avx2(body) },
        Width::Two => {}
    }
    body.call::<Lanes<2>>()
}
