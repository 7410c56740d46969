//! Vector files in zip archives.
#![no_main]
libfuzzer_sys::fuzz_target!(|data: &[u8]| drapery_fuzz::vector("a.zip", data));
