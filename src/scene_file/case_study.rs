//! The case studies of Zechmeister 2020, 5.1, as a scene file names them: their groups of data, and how much each has.
//!
//! Tables 5.1 and 5.2 tell the sums of a study alone. Those of HORA RLL, FA and RC part without a remainder into groups that they share (22,330
//! lakes with 659 islands; 12 borders of 50,079 vertices) and one of their own. The groups of the other studies are estimates that keep the sums.

use crate::parameter::words;

words! {
    /// A case study.
    pub enum Study {
        /// HORA Isolines (5.1.1).
        Isolines = "il",
        /// Cologne OpenStreetMap (5.1.2).
        Cologne = "osm",
        /// Wachau (5.1.3).
        Wachau = "wachau",
        /// Graz Sewer Catchments (5.1.4).
        Graz = "graz",
        /// HORA River Lines & Lakes (5.1.5).
        Rivers = "rll",
        /// Cologne & Surrounding Area (5.1.6).
        Surroundings = "sa",
        /// HORA Flood Areas (5.1.7).
        Floods = "fa",
        /// HORA River Catchments (5.1.8).
        Catchments = "rc",
    }
}

words! {
    /// A data group of a study: what is drawn alike.
    pub enum Group {
        /// Nested areas along a river, few of them, with many islands.
        Isolines = "isolines",
        /// Nested areas along rivers, jagged, with hundreds of islands each.
        Floods = "floods",
        /// A partition into jagged areas.
        Catchments = "catchments",
        /// A partition into small areas, some with holes.
        LandUse = "land-use",
        /// Scattered areas of very different sizes, the largest with islands.
        Lakes = "lakes",
        /// The same in a city.
        Water = "water",
        /// Right-angled areas between streets.
        Buildings = "buildings",
        /// Short lines that meet in towns.
        Roads = "roads",
        /// The same, fewer.
        Tracks = "tracks",
        /// Long lines.
        Rails = "rails",
        /// Long winding lines.
        Rivers = "rivers",
        /// The same, shorter.
        Streams = "streams",
        /// Few closed lines of very many vertices.
        Borders = "borders",
    }
}

/// Rings or lines and all their vertices.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Amount {
    /// How many rings or lines.
    pub decals: usize,
    /// How many vertices all of them have.
    pub vertices: usize,
}

/// How much a group has. Outlines, which follow from the rings, are not counted in it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DataGroup {
    /// Its name.
    pub group: Group,
    /// Outer rings of polygons.
    pub exterior: Amount,
    /// Holes.
    pub interior: Amount,
    /// Lines.
    pub lines: Amount,
}

const NONE: Amount = Amount { decals: 0, vertices: 0 };

const fn amount((decals, vertices): (usize, usize)) -> Amount {
    Amount { decals, vertices }
}

const fn areas(group: Group, exterior: (usize, usize), interior: (usize, usize)) -> DataGroup {
    DataGroup { group, exterior: amount(exterior), interior: amount(interior), lines: NONE }
}

const fn lines(group: Group, lines: (usize, usize)) -> DataGroup {
    DataGroup { group, exterior: NONE, interior: NONE, lines: amount(lines) }
}

/// What three studies of Austria share: all polygons of HORA RLL, and in HORA RC all holes and the lines that are no outlines.
const LAKES: DataGroup = areas(Group::Lakes, (22_330, 904_271), (659, 61_666));
const BORDERS: DataGroup = lines(Group::Borders, (12, 50_079));

impl Study {
    /// Its data groups from the lowest to the highest.
    pub fn groups(self) -> &'static [DataGroup] {
        use Group::*;
        match self {
            Self::Isolines => const { &[areas(Isolines, (19, 53_833), (1605, 69_178))] },
            Self::Cologne => {
                const {
                    &[
                        areas(LandUse, (6949, 160_000), (800, 17_000)),
                        areas(Water, (800, 25_720), (56, 1686)),
                        lines(Roads, (43_985, 227_219)),
                    ]
                }
            }
            Self::Wachau => {
                const {
                    &[
                        areas(LandUse, (21_710, 328_924), (2327, 20_445)),
                        lines(Roads, (6277, 95_000)),
                        lines(Borders, (30, 19_612)),
                    ]
                }
            }
            Self::Graz => {
                const {
                    &[
                        areas(LandUse, (83_768, 1_330_000), (31_380, 330_945)),
                        areas(Catchments, (8000, 1_120_000), (0, 0)),
                        areas(Lakes, (500, 21_650), (0, 0)),
                        lines(Rivers, (600, 40_434)),
                        lines(Streams, (1500, 60_000)),
                        lines(Tracks, (4000, 48_000)),
                        lines(Roads, (14_000, 180_000)),
                        lines(Rails, (1011, 12_000)),
                    ]
                }
            }
            Self::Rivers => const { &[LAKES, lines(Rivers, (2735, 4_752_296)), BORDERS] },
            Self::Surroundings => {
                const {
                    &[
                        areas(LandUse, (80_000, 2_848_849), (200, 2200)),
                        areas(Water, (6321, 140_000), (76, 782)),
                        areas(Buildings, (360_000, 3_240_000), (0, 0)),
                        lines(Rivers, (2000, 20_000)),
                        lines(Roads, (290_334, 1_430_521)),
                    ]
                }
            }
            Self::Floods => {
                const { &[areas(Floods, (668, 1_533_586), (115_637, 8_207_296)), LAKES, BORDERS] }
            }
            Self::Catchments => const { &[areas(Catchments, (41_067, 14_163_305), (0, 0)), LAKES, BORDERS] },
        }
    }

    /// One of its groups; `None` where it has no such group.
    pub fn group(self, group: Group) -> Option<&'static DataGroup> {
        self.groups().iter().find(|own| own.group == group)
    }
}

impl Amount {
    /// So many times as much, and where there is something, at least one of at least so many vertices.
    pub fn scaled(self, scale: f64, least: usize) -> Self {
        if self.decals == 0 {
            return self;
        }
        let times = |number: usize| (number as f64 * scale).round() as usize;
        let decals = times(self.decals).max(1);
        Self { decals, vertices: times(self.vertices).max(least * decals) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parameter::Named;

    #[test]
    fn no_study_has_a_group_twice() {
        for (name, study) in Study::NAMES {
            let groups = study.groups();
            let is_twice = |at: usize| groups[..at].iter().any(|other| other.group == groups[at].group);
            assert!(!(0..groups.len()).any(is_twice), "{name}");
        }
    }

    #[test]
    fn what_is_scaled_down_never_vanishes_and_keeps_the_fewest_vertices() {
        let amount = |decals, vertices| Amount { decals, vertices };
        assert_eq!(amount(1000, 5000).scaled(0.01, 3), amount(10, 50));
        assert_eq!(amount(12, 50_079).scaled(0.01, 2), amount(1, 501));
        assert_eq!(amount(1000, 5000).scaled(1e-9, 3), amount(1, 3));
        assert_eq!(amount(0, 0).scaled(0.5, 3), amount(0, 0));
    }
}
