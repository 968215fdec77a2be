//! The equation of motion in canonical variables: positions, and the momenta that belong to them.

use crate::dynamics::Model;
use crate::error::Error;
use crate::scalar::{Real, Scalar};
use crate::state::{Forces, State};
use crate::validate::length;

/// From rates to canonical momenta `p = M v` and back, and `ṗ = ∂T/∂q + f`, exactly, for any robot whose arms meet in
/// the base.
///
/// The momentum of a joint is the angular momentum of the bodies beyond it, about the joint; that of the base is the
/// linear momentum, and the angular momentum about the base COM. With the velocity `v_k` of joint k and the linear
/// momentum `P_k` beyond it
///
/// `∂T/∂θ_k = −v_k × P_k`, `∂T/∂yaw = −v_b × P`, `∂T/∂x = ∂T/∂y = 0`,
///
/// for turning what is beyond a joint turns the velocities relative to it and changes no energy but by the joint's own
/// velocity. The robot's momenta, `[l, px, py] = [p_yaw + x p_y − y p_x, p_x, p_y]`, are linear and bilinear in these
/// variables: what integrators of Gauss's kind keep exactly. `M⁻¹ p` comes from the forward dynamics of a robot at
/// rest, under p in the place of forces.
///
/// All slices but the last are working space: one entry per body (joints + 1), or per joint.
#[derive(Debug)]
pub struct Canonical<'a, T> {
    /// Per body: mass, and inertia about the COM.
    pub inertias: &'a mut [[T; 2]],
    /// Per body.
    pub poses: &'a mut [[T; 3]],
    /// Per body.
    pub twists: &'a mut [[T; 3]],
    /// Per joint: from it to the COM of its link, in the link's frame.
    pub offsets: &'a mut [[T; 2]],
    /// Per joint: whether nothing is beyond its link.
    pub ends: &'a mut [bool],
    /// Per joint.
    pub rates: &'a mut [T],
}

/// What a sweep over the bodies from the end effectors to the base gathers: the momentum beyond a joint.
#[derive(Clone, Copy)]
struct Outboard<T> {
    /// About the base COM.
    angular: T,
    linear: [T; 2],
}

