//! The text of a CRS, and maps of places by what it describes.
#![no_main]
libfuzzer_sys::fuzz_target!(|data: &[u8]| drapery_fuzz::crs(data));
