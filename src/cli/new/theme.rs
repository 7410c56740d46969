//! What a layer shows, told by its name, and the colours that maps have for that.

/// How things of a kind look.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Look {
    /// The inside of areas.
    pub(super) fill: [u8; 3],
    /// Its opacity.
    pub(super) opacity: f64,
    /// Lines and borders.
    pub(super) stroke: [u8; 3],
    /// How wide lines are in pixels.
    pub(super) width: f64,
}

/// A kind of thing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Theme {
    Border,
    Water,
    Land,
    Ice,
    Wood,
    Rail,
    Path,
    Road,
    Building,
    Field,
    Contour,
    Danger,
    Place,
}

/// Words of names, in lower case: `*` stands for any ending. Where a word is of two kinds, the first one counts.
const WORDS: [(Theme, &[&str]); 13] = [
    (
        Theme::Border,
        &[
            "watershed*",
            "catchment*",
            "basin*",
            "border*",
            "bound*",
            "admin*",
            "count*",
            "state",
            "states",
            "district*",
            "commune*",
            "communit*",
            "province*",
            "region",
            "regions",
            "regionen",
            "municip*",
            "grenz*",
            "gemeinde*",
            "zone",
            "zones",
            "perimeter*",
            "extent*",
            "outline*",
        ],
    ),
    (
        Theme::Water,
        &[
            "water*",
            "river*",
            "stream*",
            "lake*",
            "sea",
            "seas",
            "ocean*",
            "hydro*",
            "reservoir*",
            "pond*",
            "canal*",
            "wetland*",
            "gewaess*",
            "gewäss*",
            "fluss*",
            "fluess*",
            "bach",
            "baeche",
            "see",
            "seen",
            "meer*",
            "wasser*",
            "eau",
            "eaux",
            "lac",
            "lacs",
            "fleuve*",
            "riviere*",
            "rivière*",
            "rio",
            "rios",
            "agua*",
            "lago*",
        ],
    ),
    (
        Theme::Land,
        &["coast*", "shore*", "land", "island*", "insel*", "kueste*", "küste*", "continent*", "gshhs*"],
    ),
    (Theme::Ice, &["glacier*", "gletscher*", "ice", "rgi*", "snow*", "firn*", "glims*"]),
    (
        Theme::Wood,
        &[
            "forest*",
            "wood*",
            "tree*",
            "wald*",
            "veget*",
            "park",
            "parks",
            "protected*",
            "nature*",
            "reserve",
            "reserves",
            "foret*",
            "forêt*",
            "bosque*",
            "green*",
            "meadow*",
        ],
    ),
    (Theme::Rail, &["rail*", "train*", "tram*", "bahn*", "gleis*"]),
    (
        Theme::Path,
        &[
            "path*",
            "trail*",
            "track*",
            "hike*",
            "hiking*",
            "footway*",
            "weg",
            "wege",
            "piste*",
            "ski*",
            "centerline*",
            "centreline*",
            "flowline*",
        ],
    ),
    (
        Theme::Road,
        &[
            "road*",
            "street*",
            "highway*",
            "motorway*",
            "strass*",
            "straß*",
            "rue",
            "rues",
            "route*",
            "via",
            "vias",
            "calle*",
            "carretera*",
            "transport*",
            "way",
            "ways",
        ],
    ),
    (
        Theme::Building,
        &[
            "building*",
            "house*",
            "urban*",
            "built*",
            "settlement*",
            "gebaeude*",
            "gebäude*",
            "haeuser*",
            "school*",
            "restaurant*",
            "residential*",
            "dam",
            "dams",
            "wall",
            "walls",
        ],
    ),
    (
        Theme::Field,
        &[
            "farm*", "field*", "parcel*", "plot", "plots", "crop*", "agri*", "cadast*", "landuse*", "acker*",
            "flur*",
        ],
    ),
    (Theme::Contour, &["contour*", "isoline*", "isohyps*", "hoehenlinie*", "höhenlinie*"]),
    (
        Theme::Danger,
        &[
            "hazard*",
            "danger*",
            "avalanche*",
            "lawine*",
            "release*",
            "rel",
            "landslide*",
            "slide*",
            "flood*",
            "fire*",
            "risk*",
        ],
    ),
    (
        Theme::Place,
        &[
            "place*", "town*", "city", "cities", "village*", "peak*", "summit*", "poi", "pois", "station*",
            "hut", "huts",
        ],
    ),
];

impl Theme {
    /// The kind of thing that a layer of this name shows, where the name tells.
    pub(super) fn of(name: &str) -> Option<Self> {
        let words = words(name);
        let is = |pattern: &&str, word: &String| match pattern.strip_suffix('*') {
            Some(start) => word.starts_with(start),
            None => word == pattern,
        };
        let has =
            |patterns: &[&str]| words.iter().any(|word| patterns.iter().any(|pattern| is(pattern, word)));
        WORDS.iter().find(|(_, patterns)| has(patterns)).map(|(theme, _)| *theme)
    }

