//! Edits of the terrain, the ground, the sky and the camera.

use crate::scene::{Color, DepthFormat, GroundColors, Light, Posts, Projection, Scene, Surface};
use crate::space::{Plan, World};
use glam::{DVec2, DVec3};

fn grid(surface: &mut Surface, edit: impl FnOnce(&mut Posts) -> bool) -> bool {
    match surface {
        Surface::Grid(posts) => edit(posts),
        Surface::Points(_) | Surface::Globe(_) => false,
    }
}

fn heights(surface: &mut Surface, edit: impl Fn(f64) -> f64) -> bool {
    grid(surface, |posts| {
        posts.heights_mut().iter_mut().fold(false, |any, h| {
            let new = edit(*h);
            let is_new = new != *h;
            *h = new;
            any | is_new
        })
    })
}

pub(in super::super) fn heights_a_fiftieth_more(_: &mut Scene, surface: &mut Surface) -> bool {
    heights(surface, |h| h * 1.02)
}

pub(in super::super) fn heights_in_steps(_: &mut Scene, surface: &mut Surface) -> bool {
    heights(surface, |h| (h / 8.0).floor() * 8.0)
}

/// Feet taken as metres.
pub(in super::super) fn heights_in_feet(_: &mut Scene, surface: &mut Surface) -> bool {
    heights(surface, |h| h * 0.3048)
}

/// Heights stand half a cell off, as those of pixels that are areas.
pub(in super::super) fn posts_half_a_cell_off(_: &mut Scene, surface: &mut Surface) -> bool {
    grid(surface, |posts| {
        posts.first = posts.first + (posts.east() + posts.north()) * 0.5;
        true
    })
}

/// A post in the middle is at the height 0.
pub(in super::super) fn a_post_without_height(_: &mut Scene, surface: &mut Surface) -> bool {
    grid(surface, |posts| {
        let middle = posts.rows() / 2 * posts.columns() + posts.columns() / 2;
        let was = std::mem::replace(&mut posts.heights_mut()[middle], 0.0);
        was != 0.0
    })
}

/// The first row is the northern one.
pub(in super::super) fn rows_from_the_north(_: &mut Scene, surface: &mut Surface) -> bool {
    grid(surface, |posts| {
        let columns = posts.columns();
        let turned: Vec<f64> = posts.heights().chunks(columns).rev().flatten().copied().collect();
        let is_other = turned != posts.heights();
        posts.heights_mut().copy_from_slice(&turned);
        is_other
    })
}

/// The mesh is smoothed: each post is the mean of itself and its eastern neighbour.
pub(in super::super) fn heights_smoothed(_: &mut Scene, surface: &mut Surface) -> bool {
    grid(surface, |posts| {
        let columns = posts.columns();
        let before = posts.heights().to_vec();
        for (k, h) in posts.heights_mut().iter_mut().enumerate() {
            let east = if k % columns + 1 < columns { k + 1 } else { k };
            *h = (before[k] + before[east]) / 2.0;
        }
        before != posts.heights()
    })
}

/// The same posts, on a grid that is written from another corner: columns are rows, one way turned round.
pub(in super::super) fn grid_turned(scene: &mut Scene, surface: &mut Surface) -> bool {
    if scene.lod.is_some() || scene.diagonal != crate::scene::Diagonal::SwNe {
        return false;
    }
    // Turned by half a turn, a cell's diagonal from south-west to north-east stays what it is.
    grid(surface, |posts| {
        let (columns, rows) = (posts.columns(), posts.rows());
        let first = posts.plan(columns - 1, rows - 1);
        let (east, north) = (-posts.east(), -posts.north());
        let turned = posts.heights().iter().rev().copied().collect();
        Posts::new((columns, rows), first, (east, north), turned).map(|new| *posts = new).is_ok()
    })
}

fn camera(scene: &mut Scene, edit: impl FnOnce(World, World) -> World) -> bool {
    scene.camera.eye = edit(scene.camera.eye, scene.camera.target);
    true
}

/// The eye a hundredth of its distance higher.
pub(in super::super) fn eye_higher(scene: &mut Scene, _: &mut Surface) -> bool {
    camera(scene, |eye, target| eye + DVec3::Z * ((target - eye).length() / 100.0))
}

/// The eye a hundredth of its distance to the side.
pub(in super::super) fn eye_beside(scene: &mut Scene, _: &mut Surface) -> bool {
    camera(scene, |eye, target| eye + DVec3::X * ((target - eye).length() / 100.0))
}

/// The picture spans a fiftieth more than it should.
pub(in super::super) fn wider_angle(scene: &mut Scene, _: &mut Surface) -> bool {
    scene.camera.projection = match scene.camera.projection {
        Projection::Perspective { fov_y_deg } => Projection::Perspective { fov_y_deg: fov_y_deg * 1.02 },
        Projection::Orthographic { height_m } => Projection::Orthographic { height_m: height_m * 1.02 },
    };
    true
}

