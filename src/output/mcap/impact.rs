//! What exact impacts did: arrows and numbers.

use super::channel::{Channel, Recording, timestamp};
use super::frames::WORLD;
use super::scalars::Scalars;
use super::scene::{color, pose};
use crate::capture::impact::ImpactResult;
use crate::layout::Arm;
use foxglove::messages::{ArrowPrimitive, Duration, SceneEntity, SceneUpdate, TextPrimitive};
use std::io;

const RED: [f64; 4] = [0.7, 0.15, 0.12, 1.0];
/// How long arrows are shown, s.
const SHOWN: i32 = 4;
/// Length of the longest arrow over the reach of the arms.
const LONGEST: f64 = 0.25;
/// Fields of `/impact`: of each arm, then of all.
const IMPULSE: [(&str, &str); 3] = [("n", "N m s"), ("fx", "N s"), ("fy", "N s")];
const RESULTS: [(&str, &str); 5] = [
    ("angular_momentum_jump", "N m s"),
    ("linear_momentum_jump_x", "N s"),
    ("linear_momentum_jump_y", "N s"),
    ("kinetic_energy_before", "J"),
    ("kinetic_energy_after", "J"),
];

/// Where impacts go: `/impulses` and `/impact`.
pub(super) struct Impacts<'a> {
    arms: &'a [Arm],
    arrows: Channel<SceneUpdate>,
    numbers: Scalars,
}

impl<'a> Impacts<'a> {
    pub(super) fn new(recording: &mut Recording, arms: &'a [Arm]) -> io::Result<Self> {
        let of_arm = |arm: &Arm| IMPULSE.map(|(part, unit)| (format!("{}_impulse_{part}", arm.name), unit));
        let of_all = RESULTS.map(|(name, unit)| (name.to_owned(), unit));
        let fields: Vec<_> = arms.iter().flat_map(of_arm).chain(of_all).collect();
        let fields: Vec<_> = fields.iter().map(|(name, unit)| (name.as_str(), *unit)).collect();
        let arrows = recording.channel("/impulses")?;
        Ok(Self { arms, arrows, numbers: Scalars::new(recording, "impact", &fields)? })
    }

    /// One impact, with the poses [yaw, x, y] of the end effectors then; an arm that touches nothing has an impulse of
    /// 0.
    pub(super) fn log(
        &self,
        recording: &mut Recording,
        time: f64,
        impact: &ImpactResult,
        end_effectors: &[[f64; 3]],
    ) -> io::Result<()> {
        recording.log(self.arrows, time, &self.arrows(time, impact, end_effectors))?;
        let impulses = impact.impulses.iter().flat_map(|impulse| impulse.unwrap_or_default());
        let energies = [impact.kinetic_energy_before, impact.kinetic_energy_after];
        self.numbers.log(recording, time, impulses.chain(impact.momentum_jump).chain(energies))
    }

    /// The impulse on the robot at each contact: as an arrow its force part, the longest as long as is easy to see.
    fn arrows(&self, time: f64, impact: &ImpactResult, end_effectors: &[[f64; 3]]) -> SceneUpdate {
        let impulses = &impact.impulses;
        let magnitudes = impact.impulse_magnitudes();
        let largest = magnitudes.iter().flatten().copied().fold(0.0, f64::max);
        let reach = self.arms.iter().map(Arm::reach).fold(0.0, f64::max);
        let entity = |(i, arm): (usize, &Arm)| {
            let [_, x, y] = *end_effectors.get(i)?;
            let ([_, fx, fy], size) = ((*impulses.get(i)?)?, (*magnitudes.get(i)?)?);
            let length = if largest > 0.0 { LONGEST * reach * size / largest } else { 0.0 };
            Some(SceneEntity {
                timestamp: Some(timestamp(time)),
                frame_id: WORLD.to_owned(),
                id: arm.name.clone(),
                lifetime: Some(Duration::new(SHOWN, 0)),
                arrows: vec![ArrowPrimitive {
                    pose: Some(pose([fy.atan2(fx), x, y])),
                    shaft_length: 0.7 * length,
                    shaft_diameter: 0.06 * length,
                    head_length: 0.3 * length,
                    head_diameter: 0.15 * length,
                    color: Some(color(RED)),
                }],
                texts: vec![TextPrimitive {
                    pose: Some(pose([0.0, x, y])),
                    billboard: true,
                    font_size: 14.0,
                    scale_invariant: true,
                    color: Some(color(RED)),
                    text: format!("{size:.3e} N s"),
                }],
                ..SceneEntity::default()
            })
        };
        let entities = self.arms.iter().enumerate().filter_map(entity).collect();
        SceneUpdate { deletions: Vec::new(), entities }
    }
}
