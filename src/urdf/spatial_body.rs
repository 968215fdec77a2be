//! Mass, centre of mass and inertia tensor of rigid bodies in space.

use super::UrdfError;
use super::description::Link;
use super::finite::finite;
use nalgebra::{IsometryMatrix3, Matrix3, Vector3};

/// A rigid body in the frame of a link.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SpatialBody {
    pub(super) mass: f64,
    pub(super) com: Vector3<f64>,
    /// About the centre of mass.
    pub(super) inertia: Matrix3<f64>,
}

impl SpatialBody {
    /// The body of a link in the frame of that link; massless without `<inertial>`.
    pub(super) fn from_link(link: &Link) -> Result<Self, UrdfError> {
        let inertial = &link.inertial;
        let problem = |found: String, wanted: &'static str| UrdfError::link(&link.name, found, wanted);
        finite("its mass", [inertial.mass], problem)?;
        finite("its centre of mass", inertial.origin.xyz, problem)?;
        finite("the rpy of its inertia", inertial.origin.rpy, problem)?;
        let [xx, xy, xz, yy, yz, zz] = finite("its inertia [ixx, ixy, ixz, iyy, iyz, izz]", inertial.inertia, problem)?;
        if inertial.mass < 0.0 {
            return Err(problem(format!("its mass is {:?} kg", inertial.mass), "expected 0 or more"));
        }
        let moments = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
        let own = Self { mass: inertial.mass, com: Vector3::zeros(), inertia: moments };
        Ok(own.transformed(&inertial.origin.isometry()))
    }

    /// Whether mass and inertia are zero.
    pub(super) fn is_massless(&self) -> bool {
        self.mass == 0.0 && self.inertia == Matrix3::zeros()
    }

    /// The same body in the frame that `place` maps to.
    pub(super) fn transformed(&self, place: &IsometryMatrix3<f64>) -> Self {
        let turn = place.rotation.matrix();
        Self {
            mass: self.mass,
            com: place.rotation * self.com + place.translation.vector,
            inertia: turn * self.inertia * turn.transpose(),
        }
    }

    /// Both as one rigid body. A massless one changes no bit of the other.
    pub(super) fn combined(&self, other: &Self) -> Self {
        if other.is_massless() {
            return self.clone();
        }
        if self.is_massless() {
            return other.clone();
        }
        let mass = self.mass + other.mass;
        let com = if mass > 0.0 { (self.com * self.mass + other.com * other.mass) / mass } else { self.com };
        Self { mass, com, inertia: self.inertia_about(&com) + other.inertia_about(&com) }
    }

    /// By the parallel axis theorem.
    fn inertia_about(&self, point: &Vector3<f64>) -> Matrix3<f64> {
        let arm = self.com - point;
        self.inertia + (Matrix3::identity() * arm.norm_squared() - arm * arm.transpose()) * self.mass
    }
}
