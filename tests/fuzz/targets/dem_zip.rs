//! Terrain files in zip archives.
#![no_main]
libfuzzer_sys::fuzz_target!(|data: &[u8]| drapery_fuzz::dem("a.zip", data));
