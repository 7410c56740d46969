//! How far techniques are from the truth.

use super::super::curves::{Axis, Curve, curves};
use super::super::figure::{Figure, Panel, Paper, Scale};
use super::super::shot::Shot;
use crate::buffer::Buffer;
use crate::compare::{Difference, Expected, Image};
use crate::error::{Error, Result};
use crate::measure::{Certified, Unwatched, applicable, image, supersampled};
use crate::technique::Kind;
use crate::truth::Budget;

const VALLEY: &str = include_str!("../schneider_klein/valley.toml");
const ROADS: &str = include_str!("../she/roads.toml");

pub(super) const TECHNIQUES: Figure = Figure {
    name: "ours-techniques",
    paper: Paper::Ours,
    number: "",
    title: "Every technique, and where it is wrong",
    caption: "One scene, without shading, by each technique that draws it with its default settings, beside its distance from the truth: black lies in the certified interval, blue is off by at \
              most a step of an 8-bit code, yellow to pink by more.",
    look_for: "which borders each one misses: samples that are too few, textures that are too coarse, corners that are drawn in another way; geometry overlay fills nothing.",
    draw: techniques,
};

fn certified(shot: &Shot) -> Result<Certified> {
    Certified::of((&shot.stage, &shot.view), &Budget::default(), 1, &Unwatched)
}

fn techniques(scale: Scale) -> Result<Vec<Panel>> {
    // The ground's own shading has borders too, which all have in common.
    let shot = Shot::scaled(VALLEY, &["terrain.shade="], scale)?;
    let truth = certified(&shot)?;
    let mut panels = Vec::new();
    for kind in applicable(&shot.stage, &Unwatched)? {
        let picture = shot.by(kind)?;
        let difference = truth.difference(&Image::from_rgba8(&picture)?)?;
        let metrics = difference.metrics(0.0);
        let caption = format!(
            "off by {:.4} (root mean square), by more than a step in {:.1} % of pixels",
            metrics.rmse,
            100.0 * metrics.over_one_code_value
        );
        panels.push(Panel::picture(kind.name(), picture));
        panels.push(Panel::picture(caption, difference.heat_map(1.0 / 255.0)));
    }
    Ok(panels)
}

pub(super) const SAMPLES: Figure = Figure {
    name: "ours-samples",
    paper: Paper::Ours,
    number: "",
    title: "Error against samples",
    caption: "The root mean square of the distance from the truth, over the samples a pixel: plain supersampling, and the techniques that take samples.",
    look_for: "stencil volumes and static decals are supersampling in another way. Inverse projection with the paper's corners stops getting better at once: its half-pixel shift weighs more than \
               its samples. With true corners it gets further, and stops where its other simplifications weigh more.",
    draw: samples,
};

/// The techniques that take n x n samples, the setting, further ones, and which n are tried.
const SAMPLED: [(Kind, &str, &[&str], &[usize]); 4] = [
    (Kind::StencilVolume, "technique.stencil-volume.samples", &[], &[1, 2, 3, 4, 6, 8]),
    (Kind::InverseProjection, "technique.inverse-projection.samples", &[], &[1, 2, 3, 4, 6, 8]),
    (
        Kind::InverseProjection,
        "technique.inverse-projection.samples",
        &["technique.inverse-projection.corners=\"true\""],
        &[1, 2, 3, 4, 6, 8],
    ),
    (Kind::StaticDecal, "technique.static-decal.samples", &[], &[1, 3, 4, 6, 8]),
];

fn samples(scale: Scale) -> Result<Vec<Panel>> {
    // The ground's own shading is the same in all: without it, what is left is lines.
    let flat = ["image.width=240", "image.height=160", "terrain.shade=", "layer.roads.line.cap=\"butt\""];
    let shot = Shot::scaled(ROADS, &flat, scale)?;
    let truth = certified(&shot)?;
    let mut all = Vec::new();
    let mut points = Vec::new();
    for n in [1, 2, 3, 4, 6, 8, 12, 16] {
        let (sampled, _) = supersampled((&shot.stage, &shot.view), n, 1, &Unwatched)?;
        points.push([(n * n) as f64, truth.difference(&image(&sampled.colors)?)?.metrics(0.0).rmse]);
    }
    all.push(Curve { name: "supersampling".into(), points });
    for (kind, setting, further, counts) in SAMPLED {
        let mut points = Vec::new();
        for n in counts {
            // Static decals say how many samples a pixel has, the others how many both ways.
            let value = if kind == Kind::StaticDecal { n * n } else { *n };
            let set = format!("{setting}={value}");
            let changes = [&flat[..], further, &[set.as_str()]].concat();
            let picture: Buffer<[u8; 4]> = Shot::scaled(ROADS, &changes, scale)?.by(kind)?;
            points.push([(n * n) as f64, truth.metrics(&picture)?.rmse]);
        }
        let words = if further.is_empty() { "" } else { ", true corners" };
        all.push(Curve { name: format!("{}{words}", kind.name()), points });
    }
    let across = Axis { title: "samples a pixel", decades: [0, 3] };
    let up = Axis { title: "root mean square error", decades: [-4, -1] };
    let drawn = curves("error against samples", [&across, &up], &all);
    Ok(vec![Panel::drawing("roads of 5 m on ground without shading", drawn)])
}

pub(super) const MACHINES: Figure = Figure {
    name: "ours-machines",
    paper: Paper::Ours,
    number: "",
    title: "The same technique on four machines",
    caption: "Static decals in exact mathematics and on imitated machines: single precision, vertices snapped to a 16th of a pixel, depth of 16 bits. Of the \
              machines the difference from exact mathematics.",
    look_for: "machines differ at silhouettes and borders, by whole samples.",
    draw: machines,
};

const DEVICES: [(&[&str], &str); 4] = [
    (&[], "exact mathematics"),
    (&["device.precision=\"f32\""], "single precision"),
    (&["device.precision=\"f32\"", "device.subpixel_bits=4"], "snapped to a 16th of a pixel"),
    (&["device.precision=\"f32\"", "device.subpixel_bits=8", "device.depth=\"unorm16\""], "depth of 16 bits"),
];

fn machines(scale: Scale) -> Result<Vec<Panel>> {
    let mut panels = Vec::new();
    let mut exact: Option<Expected> = None;
    for (device, words) in DEVICES {
        let picture = Shot::scaled(VALLEY, device, scale)?.by(Kind::StaticDecal)?;
        let seen = Image::from_rgba8(&picture)?;
        if let Some(exact) = &exact {
            let difference = Difference::of(exact, &seen)
                .map_err(|what| Error::internal(format!("two machines: {what}")).caused_by(what))?;
            let off = difference.metrics(1.0 / 255.0).failing;
            panels.push(Panel::picture(
                format!("{words}: {off} pixels differ by more than a step"),
                difference.heat_map(1.0 / 255.0),
            ));
        } else {
            panels.push(Panel::picture(words, picture));
            exact = Some(Expected::exactly(seen));
        }
    }
    Ok(panels)
}