/// Parallel rays for those through the eye.
pub(in super::super) fn parallel_rays(scene: &mut Scene, _: &mut Surface) -> bool {
    let Projection::Perspective { fov_y_deg } = scene.camera.projection else { return false };
    let distance = (scene.camera.target - scene.camera.eye).length();
    let height_m = 2.0 * distance * crate::math::tan(fov_y_deg.to_radians() / 2.0);
    scene.camera.projection = Projection::Orthographic { height_m };
    true
}

/// The near plane lies where the middle of the picture is seen.
pub(in super::super) fn near_plane_too_far(scene: &mut Scene, _: &mut Surface) -> bool {
    scene.camera.near_m = (scene.camera.target - scene.camera.eye).length();
    scene.camera.far_m.is_none()
}

pub(in super::super) fn near_plane_ignored(scene: &mut Scene, _: &mut Surface) -> bool {
    let was = std::mem::replace(&mut scene.camera.near_m, 0.5);
    was > 20.0
}

pub(in super::super) fn far_plane_ignored(scene: &mut Scene, _: &mut Surface) -> bool {
    scene.camera.far_m.take().is_some()
}

/// Depths are few where the near plane is near; of parallel rays they are evenly spaced, and enough.
pub(in super::super) fn depths_of_16_bits(scene: &mut Scene, _: &mut Surface) -> bool {
    scene.device.depth = DepthFormat::Unorm16;
    scene.camera.near_m = 0.1;
    matches!(scene.camera.projection, Projection::Perspective { .. })
}

/// A far plane where the middle of the picture is seen.
pub(in super::super) fn far_plane_too_near(scene: &mut Scene, _: &mut Surface) -> bool {
    let middle = (scene.camera.target - scene.camera.eye).length();
    scene.camera.far_m = Some(middle);
    scene.camera.near_m < middle
}

fn ground(scene: &mut Scene, edit: impl FnOnce(Color) -> Color) -> bool {
    let GroundColors::Constant(color) = &mut scene.ground.colors else { return false };
    *color = edit(*color);
    true
}

fn codes_off(color: Color, codes: f64) -> Color {
    let Color([r, g, b, a]) = color;
    let off = |v: f64| if v > 0.5 { v - codes / 255.0 } else { v + codes / 255.0 };
    Color([off(r), off(g), off(b), a])
}

pub(in super::super) fn ground_two_codes_off(scene: &mut Scene, _: &mut Surface) -> bool {
    ground(scene, |color| codes_off(color, 2.0))
}

pub(in super::super) fn sky_two_codes_off(scene: &mut Scene, _: &mut Surface) -> bool {
    scene.image.background = codes_off(scene.image.background, 2.0);
    true
}

pub(in super::super) fn shade_missing(scene: &mut Scene, _: &mut Surface) -> bool {
    scene.ground.light.take().is_some()
}

/// The light a few degrees beside where it is.
pub(in super::super) fn light_beside(scene: &mut Scene, _: &mut Surface) -> bool {
    scene.ground.light =
        scene.ground.light.map(|light| Light { azimuth_deg: light.azimuth_deg + 5.0, ..light });
    scene.ground.light.is_some()
}

/// A shade where there is none.
pub(in super::super) fn shade_added(scene: &mut Scene, _: &mut Surface) -> bool {
    scene.ground.light.replace(Light::default()).is_none()
}

/// Features lie half a cell of the terrain off.
pub(in super::super) fn data_half_a_cell_off(scene: &mut Scene, surface: &mut Surface) -> bool {
    let mut by = DVec2::ZERO;
    let is_grid = grid(surface, |posts| {
        by = (posts.east() + posts.north()) * 0.5;
        true
    });
    for feature in scene.layers.iter_mut().flat_map(|layer| &mut layer.features) {
        move_shape(&mut feature.shape, |p| p + by);
    }
    is_grid
}

/// All of it elsewhere, as if the scene's zero point were another.
pub(in super::super) fn another_origin(scene: &mut Scene, surface: &mut Surface) -> bool {
    let by = DVec3::new(1024.0, -512.0, 128.0);
    let is_grid = grid(surface, |posts| {
        posts.first = posts.first + by.truncate();
        posts.heights_mut().iter_mut().for_each(|h| *h += by.z);
        true
    });
    if !is_grid {
        return false;
    }
    scene.origin -= by;
    scene.camera.eye = scene.camera.eye + by;
    scene.camera.target = scene.camera.target + by;
    for feature in scene.layers.iter_mut().flat_map(|layer| &mut layer.features) {
        move_shape(&mut feature.shape, |p| p + by.truncate());
    }
    true
}

fn move_shape(shape: &mut crate::scene::Shape, to: impl Fn(Plan) -> Plan) {
    use crate::scene::Shape;
    match shape {
        Shape::Polygon(parts) | Shape::Line(parts) => parts.iter_mut().flatten().for_each(|p| *p = to(*p)),
        Shape::MultiPolygon(members) => members.iter_mut().flatten().flatten().for_each(|p| *p = to(*p)),
        Shape::Points(points) => points.iter_mut().for_each(|p| *p = to(*p)),
        Shape::Swath { members, lines } => {
            members.iter_mut().flatten().chain(lines).flatten().for_each(|p| *p = to(*p));
        }
    }
}
