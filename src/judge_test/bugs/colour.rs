//! Colours that are blended or encoded wrong.

use super::super::edit::Edit::{Keys, Picture, Scene};
use super::super::{geometry as g, picture};
use super::bug::{Bug, Class::Colour as Here};

/// The bugs.
pub(super) const BUGS: &[Bug] = &[
    Bug::any(Here, "blended in linear light", Keys(&["compositing.space=\"linear\""])),
    Bug::any(Here, "blended in codes", Keys(&["compositing.space=\"encoded\""])),
    Bug::any(Here, "added for over", Keys(&["compositing.mode=\"additive\""])),
    Bug::any(Here, "over for added", Keys(&["compositing.mode=\"over\""])),
    Bug::any(Here, "premultiplied twice", Scene(g::premultiplied_twice)),
    Bug::any(Here, "opacity twice", Scene(g::opacity_twice)),
    Bug::any(Here, "alpha dropped", Scene(g::alpha_dropped)),
    Bug::any(Here, "three hundredths less opaque", Scene(g::a_little_less_opaque)),
    Bug::any(Here, "alpha in four bits", Scene(g::alpha_in_four_bits)),
    Bug::any(Here, "layer's opacity ignored", Scene(g::group_ignored)),
    Bug::any(Here, "layer's opacity for each feature", Scene(g::group_as_features)),
    Bug::any(Here, "outlines in the fill's colour", Scene(g::outlines_in_the_fill_s_colour)),
    Bug::any(Here, "red and blue swapped", Picture(picture::red_for_blue)),
    Bug::any(Here, "green for red", Picture(picture::green_twice)),
    Bug::any(Here, "encoded twice", Picture(picture::encoded_twice)),
    Bug::any(Here, "colours three codes off", Scene(g::three_codes_off)),
    Bug::any(Here, "ground two codes off", Scene(g::ground_two_codes_off)),
    Bug::any(Here, "sky two codes off", Scene(g::sky_two_codes_off)),
    Bug::any(Here, "two codes darker", Picture(picture::two_codes_darker)),
    Bug::any(Here, "codes of seven bits", Picture(picture::seven_bits)),
    Bug::any(Here, "dithered", Picture(picture::dithered)),
    Bug::any(Here, "alpha of the sky dropped", Picture(picture::opaque)),
    Bug::any(Here, "alpha two codes less", Picture(picture::almost_opaque)),
    Bug::any(Here, "shade missing", Scene(g::shade_missing)),
    Bug::any(Here, "light five degrees beside", Scene(g::light_beside)),
    Bug::any(Here, "shade that nobody asked for", Scene(g::shade_added)),
];
