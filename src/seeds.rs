//! The small files that tests make, as seeds for the fuzz targets of `tests/fuzz/`.

use std::path::PathBuf;

/// Writes seeds of a target into its folder below `$DRAPERY_SEEDS`.
pub(crate) fn plant(target: &str, seeds: impl IntoIterator<Item = impl AsRef<[u8]>>) {
    let below = std::env::var_os("DRAPERY_SEEDS").expect("DRAPERY_SEEDS names a folder");
    let folder = PathBuf::from(below).join(target);
    std::fs::create_dir_all(&folder).unwrap();
    for (at, seed) in seeds.into_iter().enumerate() {
        std::fs::write(folder.join(format!("seed-{at}")), seed).unwrap();
    }
}

/// A file with what lies beside it, by extension, as the targets take it.
#[cfg(feature = "render")]
pub(crate) fn beside(main: &[u8], others: &[(&str, &[u8])]) -> Vec<u8> {
    let mut seed = main.to_vec();
    for (extension, content) in others {
        seed.extend(format!("\n=== {extension}\n").bytes());
        seed.extend(*content);
    }
    seed
}
