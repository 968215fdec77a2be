//! Base, arms and targets, each in its own frame, the arms link in link.

use super::clip::{Clip, pair, short};
use crate::frames::{Frame, FrameMotion};
use crate::layout::{Arm, Link};
use crate::outline::Outline;
use crate::output::scene::{PALETTE, base_shape, hexadecimal, target_colour_index, wheel_radius};
use crate::output::time_series::TimeSeriesRow;
use crate::scenario::Scenario;
use std::fmt::Write as _;

/// An end effector that holds a target.
pub(super) struct Hold {
    pub(super) arm: usize,
    /// From when on, s.
    pub(super) since: f64,
}

/// What the bodies are drawn from.
pub(super) struct Motion<'a> {
    pub(super) scenario: &'a Scenario,
    pub(super) frames: &'a [Frame],
    /// One per instant of the clip.
    pub(super) rows: &'a [TimeSeriesRow<'a>],
    pub(super) holds: &'a [Hold],
    pub(super) clip: &'a Clip,
    /// The instant that is seen without animation.
    pub(super) still: usize,
    /// px per m.
    pub(super) scale: f64,
}

/// The colour of a member of the palette.
pub(in crate::output) fn colour(index: usize) -> String {
    hexadecimal(PALETTE[index % PALETTE.len()])
}

