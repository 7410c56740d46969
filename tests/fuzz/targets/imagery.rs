//! An image on a scene's ground, and its world file.
#![no_main]
libfuzzer_sys::fuzz_target!(|data: &[u8]| drapery_fuzz::imagery(data));
