//! The description of a layout: masses, lengths, degrees of freedom, generated code.

use super::number::{point, short};
use crate::engine::Choice;
use crate::layout::Layout;
use crate::plain_text::Column::{Left, Right};
use crate::plain_text::{Table, entry};
use crate::registry::{self, Robots};
use crate::simulate::bodies::{BodySums, bodies, inertia_about};
use crate::state::State;
use crate::structure::in_words;

pub(super) fn description(layout: &Layout, robots: Robots<'_>) -> String {
    let mut out = format!("{}: a layout, sha256 {}\n\n", layout.name, digest(layout));
    out += &entry("degrees of freedom", &freedom(layout));
    let (all, base) = (layout.mass(), &layout.base);
    let [mass, share] = [all, 100.0 * base.mass / all].map(short);
    out += &entry("mass", &format!("{mass} kg, {share} % of it in the base"));
    let [mass, inertia, radius] = [base.mass, base.inertia, base.radius_of_gyration()].map(short);
    out += &entry("base", &format!("{mass} kg, {inertia} kg m², radius of gyration {radius} m"));
    let zeros = vec![0.0; layout.joints()];
    let state = State { base_pose: [0.0; 3], joint_angles: &zeros, base_twist: [0.0; 3], joint_rates: &zeros };
    if let Ok(bodies) = bodies(&*registry::generic(layout), &state, &[]) {
        let inertia = short(inertia_about(&bodies, BodySums::new(bodies.iter().copied()).center_of_mass()));
        out += &entry("inertia", &format!("{inertia} kg m² about the robot's COM, all joint angles 0"));
    }
    out += &entry("structure", &in_words(layout));
    out += &entry("generated code", &code(layout, robots));
    out + "\n" + &arms(layout)
}

/// The first 12 digits of the hash.
pub(super) fn digest(layout: &Layout) -> String {
    layout.sha256()[..12].to_owned()
}

pub(super) fn freedom(layout: &Layout) -> String {
    let joints = layout.joints();
    format!("{}: base 3, joints {joints}", 3 + joints)
}

/// The generated code of its structure, or what computes it instead.
pub(super) fn code(layout: &Layout, robots: Robots<'_>) -> String {
    match robots.code(layout).map(|code| code.manifest) {
        Ok(manifest) if manifest.sha256 == layout.sha256() => format!("generated::{}", manifest.name),
        Ok(manifest) => format!("generated::{}, with these numbers as its parameters", manifest.name),
        Err(_) => {
            let (choice, unusable) = Choice::fastest(layout, robots);
            let why = unusable.map_or_else(String::new, |why| format!(" ({why})"));
            format!(
                "none of this structure in this build; computed by {}, {}{why}",
                choice.engine.name(),
                choice.origin
            )
        }
    }
}

fn arms(layout: &Layout) -> String {
    let mut table = Table::new(&[
        Left("arm"),
        Right("links"),
        Right("mass [kg]"),
        Right("length [m]"),
        Right("from base COM [m]"),
        Left("mount [m, rad]"),
    ]);
    for arm in &layout.arms {
        let angle = if arm.mount_angle == 0.0 { String::new() } else { format!(" at {}", short(arm.mount_angle)) };
        let [mass, length, reach] = [arm.mass(), arm.reach(), arm.reach_from_base()].map(short);
        let mount = format!("{}{angle}", point(arm.mount));
        table.row([arm.name.clone(), arm.links.len().to_string(), mass, length, reach, mount]);
    }
    table.text()
}
