//! A layer of a scene from its file to the draw list: reprojected, clipped, styled.
#![no_main]
libfuzzer_sys::fuzz_target!(|data: &[u8]| drapery_fuzz::layer(data));
