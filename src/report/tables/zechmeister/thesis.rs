//! What the thesis tells of its case studies: Tables 5.1 to 5.3, as they are printed.

use super::amounts::{Amount, Amounts, Groups};

/// A case study of the thesis.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Study {
    /// Its name there.
    pub name: &'static str,
    /// Tables 5.1 and 5.2.
    pub amounts: Amounts,
    /// Table 5.3.
    pub groups: Groups,
}

/// The studies in the thesis's order: by their vertices.
pub static STUDIES: [Study; 8] = [
    study("HORA IL", [[19, 53_833], [1605, 69_178], [1624, 123_011]], ([1, 0, 0], [0, 0])),
    study("Cologne OSM", [[7749, 185_720], [856, 18_686], [43_985, 227_219]], ([0, 2, 1], [2, 1])),
    study("Wachau", [[21_710, 328_924], [2327, 20_445], [6307, 114_612]], ([0, 1, 2], [1, 1])),
    study("Graz SC", [[92_268, 2_471_650], [31_380, 330_945], [29_111, 1_460_434]], ([1, 2, 5], [3, 5])),
    study("HORA RLL", [[22_330, 904_271], [659, 61_666], [2747, 4_802_375]], ([0, 1, 2], [0, 0])),
    study("Cologne SA", [[446_321, 6_228_849], [276, 2982], [652_334, 4_690_521]], ([1, 2, 2], [2, 1])),
    study("HORA FA", [[22_998, 2_437_857], [116_296, 8_268_962], [116_317, 9_790_961]], ([1, 1, 1], [1, 0])),
    study("HORA RC", [[63_397, 15_067_576], [659, 61_666], [41_079, 14_213_384]], ([1, 1, 1], [1, 0])),
];

const fn study(
    name: &'static str,
    [exterior, interior, lines]: [[usize; 2]; 3],
    ([outlined, areas, lines_alone], [fills, strokes]): ([usize; 3], [usize; 2]),
) -> Study {
    const fn amount([decals, vertices]: [usize; 2]) -> Amount {
        Amount { decals, vertices }
    }
    Study {
        name,
        amounts: Amounts { exterior: amount(exterior), interior: amount(interior), lines: amount(lines) },
        groups: Groups { outlined, areas, lines: lines_alone, colored_areas: fills, colored_lines: strokes },
    }
}

/// The study of a name.
pub fn study_of(name: &str) -> Option<&'static Study> {
    STUDIES.iter().find(|study| study.name == name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parameter::Named;
    use crate::scene_file::{self, DataGroup};

    #[test]
    fn the_sums_are_those_of_the_thesis() {
        let of = |study: &Study| {
            let Amounts { exterior, interior, lines } = study.amounts;
            let decals = exterior.decals + interior.decals + lines.decals;
            (decals, exterior.vertices + interior.vertices + lines.vertices)
        };
        let printed = [
            (3248, 246_022),
            (52_590, 431_625),
            (30_344, 463_981),
            (152_759, 4_263_029),
            (25_736, 5_768_312),
            (1_098_931, 10_922_352),
            (255_611, 20_497_780),
            (105_135, 29_342_626),
        ];
        assert_eq!(STUDIES.each_ref().map(of), printed);
        let calls = [2, 3, 3, 9, 3, 6, 4, 4];
        assert_eq!(STUDIES.each_ref().map(|study| study.groups.draw_calls()), calls);
    }

    #[test]
    fn the_groups_that_are_generated_have_as_much_in_all_as_the_thesis() {
        for ((word, study), thesis) in scene_file::Study::NAMES.iter().zip(&STUDIES) {
            // Which groups have outlines is said by the scenes: those of isolines, catchments, buildings and floods.
            let is_outlined = |data: &&DataGroup| {
                use scene_file::Group::*;
                matches!(data.group, Isolines | Catchments | Buildings | Floods)
            };
            let of = |pick: fn(&scene_file::Amount) -> usize| {
                let all = study.groups().iter();
                let outlines: usize =
                    all.clone().filter(is_outlined).map(|d| pick(&d.exterior) + pick(&d.interior)).sum();
                let sum = |of: fn(&DataGroup) -> scene_file::Amount| -> usize {
                    study.groups().iter().map(|data| pick(&of(data))).sum()
                };
                [sum(|d| d.exterior), sum(|d| d.interior), outlines + sum(|d| d.lines)]
            };
            let Amounts { exterior, interior, lines } = thesis.amounts;
            assert_eq!(of(|a| a.decals), [exterior.decals, interior.decals, lines.decals], "{word}");
            assert_eq!(of(|a| a.vertices), [exterior.vertices, interior.vertices, lines.vertices], "{word}");
        }
    }
}
