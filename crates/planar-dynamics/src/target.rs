//! Eqs. (3) to (5), (12) and (14) of a captured object, and the link that it forms with the last link of an arm.
//!
//! # Example
//! ```
//! use planar_dynamics::target::Target;
//!
//! // 3 kg that turn at 2 rad/s, held half a metre beside the COM
//! let target = Target { mass: 3.0, inertia: 0.25, contact: [0.5, 0.0], twist: [2.0, 0.0, -0.5] };
//! // the contact point moves by v + ω × r
//! let contact_twist = target.contact_jacobian().map(|[a, b, c]| 2.0 * a + 0.0 * b - 0.5 * c);
//! assert_eq!(contact_twist, [2.0, 0.0, 0.5]);
//! assert_eq!(target.twist_from_contact(&contact_twist), target.twist);
//! // a robot that stops it receives its momentum, here about the contact point: 0.25 · 2 + 0.5 · 1.5
//! assert_eq!(target.impulse(&[0.0; 3]), [1.25, 0.0, -1.5]);
//! ```

use super::body::Body;
use super::scalar::Scalar;

/// A free-floating rigid body that an end effector captures at one point.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Target<T> {
    /// kg.
    pub mass: T,
    /// About its COM, kg m².
    pub inertia: T,
    /// [rx, ry] from its COM to the contact point, inertial axes at the impact, m.
    pub contact: [T; 2],
    /// [ω, vx, vy] of its COM before the impact, inertial axes; rad/s, m/s.
    pub twist: [T; 3],
}

impl<T: Scalar> Target<T> {
    /// A target without mass and inertia, which exerts no impulse.
    #[must_use]
    pub fn massless() -> Self {
        Self { mass: T::ZERO, inertia: T::ZERO, contact: [T::ZERO; 2], twist: [T::ZERO; 3] }
    }

    /// `J_t` of eq. (5): contact twist = `J_t` · twist of the COM. The sign is that of v + ω × r, opposite to the print.
    #[must_use]
    pub fn contact_jacobian(&self) -> [[T; 3]; 3] {
        let [rx, ry] = self.contact;
        let (zero, one) = (T::ZERO, T::ONE);
        [[one, zero, zero], [-ry, one, zero], [rx, zero, one]]
    }

    /// Twist of the COM from that of the contact point: eq. (14), `t_t = J_t⁻¹ t_e`.
    #[must_use]
    pub fn twist_from_contact(&self, contact_twist: &[T; 3]) -> [T; 3] {
        let [omega, vx, vy] = *contact_twist;
        let [rx, ry] = self.contact;
        [omega, vx + ry * omega, vy - rx * omega]
    }

    /// Impulse [n, fx, fy] on the robot at the contact point: `F̄ = −J_t⁻ᵀ I_t (t_tf − t_ti)`, from eq. (3).
    ///
    /// Equal to eq. (12), but never singular. N m s, N s, N s; inertial axes.
    #[must_use]
    pub fn impulse(&self, twist_after: &[T; 3]) -> [T; 3] {
        let [rx, ry] = self.contact;
        let fx = self.mass * (self.twist[1] - twist_after[1]);
        let fy = self.mass * (self.twist[2] - twist_after[2]);
        let spin = self.inertia * (self.twist[0] - twist_after[0]);
        [spin + ry * fx - rx * fy, fx, fy]
    }

    /// Momentum [l, px, py] about the inertial origin and kinetic energy, with its COM at `position` moving by `twist`.
    #[must_use]
    pub fn momentum(&self, position: &[T; 2], twist: &[T; 3]) -> ([T; 3], T) {
        let [x, y] = *position;
        Body { mass: self.mass, inertia: self.inertia, pose: [T::ZERO, x, y], twist: *twist }.momentum()
    }

    /// Position of its COM with the contact point at the end effector's pose.
    #[must_use]
    pub fn position(&self, end_effector: &[T; 3]) -> [T; 2] {
        [end_effector[1] - self.contact[0], end_effector[2] - self.contact[1]]
    }

    /// The rigid body of the target and a link that holds it at `[length, 0]` of its frame; `yaw` is the absolute
    /// direction of the link, rad.
    #[must_use]
    pub fn merged_link(&self, link: &LinkInertia<T>, length: T, yaw: T) -> LinkInertia<T> {
        let (sin, cos) = yaw.sin_cos();
        let [rx, ry] = self.contact;
        // the target's COM in the link's frame: end effector − R(−yaw) r
        let com = [length - (cos * rx + sin * ry), sin * rx - cos * ry];
        let mass = link.mass + self.mass;
        let offset = [com[0] - link.com[0], com[1] - link.com[1]];
        let share = self.mass / mass;
        let reduced = link.mass * share;
        LinkInertia {
            mass,
            inertia: link.inertia + self.inertia + reduced * (offset[0] * offset[0] + offset[1] * offset[1]),
            com: [link.com[0] + share * offset[0], link.com[1] + share * offset[1]],
        }
    }
}

/// Inertial properties of one link.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LinkInertia<T> {
    /// kg.
    pub mass: T,
    /// About the COM, kg m².
    pub inertia: T,
    /// In the link's frame, m.
    pub com: [T; 2],
}
