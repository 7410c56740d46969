//! Which closed ways are areas: OpenStreetMap has no type for them, so their tags tell.
//!
//! By the wiki's *Map features* and the lists that renderers keep: keys that stand for areas, but for some of their values. What
//! says `area=yes` or `area=no` is as it says; roads, railways and barriers that run in a circle are lines.

/// Keys whose closed ways are areas, and the values that are lines all the same.
const AREAS: [(&str, &[&str]); 22] = [
    ("aeroway", &["taxiway"]),
    ("amenity", &[]),
    ("area:highway", &[]),
    ("boundary", &[]),
    ("building", &["no"]),
    ("building:part", &["no"]),
    ("craft", &[]),
    ("geological", &[]),
    ("golf", &["hole", "path", "cartpath"]),
    ("historic", &[]),
    ("indoor", &[]),
    ("landuse", &[]),
    ("leisure", &["track", "slipway"]),
    ("man_made", &["pipeline", "embankment", "breakwater", "groyne", "cutline", "goods_conveyor"]),
    ("military", &[]),
    ("natural", &["coastline", "cliff", "ridge", "arete", "tree_row", "valley", "strait"]),
    ("office", &[]),
    ("place", &[]),
    ("power", &["line", "minor_line", "cable"]),
    ("shop", &[]),
    ("sport", &[]),
    ("tourism", &[]),
];

/// Values of other keys whose closed ways are areas.
const MORE: [(&str, &[&str]); 4] = [
    ("highway", &["platform", "rest_area", "services"]),
    ("public_transport", &["platform", "station"]),
    ("railway", &["platform", "station", "turntable"]),
    ("waterway", &["riverbank", "dock", "boatyard", "dam", "fuel"]),
];

/// Keys that make a line of a closed way, whatever else it is.
const LINES: [&str; 3] = ["highway", "railway", "barrier"];

/// Whether a closed way with these tags is an area.
pub(super) fn is_area<S: AsRef<str>>(tags: &[(S, S)]) -> bool {
    let value = |key: &str| tags.iter().find(|(own, _)| own.as_ref() == key).map(|(_, value)| value.as_ref());
    let among = |list: &[(&str, &[&str])], is_listed: bool| {
        list.iter().any(|(key, values)| value(key).is_some_and(|value| values.contains(&value) == is_listed))
    };
    match value("area") {
        Some("yes") => true,
        Some("no") => false,
        _ => among(&MORE, true) || (among(&AREAS, false) && LINES.iter().all(|key| value(key).is_none())),
    }
}

#[cfg(test)]
mod tests {
    use super::is_area;

    #[test]
    fn tags_tell_areas_from_lines_that_run_in_a_circle() {
        let is = |tags: &[(&'static str, &'static str)]| is_area(tags);
        for area in [
            &[("building", "yes")][..],
            &[("natural", "water")],
            &[("highway", "platform")],
            &[("highway", "pedestrian"), ("area", "yes")],
            &[("leisure", "track"), ("area", "yes")],
        ] {
            assert!(is(area), "{area:?}");
        }
        for line in [
            &[("highway", "residential")][..],
            &[("natural", "coastline")],
            &[("barrier", "fence"), ("tourism", "zoo")],
            &[("landuse", "grass"), ("area", "no")],
            &[("name", "x")],
            &[("building", "no")],
        ] {
            assert!(!is(line), "{line:?}");
        }
    }
}
