//! Scene files, each with overrides.
#![no_main]
libfuzzer_sys::fuzz_target!(|data: &[u8]| drapery_fuzz::scene_file(data));
