//! The items as tables: what is painted, in draw order, whoever draws it.

use crate::buffer::{Plane, Values};
use crate::canvas::table;
use crate::draw_list::DrawList;

/// A row an item in draw order: layer, feature in the layer ([`crate::draw_list::NO_FEATURE`] of what is outside of all polygons), what it is (0 a fill, 1
/// what is outside, 2 an outline, 3 a line, 4 a point), its polygon's rule (0 even-odd, 1 nonzero), which side of that counts (0 both, 1 its inside, 2 its
/// outside), and 1 where its layer is composed as a whole.
pub fn items(list: &DrawList) -> Plane {
    let row = |number: u32, layer: u32, feature: u32| {
        let style = list.style_of(number);
        let [role, rule, cut] = style.codes();
        [layer, feature, role, rule, cut, u32::from(style.group.is_some())]
    };
    let mut rows = list.numbered().map(|(number, item)| row(number, item.layer, item.feature)).collect();
    table("items", &mut rows, Values::U32)
}

/// A row an item: what it is painted with, red, green, blue, alpha (encoded, straight, all opacities of its own in it), and the opacity of its layer as a
/// whole, 1 where it is composed by itself.
pub fn item_paints(list: &DrawList) -> Plane {
    let row = |number: u32| {
        let style = list.style_of(number);
        let [r, g, b, a] = style.paint.0;
        [r, g, b, a, style.group.map_or(1.0, |group| group.opacity)]
    };
    let mut rows = list.numbered().map(|(number, _)| row(number)).collect();
    table("paints", &mut rows, Values::F64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn items_are_told_in_draw_order_with_what_they_are_and_their_paint() {
        let text = "schema = 1\nterrain = { generate = { kind = \"plane\", posts = [3, 3], cell_m = 10.0, height_m = 1.0 } }\n\
             [[layer]]\nfeatures = [{ polygon = [[-4, -4], [4, -4], [0, 4]] }]\nopacity = 0.25\n\
             fill = { color = \"#ff0000\", opacity = 0.5, rule = \"nonzero\" }\n\
             outline = { color = \"#0000ff\", width_m = 1.0, mode = \"offset\" }\n\
             [[layer]]\nfeatures = [{ line = [[-9, 0], [9, 0]] }]\nline = { color = \"#00ff00\", width_m = 2.0 }\n";
        let stage = crate::Opened::parse(text).unwrap().stage;
        let Values::U32(rows) = items(&stage.draw_list).values else { panic!() };
        assert_eq!(rows.as_chunks::<6>().0, [[0, 0, 0, 1, 0, 1], [0, 0, 2, 1, 2, 1], [1, 0, 3, 0, 0, 0]]);
        let Values::F64(paints) = item_paints(&stage.draw_list).values else { panic!() };
        assert_eq!(paints.as_chunks::<5>().0[0], [1.0, 0.0, 0.0, 0.5, 0.25]);
        assert_eq!(paints.as_chunks::<5>().0[2], [0.0, 1.0, 0.0, 1.0, 1.0]);
    }
}
