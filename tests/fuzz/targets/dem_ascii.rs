//! Esri ASCII grids.
#![no_main]
libfuzzer_sys::fuzz_target!(|data: &[u8]| drapery_fuzz::dem("a.asc", data));
