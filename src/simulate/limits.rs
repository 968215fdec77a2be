//! Limits of joint angles and rates, and their violations: checked in every run, not enforced.
//!
//! # Example
//! ```
//! use planar_capture::simulate::limits::{JointLimits, LimitViolations};
//! use planar_capture::state::State;
//!
//! let limits = [JointLimits { name: "joint 1 of arm1".to_owned(), angles: Some([-1.0, 2.0]), rate: None }];
//! let mut found = LimitViolations::default();
//! for (time, angle) in [(1.0, 1.5), (2.0, 2.25), (3.0, -1.125)] {
//!     let (joint_angles, joint_rates) = (&[angle][..], &[0.5][..]);
//!     found.record(&limits, time, &State { base_pose: [0.0; 3], joint_angles, base_twist: [0.0; 3], joint_rates });
//! }
//! let largest = found.joint_angle.expect("an angle beyond its limits");
//! assert_eq!((largest.time, largest.limit, largest.size()), (2.0, 2.0, 0.25));
//! assert_eq!(found.joint_rate, None);
//! ```

use crate::simulate::path::PathInterval;
use crate::state::State;

/// Coordinates of the base, which stand before those of the joints.
const BASE: usize = 3;

/// The limits of one joint.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct JointLimits {
    /// The joint, as in messages: `joint 2 of arm1`.
    pub name: String,
    /// Smallest and largest angle, rad; `None` without a limit.
    pub angles: Option<[f64; 2]>,
    /// Largest absolute rate, rad/s; `None` without a limit.
    pub rate: Option<f64>,
}

impl JointLimits {
    /// The limit that an angle is beyond, rad; NaN is beyond every limit.
    #[must_use]
    pub fn angle_beyond(&self, angle: f64) -> Option<f64> {
        let [low, high] = self.angles?;
        if angle < low { Some(low) } else { (angle > high || angle.is_nan()).then_some(high) }
    }

    /// The limit that a rate is beyond, rad/s, with the sign of the rate; NaN is beyond every limit.
    #[must_use]
    pub fn rate_beyond(&self, rate: f64) -> Option<f64> {
        self.rate.filter(|limit| rate.abs() > *limit || rate.is_nan()).map(|limit| limit.copysign(rate))
    }
}

/// A joint beyond its limit.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct LimitViolation {
    /// `joint 2 of arm1`.
    pub joint: String,
    /// Since the start of the phase, s.
    pub time: f64,
    /// rad or rad/s.
    pub value: f64,
    /// The limit, in the same unit.
    pub limit: f64,
}

impl LimitViolation {
    /// Distance from the limit, greater than 0.
    #[must_use]
    pub fn size(&self) -> f64 {
        (self.value - self.limit).abs()
    }
}

/// The largest violations of a phase.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct LimitViolations {
    /// Of an angle, rad.
    pub joint_angle: Option<LimitViolation>,
    /// Of a rate, rad/s.
    pub joint_rate: Option<LimitViolation>,
}

impl LimitViolations {
    /// Checks one state.
    pub fn record(&mut self, limits: &[JointLimits], time: f64, state: &State<'_, f64>) {
        for (joint, (angle, rate)) in limits.iter().zip(state.joint_angles.iter().zip(state.joint_rates)) {
            self.record_joint(joint, time, [*angle, *rate]);
        }
    }

    /// Checks where an angle or a rate is at its largest or smallest within an interval of the path: whatever the steps are, no
    /// violation lies between two of them.
    pub(crate) fn record_between(&mut self, limits: &[JointLimits], interval: &PathInterval<'_>) {
        for (joint, limits) in limits.iter().enumerate() {
            for time in interval.extremes(BASE + joint).into_iter().flatten() {
                let [angle, rate] = interval.coordinate_at(BASE + joint, time);
                self.record_joint(limits, time, [angle, rate]);
            }
        }
    }

    fn record_joint(&mut self, joint: &JointLimits, time: f64, [angle, rate]: [f64; 2]) {
        let found = [
            (&mut self.joint_angle, angle, joint.angle_beyond(angle)),
            (&mut self.joint_rate, rate, joint.rate_beyond(rate)),
        ];
        for (largest, value, limit) in found {
            let Some(limit) = limit else { continue };
            let violation = LimitViolation { joint: joint.name.clone(), time, value, limit };
            if largest.as_ref().is_none_or(|largest| violation.size() > largest.size()) {
                *largest = Some(violation);
            }
        }
    }

    /// The larger of these violations and those of the `next` phase, which starts after this one of `duration` (s).
    #[must_use]
    pub fn then(self, next: Self, duration: f64) -> Self {
        let larger = |before: Option<LimitViolation>, after: Option<LimitViolation>| {
            let after = after.map(|violation| LimitViolation { time: duration + violation.time, ..violation });
            match (before, after) {
                (Some(before), Some(after)) => Some(if after.size() > before.size() { after } else { before }),
                (before, after) => before.or(after),
            }
        };
        Self {
            joint_angle: larger(self.joint_angle, next.joint_angle),
            joint_rate: larger(self.joint_rate, next.joint_rate),
        }
    }

    /// One sentence for each violation.
    #[must_use]
    pub fn sentences(&self) -> Vec<String> {
        let say = |violation: &Option<LimitViolation>, verb: &str, unit: &str| {
            let LimitViolation { joint, time, value, limit } = violation.as_ref()?;
            Some(format!("{joint} {verb} {value:.6} {unit} at {time:.3} s, beyond its limit of {limit} {unit}"))
        };
        [say(&self.joint_angle, "is at", "rad"), say(&self.joint_rate, "turns with", "rad/s")]
            .into_iter()
            .flatten()
            .collect()
    }
}
