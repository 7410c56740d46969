//! OpenStreetMap extracts.
#![no_main]
libfuzzer_sys::fuzz_target!(|data: &[u8]| drapery_fuzz::vector("a.osm.pbf", data));
