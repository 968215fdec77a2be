//! Canonical momenta from rates and back, and the gradient of the kinetic energy, by one sweep over the bodies.

use crate::dynamics::Model;
use crate::error::Error;
use crate::scalar::{Real, Scalar};
use crate::state::{Coordinates, Forces, State, coordinates, coordinates_mut};
use crate::validate::length;

/// Canonical variables: positions q and their momenta `p = M v`, with `ṗ = ∂T/∂q + f`; exact for any robot whose arms
/// are mounted on the base.
///
/// The momentum of a joint is the angular momentum of its outboard bodies about the joint; that of the base is the
/// linear momentum, and the angular momentum about the base COM. With the velocity `v_k` of joint k and the linear
/// momentum `P_k` of its outboard bodies
///
/// `∂T/∂θ_k = −v_k × P_k`, `∂T/∂yaw = −v_b × P`, `∂T/∂x = ∂T/∂y = 0`,
///
/// because a rotation of the outboard bodies about the joint also rotates their velocities relative to it, and so
/// changes the energy by the joint's own velocity alone. The robot's momenta `[l, px, py] = [p_yaw + x p_y − y p_x, p_x,
/// p_y]` are linear and bilinear in these variables, and so conserved by Gauss–Legendre methods. `M⁻¹ p` is the forward
/// dynamics of a robot at rest, with p in place of the forces.
///
/// All slices are working space: one entry per body (joints + 1), or per joint.
#[derive(Debug)]
pub struct CanonicalVariables<'a, T> {
    /// Per body: mass, and inertia about the COM.
    pub inertias: &'a mut [[T; 2]],
    /// Per body.
    pub poses: &'a mut [[T; 3]],
    /// Per body.
    pub twists: &'a mut [[T; 3]],
    /// Per joint: from it to the COM of its link, in the link's frame.
    pub offsets: &'a mut [[T; 2]],
    /// Per joint: whether its link is the last of the arm.
    pub leaves: &'a mut [bool],
    /// Per joint.
    pub rates: &'a mut [T],
}

/// Momentum of all bodies outboard of a joint.
#[derive(Clone, Copy)]
struct Outboard<T> {
    /// About the base COM.
    angular: T,
    linear: [T; 2],
}

