//! The scene for programs that show glTF 2.0, as one binary file: the mesh, and lines and borders on it.
//!
//! Positions are scene-local and single, z up as in all files of a bundle; the node turns them to glTF's y up. Lines are for looking at: their vertices
//! stand on the terrain, at most half a cell apart, and what lies between may cut a fold of it. Widths are not in it.

use super::{triangles, vertices};
use crate::buffer::Values;
use crate::draw_list::{Chain, DrawList};
use crate::error::{Error, Result};
use crate::resolve::linear_from_encoded;
use crate::scene::{Color, GroundColors, Scene};
use crate::space::Plan;
use crate::terrain::{Drape, Mesh, SKY};
use serde_json::{Value, json};

/// Kinds of numbers and uses of glTF's.
const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;
const LINE_STRIP: u32 = 3;
const TRIANGLES: u32 = 4;

/// The most vertices of lines: what needs more is left to the other files.
const MOST_LINE_VERTICES: usize = 1 << 22;

/// The file being made.
#[derive(Default)]
struct Binary {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
    materials: Vec<Value>,
    primitives: Vec<Value>,
}

/// The bytes of a `.glb` file of what a view sees of a scene.
///
/// # Errors
/// When the file would be longer than the format can say.
pub(super) fn glb(scene: &Scene, list: &DrawList, mesh: &Mesh) -> Result<Vec<u8>> {
    let mut file = Binary::default();
    file.add_mesh(scene, mesh);
    if mesh.drape() == Drape::Vertical {
        file.add_lines(list, mesh);
    }
    file.finished(&scene.name)
}

impl Binary {
    fn add_mesh(&mut self, scene: &Scene, mesh: &Mesh) {
        let (Values::F64(places), Values::U32(corners)) = (vertices(mesh).values, triangles(mesh).values)
        else {
            return;
        };
        let places: Vec<[f32; 3]> =
            places.as_chunks().0.iter().map(|p: &[f64; 3]| p.map(|v| v as f32)).collect();
        let corners: Vec<u32> = corners.into_iter().filter(|corner| *corner != SKY).collect();
        if corners.is_empty() {
            return;
        }
        let color = match scene.ground.colors {
            GroundColors::Constant(color) => color,
            GroundColors::Imagery(_) => Color([1.0; 4]),
        };
        let (position, material) = (self.add_places(&places), self.add_material(color));
        let bytes: Vec<u8> = corners.iter().flat_map(|corner| corner.to_le_bytes()).collect();
        let view = self.add_view(&bytes, ELEMENT_ARRAY_BUFFER);
        self.accessors.push(json!({ "bufferView": view, "componentType": UNSIGNED_INT, "count": corners.len(), "type": "SCALAR" }));
        self.primitives.push(json!({
            "attributes": { "POSITION": position },
            "indices": self.accessors.len() - 1,
            "material": material,
            "mode": TRIANGLES,
        }));
    }

    fn add_lines(&mut self, list: &DrawList, mesh: &Mesh) {
        let (mut count, step) = (0, 0.5 * mesh.resolution());
        let mut materials = vec![None; list.styles().len()];
        for item in list.items() {
            for chain in list.strokes(item).iter().chain(list.border(item)) {
                for run in draped(list, mesh, chain, step) {
                    count += run.len();
                    if count > MOST_LINE_VERTICES {
                        return;
                    }
                    let style = item.style as usize;
                    let paint = list.styles()[style].paint;
                    let material = *materials[style].get_or_insert_with(|| self.add_material(paint));
                    let position = self.add_places(&run);
                    self.primitives.push(
                        json!({ "attributes": { "POSITION": position }, "material": material, "mode": LINE_STRIP }),
                    );
                }
            }
        }
    }

