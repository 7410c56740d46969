//! Shapefiles, with their tables, indices, CRSs and code pages.
#![no_main]
libfuzzer_sys::fuzz_target!(|data: &[u8]| drapery_fuzz::vector("a.shp", data));