impl<T: Real> CanonicalVariables<'_, T> {
    /// Stores the robot's masses and where its joints are. To be called before all else, and again after a merge.
    ///
    /// # Errors
    /// [`Error::Length`] where a slice has the wrong length, and those of the model.
    pub fn measure<M: Model<T> + ?Sized>(
        &mut self,
        model: &M,
        base_pose: &[T; 3],
        joint_angles: &[T],
    ) -> Result<(), Error> {
        let joints = model.joints();
        for found in [self.offsets.len(), self.leaves.len(), self.rates.len()] {
            length("canonical working space", joints, found)?;
        }
        model.body_inertias(self.inertias)?;
        model.body_poses(base_pose, joint_angles, self.poses)?;
        for (joint, (offset, leaf)) in self.offsets.iter_mut().zip(self.leaves.iter_mut()).enumerate() {
            for (k, rate) in self.rates.iter_mut().enumerate() {
                *rate = if k == joint { T::ONE } else { T::ZERO };
            }
            let base_twist = [T::ZERO; 3];
            let turning = State { base_pose: *base_pose, joint_angles, base_twist, joint_rates: self.rates };
            model.body_twists(&turning, self.twists)?;
            let missing = Error::Length { quantity: "body_twists", expected: joints + 1, found: self.twists.len() };
            let [yaw, ..] = *self.poses.get(joint + 1).ok_or(missing)?;
            let [_, vx, vy] = *self.twists.get(joint + 1).ok_or(missing)?;
            // a rotation at 1 rad/s gives the COM the velocity k × r
            let (sine, cosine) = Scalar::sin_cos(yaw);
            let (rx, ry) = (vy, -vx);
            *offset = [cosine * rx + sine * ry, cosine * ry - sine * rx];
            *leaf = self.twists.get(joint + 2).is_none_or(|[omega, ..]| *omega == T::ZERO);
        }
        Ok(())
    }

    /// `p = M v`: 3 + joints.
    ///
    /// # Errors
    /// [`Error::Length`], and those of the model.
    pub fn momenta<M: Model<T> + ?Sized>(
        &mut self,
        model: &M,
        state: &State<'_, T>,
        momenta: &mut [T],
    ) -> Result<(), Error> {
        let Coordinates { base, joints, .. } = coordinates_mut(momenta, model.joints())?;
        let Outboard { angular, linear: [px, py] } =
            self.sweep(model, state, joints, |momentum, [x, y], _, Outboard { angular, linear: [px, py] }| {
                *momentum = angular - (x * py - y * px);
            })?;
        *base = [angular, px, py];
        Ok(())
    }

    /// `v = M⁻¹ p`: returns the base twist and fills `rates` with the joint rates.
    ///
    /// # Errors
    /// [`Error::Length`] unless there are 3 + joints momenta, and those of the model.
    pub fn velocities<M: Model<T> + ?Sized>(
        &mut self,
        model: &M,
        base_pose: [T; 3],
        joint_angles: &[T],
        momenta: &[T],
        rates: &mut [T],
    ) -> Result<[T; 3], Error> {
        let momenta = coordinates(momenta, model.joints())?;
        self.rates.fill(T::ZERO);
        let at_rest = State { base_pose, joint_angles, base_twist: [T::ZERO; 3], joint_rates: self.rates };
        let forces = Forces { base_wrench: Some(*momenta.base), ..Forces::torques(momenta.joints) };
        model.forward_dynamics(&at_rest, &forces, rates)
    }

    /// Adds `∂T/∂q` to `rates`: 3 + joints.
    ///
    /// # Errors
    /// [`Error::Length`], and those of the model.
    pub fn add_energy_gradient<M: Model<T> + ?Sized>(
        &mut self,
        model: &M,
        state: &State<'_, T>,
        rates: &mut [T],
    ) -> Result<(), Error> {
        let Coordinates { base: [yaw, ..], joints, .. } = coordinates_mut(rates, model.joints())?;
        let add = |rate: &mut T, [vx, vy]: [T; 2], [px, py]: [T; 2]| *rate += vy * px - vx * py;
        let all =
            self.sweep(model, state, joints, |rate, _, velocity, outboard| add(rate, velocity, outboard.linear))?;
        let [_, vx, vy] = state.base_twist;
        add(yaw, [vx, vy], all.linear);
        Ok(())
    }

    /// Calls `update` with each joint's entry of `values`, its position relative to the base COM, its velocity, and the
    /// momentum of its outboard bodies; returns the momentum of all bodies.
    fn sweep<M: Model<T> + ?Sized>(
        &mut self,
        model: &M,
        state: &State<'_, T>,
        values: &mut [T],
        update: impl Fn(&mut T, [T; 2], [T; 2], Outboard<T>),
    ) -> Result<Outboard<T>, Error> {
        model.body_poses(&state.base_pose, state.joint_angles, self.poses)?;
        model.body_twists(state, self.twists)?;
        let [_, base_x, base_y] = state.base_pose;
        let none = Outboard { angular: T::ZERO, linear: [T::ZERO; 2] };
        let (mut outboard, mut all) = (none, none);
        let mut bodies = self.poses.iter().zip(self.twists.iter()).zip(self.inertias.iter());
        let base = bodies.next();
        let links = bodies.zip(self.offsets.iter().zip(self.leaves.iter())).zip(values);
        for (((([yaw, x, y], [omega, vx, vy]), [mass, inertia]), ([along, across], leaf)), value) in links.rev() {
            if *leaf {
                outboard = none;
            }
            let [px, py] = [*mass * *vx, *mass * *vy];
            let (x, y) = (*x - base_x, *y - base_y);
            let angular = *inertia * *omega + (x * py - y * px);
            for sum in [&mut outboard, &mut all] {
                sum.angular += angular;
                sum.linear = [sum.linear[0] + px, sum.linear[1] + py];
            }
            let (sine, cosine) = Scalar::sin_cos(*yaw);
            let (rx, ry) = (cosine * *along - sine * *across, sine * *along + cosine * *across);
            update(value, [x - rx, y - ry], [*vx + *omega * ry, *vy - *omega * rx], outboard);
        }
        if let Some(((_, [omega, vx, vy]), [mass, inertia])) = base {
            all.angular += *inertia * *omega;
            all.linear = [all.linear[0] + *mass * *vx, all.linear[1] + *mass * *vy];
        }
        Ok(all)
    }
}
