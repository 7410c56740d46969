//! All attributes of a scene's layers, read once more for who wants to keep them: a scene that is drawn has none.

use super::blame::Named;
use super::columns::Columns;
use crate::scene::Column;
use crate::scene_file::{LayerSource, LayerSpec, SceneFile};
use crate::source::vector;

/// The columns of each layer of a scene, in the order of its layers: of files and of features that the scene file writes; none of what is
/// generated. `tell` is told of a layer whose attributes cannot be read: it has none.
pub fn attributes(scene: &SceneFile, tell: &dyn Fn(&str)) -> Vec<Vec<Column>> {
    scene.layers.iter().map(|spec| of_layer(scene, spec, tell)).collect()
}

fn of_layer(scene: &SceneFile, spec: &LayerSpec, tell: &dyn Fn(&str)) -> Vec<Column> {
    match &spec.source {
        LayerSource::Inline(features) => Columns::of_inline(features, scene).into_columns(),
        LayerSource::Generate(_) => Vec::new(),
        LayerSource::File { file, layer } => {
            let named = Named::new(scene, file);
            vector::read_attributes(named.path(), layer.as_deref()).unwrap_or_else(|error| {
                tell(&format!("layer `{}` is written without attributes: {}", spec.name, error.what()));
                Vec::new()
            })
        }
    }
}
