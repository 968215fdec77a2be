//! Outlines as points, for viewers that draw no scenes.

use super::channel::timestamp;
use super::scene::pose;
use crate::output::scene::Body;
use foxglove::messages::packed_element_field::NumericType;
use foxglove::messages::{PackedElementField, PointCloud};

/// Distance of points on a line over the body's thickness.
const SPACING: f64 = 0.2;
/// On one stretch, whatever the body's proportions are.
const MOST: f64 = 500.0;

/// A body's lines as points in its frame, which carries them along.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "points are f32 by custom, a colour's part is 0 to 1"
)]
pub(super) fn outline(body: &Body) -> PointCloud {
    let colour = body.colour.map(|part| (part * 255.0).round() as u8);
    let mut data = Vec::new();
    for line in body.shape.lines() {
        for (from, to) in line.iter().zip(line.iter().skip(1)) {
            let points = ((to[0] - from[0]).hypot(to[1] - from[1]) / (SPACING * body.thickness)).ceil().min(MOST);
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
    let (number, part) = (NumericType::Float32, NumericType::Uint8);
    let fields = [
        ("x", 0, number),
        ("y", 4, number),
        ("z", 8, number),
        ("red", 12, part),
        ("green", 13, part),
        ("blue", 14, part),
        ("alpha", 15, part),
    ];
    PointCloud {
        timestamp: Some(timestamp(0.0)),
        frame_id: body.frame.clone(),
        pose: Some(pose([0.0; 3])),
        point_stride: 16,
        fields: fields.map(field).into(),
        data: data.into(),
    }
}
