//! The manifest of a folder of goldens.
#![no_main]
libfuzzer_sys::fuzz_target!(|data: &[u8]| drapery_fuzz::manifest(data));
