//! The plane that a robot moves in, as the frames of its links see it.

use nalgebra::{Rotation3, Unit, Vector3};

/// How far from parallel axes may be, rad: 1.5708 for π/2, which many files have, is 4e-6 off.
pub(super) const PARALLEL: f64 = 1e-5;

/// The axes of the plane in the frame of some link: its normal, and the link's own x axis projected on it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plane {
    pub(super) normal: Unit<Vector3<f64>>,
    pub(super) x: Vector3<f64>,
    y: Vector3<f64>,
}

impl Plane {
    /// With the projected x axis of the frame, or its y axis where x is along the normal.
    pub(super) fn across(normal: Unit<Vector3<f64>>) -> Self {
        let own = if normal.cross(&Vector3::x()).norm() > PARALLEL { Vector3::x() } else { Vector3::y() };
        let x = (own - normal.scale(normal.dot(&own))).normalize();
        Self { normal, x, y: normal.cross(&x) }
    }

    /// The plane of a base whose first joint has this axis: normal +z where the axis is along z, else the axis.
    pub(super) fn of_base(axis: Unit<Vector3<f64>>) -> Self {
        let upright = axis.cross(&Vector3::z()).norm() <= PARALLEL;
        Self::across(if upright { Vector3::z_axis() } else { axis })
    }

    /// The same plane in the frame of a link that is turned by `rotation`, with that link's own x axis.
    pub(super) fn seen_from(&self, rotation: &Rotation3<f64>) -> Self {
        Self::across(Unit::new_normalize(rotation.inverse() * self.normal.into_inner()))
    }

    /// Coordinates in the plane, and the height above it.
    pub(super) fn project(&self, vector: &Vector3<f64>) -> ([f64; 2], f64) {
        ([self.x.dot(vector), self.y.dot(vector)], self.normal.dot(vector))
    }

    /// Angle of an axis with the normal, rad, and whether it points the other way.
    pub(super) fn tilt(&self, axis: &Vector3<f64>) -> (f64, bool) {
        let along = self.normal.dot(axis);
        (self.normal.cross(axis).norm().atan2(along.abs()), along < 0.0)
    }
}

/// Direction of a planar vector, rad.
pub(super) fn direction([x, y]: [f64; 2]) -> f64 {
    y.atan2(x)
}

/// A planar vector from axes that are turned by `angle`; at 0 it stays what it is to the bit.
pub(super) fn turned_back([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (sine, cosine) = angle.sin_cos();
    [cosine * x + sine * y, cosine * y - sine * x]
}

/// Components below 1e-12 of `scale` as the exact zeros they stand for: what sines of π and sums of equal numbers
/// leave. Exact zeros are structural: they choose the generated code.
pub(super) fn snapped<const N: usize>(vector: [f64; N], scale: f64) -> [f64; N] {
    vector.map(|component| if component.abs() <= 1e-12 * scale { 0.0 } else { component })
}
