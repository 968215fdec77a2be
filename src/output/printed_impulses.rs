//! The impulses that the paper prints, which are shown beside those of its robot only.

use crate::layout::Layout;
use crate::registry::SHIPPED;
use crate::scenario::Scenario;

/// The name of the paper's robot among the shipped ones.
const ROBOT: &str = "dual_arm_3r";

/// Whether some case has printed impulses and the robot is the paper's, whatever its name.
#[must_use]
pub fn are_comparable(scenario: &Scenario) -> bool {
    let any = scenario.cases.iter().any(|case| case.printed_impulses.iter().any(Option::is_some));
    any && is_of_the_paper(&scenario.layout)
}

fn is_of_the_paper(layout: &Layout) -> bool {
    let shipped = SHIPPED.iter().find(|(name, _)| *name == ROBOT);
    let paper = shipped.and_then(|(name, text)| Layout::parse(text, name).ok());
    paper.is_some_and(|paper| Layout { name: layout.name.clone(), ..paper }.sha256() == layout.sha256())
}
