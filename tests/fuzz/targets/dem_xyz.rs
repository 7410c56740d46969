//! Lines of points.
#![no_main]
libfuzzer_sys::fuzz_target!(|data: &[u8]| drapery_fuzz::dem("a.xyz", data));
