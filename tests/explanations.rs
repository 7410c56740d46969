//! What `drapery explain` tells of a pixel is so: what covers it, how near its border is, what techniques made of it, why a feature is not there.

#![cfg(feature = "render")]
#![allow(clippy::unwrap_used, reason = "helpers of tests are no tests to the lint")]

mod drawing;

use drapery::explain::{self, Account, Asking, page};
use drapery::measure::Unwatched;
use drapery::technique::{self, Kind};
use drapery::truth::Budget;
use drapery::{Opened, Result};

/// A white plane seen from straight above, 10 m a pixel, of which a black polygon covers all west of `x` metres; a red road crosses its east.
fn text(x: f64) -> String {
    let layers = format!(
        "[[layer]]\nname = \"field\"\nfeatures = [{{ polygon = [[-900, -900], [{x}, -900], [{x}, 900], [-900, 900]], properties = {{ name = \"Acre\" }} }}]\n\
         fill = {{ color = \"#000000\" }}\n\
         [[layer]]\nname = \"road\"\nfeatures = [{{ line = [[300, -900], [300, 900]], properties = {{ ref = \"A1\" }} }}]\n\
         line = {{ color = \"#ff0000\", width_m = 20.0 }}\n\
         [technique.static-decal]\nsamples = 4\n"
    );
    drawing::scene(
        "kind = \"plane\", posts = [97, 97], cell_m = 20.0, height_m = 0.0",
        "eye = [0, 0, 500], target = [0, 0, 0], up = [0, 1, 0], projection = \"orthographic\", height_m = 640.0",
        &layers,
    )
}

fn asking<'a>(kinds: &'a [Kind], feature: Option<&'a str>) -> Asking<'a> {
    Asking { kinds: Some(kinds), feature, attributes: &[], close_up: 0, budget: Budget::default() }
}

/// The account of a pixel of row 30, of a scene whose field ends at `x` metres.
fn told(x: f64, column: usize, kinds: &[Kind], feature: Option<&str>) -> Result<Account> {
    let mut scene = Opened::parse(&text(x)).unwrap();
    let attributes = drapery::source::load::attributes(&scene.text.file, &|_| {});
    let asking = Asking { attributes: &attributes, ..asking(kinds, feature) };
    explain::pixel(&mut scene, &asking, [column, 30])
}

#[test]
fn a_pixel_across_a_border_is_told_by_its_shares_and_its_margin() {
    // Column 48 is 0 to 10 m; its centre is 0.003 pixels east of the field's border.
    let account = told(4.97, 48, &[Kind::StencilVolume], None).unwrap();
    let [field] = &account.covering[..] else { panic!("{:?}", account.covering) };
    assert_eq!(field.name, "field 0 \"Acre\" (fill)");
    assert!((field.low - 0.497).abs() < 1e-9 && (field.high - 0.497).abs() < 1e-9, "{field:?}");
    assert!((account.truth.estimate[0] - 0.503).abs() < 1e-9, "{:?}", account.truth);
    let margin = &account.centre.as_ref().unwrap().margins[0];
    assert!((margin.pixels - 0.003).abs() < 1e-9 && !margin.is_inside, "{margin:?}");
    assert_eq!((margin.toward, &margin.flipped_by[..]), ("left of it", &["a snap to 1/16 px"][..]));
    assert!(
        account
            .text()
            .contains("it is outside field 0 \"Acre\" (fill), whose border is 0.00300 px left of it")
    );
    assert_eq!(account.centre.as_ref().unwrap().silhouette, None);
    let names: Vec<&str> = account.ladder.iter().map(|rung| rung.name.as_str()).collect();
    assert_eq!(names, ["ground"]);
    let shares: f64 = account.scenery.pieces.iter().map(|piece| piece.share).sum();
    assert!((shares - 1.0).abs() < 1e-9, "{shares}");
}

#[test]
fn each_technique_is_told_with_the_frames_colour_its_sections_and_what_brings_it_nearer() {
    let scene = Opened::parse(&text(4.97)).unwrap();
    let kinds = [Kind::StencilVolume, Kind::StaticDecal, Kind::InverseProjection];
    let account = told(4.97, 48, &kinds, None).unwrap();
    assert_eq!(account.techniques.len(), kinds.len());
    for (by, kind) in account.techniques.iter().zip(kinds) {
        let frame = drawing::frame_of(kind, &scene.stage, &[]);
        assert_eq!(by.code, *frame.image.at(48, 30), "{}", by.technique);
        assert!(by.steps.iter().all(|step| !step.section.is_empty() && !step.text.is_empty()));
        assert!(by.steps.iter().any(|step| !step.margins.is_empty()), "{by:?}");
    }
    let stencil = &account.techniques[0];
    assert!((stencil.error - 0.497).abs() < 0.001, "{stencil:?}");
    assert!(stencil.tried.iter().any(|tried| tried.error < 0.01), "{:?}", stencil.tried);
}

#[test]
fn the_scenes_own_settings_are_back_when_others_have_been_tried() {
    let mut scene = Opened::parse(&text(4.97)).unwrap();
    let before = scene.stage.scene.technique.clone();
    explain::pixel(&mut scene, &asking(&[Kind::StaticDecal], None), [48, 30]).unwrap();
    assert_eq!(scene.stage.scene.technique, before);
}