impl<T: Real> Canonical<'_, T> {
    /// Looks at the robot: its masses, and where its joints are. To be called once, and again after a merge.
    ///
    /// # Errors
    /// [`Error::Length`] where a slice has the wrong length, and what the model says.
    pub fn measure(&mut self, model: &dyn Model<T>, base_pose: &[T; 3], joint_angles: &[T]) -> Result<(), Error> {
        let joints = model.joints();
        for found in [self.offsets.len(), self.ends.len(), self.rates.len()] {
            length("canonical working space", joints, found)?;
        }
        model.body_inertias(self.inertias)?;
        model.body_poses(base_pose, joint_angles, self.poses)?;
        for joint in 0..joints {
            for (k, rate) in self.rates.iter_mut().enumerate() {
                *rate = if k == joint { T::ONE } else { T::ZERO };
            }
            let base_twist = [T::ZERO; 3];
            let turning = State { base_pose: *base_pose, joint_angles, base_twist, joint_rates: self.rates };
            model.body_twists(&turning, self.twists)?;
            let (Some([_, vx, vy]), Some([yaw, ..])) = (self.twists.get(joint + 1), self.poses.get(joint + 1)) else {
                continue;
            };
            // turning at 1 rad/s moves the COM at k × r
            let (sine, cosine) = Scalar::sin_cos(*yaw);
            let (rx, ry) = (*vy, -*vx);
            if let (Some(offset), Some(end)) = (self.offsets.get_mut(joint), self.ends.get_mut(joint)) {
                *offset = [cosine * rx + sine * ry, cosine * ry - sine * rx];
                *end = self.twists.get(joint + 2).is_none_or(|[omega, ..]| *omega == T::ZERO);
            }
        }
        Ok(())
    }

    /// `p = M v`: 3 + joints.
    ///
    /// # Errors
    /// What the model says.
    pub fn momenta(&mut self, model: &dyn Model<T>, state: &State<'_, T>, momenta: &mut [T]) -> Result<(), Error> {
        self.sweep(model, state, |place, [x, y], _, Outboard { angular, linear: [px, py] }| {
            if let Some(momentum) = momenta.get_mut(place) {
                *momentum = angular - (x * py - y * px);
            }
            if let (0, Some([_, of_x, of_y])) = (place, momenta.first_chunk_mut::<3>()) {
                (*of_x, *of_y) = (px, py);
            }
        })
    }

    /// `v = M⁻¹ p`: the base twist, and the joint rates into `rates`.
    ///
    /// # Errors
    /// [`Error::Length`] unless there are 3 + joints momenta, and what the model says.
    pub fn velocities(
        &mut self,
        model: &dyn Model<T>,
        base_pose: [T; 3],
        joint_angles: &[T],
        momenta: &[T],
        rates: &mut [T],
    ) -> Result<[T; 3], Error> {
        let wrong = Error::Length { quantity: "momenta", expected: 3 + model.joints(), found: momenta.len() };
        let (of_base, of_joints) = momenta.split_first_chunk::<3>().ok_or(wrong)?;
        self.rates.fill(T::ZERO);
        let at_rest = State { base_pose, joint_angles, base_twist: [T::ZERO; 3], joint_rates: self.rates };
        let forces = Forces { base_wrench: Some(*of_base), ..Forces::torques(of_joints) };
        model.forward_dynamics(&at_rest, &forces, rates)
    }

    /// Adds `∂T/∂q` to `rates`: 3 + joints.
    ///
    /// # Errors
    /// What the model says.
    pub fn add_energy_gradient(
        &mut self,
        model: &dyn Model<T>,
        state: &State<'_, T>,
        rates: &mut [T],
    ) -> Result<(), Error> {
        self.sweep(model, state, |place, _, [vx, vy], Outboard { linear: [px, py], .. }| {
            if let Some(rate) = rates.get_mut(place) {
                *rate += vy * px - vx * py;
            }
        })
    }

    /// Calls `each` with the place of a joint's momentum (the base's yaw has the first), the joint's place seen from
    /// the base COM, its velocity, and the momentum beyond it.
    fn sweep(
        &mut self,
        model: &dyn Model<T>,
        state: &State<'_, T>,
        mut each: impl FnMut(usize, [T; 2], [T; 2], Outboard<T>),
    ) -> Result<(), Error> {
        model.body_poses(&state.base_pose, state.joint_angles, self.poses)?;
        model.body_twists(state, self.twists)?;
        let [_, base_x, base_y] = state.base_pose;
        let none = Outboard { angular: T::ZERO, linear: [T::ZERO; 2] };
        let (mut beyond, mut all) = (none, none);
        let moving = self.poses.iter().zip(self.twists.iter()).zip(self.inertias.iter()).skip(1).enumerate();
        let links = moving.zip(self.offsets.iter().zip(self.ends.iter()));
        for ((joint, (([yaw, x, y], [omega, vx, vy]), [mass, inertia])), ([along, across], end)) in links.rev() {
            if *end {
                beyond = none;
            }
            let [px, py] = [*mass * *vx, *mass * *vy];
            let (x, y) = (*x - base_x, *y - base_y);
            let angular = *inertia * *omega + (x * py - y * px);
            for sum in [&mut beyond, &mut all] {
                sum.angular += angular;
                sum.linear = [sum.linear[0] + px, sum.linear[1] + py];
            }
            let (sine, cosine) = Scalar::sin_cos(*yaw);
            let (rx, ry) = (cosine * *along - sine * *across, sine * *along + cosine * *across);
            each(joint + 3, [x - rx, y - ry], [*vx + *omega * ry, *vy - *omega * rx], beyond);
        }
        if let Some([mass, inertia]) = self.inertias.first() {
            let [omega, vx, vy] = state.base_twist;
            all.angular += *inertia * omega;
            all.linear = [all.linear[0] + *mass * vx, all.linear[1] + *mass * vy];
            each(0, [T::ZERO; 2], [vx, vy], all);
        }
        Ok(())
    }
}
