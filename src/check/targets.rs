//! Warnings about targets: mass, inertia, contact points, reach and spin.

use super::number::{point, short};
use super::warning;
use crate::capture::assembly::rotated;
use crate::capture::reach::Reach;
use crate::contact::ContactKind;
use crate::diagnostic::Warning;
use crate::outline::Outline;
use crate::scenario::{Detection, PlannedContact, Scenario, Target};
use std::f64::consts::TAU;

/// Largest distance of a contact point from the target's outline, relative to the target's size.
const MAX_OFFSET: f64 = 0.05;

pub(super) fn warnings(scenario: &Scenario) -> Vec<Warning> {
    let each = scenario.targets.iter().enumerate().flat_map(|(i, target)| {
        let found = [
            heavy(scenario, target),
            off_outline(scenario, target),
            large_inertia(target),
            on_a_wheel(scenario, target),
            out_of_reach(scenario, target),
            spin("twist[0]", &target.twist),
            too_few_joints(scenario, i, target),
        ];
        let in_table = move |found: Warning| Warning { key: format!("target[{i}].{}", found.key), ..found };
        found.into_iter().flatten().map(in_table)
    });
    each.chain(spinning_cases(scenario)).collect()
}

fn heavy(scenario: &Scenario, target: &Target) -> Option<Warning> {
    let robot = scenario.layout.mass();
    (target.mass > robot).then(|| {
        let why = format!("heavier than the robot that captures it, {} kg", short(robot));
        warning("mass", why, "masses are in kg; such a target moves the robot more than the robot moves it")
    })
}

fn off_outline(scenario: &Scenario, target: &Target) -> Option<Warning> {
    if scenario.contact.detection == Detection::Event {
        return None; // contact points are not given
    }
    let points = target.contacts.iter().map(|contact| contact.point);
    let mut distances =
        points.map(|point| (point, target.outline.signed_distance(rotated(point, -target.yaw)).distance));
    let ([x, y], distance) = distances.find(|(_, distance)| distance.abs() > MAX_OFFSET * target.outline.reach())?;
    let why = match target.outline {
        Outline::Disc { radius, .. } => {
            format!("{} m from the COM, but the radius is {} m", short(libm::hypot(x, y)), short(radius))
        }
        _ if distance > 0.0 => format!("{} m outside the outline", short(distance)),
        _ => format!("{} m inside the outline", short(-distance)),
    };
    let help = "contact runs from the target's COM to the point on its rim that the end effector holds, m";
    Some(warning("contact", why, help))
}

fn large_inertia(target: &Target) -> Option<Warning> {
    // the larger of outline and contact point, either of which may be in the wrong unit
    let [x, y] = target.contacts[0].point;
    let size = target.outline.reach().max(libm::hypot(x, y));
    let ring = target.mass * size * size;
    (target.inertia > ring * (1.0 + 1e-9)).then(|| {
        let why = format!("more than a ring of its mass and size has, {} kg m²: mass · radius²", short(ring));
        let sphere = short(0.4 * ring);
        warning(
            "inertia",
            why,
            format!("inertias are in kg m² about the COM; a solid sphere has 2/5 of that, {sphere}"),
        )
    })
}

fn on_a_wheel(scenario: &Scenario, target: &Target) -> Option<Warning> {
    let arms = &scenario.layout.arms;
    let arm = target.contacts.iter().map(|contact| &arms[contact.arm]).find(|arm| arm.reach() == 0.0)?;
    let why = format!("`{}` has no length, it is a reaction wheel, which cannot capture", arm.name);
    let longer: Vec<_> = arms.iter().filter(|arm| arm.reach() > 0.0).map(|arm| arm.name.as_str()).collect();
    Some(warning("arm", why, format!("arms with a length: {}", longer.join(", "))))
}

/// A loop with more constraints than degrees of freedom: the impulses at its contacts are not unique.
fn too_few_joints(scenario: &Scenario, i: usize, target: &Target) -> Option<Warning> {
    let arms = &scenario.layout.arms;
    let joints: usize = target.contacts.iter().map(|contact| arms[contact.arm].links.len()).sum();
    let constraints =
        |kinds: &Vec<Option<ContactKind>>| -> usize { kinds.iter().flatten().map(|kind| kind.constraints()).sum() };
    let most = scenario.cases.iter().map(|case| constraints(&case.kinds[i])).max()?;
    // the target itself brings three degrees of freedom
    (most > joints + 3).then(|| {
        let why = format!("{most} constraints hold it, but its arms' {joints} joints and itself have {}", joints + 3);
        warning("kind", why, "such an impact has no unique solution; a pin has 2 constraints, a rigid contact 3")
    })
}

/// The reach of the arm of the first contact against the contact point; `None` where the target's position is not
/// given or the contact point is not.
pub(super) fn contact_reach(scenario: &Scenario, target: &Target) -> Option<Reach> {
    let [x, y] = target.position.filter(|_| scenario.contact.detection == Detection::Time)?;
    let PlannedContact { arm, point: [rx, ry], .. } = target.contacts[0];
    Reach::new(scenario, arm, [x + rx, y + ry])
}

fn out_of_reach(scenario: &Scenario, target: &Target) -> Option<Warning> {
    let Reach { center_of_mass, distance, limit } = contact_reach(scenario, target).filter(Reach::is_exceeded)?;
    let why = format!(
        "puts the contact point {} m from where the robot's COM is at the end of the approach; no pose brings the \
         arm's end effector further out than {} m",
        short(distance),
        short(limit)
    );
    let at = point(center_of_mass);
    let help = format!("position is that of the target's COM, m, inertial frame; the robot's COM is then at {at}");
    Some(warning("position", why, help))
}

/// A target that tumbles more than once a second.
fn spin(key: impl Into<String>, [omega, ..]: &[f64; 3]) -> Option<Warning> {
    (omega.abs() > TAU).then(|| {
        let why = format!("the target tumbles {} times a second", short(omega.abs() / TAU));
        let [degrees, radians] = [*omega, omega.to_radians()].map(short);
        warning(key, why, format!("a twist is [ω, vx, vy] in rad/s, m/s, m/s; {degrees}°/s are {radians} rad/s"))
    })
}

fn spinning_cases(scenario: &Scenario) -> impl Iterator<Item = Warning> {
    scenario.cases.iter().filter_map(|case| {
        // a target with a warning of its own has no second one
        let mut own =
            case.target_twists.iter().zip(&scenario.targets).filter(|(_, target)| target.twist[0].abs() <= TAU);
        own.find_map(|(twist, _)| spin(format!("case[{}].target_twists", case.index), twist))
    })
}
