//! "Did you mean".

/// The help for a name that is not known.
pub(super) fn nearest_or_all(given: &str, known: &[&str], what: &str) -> String {
    if let Some(near) = nearest(given, known) {
        return format!("did you mean `{near}`?");
    }
    if known.is_empty() {
        return format!("no {what} are known here");
    }
    format!("known {what}: {}", known.join(", "))
}

/// The known name that a person most likely meant.
pub(super) fn nearest<'a>(given: &str, known: &[&'a str]) -> Option<&'a str> {
    let given = given.to_lowercase().replace('-', "_");
    let distance = |name: &str| {
        let name = name.to_lowercase().replace('-', "_");
        let stem = name.strip_suffix("_m").or(name.strip_suffix("_deg")).unwrap_or(&name);
        strsim::osa_distance(&given, &name).min(strsim::osa_distance(&given, stem))
    };
    let (cost, name) = known.iter().map(|name| (distance(name), *name)).min()?;
    let allowed = (given.chars().count() / 2).min(3);
    (cost <= allowed && cost < name.chars().count()).then_some(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_forgotten_unit_is_found() {
        assert_eq!(nearest("width", &["color", "width_m", "width_px"]), Some("width_m"));
        assert_eq!(nearest("fov_y", &["fov_y_deg", "far_m"]), Some("fov_y_deg"));
    }

    #[test]
    fn a_slip_is_found_and_another_word_is_not() {
        assert_eq!(nearest("colour", &["color", "cap"]), Some("color"));
        assert_eq!(nearest("elephant", &["color", "cap"]), None);
        assert_eq!(nearest("", &["up"]), None);
    }
}
