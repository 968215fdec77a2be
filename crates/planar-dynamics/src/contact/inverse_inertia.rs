//! The extended inverse inertia tensor of an end effector or a body, and the effective mass and impulses that follow.

use super::{entry, entry_mut};
use crate::dynamics::Model;
use crate::error::Error;
use crate::scalar::{Real, Scalar};
use crate::state::{Forces, State};
use crate::validate::length;

/// The change of a twist [ω, vx, vy] at a point per impulse [n, fx, fy] there: of an end effector, the extended inverse
/// inertia tensor `J_e M⁻¹ J_eᵀ` of Yoshida & Sashida (*Modeling of impact dynamics and impulse minimization for space
/// robots*, IROS 1993), base and joints free; of a body, `J_t I_t⁻¹ J_tᵀ`; of both in contact, the sum.
///
/// Symmetric, rows of inertial axes; 1/(kg m²), 1/(kg m), 1/kg.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct InverseInertia<T>(pub [[T; 3]; 3]);

/// The impulses that stop relative velocities of 1 m/s in all directions at a point contact: the ellipse `F̄ᵀ G² F̄ = 1`
/// with the force part G of the sum of both inverse inertias.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ImpulseEllipse<T> {
    /// The longer and the shorter one, N s per m/s = kg.
    pub semi_axes: [T; 2],
    /// Direction of the longer one, inertial frame, rad, in (−π/2, π/2].
    pub direction: T,
}

impl<T: Real> InverseInertia<T> {
    /// The inverse inertia of the end effector of an arm.
    ///
    /// # Errors
    /// [`Error::Index`] for an arm that does not exist; [`Error::Length`] unless `wrenches` has one entry per arm and
    /// `workspace` two per joint; those of the model.
    pub fn of_end_effector<M: Model<T> + ?Sized>(
        model: &M,
        base_pose: &[T; 3],
        joint_angles: &[T],
        arm: usize,
        wrenches: &mut [[T; 3]],
        workspace: &mut [T],
    ) -> Result<Self, Error> {
        length("workspace", 2 * model.joints(), workspace.len())?;
        let (zero_rates, joint_rates) = workspace.split_at_mut(model.joints());
        zero_rates.fill(T::ZERO);
        let at_rest = State { base_pose: *base_pose, joint_angles, base_twist: [T::ZERO; 3], joint_rates: zero_rates };
        let (zero, one) = (T::ZERO, T::ONE);
        let mut columns = [[one, zero, zero], [zero, one, zero], [zero, zero, one]];
        for column in &mut columns {
            wrenches.fill([zero; 3]);
            *entry_mut("arm", wrenches, arm)? = *column;
            let forces = Forces { end_effector_wrenches: Some(wrenches), ..Forces::torques(zero_rates) };
            let base_twist = model.forward_dynamics(&at_rest, &forces, joint_rates)?;
            model.end_effector_twists(&State { base_twist, joint_rates, ..at_rest }, wrenches)?;
            *column = *entry("arm", wrenches, arm)?;
        }
        Ok(Self(columns))
    }

    /// The inverse inertia of a free body at a point with this offset from its COM, inertial axes; kg, kg m², m.
    #[must_use]
    pub fn of_body(mass: T, inertia: T, [rx, ry]: [T; 2]) -> Self {
        let (m, i) = (mass.recip(), inertia.recip());
        Self([
            [i, -(i * ry), i * rx],
            [-(i * ry), m + i * ry * ry, -(i * rx * ry)],
            [i * rx, -(i * rx * ry), m + i * rx * rx],
        ])
    }

    /// The sum for two bodies in contact: the change of the twist of one relative to the other.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        let mut sum = self.0;
        for (a, b) in sum.as_flattened_mut().iter_mut().zip(other.0.as_flattened()) {
            *a += *b;
        }
        Self(sum)
    }

    /// The effective mass at a point contact along this unit direction, kg: `1/(nᵀ G n)`.
    #[must_use]
    pub fn effective_mass(&self, direction: &[T; 2]) -> T {
        let ([nx, ny], [_, [_, xx, xy], [_, _, yy]]) = (*direction, self.0);
        (nx * (xx * nx + xy * ny) + ny * (xy * nx + yy * ny)).recip()
    }

    /// The impulse [fx, fy] at a point contact, on the first of the two, that stops their relative velocity [vx, vy]
    /// without restitution: `F̄ = −G⁻¹ v`. Its magnitude for a unit velocity is the impulse index of that direction.
    #[must_use]
    pub fn stopping_impulse(&self, [vx, vy]: &[T; 2]) -> [T; 2] {
        let [_, [_, a, b], [_, _, c]] = self.0;
        let determinant = a * c - b * b;
        [(b * *vy - c * *vx) / determinant, (b * *vx - a * *vy) / determinant]
    }

    /// See [`ImpulseEllipse`].
    #[must_use]
    pub fn impulse_ellipse(&self) -> ImpulseEllipse<T> {
        let [_, [_, a, b], [_, _, c]] = self.0;
        let half = T::constant(0.5);
        let (mean, difference) = ((a + c) * half, (a - c) * half);
        let radius = Scalar::sqrt(difference * difference + b * b);
        let larger = mean + radius;
        // from the determinant, the product of both eigenvalues, without cancellation
        let smaller = (a * c - b * b) / larger;
        // the longer axis is the eigenvector of the smaller eigenvalue
        let direction = half * Scalar::atan2(-b, -difference);
        // −π/2 arises for b = −0 and for a very small b
        let right_angle = T::constant(core::f64::consts::FRAC_PI_2);
        let direction = if direction > -right_angle { direction } else { right_angle };
        ImpulseEllipse { semi_axes: [smaller.recip(), larger.recip()], direction }
    }
}
