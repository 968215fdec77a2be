//! The visuals of all bodies as solids, for viewers that draw scenes.

use super::recording::timestamp;
use super::transforms::pose;
use crate::outline::{Outline, edges};
use crate::output::scene::{Shape, Visual};
use foxglove::messages::line_primitive::Type;
use foxglove::messages::{
    Color, CubePrimitive, CylinderPrimitive, LinePrimitive, Point3, Pose, SceneEntity, SceneUpdate,
    TriangleListPrimitive, Vector3,
};

/// One entity per body, fixed in the body's frame.
pub(super) fn solids(visuals: &[Visual]) -> SceneUpdate {
    SceneUpdate { deletions: Vec::new(), entities: visuals.iter().map(solid).collect() }
}

fn solid(visual: &Visual) -> SceneEntity {
    let mut entity = SceneEntity {
        timestamp: Some(timestamp(0.0)),
        frame_id: visual.frame.clone(),
        id: visual.frame.clone(),
        frame_locked: true,
        lines: visual.shape.lines().iter().map(|line| stroke(line, visual.thickness)).collect(),
        ..SceneEntity::default()
    };
    let color = Some(color(visual.colour));
    match &visual.shape {
        Shape::Rectangle { centre: [x, y], size } => entity.cubes.push(CubePrimitive {
            pose: Some(pose([0.0, *x, *y])),
            size: Some(Vector3 { x: size[0], y: size[1], z: visual.thickness }),
            color,
        }),
        Shape::Outline(Outline::Disc { center: [x, y], radius }) => entity.cylinders.push(CylinderPrimitive {
            pose: Some(pose([0.0, *x, *y])),
            size: Some(Vector3 { x: 2.0 * radius, y: 2.0 * radius, z: visual.thickness }),
            bottom_scale: 1.0,
            top_scale: 1.0,
            color,
        }),
        Shape::Outline(outline) => entity.triangles.push(TriangleListPrimitive {
            pose: Some(pose([0.0; 3])),
            points: side_faces(&outline.corners(), visual.thickness / 2.0),
            color,
            ..TriangleListPrimitive::default()
        }),
    }
    entity
}

/// The side faces of a prism, two triangles each; its base, which need not be convex, is left open.
fn side_faces(corners: &[[f64; 2]], height: f64) -> Vec<Point3> {
    let face = |(from, to): ([f64; 2], [f64; 2])| {
        let corner = |[x, y]: [f64; 2], z: f64| Point3 { x, y, z };
        let [a, b, c, d] = [corner(from, -height), corner(to, -height), corner(to, height), corner(from, height)];
        [a, b, c, a, c, d]
    };
    edges(corners).flat_map(face).collect()
}

/// A line on the upper face of a body, two pixels wide.
fn stroke(line: &[[f64; 2]], thickness: f64) -> LinePrimitive {
    LinePrimitive {
        r#type: Type::LineStrip.into(),
        pose: Some(Pose { position: Some(Vector3 { x: 0.0, y: 0.0, z: thickness / 2.0 }), ..pose([0.0; 3]) }),
        thickness: 2.0,
        scale_invariant: true,
        points: line.iter().map(|[x, y]| Point3 { x: *x, y: *y, z: 0.0 }).collect(),
        color: Some(color([0.15, 0.2, 0.25, 1.0])),
        ..LinePrimitive::default()
    }
}

pub(super) fn color([r, g, b, a]: [f64; 4]) -> Color {
    Color { r, g, b, a }
}
