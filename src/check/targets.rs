//! Targets that are out of reach, or that no body of that size can be.

use super::number::{point, short};
use super::places::{center_of_mass, places};
use crate::capture::assembly::turned;
use crate::contact::ContactKind;
use crate::diagnostic::Warning;
use crate::layout::Layout;
use crate::outline::Outline;
use crate::registry;
use crate::scenario::{Detection, PlannedContact, Scenario, Target};
use std::f64::consts::TAU;

/// Contact is made on a target's rim: to this part of the radius.
const RIM: f64 = 0.05;

/// What is odd about the targets, one by one.
pub(super) fn warnings(scenario: &Scenario) -> Vec<Warning> {
    let targets = scenario.targets.iter().enumerate();
    let contact_at_time = scenario.contact.detection == Detection::Time;
    let each = targets.flat_map(|(i, target)| {
        let found = [
            heavy(scenario, target),
            if contact_at_time { off_rim(target) } else { None },
            inertia(target),
            on_a_wheel(scenario, target),
            out_of_reach(scenario, target),
            spin(&target.twist).map(|(why, help)| ("twist[0]", why, help)),
            too_few_joints(scenario, i, target),
        ];
        found.into_iter().flatten().map(move |(key, why, help)| Warning {
            key: format!("target[{i}].{key}"),
            why,
            help,
        })
    });
    each.chain(spinning_cases(scenario)).collect()
}

