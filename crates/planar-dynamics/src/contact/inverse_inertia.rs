//! How an end effector answers impulses: the extended inverse inertia tensor and what follows from it.

use crate::dynamics::Model;
use crate::error::Error;
use crate::linear::dot;
use crate::scalar::{Real, Scalar};
use crate::state::{Forces, State};
use crate::validate::length;

/// The change of a twist [ω, vx, vy] at a point per impulse [n, fx, fy] there: of an end effector, the extended inverse
/// inertia tensor `J_e M⁻¹ J_eᵀ` of Yoshida & Sashida (*Modeling of impact dynamics and impulse minimization for space
/// robots*, IROS 1993), base and joints free; of a body, `J_t I_t⁻¹ J_tᵀ`; of both in contact, the sum.
///
/// Symmetric, rows of inertial axes; 1/(kg m²), 1/(kg m), 1/kg.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InverseInertia<T>(pub [[T; 3]; 3]);

/// The impulses at a point contact that a closing speed of 1 m/s can ask for, from any side: an ellipse,
/// `F̄ᵀ G² F̄ = 1` with G the force part of the sum of both inverse inertias.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImpulseEllipse<T> {
    /// The longer and the shorter one, N s per m/s, so kg.
    pub semi_axes: [T; 2],
    /// Direction of the longer one, inertial frame, rad, in (−π/2, π/2].
    pub direction: T,
}

impl<T: Real> InverseInertia<T> {
    /// Of the end effector of an arm.
    ///
    /// # Errors
    /// [`Error::Index`] where there is no such arm, [`Error::Length`] where the slices do not fit the model: `wrenches`
    /// has one per arm, `scratch` twice as many numbers as there are joints; what the model says.
    pub fn of_end_effector(
        model: &dyn Model<T>,
        base_pose: &[T; 3],
        joint_angles: &[T],
        arm: usize,
        wrenches: &mut [[T; 3]],
        scratch: &mut [T],
    ) -> Result<Self, Error> {
        length("scratch", 2 * model.joints(), scratch.len())?;
        let (still, joint_rates) = scratch.split_at_mut(model.joints());
        still.fill(T::ZERO);
        let at_rest = State { base_pose: *base_pose, joint_angles, base_twist: [T::ZERO; 3], joint_rates: still };
        let mut columns = [[T::ZERO; 3]; 3];
        for (i, column) in columns.iter_mut().enumerate() {
            wrenches.fill([T::ZERO; 3]);
            let arms = wrenches.len();
            let missing = Error::Index { what: "arm", index: arm, count: arms };
            let wrench = wrenches.get_mut(arm).ok_or(missing)?;
            for (j, part) in wrench.iter_mut().enumerate() {
                *part = if i == j { T::ONE } else { T::ZERO };
            }
            let forces = Forces { end_effector_wrenches: Some(wrenches), ..Forces::torques(still) };
            let base_twist = model.forward_dynamics(&at_rest, &forces, joint_rates)?;
            model.end_effector_twists(&State { base_twist, joint_rates, ..at_rest }, wrenches)?;
            *column = wrenches.get(arm).copied().unwrap_or([T::ZERO; 3]);
        }
        Ok(Self(columns))
    }

    /// Of a free body at a point with this offset from its COM, inertial axes; kg, kg m², m.
    #[must_use]
    pub fn of_body(mass: T, inertia: T, [rx, ry]: [T; 2]) -> Self {
        let (m, i) = (mass.recip(), inertia.recip());
        Self([
            [i, -(i * ry), i * rx],
            [-(i * ry), m + i * ry * ry, -(i * rx * ry)],
            [i * rx, -(i * rx * ry), m + i * rx * rx],
        ])
    }

    /// Of two in contact: twists of one relative to the other.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        let mut sum = self.0;
        for (a, b) in sum.as_flattened_mut().iter_mut().zip(other.0.as_flattened()) {
            *a += *b;
        }
        Self(sum)
    }

    /// The mass that an impulse along this unit direction meets at a point contact, kg: `1/(nᵀ G n)`.
    #[must_use]
    pub fn effective_mass(&self, direction: &[T; 2]) -> T {
        dot(direction, self.change(direction)).recip()
    }

    /// The impulse at a point contact, [fx, fy] on the first of the two, that ends their relative velocity [vx, vy]
    /// without restitution: `F̄ = −G⁻¹ v`. Its size for a unit velocity is the impulse index of that direction.
    #[must_use]
    pub fn stopping_impulse(&self, [vx, vy]: &[T; 2]) -> [T; 2] {
        let [_, [_, a, b], [_, _, c]] = self.0;
        let determinant = a * c - b * b;
        [(b * *vy - c * *vx) / determinant, (b * *vx - a * *vy) / determinant]
    }

    /// The ellipse of those impulses.
    #[must_use]
    pub fn impulse_ellipse(&self) -> ImpulseEllipse<T> {
        let [_, [_, a, b], [_, _, c]] = self.0;
        let half = T::constant(0.5);
        let (middle, difference) = ((a + c) * half, (a - c) * half);
        let radius = Scalar::sqrt(difference * difference + b * b);
        let larger = middle + radius;
        // the product of both is the determinant: no cancellation in the smaller one
        let smaller = (a * c - b * b) / larger;
        // the longer axis is the eigenvector of the smaller eigenvalue
        let direction = half * Scalar::atan2(-b, -difference);
        // along y from either side of it: b may be −0, or too small to show
        let end = T::constant(core::f64::consts::FRAC_PI_2);
        let direction = if direction > -end { direction } else { end };
        ImpulseEllipse { semi_axes: [smaller.recip(), larger.recip()], direction }
    }

    fn change(&self, [fx, fy]: &[T; 2]) -> [T; 2] {
        let [_, [_, a, b], [_, _, c]] = self.0;
        [a * *fx + b * *fy, b * *fx + c * *fy]
    }
}
