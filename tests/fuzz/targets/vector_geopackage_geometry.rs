//! The geometries in GeoPackages.
#![no_main]
libfuzzer_sys::fuzz_target!(|data: &[u8]| drapery_fuzz::geopackage_geometry(data));