#[test]
fn a_feature_that_is_not_there_is_told_with_where_it_is() {
    let kinds = [Kind::StencilVolume];
    for asked in ["road", "ROAD", "road/0", "A1"] {
        let account = told(4.97, 60, &kinds, Some(asked)).unwrap();
        let feature = account.feature.unwrap();
        let reasons = feature.reasons.join("; ");
        assert!(!feature.shows, "{reasons}");
        // The pixel's centre is at 125 m, the road's centre line at 300 m.
        assert!(reasons.contains("road 0 \"A1\" (line), 175.00 m east"), "{reasons}");
        assert!(reasons.contains("is seen at 78.0, 30.5: pixel 78,30"), "{reasons}");
    }
    let feature = told(4.97, 78, &kinds, Some("road")).unwrap().feature.unwrap();
    assert!(feature.shows && feature.reasons[0].contains("covers 100.00 % of the pixel"), "{feature:?}");
}

#[test]
fn what_cannot_be_told_is_refused_with_what_is_near() {
    let refused =
        |column, kinds: &[Kind], feature| told(4.97, column, kinds, feature).unwrap_err().to_string();
    assert!(refused(96, &[], None).contains("there is no pixel 96,30 in a picture of 96 x 64"));
    assert!(refused(3, &[Kind::DynamicLine], None).contains("width in pixels"));
    assert!(refused(3, &[], Some("raod")).contains("did you mean `road`?"));
    assert!(refused(3, &[], Some("Acer")).contains("did you mean `Acre`?"));
    assert!(refused(3, &[], Some("road/7")).contains("no layer and no feature is called `road/7`"));
}

#[test]
fn a_silhouette_is_told_with_what_is_seen_beyond() {
    // A ridge along the middle of the picture, seen flatly from the south: its northern side is hidden.
    let text = drawing::scene(
        "kind = \"cone\", posts = [33, 33], cell_m = 20.0, height_m = 120.0",
        "eye = [0, -900, 60], target = [0, 0, 40]",
        "",
    );
    let mut scene = Opened::parse(&text).unwrap();
    let view = scene.view().unwrap();
    let asking = asking(&[], None);
    let has_sky = |account: &Account| {
        account.scenery.pieces.iter().any(|piece| piece.share > 0.0 && piece.triangle.is_none())
    };
    let mut seen = 0;
    for y in 0..view.height() {
        let account = explain::pixel(&mut scene, &asking, [view.width() / 2, y]).unwrap();
        if let (true, Some(centre)) = (has_sky(&account), &account.centre) {
            seen += 1;
            let edge = centre.silhouette.as_ref().unwrap();
            assert!(edge.triangle.is_none() && edge.pixels <= 0.71, "{edge:?}");
        }
    }
    assert!(seen > 0);
}

#[test]
fn a_page_is_one_file_that_asks_the_network_for_nothing() {
    let mut scene = Opened::parse(&text(4.97)).unwrap();
    let kinds = [Kind::StaticDecal, Kind::StencilVolume];
    let asking = Asking { close_up: 8, ..asking(&kinds, None) };
    let interesting = explain::picture(&scene, &asking, 5, &Unwatched).unwrap();
    let account = explain::pixel(&mut scene, &asking, [48, 30]).unwrap();
    let pages = [page::of_pixel("<b>", &account).unwrap(), page::of_picture("<b>", &interesting).unwrap()];
    for page in pages {
        assert!(page.contains("&lt;b&gt;") && !page.contains("<b>"));
        assert!(!page.contains("://") && !page.contains("@import"), "a page names an address");
        assert_eq!(page.matches("</script>").count(), page.matches("<script").count());
    }
}

#[test]
fn the_pixels_of_a_page_are_the_worst_and_each_is_of_a_square_of_its_own() {
    let scene = Opened::parse(&text(4.97)).unwrap();
    let kinds = [Kind::StencilVolume];
    let interesting = explain::picture(&scene, &asking(&kinds, None), 12, &Unwatched).unwrap();
    let off = |account: &Account| account.techniques[0].error;
    let count = interesting.accounts.len();
    assert!(count > 3 && count <= 12, "{count}");
    assert!(interesting.accounts.windows(2).all(|pair| off(&pair[0]) >= off(&pair[1]) - 1e-9));
    // The field's border is wrong all along column 48, the road's are right.
    assert!(interesting.accounts.iter().all(|account| account.pixel[0] == 48 && off(account) > 0.4));
    let mut squares: Vec<usize> =
        interesting.accounts.iter().map(|a| a.pixel[1] / interesting.square).collect();
    squares.sort_unstable();
    squares.dedup();
    assert_eq!(squares.len(), count);
}

#[test]
fn every_step_of_every_technique_names_its_section() {
    let stage = Opened::parse(&text(4.97)).unwrap().stage;
    let view = stage.view().unwrap();
    for kind in drawing::kinds_for(&stage) {
        let prepared = technique::prepare(kind, &stage).unwrap();
        let pixels = [[48, 30], [0, 0], [78, 12]];
        let together = prepared.steps_of_all(&view, &pixels).unwrap();
        for (explained, pixel) in together.iter().zip(pixels) {
            let alone = technique::explain(prepared.as_ref(), &view, pixel).unwrap();
            assert_eq!(format!("{:?}", explained.steps), format!("{:?}", alone.steps), "{kind:?} {pixel:?}");
            assert!(explained.steps.iter().all(|step| !step.section().is_empty()), "{kind:?}");
        }
    }
}
