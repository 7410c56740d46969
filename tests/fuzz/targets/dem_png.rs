//! PNGs with heights in their colours, and world files.
#![no_main]
libfuzzer_sys::fuzz_target!(|data: &[u8]| drapery_fuzz::dem("a.png", data));
