//! What the exact impact did: arrows and numbers.

use super::channel::{Recording, timestamp};
use super::frames::WORLD;
use super::scalars::Scalars;
use super::scene::{color, pose};
use crate::layout::Arm;
use crate::scenario::Scenario;
use crate::study::Captured;
use foxglove::messages::{ArrowPrimitive, Duration, SceneEntity, SceneUpdate, TextPrimitive};
use std::io;

const RED: [f64; 4] = [0.7, 0.15, 0.12, 1.0];
/// How long arrows are shown, s.
const SHOWN: i32 = 4;
/// Length of the longest arrow over the reach of the arms.
const LONGEST: f64 = 0.25;

/// An impact, and where it is.
pub(super) struct Impact<'a> {
    pub(super) scenario: &'a Scenario,
    pub(super) captured: &'a Captured,
    /// [yaw, x, y] of each tip; rad, m.
    pub(super) tips: &'a [[f64; 3]],
}

impl Impact<'_> {
    /// `/impulses` and `/impact`.
    pub(super) fn write(&self, recording: &mut Recording, time: f64) -> io::Result<()> {
        let arrows = recording.channel("/impulses")?;
        recording.log(arrows, time, &self.arrows(time))?;
        let fields = self.numbers();
        let names: Vec<_> = fields.iter().map(|(name, unit, _)| (name.as_str(), *unit)).collect();
        let scalars = Scalars::new(recording, "impact", &names)?;
        scalars.log(recording, time, fields.iter().map(|(_, _, value)| *value))
    }

    /// The impulse on the robot at each contact: as an arrow its force part, the longest as long as is easy to see.
    fn arrows(&self, time: f64) -> SceneUpdate {
        let impulses = &self.captured.impact.exact.impulses;
        let magnitudes = self.captured.impact.exact.impulse_magnitudes();
        let largest = magnitudes.iter().flatten().copied().fold(0.0, f64::max);
        let arms = &self.scenario.layout.arms;
        let reach = arms.iter().map(Arm::reach).fold(0.0, f64::max);
        let entity = |(i, arm): (usize, &Arm)| {
            let [_, x, y] = *self.tips.get(i)?;
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
        let entities = arms.iter().enumerate().filter_map(entity).collect();
        SceneUpdate { deletions: Vec::new(), entities }
    }

    /// Name, unit and value of each.
    fn numbers(&self) -> Vec<(String, &'static str, f64)> {
        let exact = &self.captured.impact.exact;
        let mut list = Vec::new();
        for (arm, impulse) in self.scenario.layout.arms.iter().zip(&exact.impulses) {
            for ((part, unit), value) in
                [("n", "N m s"), ("fx", "N s"), ("fy", "N s")].into_iter().zip(impulse.iter().flatten())
            {
                list.push((format!("{}_impulse_{part}", arm.name), unit, *value));
            }
        }
        let [l, px, py] = exact.momentum_jump;
        list.extend([
            ("angular_momentum_jump".to_owned(), "N m s", l),
            ("linear_momentum_jump_x".to_owned(), "N s", px),
            ("linear_momentum_jump_y".to_owned(), "N s", py),
            ("kinetic_energy_before".to_owned(), "J", exact.kinetic_energy_before),
            ("kinetic_energy_after".to_owned(), "J", exact.kinetic_energy_after),
        ]);
        list
    }
}
