//! Warnings about targets whose contacts are found by detection, and that no end effector can reach meanwhile.

use super::number::{point, short};
use super::warning;
use crate::capture::reach::{Reach, UniformMotion};
use crate::diagnostic::Warning;
use crate::scenario::{Case, Detection, Scenario, Target};

/// In several targets' company one may be met after the impact of another, which pushes the robot: by this factor
/// further than the robot's COM would bring the end effectors without it.
const PUSHED: f64 = 2.0;
/// From this many reaches on a position is probably in mm.
const OTHER_UNIT: f64 = 50.0;

pub(super) fn warnings(scenario: &Scenario) -> Vec<Warning> {
    if scenario.contact.detection != Detection::Event {
        return Vec::new();
    }
    let each = scenario.targets.iter().enumerate().flat_map(|(i, target)| {
        let cases = scenario.cases.iter();
        let far: Vec<_> = cases.filter_map(|case| Some((case, distant(scenario, case, i)?))).collect();
        let is_always = far.len() == scenario.cases.len();
        far.into_iter().take(if is_always { 1 } else { usize::MAX }).map(move |(case, reach)| {
            let key = if is_always {
                format!("target[{i}].position")
            } else {
                // its own twist takes the target away
                format!("case[{}].target_twists", case.index)
            };
            warning(key, why(target, &reach), help(target, &reach))
        })
    });
    each.collect()
}

/// Whether a target is out of reach in a case, of which there is a warning.
pub(super) fn is_distant(scenario: &Scenario, case: &Case, i: usize) -> bool {
    distant(scenario, case, i).is_some()
}

/// Where a target is nearest to the robot in a case, of the arm with the longest reach among those that are to meet it;
/// `None` where its outline may be within that.
fn distant(scenario: &Scenario, case: &Case, i: usize) -> Option<Reach> {
    let target = &scenario.targets[i];
    let [_, vx, vy] = case.target_twists[i];
    let motion = UniformMotion { start: target.position?, velocity: [vx, vy] };
    let has_others = scenario.targets.len() > 1;
    let after = scenario.post_impact.as_ref().filter(|_| has_others).map_or(0.0, |phase| phase.duration);
    let span = scenario.approach.duration + after;
    let reaches = target.contacts.iter().filter_map(|contact| Reach::nearest(scenario, contact.arm, motion, span));
    let nearest = reaches.max_by(|a, b| a.limit.total_cmp(&b.limit))?;
    let factor = if has_others { PUSHED } else { 1.0 };
    (nearest.distance > factor * (nearest.limit + target.outline.reach())).then_some(nearest)
}

fn why(target: &Target, reach: &Reach) -> String {
    format!(
        "no end effector can meet `{}`: it stays {} m or more from the robot's COM, and with an outline that goes {} m from \
         its own COM it would have to be within {} m",
        target.name,
        short(reach.distance),
        short(target.outline.reach()),
        short(reach.limit + target.outline.reach())
    )
}

fn help(target: &Target, reach: &Reach) -> String {
    let at = point(reach.center_of_mass);
    let place = format!(
        "position is that of the target's COM at the start, m, inertial frame; the robot's COM is then at {at}"
    );
    match target.position.filter(|_| reach.distance > OTHER_UNIT * reach.limit) {
        Some([x, y]) => format!("{place}; {} mm are {} m", point([x, y]), point([x / 1000.0, y / 1000.0])),
        None => place,
    }
}
