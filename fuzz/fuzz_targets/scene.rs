//! The text of a scene: read, checked and, if it is small, assembled.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| sph_fuzz::check(text, &[]));