impl Motion<'_> {
    /// All bodies, in metres, the targets below the robot.
    pub(super) fn bodies(&self) -> String {
        // inside out: a frame's group contains those of its children
        let mut groups: Vec<String> = self.frames.iter().map(|frame| self.shape(frame)).collect();
        let (mut robot, mut targets) = (String::new(), String::new());
        for (i, frame) in self.frames.iter().enumerate().rev() {
            let group = self.placed(frame, &groups[i]);
            match (frame.parent, frame.motion) {
                (Some(parent), _) => groups[parent].push_str(&group),
                (None, FrameMotion::Target(_)) => targets.insert_str(0, &group),
                (None, _) => robot = group,
            }
        }
        targets + &robot
    }

    /// The group of a frame in its parent.
    fn placed(&self, frame: &Frame, content: &str) -> String {
        let [angle, x, y] = frame.pose;
        let place = format!("translate({})", pair([x, y]));
        let place = if angle == 0.0 { place } else { format!("{place} rotate({})", degrees(angle)) };
        match frame.motion {
            FrameMotion::Fixed => format!("<g transform=\"{place}\">{content}</g>"),
            FrameMotion::Joint(joint) => {
                let turned = self.turned(|row| row.sample.state.joint_angles[joint], content);
                format!("<g transform=\"{place}\">{turned}</g>")
            }
            FrameMotion::Base => self.free(|row| row.sample.state.base_pose, content),
            FrameMotion::Target(target) => self.free(|row| row.targets[target].pose, content),
        }
    }

    fn turned(&self, angle: impl Fn(&TimeSeriesRow<'_>) -> f64, content: &str) -> String {
        let angles: Vec<_> = self.rows.iter().map(|row| degrees(angle(row))).collect();
        self.clip.moving("rotate", &angles, self.still, content)
    }

    fn free(&self, pose: impl Fn(&TimeSeriesRow<'_>) -> [f64; 3], content: &str) -> String {
        let places: Vec<_> = self.rows.iter().map(|row| pair([pose(row)[1], pose(row)[2]])).collect();
        self.clip.moving("translate", &places, self.still, &self.turned(|row| pose(row)[0], content))
    }

    /// What is drawn in a frame.
    fn shape(&self, frame: &Frame) -> String {
        let arms = &self.scenario.layout.arms;
        match (frame.motion, frame.arm) {
            (FrameMotion::Base, _) => self.base(),
            (FrameMotion::Target(target), _) => self.target(target),
            (FrameMotion::Joint(joint), Some(arm)) => {
                let before: usize = arms[..arm].iter().map(|arm: &Arm| arm.links.len()).sum();
                self.link(&arms[arm].links[joint - before], &colour(arm))
            }
            (_, Some(arm)) => self.end_effector(arm),
            _ => String::new(),
        }
    }

    /// Pixels in metres.
    fn pixels(&self, count: f64) -> f64 {
        count / self.scale
    }

    /// Width of the line of a link, m.
    fn thickness(&self) -> f64 {
        self.pixels((0.06 * self.scale).clamp(3.0, 9.0))
    }

    fn base(&self) -> String {
        let [outline, nose] = base_shape(&self.scenario.layout).lines();
        let reach = nose.last().map_or(0.0, |[x, _]| 0.7 * x);
        format!(
            "<path class=\"base\" d=\"{}\"/><path class=\"edge\" d=\"M0 0H{}\"/><circle class=\"mark\" r=\"{}\"/>",
            path(&outline),
            short(reach, 4),
            short(self.pixels(3.5), 4)
        )
    }

    fn link(&self, link: &Link, colour: &str) -> String {
        let (thick, mut drawn) = (self.thickness(), String::new());
        if let Some(outline) = &link.outline {
            let path = path(&outline.corners());
            let _ = write!(drawn, "<path class=\"body\" fill=\"{colour}\" stroke=\"{colour}\" d=\"{path}\"/>");
        }
        if link.length > 0.0 {
            let (length, width) = (short(link.length, 4), short(thick, 4));
            let _ = write!(
                drawn,
                "<path d=\"M0 0H{length}\" stroke=\"{colour}\" stroke-width=\"{width}\" stroke-linecap=\"round\"/>"
            );
        } else {
            let radius = short(wheel_radius(link).max(self.pixels(6.0)), 4);
            let _ = write!(
                drawn,
                "<circle class=\"body\" r=\"{radius}\" fill=\"{colour}\" stroke=\"{colour}\"/>\
                 <path class=\"edge\" stroke=\"{colour}\" d=\"M0 0H{radius}\"/>"
            );
        }
        let _ = write!(drawn, "<circle class=\"joint\" r=\"{}\" stroke=\"{colour}\"/>", short(0.62 * thick, 4));
        drawn
    }

    /// A point, and a square once it holds a target.
    fn end_effector(&self, arm: usize) -> String {
        let (thick, colour) = (self.thickness(), colour(arm));
        let mut drawn = format!("<circle r=\"{}\" fill=\"{colour}\"/>", short(0.62 * thick, 4));
        if let Some(hold) = self.holds.iter().find(|hold| hold.arm == arm) {
            let half = 0.55 * thick + self.pixels(3.0);
            let square = format!(
                "<path class=\"hold\" stroke=\"{colour}\" d=\"{}\"/>",
                path(&[[-half, -half], [half, -half], [half, half], [-half, half]])
            );
            drawn += &self.clip.seen(hold.since, None, &square);
        }
        drawn
    }

    fn target(&self, index: usize) -> String {
        let colour = colour(target_colour_index(self.scenario.layout.arms.len(), index));
        let outline = &self.scenario.targets[index].outline;
        let path = path(&outline.corners());
        let mut drawn = format!("<path class=\"body\" fill=\"{colour}\" stroke=\"{colour}\" d=\"{path}\"/>");
        if let Outline::Disc { radius, .. } = outline {
            // spokes that show the rotation
            let radius = short(*radius, 4);
            let spokes = format!("M-{radius} 0H{radius}M0 0V{radius}");
            let _ = write!(drawn, "<path class=\"edge\" stroke=\"{colour}\" d=\"{spokes}\"/>");
        }
        let _ = write!(drawn, "<circle r=\"{}\" fill=\"{colour}\"/>", short(self.pixels(3.0), 4));
        drawn
    }
}

/// An angle in degrees.
fn degrees(angle: f64) -> String {
    short(angle.to_degrees(), 2)
}

/// A closed path.
pub(in crate::output) fn path(corners: &[[f64; 2]]) -> String {
    let points: Vec<_> = corners.iter().map(|corner| pair(*corner)).collect();
    format!("M{}Z", points.join("L"))
}
