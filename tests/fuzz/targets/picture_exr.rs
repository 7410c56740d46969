//! Pictures of `compare`: EXR.
#![no_main]
libfuzzer_sys::fuzz_target!(|data: &[u8]| drapery_fuzz::picture(data));