    /// Adds a view of bytes, whose number it returns.
    fn add_view(&mut self, bytes: &[u8], target: u32) -> usize {
        self.views.push(json!({ "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len(), "target": target }));
        // All numbers have four bytes, so all begin at multiples of four.
        self.bytes.extend_from_slice(bytes);
        self.views.len() - 1
    }

    /// Adds positions, whose accessor's number it returns.
    fn add_places(&mut self, places: &[[f32; 3]]) -> usize {
        let (mut low, mut high) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
        for place in places {
            for k in 0..3 {
                low[k] = if place[k] < low[k] { place[k] } else { low[k] };
                high[k] = if place[k] > high[k] { place[k] } else { high[k] };
            }
        }
        let bytes: Vec<u8> = places.iter().flatten().flat_map(|v| v.to_le_bytes()).collect();
        let view = self.add_view(&bytes, ARRAY_BUFFER);
        self.accessors.push(json!({
            "bufferView": view,
            "componentType": FLOAT,
            "count": places.len(),
            "type": "VEC3",
            "min": low.map(f64::from),
            "max": high.map(f64::from),
        }));
        self.accessors.len() - 1
    }

    /// Adds a material of a colour, whose number it returns. glTF's colours are linear.
    fn add_material(&mut self, Color([r, g, b, a]): Color) -> usize {
        let factor = [linear_from_encoded(r), linear_from_encoded(g), linear_from_encoded(b), a];
        let mut material = json!({
            "pbrMetallicRoughness": { "baseColorFactor": factor, "metallicFactor": 0.0 },
            "doubleSided": true,
        });
        if a < 1.0 {
            material["alphaMode"] = "BLEND".into();
        }
        self.materials.push(material);
        self.materials.len() - 1
    }

    /// The header and both chunks (glTF 2.0, 4.4).
    fn finished(self, name: &str) -> Result<Vec<u8>> {
        let half = std::f64::consts::FRAC_1_SQRT_2;
        let mut document = json!({
            "asset": { "version": "2.0", "generator": concat!("drapery ", env!("CARGO_PKG_VERSION")) },
            "scene": 0,
        });
        if self.primitives.is_empty() {
            document["scenes"] = json!([{ "name": name }]);
        } else {
            document["scenes"] = json!([{ "name": name, "nodes": [0] }]);
            // A quarter turn around x: z becomes y, y becomes -z.
            document["nodes"] = json!([{ "mesh": 0, "rotation": [-half, 0.0, 0.0, half] }]);
            document["meshes"] = json!([{ "primitives": self.primitives }]);
            document["materials"] = self.materials.into();
            document["accessors"] = self.accessors.into();
            document["bufferViews"] = self.views.into();
            document["buffers"] = json!([{ "byteLength": self.bytes.len() }]);
        }
        let mut text = document.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let chunks = [(&text, b"JSON"), (&self.bytes, b"BIN\0")];
        let chunks = chunks.into_iter().filter(|(bytes, _)| !bytes.is_empty());
        let total = 12 + chunks.clone().map(|(bytes, _)| 8 + bytes.len()).sum::<usize>();
        let length = |bytes: usize| {
            u32::try_from(bytes).map_err(|_| {
                Error::unsupported("this scene is too large for a glTF file")
                    .help("give the terrain a `window`")
            })
        };
        let mut file = b"glTF".to_vec();
        file.extend(2u32.to_le_bytes());
        file.extend(length(total)?.to_le_bytes());
        for (bytes, kind) in chunks {
            file.extend(length(bytes.len())?.to_le_bytes());
            file.extend(kind);
            file.extend(bytes);
        }
        Ok(file)
    }
}

/// The parts of a chain's path that have terrain below them, put on it.
fn draped(list: &DrawList, mesh: &Mesh, chain: &Chain, step: f64) -> Vec<Vec<[f32; 3]>> {
    let (mut runs, mut run) = (Vec::new(), Vec::new());
    let mut put = |at: Plan| match mesh.height_at(at) {
        Some(height) => run.push([at.x, at.y, height].map(|v| v as f32)),
        None => runs.push(std::mem::take(&mut run)),
    };
    let path = list.path_of(chain);
    path.first().into_iter().for_each(|at| put(*at));
    for pair in path.windows(2) {
        let way = pair[1] - pair[0];
        let parts = (way.length() / step).ceil().clamp(1.0, 4096.0) as u32;
        (1..parts).for_each(|k| put(pair[0] + way * (f64::from(k) / f64::from(parts))));
        put(pair[1]);
    }
    runs.push(run);
    runs.retain(|run| run.len() > 1);
    runs
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parts(file: &[u8]) -> (Value, Vec<u8>) {
        let number = |at: usize| u32::from_le_bytes(file[at..at + 4].try_into().unwrap()) as usize;
        assert_eq!((&file[..4], number(4), number(8)), (&b"glTF"[..], 2, file.len()));
        let json = number(12);
        assert_eq!((&file[16..20], json % 4), (&b"JSON"[..], 0));
        let binary = number(20 + json);
        assert_eq!((&file[24 + json..28 + json], 28 + json + binary), (&b"BIN\0"[..], file.len()));
        (serde_json::from_slice(&file[20..20 + json]).unwrap(), file[28 + json..].to_vec())
    }

    #[test]
    fn the_file_has_the_mesh_and_its_lines_stand_on_it() {
        let scene = crate::Opened::parse(crate::tutorial::SMALL_SCENE).unwrap().stage;
        let (told, bytes) = parts(&glb(&scene.scene, &scene.draw_list, &scene.mesh).unwrap());
        assert_eq!(
            (&told["asset"]["version"], told["buffers"][0]["byteLength"].as_u64()),
            (&"2.0".into(), Some(bytes.len() as u64))
        );
        let numbers = |accessor: &Value| -> Vec<f32> {
            let view = &told["bufferViews"][accessor["bufferView"].as_u64().unwrap() as usize];
            let [from, length] = ["byteOffset", "byteLength"].map(|key| view[key].as_u64().unwrap() as usize);
            assert_eq!(from % 4, 0);
            bytes[from..from + length].as_chunks().0.iter().map(|v| f32::from_le_bytes(*v)).collect()
        };
        let primitives = told["meshes"][0]["primitives"].as_array().unwrap();
        assert!(primitives.len() > 1, "{told}");
        for primitive in primitives {
            let accessor = &told["accessors"][primitive["attributes"]["POSITION"].as_u64().unwrap() as usize];
            let places = numbers(accessor);
            assert_eq!(Some(places.len() as u64), accessor["count"].as_u64().map(|count| 3 * count));
            let east =
                places.iter().step_by(3).copied().fold(f32::NEG_INFINITY, |a, b| if b > a { b } else { a });
            assert_eq!(accessor["max"][0].as_f64(), Some(f64::from(east)));
            assert!(told["materials"][primitive["material"].as_u64().unwrap() as usize].is_object());
            if primitive["mode"] == LINE_STRIP {
                for place in places.chunks(3) {
                    let at = Plan::new(place[0].into(), place[1].into());
                    let height = scene.mesh.height_at(at).unwrap();
                    assert!((height - f64::from(place[2])).abs() < 0.01, "{place:?}: {height}");
                }
            }
        }
        let indices = &told["accessors"][primitives[0]["indices"].as_u64().unwrap() as usize];
        assert_eq!(indices["count"].as_u64(), Some(3 * u64::from(scene.mesh.triangle_ids())));
    }
}
