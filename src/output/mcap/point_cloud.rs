//! The outlines of all bodies as points, for viewers that do not draw scenes.

use super::recording::timestamp;
use super::transforms::pose;
use crate::output::scene::Visual;
use foxglove::messages::packed_element_field::NumericType;
use foxglove::messages::{PackedElementField, PointCloud};

/// Distance of two points over the body's thickness.
const SPACING: f64 = 0.2;
/// Largest number of points on one segment.
const MAX_POINTS: f64 = 500.0;

/// The lines of a body as points in its frame.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "f32 coordinates, parts of colours 0 to 1")]
pub(super) fn outline(visual: &Visual) -> PointCloud {
    let colour = visual.colour.map(|part| (part * 255.0).round() as u8);
    let mut data = Vec::new();
    for line in visual.shape.lines() {
        for (from, to) in line.iter().zip(line.iter().skip(1)) {
            let length = libm::hypot(to[0] - from[0], to[1] - from[1]);
            let points = (length / (SPACING * visual.thickness)).ceil().min(MAX_POINTS);
            for i in 0..points as u32 {
                let part = f64::from(i) / points;
                let [x, y] = [0, 1].map(|axis: usize| from[axis] + part * (to[axis] - from[axis]));
                for value in [x, y, 0.0] {
                    data.extend((value as f32).to_le_bytes());
                }
                data.extend(colour);
            }
        }
    }
    let field = |(name, offset, kind): (&str, u32, NumericType)| PackedElementField {
        name: name.to_owned(),
        offset,
        r#type: kind.into(),
    };
    let (float, byte) = (NumericType::Float32, NumericType::Uint8);
    let fields = [
        ("x", 0, float),
        ("y", 4, float),
        ("z", 8, float),
        ("red", 12, byte),
        ("green", 13, byte),
        ("blue", 14, byte),
        ("alpha", 15, byte),
    ];
    PointCloud {
        timestamp: Some(timestamp(0.0)),
        frame_id: visual.frame.clone(),
        pose: Some(pose([0.0; 3])),
        point_stride: 16,
        fields: fields.map(field).into(),
        data: data.into(),
    }
}
