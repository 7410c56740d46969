//! The argument of `render` and `export` that names a device.

use drapery::calibrate::{KNOWN, changes};
use drapery::scene_file::text_of;
use drapery::{Error, Result};
use std::path::Path;

/// Whose machine is imitated.
#[derive(Debug, Clone, clap::Args)]
pub(super) struct DeviceArgument {
    /// The device to imitate, its keys over those of the scene: a file with a table [device] (`drapery calibrate read`), or one of
    /// lavapipe, llvmpipe, swiftshader, gpu-8bit, exact.
    #[arg(long, value_name = "DEVICE")]
    device: Option<String>,
}

impl DeviceArgument {
    /// The scene's changes, those of the device before others.
    pub(super) fn before(&self, overrides: &[String]) -> Result<Vec<String>> {
        let Some(asked) = &self.device else { return Ok(overrides.to_vec()) };
        if let Some((_, table)) = KNOWN.iter().find(|(name, _)| name == asked) {
            return Ok([changes(table)?, overrides.to_vec()].concat());
        }
        let path = Path::new(asked);
        if !path.exists() {
            let names = KNOWN.map(|(name, _)| name).join(", ");
            return Err(Error::usage(format!("there is no device `{asked}`, and no such file"))
                .help(format!("devices here: {names}; or a file that `drapery calibrate read` has made")));
        }
        let own = changes(&text_of(path)?).map_err(|error| error.in_file(path))?;
        Ok([own, overrides.to_vec()].concat())
    }
}