    /// How it looks.
    pub(super) fn look(self) -> Look {
        let look = |fill, opacity, stroke, width| Look { fill, opacity, stroke, width };
        match self {
            Self::Water => look([0x4a, 0x9b, 0xd9], 0.75, [0x1b, 0x63, 0xa5], 2.2),
            // What lies inside a coast is land; the coast itself is drawn as water is.
            Self::Land => look([0xcf, 0xc4, 0x8e], 0.45, [0x1b, 0x63, 0xa5], 2.2),
            Self::Ice => look([0xc4, 0xea, 0xf7], 0.75, [0x2a, 0x8c, 0xad], 2.0),
            Self::Wood => look([0x4f, 0xa0, 0x52], 0.45, [0x1e, 0x69, 0x2b], 2.0),
            Self::Road => look([0xe0, 0x7b, 0x39], 0.6, [0xd9, 0x4f, 0x1e], 2.8),
            Self::Rail => look([0x77, 0x77, 0x77], 0.6, [0x33, 0x33, 0x33], 2.0),
            Self::Path => look([0xb9, 0x7d, 0x3c], 0.5, [0x8c, 0x51, 0x0a], 2.0),
            Self::Building => look([0x9b, 0x8c, 0x8c], 0.8, [0x4d, 0x3f, 0x3f], 2.0),
            Self::Field => look([0xe3, 0xc5, 0x67], 0.4, [0x8a, 0x6d, 0x1a], 1.5),
            Self::Border => look([0x9a, 0x6f, 0xc0], 0.12, [0x6a, 0x2f, 0x9a], 2.0),
            Self::Contour => look([0xb0, 0x82, 0x50], 0.2, [0x8b, 0x5a, 0x2b], 1.2),
            Self::Danger => look([0xe8, 0x4a, 0x3c], 0.55, [0x9c, 0x10, 0x14], 2.5),
            Self::Place => look([0xf2, 0xb7, 0x1f], 0.6, [0x2b, 0x2b, 0x2b], 2.0),
        }
    }
}

/// The words of a name: it is cut where letters end and where a capital follows a small one.
fn words(name: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut before = ' ';
    for c in name.chars() {
        if (before.is_lowercase() && c.is_uppercase()) || !c.is_alphabetic() {
            words.push(String::new());
        }
        if c.is_alphabetic()
            && let Some(word) = words.last_mut()
        {
            word.extend(c.to_lowercase());
        }
        before = c;
    }
    words.retain(|word| !word.is_empty());
    words
}

/// Colours of layers whose names tell nothing, in turn: far apart in hue, and none of the themes'.
const OTHERS: [[u8; 3]; 6] = [
    [0xe7, 0x29, 0x8a],
    [0x1b, 0x9e, 0x77],
    [0x75, 0x70, 0xb3],
    [0xe6, 0xab, 0x02],
    [0xa6, 0x3d, 0x2f],
    [0x33, 0x7a, 0xb7],
];

/// Looks of the layers of a scene, no two alike.
#[derive(Debug, Default)]
pub(super) struct Looks {
    used: Vec<Option<Theme>>,
}

impl Looks {
    /// The look of the next layer. Areas of a kind that is there already show what they lie on.
    pub(super) fn of(&mut self, theme: Option<Theme>) -> Look {
        let before = self.used.iter().filter(|used| **used == theme).count();
        self.used.push(theme);
        let Some(theme) = theme else {
            let color = OTHERS[before % OTHERS.len()];
            let turns = before / OTHERS.len();
            let fill = shaded(color, turns);
            return Look { fill, opacity: 0.4, stroke: shaded(fill, 1), width: 2.5 };
        };
        let look = theme.look();
        let opacity = if before == 0 { look.opacity } else { 0.5 * look.opacity };
        Look { fill: shaded(look.fill, before), stroke: shaded(look.stroke, before), opacity, ..look }
    }
}

/// A colour of the same hue: the `n`-th beside it, darker and lighter in turn.
pub(super) fn shaded(color: [u8; 3], n: usize) -> [u8; 3] {
    let (to, share): (u8, usize) = match n % 4 {
        0 => (0, 0),
        1 => (0, 30),
        2 => (0, 55),
        _ => (255, 40),
    };
    color.map(|v| ((usize::from(v) * (100 - share) + usize::from(to) * share) / 100) as u8)
}

/// A colour as a scene file writes it.
pub(super) fn written([r, g, b]: [u8; 3]) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_tell_what_a_layer_shows() {
        for (name, theme) in [
            ("rivers", Some(Theme::Water)),
            ("water_33S", Some(Theme::Water)),
            ("watersheds_106", Some(Theme::Border)),
            ("WaterBodies2019", Some(Theme::Water)),
            ("roads_33S", Some(Theme::Road)),
            ("gis_osm_railways_free_1", Some(Theme::Rail)),
            ("protected_areas", Some(Theme::Wood)),
            ("relAlr", Some(Theme::Danger)),
            ("relMalRegional", Some(Theme::Danger)),
            ("regions_2020", Some(Theme::Border)),
            ("coastline", Some(Theme::Land)),
            ("rgi_oetztal", Some(Theme::Ice)),
            ("cb_2023_us_county_5m", Some(Theme::Border)),
            ("STRASSEN", Some(Theme::Road)),
            ("seesaw", None),
            ("entAlr", None),
            ("", None),
            ("1234", None),
        ] {
            assert_eq!(Theme::of(name), theme, "{name}");
        }
    }

    #[test]
    fn no_two_layers_of_a_kind_look_alike() {
        for theme in [None, Some(Theme::Road), Some(Theme::Water)] {
            let mut looks = Looks::default();
            let all: Vec<Look> = (0..4).map(|_| looks.of(theme)).collect();
            for (k, look) in all.iter().enumerate() {
                assert!(
                    all[..k].iter().all(|other| other.stroke != look.stroke && other.fill != look.fill),
                    "{theme:?}"
                );
            }
        }
    }
}
