//! The plane of motion of a robot in the frames of its links.

use nalgebra::{Rotation3, Unit, Vector3};

/// Largest angle between axes that count as parallel, rad; 1.5708 for π/2, as in many files, has an error of 4e-6.
pub(super) const MAX_TILT: f64 = 1e-5;

/// The axes of the plane in the frame of a link: its normal, and the projected x axis of the link.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plane {
    pub(super) normal: Unit<Vector3<f64>>,
    pub(super) x: Vector3<f64>,
    y: Vector3<f64>,
}

impl Plane {
    /// With the projected x axis of the frame, or its y axis if x is along the normal.
    pub(super) fn with_normal(normal: Unit<Vector3<f64>>) -> Self {
        let own = if normal.cross(&Vector3::x()).norm() > MAX_TILT { Vector3::x() } else { Vector3::y() };
        let x = (own - normal.scale(normal.dot(&own))).normalize();
        Self { normal, x, y: normal.cross(&x) }
    }

    /// The plane of a base whose first joint has this axis: the normal is +z if the axis is along ±z, else the axis.
    pub(super) fn for_base(axis: Unit<Vector3<f64>>) -> Self {
        let upright = axis.cross(&Vector3::z()).norm() <= MAX_TILT;
        Self::with_normal(if upright { Vector3::z_axis() } else { axis })
    }

    /// The same plane in the frame of a link that is rotated by `rotation`.
    pub(super) fn in_frame(&self, rotation: &Rotation3<f64>) -> Self {
        Self::with_normal(Unit::new_normalize(rotation.inverse() * self.normal.into_inner()))
    }

    /// Components in the plane and along the normal.
    pub(super) fn project(&self, vector: &Vector3<f64>) -> ([f64; 2], f64) {
        ([self.x.dot(vector), self.y.dot(vector)], self.normal.dot(vector))
    }

    /// Angle between an axis and the normal, rad, and whether it points against the normal.
    pub(super) fn tilt(&self, axis: &Vector3<f64>) -> (f64, bool) {
        let along = self.normal.dot(axis);
        (libm::atan2(self.normal.cross(axis).norm(), along.abs()), along < 0.0)
    }
}

/// Direction of a planar vector, rad.
pub(super) fn direction([x, y]: [f64; 2]) -> f64 {
    libm::atan2(y, x)
}

/// Components of a planar vector in axes that are rotated by `angle`; exact at 0.
pub(super) fn in_rotated_axes([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (sine, cosine) = libm::sincos(angle);
    [cosine * x + sine * y, cosine * y - sine * x]
}

/// Components below 1e-12 of `scale`, such as the sine of π, as exact zeros, which are structural: they select the
/// generated code.
pub(super) fn with_exact_zeros<const N: usize>(vector: [f64; N], scale: f64) -> [f64; N] {
    vector.map(|component| if component.abs() <= 1e-12 * scale { 0.0 } else { component })
}
