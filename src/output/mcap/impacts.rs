//! The channels `/impulses` and `/impact`: results of the exact impact model as arrows and as numbers.

use super::recording::{Channel, Recording, timestamp};
use super::scalar_channel::ScalarChannel;
use super::scene_entities::color;
use super::transforms::{WORLD, pose};
use crate::layout::Arm;
use crate::output::impacts::ImpactEvent;
use foxglove::messages::{ArrowPrimitive, Duration, SceneEntity, SceneUpdate, TextPrimitive};
use std::io;

const RED: [f64; 4] = [0.7, 0.15, 0.12, 1.0];
/// How long arrows are shown, s.
const LIFETIME: i32 = 4;
/// Length of the longest arrow over the length of the longest arm.
const LONGEST: f64 = 0.25;
/// Fields of `/impact` for each arm.
const IMPULSE: [(&str, &str); 3] = [("n", "N m s"), ("fx", "N s"), ("fy", "N s")];
/// The other fields of `/impact`.
const BALANCE: [(&str, &str); 5] = [
    ("angular_momentum_jump", "N m s"),
    ("linear_momentum_jump_x", "N s"),
    ("linear_momentum_jump_y", "N s"),
    ("kinetic_energy_before", "J"),
    ("kinetic_energy_after", "J"),
];

pub(super) struct ImpactChannels<'a> {
    arms: &'a [Arm],
    arrows: Channel<SceneUpdate>,
    numbers: ScalarChannel,
}

impl<'a> ImpactChannels<'a> {
    pub(super) fn new(recording: &mut Recording<'_>, arms: &'a [Arm]) -> io::Result<Self> {
        let impulse = |arm: &Arm| IMPULSE.map(|(part, unit)| (format!("{}_impulse_{part}", arm.name), unit));
        let balance = BALANCE.map(|(name, unit)| (name.to_owned(), unit));
        let fields: Vec<_> = arms.iter().flat_map(impulse).chain(balance).collect();
        let fields: Vec<_> = fields.iter().map(|(name, unit)| (name.as_str(), *unit)).collect();
        let arrows = recording.channel("/impulses")?;
        Ok(Self { arms, arrows, numbers: ScalarChannel::new(recording, "impact", &fields)? })
    }

    /// Adds one impact. The impulse of an arm without contact is 0.
    pub(super) fn log(&self, recording: &mut Recording<'_>, event: &ImpactEvent<'_>) -> io::Result<()> {
        recording.log(&self.arrows, event.time, &self.arrows(event))?;
        let exact = &event.solution.exact;
        let impulses = exact.impulses.iter().flat_map(|impulse| impulse.unwrap_or_default());
        let energies = [exact.kinetic_energy_before, exact.kinetic_energy_after];
        self.numbers.log(recording, event.time, impulses.chain(exact.momentum_jump).chain(energies))
    }

    /// The force part of the impulse on the robot at each contact as an arrow with its magnitude.
    fn arrows(&self, event: &ImpactEvent<'_>) -> SceneUpdate {
        let exact = &event.solution.exact;
        let largest = exact.impulse_magnitudes().into_iter().flatten().fold(0.0, f64::max);
        let reach = self.arms.iter().map(Arm::reach).fold(0.0, f64::max);
        let entity = |(i, arm): (usize, &Arm)| {
            let [_, x, y] = event.before.end_effector_poses[i];
            let [_, fx, fy] = exact.impulses[i]?;
            let magnitude = libm::hypot(fx, fy);
            let length = if largest > 0.0 { LONGEST * reach * magnitude / largest } else { 0.0 };
            Some(SceneEntity {
                timestamp: Some(timestamp(event.time)),
                frame_id: WORLD.to_owned(),
                id: arm.name.clone(),
                lifetime: Some(Duration::new(LIFETIME, 0)),
                arrows: vec![ArrowPrimitive {
                    pose: Some(pose([libm::atan2(fy, fx), x, y])),
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
                    text: format!("{magnitude:.3e} N s"),
                }],
                ..SceneEntity::default()
            })
        };
        let entities = self.arms.iter().enumerate().filter_map(entity).collect();
        SceneUpdate { deletions: Vec::new(), entities }
    }
}
