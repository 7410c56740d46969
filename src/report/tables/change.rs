//! A stage with other settings of the techniques.

use crate::error::Result;
use crate::scene_file::SceneText;
use crate::stage::Stage;

/// Gives a stage the settings that its scene's file has with some changes (`path=value`).
pub(super) fn change(stage: &mut Stage, text: &SceneText, changes: &[&str]) -> Result<()> {
    stage.scene.technique = text.changed(changes)?.technique;
    Ok(())
}
