//! Solids for viewers that draw scenes.

use super::channel::timestamp;
use super::frames::about_z;
use crate::output::scene::{Body, Shape};
use foxglove::messages::line_primitive::Type;
use foxglove::messages::{
    Color, CubePrimitive, CylinderPrimitive, LinePrimitive, Point3, Pose, Quaternion, SceneEntity, SceneUpdate,
    TriangleListPrimitive, Vector3,
};

/// Every body once, fixed in its frame, which carries it along.
pub(super) fn solids(bodies: &[Body]) -> SceneUpdate {
    SceneUpdate { deletions: Vec::new(), entities: bodies.iter().map(solid).collect() }
}

fn solid(body: &Body) -> SceneEntity {
    let mut entity = SceneEntity {
        timestamp: Some(timestamp(0.0)),
        frame_id: body.frame.clone(),
        id: body.frame.clone(),
        frame_locked: true,
        lines: body.shape.lines().iter().map(|line| stroke(line, body.thickness)).collect(),
        ..SceneEntity::default()
    };
    let color = Some(color(body.colour));
    match &body.shape {
        Shape::Rectangle { centre: [x, y], size } => entity.cubes.push(CubePrimitive {
            pose: Some(pose([0.0, *x, *y])),
            size: Some(Vector3 { x: size[0], y: size[1], z: body.thickness }),
            color,
        }),
        Shape::Disc { radius } => entity.cylinders.push(CylinderPrimitive {
            pose: Some(pose([0.0; 3])),
            size: Some(Vector3 { x: 2.0 * radius, y: 2.0 * radius, z: body.thickness }),
            bottom_scale: 1.0,
            top_scale: 1.0,
            color,
        }),
        Shape::Polygon { corners } => entity.triangles.push(TriangleListPrimitive {
            pose: Some(pose([0.0; 3])),
            points: walls(corners, body.thickness / 2.0),
            color,
            ..TriangleListPrimitive::default()
        }),
    }
    entity
}

/// A wall on each edge of a polygon, two triangles each; without faces, which need not be convex.
fn walls(corners: &[[f64; 2]], height: f64) -> Vec<Point3> {
    let edges = corners.iter().zip(corners.iter().cycle().skip(1));
    let wall = |(from, to): (&[f64; 2], &[f64; 2])| {
        let corner = |[x, y]: &[f64; 2], z: f64| Point3 { x: *x, y: *y, z };
        let [a, b, c, d] = [corner(from, -height), corner(to, -height), corner(to, height), corner(from, height)];
        [a, b, c, a, c, d]
    };
    edges.flat_map(wall).collect()
}

/// A line on the body's upper face, two pixels wide.
fn stroke(line: &[[f64; 2]], thickness: f64) -> LinePrimitive {
    LinePrimitive {
        r#type: Type::LineStrip.into(),
        pose: Some(Pose {
            position: Some(Vector3 { x: 0.0, y: 0.0, z: thickness / 2.0 }),
            orientation: Some(Quaternion { x: 0.0, y: 0.0, z: 0.0, w: 1.0 }),
        }),
        thickness: 2.0,
        scale_invariant: true,
        points: line.iter().map(|[x, y]| Point3 { x: *x, y: *y, z: 0.0 }).collect(),
        color: Some(color([0.15, 0.2, 0.25, 1.0])),
        ..LinePrimitive::default()
    }
}

/// A pose [yaw, x, y] in the plane.
pub(super) fn pose([yaw, x, y]: [f64; 3]) -> Pose {
    Pose { position: Some(Vector3 { x, y, z: 0.0 }), orientation: Some(about_z(yaw)) }
}

pub(super) fn color([r, g, b, a]: [f64; 4]) -> Color {
    Color { r, g, b, a }
}
