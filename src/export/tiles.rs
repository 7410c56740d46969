//! The tiles of a texture as pictures in a pyramid of folders, as web maps have them.

use crate::buffer::{Buffer, Plane, Values};

/// A tile.
#[derive(Debug, Clone)]
pub struct TilePicture {
    /// Its file: `z/x/y`, z growing with detail, x to the east, y to the south. Levels that are smaller than a tile are not in a
    /// pyramid of tiles; they have `below/level`.
    pub name: String,
    /// Its texels.
    pub picture: Buffer<[u8; 4]>,
}

/// The tiles of a clipmap's buffers `tiles` (so many as it shows) and `tile-keys`, of a texture that is so many texels wide, in
/// tiles of `tile` texels.
pub fn tiles(pictures: &Plane, keys: &Plane, size: u32, tile: u32) -> Vec<TilePicture> {
    let (Values::U8(texels), Values::U32(keys)) = (&pictures.values, &keys.values) else { return Vec::new() };
    let (side, across) = (tile as usize, pictures.width / tile as usize);
    let shown = across * (pictures.height / side);
    let tile_of = |(k, &[level, column, row]): (usize, &[u32; 3])| {
        let of_level = size >> level;
        let name = match of_level.checked_div(tile) {
            Some(tiles @ 1..) => format!("{}/{column}/{row}", tiles.trailing_zeros()),
            _ => format!("below/{of_level}"),
        };
        let side_here = side.min(of_level as usize);
        let (x, y) = (k % across * side, k / across * side);
        let line = |r: usize| &texels[((y + r) * pictures.width + x) * 4..][..side_here * 4];
        let values = (0..side_here).flat_map(line).copied().collect::<Vec<u8>>();
        let picture = Buffer::from_values(side_here, side_here, values.as_chunks().0.to_vec());
        TilePicture { name, picture }
    };
    keys.as_chunks().0.iter().enumerate().take(shown).map(tile_of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_are_cut_out_and_have_the_names_of_web_maps() {
        // Tiles of 2 texels, 2 in a row, of a texture of 8 texels.
        let texels: Vec<u8> = (0..4 * 4 * 4).collect();
        let pictures =
            Plane { name: "tiles", width: 4, height: 4, components: 4, values: Values::U8(texels) };
        let keys = vec![0, 3, 1, 2, 0, 0, 3, 0, 0];
        let keys = Plane { name: "tile-keys", width: 3, height: 3, components: 1, values: Values::U32(keys) };
        let found = tiles(&pictures, &keys, 8, 2);
        let names: Vec<&str> = found.iter().map(|tile| &tile.name[..]).collect();
        assert_eq!(names, ["2/3/1", "0/0/0", "below/1"]);
        let firsts: Vec<(usize, u8, u8)> = found
            .iter()
            .map(|t| (t.picture.width(), t.picture.values()[0][0], t.picture.values().last().unwrap()[0]))
            .collect();
        assert_eq!(firsts, [(2, 0, 20), (2, 8, 28), (1, 32, 32)]);
    }
}
