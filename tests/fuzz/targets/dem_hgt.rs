//! SRTM tiles: the first line is the name, the rest is repeated to a whole tile.
#![no_main]
libfuzzer_sys::fuzz_target!(|data: &[u8]| drapery_fuzz::hgt(data));
