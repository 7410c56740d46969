//! GeoTIFFs, with what may lie beside them.
#![no_main]
libfuzzer_sys::fuzz_target!(|data: &[u8]| drapery_fuzz::dem("a.tif", data));
