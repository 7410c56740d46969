//! Virtual rasters of a file beside them.
#![no_main]
libfuzzer_sys::fuzz_target!(|data: &[u8]| drapery_fuzz::dem("a.vrt", data));
