//! The parameters of the techniques.

use crate::error::Result;
use crate::scene::TechniqueSettings;
use crate::scene_file::section::{Section, Taken};
use crate::technique::{Declaration, Kind};

pub(super) fn techniques(section: &mut Section<'_>) -> Result<TechniqueSettings> {
    let mut settings = TechniqueSettings::default();
    for kind in Kind::ALL {
        let technique = kind.declaration();
        let node = section.take_or_empty(technique.parameters.name);
        Section::read(section.origin(), node, |table| one(table, technique, &mut settings))?;
    }
    Ok(settings)
}

/// Says what the table of one technique says.
fn one(section: &mut Section<'_>, technique: &Declaration, settings: &mut TechniqueSettings) -> Result<()> {
    let mut places = Vec::new();
    for key in technique.parameters.table.keys {
        if let Some(Taken { value, place }) = section.value_at(key)? {
            settings.say(technique.parameters.name, key, value);
            places.push((key.name, place));
        }
    }
    let Some(contradiction) = (technique.contradiction)(settings) else { return Ok(()) };
    let written = places.iter().find(|(name, _)| *name == contradiction.parameter);
    let place = written.map_or(section.place(), |(_, place)| place);
    Err(section.error_at(place, contradiction.what).help(contradiction.help))
}