/// (key, why, help)
type Odd = (&'static str, String, String);

fn heavy(scenario: &Scenario, target: &Target) -> Option<Odd> {
    let robot = scenario.layout.mass();
    (target.mass > robot).then(|| {
        let why = format!("heavier than the robot that captures it, {} kg", short(robot));
        ("mass", why, "masses are in kg; such a target moves the robot more than the robot moves it".to_owned())
    })
}

fn off_rim(target: &Target) -> Option<Odd> {
    let size = target.outline.reach();
    let apart = |touch: &PlannedContact| target.outline.signed_distance(turned(touch.point, -target.yaw)).distance;
    let touch = target.contacts.iter().find(|touch| apart(touch).abs() > RIM * size)?;
    let why = match target.outline {
        Outline::Disc { radius } => {
            let [x, y] = touch.point;
            format!("{} m from the COM, but the radius is {} m", short(x.hypot(y)), short(radius))
        }
        Outline::Polygon { .. } if apart(touch) > 0.0 => format!("{} m outside the polygon", short(apart(touch))),
        Outline::Polygon { .. } => format!("{} m inside the polygon", short(-apart(touch))),
    };
    let help = "contact runs from the target's COM to the point on its rim that the tip takes hold of, m";
    Some(("contact", why, help.to_owned()))
}

fn inertia(target: &Target) -> Option<Odd> {
    // whichever is meant to be its size
    let [x, y] = target.contacts[0].point;
    let size = target.outline.reach().max(x.hypot(y));
    let ring = target.mass * size * size;
    (target.inertia > ring * (1.0 + 1e-9)).then(|| {
        let why = format!("more than a ring of its mass and size has, {} kg m²: mass · radius²", short(ring));
        let help =
            format!("inertias are in kg m² about the COM; a solid sphere has 2/5 of that, {}", short(0.4 * ring));
        ("inertia", why, help)
    })
}

fn on_a_wheel(scenario: &Scenario, target: &Target) -> Option<Odd> {
    let mut arms = target.contacts.iter().filter_map(|touch| scenario.layout.arms.get(touch.arm));
    let arm = arms.find(|arm| arm.reach() == 0.0)?;
    let why = format!("`{}` has no length, it is a reaction wheel, which takes hold of nothing", arm.name);
    let longer: Vec<_> =
        scenario.layout.arms.iter().filter(|arm| arm.reach() > 0.0).map(|arm| arm.name.as_str()).collect();
    Some(("arm", why, format!("arms with a length: {}", longer.join(", "))))
}

/// A loop closed by more constraints than its arms have joints: the impulses at its contacts cannot be told apart.
fn too_few_joints(scenario: &Scenario, i: usize, target: &Target) -> Option<Odd> {
    let joints: usize =
        target.contacts.iter().filter_map(|touch| scenario.layout.arms.get(touch.arm)).map(|arm| arm.links.len()).sum();
    let constraints =
        |kinds: &Vec<Option<ContactKind>>| -> usize { kinds.iter().flatten().map(|kind| kind.constraints()).sum() };
    let most = scenario.cases.iter().filter_map(|case| case.kinds.get(i)).map(constraints).max()?;
    // the target itself brings three degrees of freedom
    (most > joints + 3).then(|| {
        let why = format!("{most} constraints hold it, but its arms' {joints} joints and itself have {}", joints + 3);
        ("kind", why, "such an impact has no unique solution; a pin has 2 constraints, a rigid grip 3".to_owned())
    })
}

/// [`distance_and_most`] of the contact point; `None` also where the target's place is not given.
pub(super) fn of_contact(scenario: &Scenario, target: &Target) -> Option<(f64, f64)> {
    let [x, y] = target.position.filter(|_| scenario.contact.detection == Detection::Time)?;
    let [rx, ry] = target.contacts[0].point;
    distance_and_most(scenario, target.contacts[0].arm, [x + rx, y + ry])
}

/// The distance of a point from the robot's COM at the end of the approach, and the most at which the arm can have its
/// end effector, in m; `None` for a wheel.
///
/// The COM goes its way whatever the joints do. In any pose it is within Σ m d of the base COM, d being how far out
/// each link's COM can be, and the end effector within the arm's reach.
pub(crate) fn distance_and_most(scenario: &Scenario, arm: usize, [x, y]: [f64; 2]) -> Option<(f64, f64)> {
    let [from_x, from_y] = center_of_mass_at_end(scenario)?;
    let arm = scenario.layout.arms.get(arm).filter(|arm| arm.reach() > 0.0)?;
    let distance = (x - from_x).hypot(y - from_y);
    Some((distance, arm.reach_from_base() + base_from_center_of_mass(&scenario.layout)))
}

fn out_of_reach(scenario: &Scenario, target: &Target) -> Option<Odd> {
    let (distance, most) = of_contact(scenario, target)?;
    (distance > most).then(|| {
        let why = format!(
            "puts the contact point {} m from where the robot's COM is at the end of the approach; no pose brings the \
             arm's tip further out than {} m",
            short(distance),
            short(most)
        );
        let at = center_of_mass_at_end(scenario).map(point).unwrap_or_default();
        (
            "position",
            why,
            format!("position is that of the target's COM, m, inertial frame; the robot's COM is then at {at}"),
        )
    })
}

fn center_of_mass_at_end(scenario: &Scenario) -> Option<[f64; 2]> {
    let (layout, initial) = (&scenario.layout, &scenario.initial);
    let start = center_of_mass(&places(layout, &initial.base_pose, &initial.joint_angles)?);
    let momentum = registry::generic(layout).momentum(&initial.view()).ok()?.linear_momentum;
    let time = scenario.approach.duration;
    Some([0, 1].map(|axis: usize| start[axis] + momentum[axis] / layout.mass() * time))
}

/// The most there can be between base COM and robot's COM, in m.
fn base_from_center_of_mass(layout: &Layout) -> f64 {
    let mut moment = 0.0;
    for arm in &layout.arms {
        let mut out = arm.mount[0].hypot(arm.mount[1]);
        for link in &arm.links {
            moment += link.mass * (out + link.com[0].hypot(link.com[1]));
            out += link.length;
        }
    }
    moment / layout.mass()
}

/// (why, help) of a target that tumbles faster than it can be caught.
fn spin([omega, ..]: &[f64; 3]) -> Option<(String, String)> {
    (omega.abs() > TAU).then(|| {
        let degrees = format!(
            "a twist is [ω, vx, vy] in rad/s, m/s, m/s; {}°/s are {} rad/s",
            short(*omega),
            short(omega.to_radians())
        );
        (format!("the target tumbles {} times a second", short(omega.abs() / TAU)), degrees)
    })
}

fn spinning_cases(scenario: &Scenario) -> impl Iterator<Item = Warning> {
    scenario.cases.iter().enumerate().filter_map(|(i, case)| {
        // of a target that is odd itself enough was said
        let own = case.target_twists.iter().zip(&scenario.targets).filter(|(_, target)| spin(&target.twist).is_none());
        let (why, help) = own.map(|(twist, _)| twist).find_map(spin)?;
        Some(Warning { key: format!("case[{i}].target_twists"), why, help })
    })
}
