//! The description of a layout: masses, lengths, degrees of freedom, generated code.

use super::number::{point, short};
use crate::engine::Choice;
use crate::layout::Layout;
use crate::registry::{self, Robots};
use crate::simulate::bodies::{BodySums, bodies, inertia_about};
use crate::state::State;
use crate::structure::in_words;
use std::fmt::{self, Write};

pub(super) fn description(layout: &Layout, robots: Robots<'_>) -> String {
    let mut text = String::new();
    write(&mut text, layout, robots).expect("writing to a String does not fail");
    text
}

fn write(out: &mut String, layout: &Layout, robots: Robots<'_>) -> fmt::Result {
    writeln!(out, "{}: a layout, sha256 {}\n", layout.name, digest(layout))?;
    writeln!(out, "  degrees of freedom  {}", freedom(layout))?;
    let (all, base) = (layout.mass(), &layout.base);
    writeln!(out, "  mass                {} kg, {} % of it in the base", short(all), short(100.0 * base.mass / all))?;
    writeln!(
        out,
        "  base                {} kg, {} kg m², radius of gyration {} m",
        short(base.mass),
        short(base.inertia),
        short(base.radius_of_gyration())
    )?;
    let zeros = vec![0.0; layout.joints()];
    let state = State { base_pose: [0.0; 3], joint_angles: &zeros, base_twist: [0.0; 3], joint_rates: &zeros };
    if let Ok(bodies) = bodies(&*registry::generic(layout), &state, &[]) {
        let inertia = short(inertia_about(&bodies, BodySums::new(bodies.iter().copied()).center_of_mass()));
        writeln!(out, "  inertia             {inertia} kg m² about the robot's COM, all joint angles 0")?;
    }
    writeln!(out, "  structure           {}", in_words(layout))?;
    writeln!(out, "  generated code      {}\n", code(layout, robots))?;
    arms(out, layout)
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

fn arms(out: &mut String, layout: &Layout) -> fmt::Result {
    let row = |cells: [&str; 6]| {
        let [name, links, mass, length, reach, mount] = cells;
        format!("  {name:<16} {links:>5} {mass:>10} {length:>10} {reach:>17}  {mount}\n")
    };
    out.write_str(&row(["arm", "links", "mass [kg]", "length [m]", "from base COM [m]", "mount [m, rad]"]))?;
    for arm in &layout.arms {
        let angle = if arm.mount_angle == 0.0 { String::new() } else { format!(" at {}", short(arm.mount_angle)) };
        out.write_str(&row([
            &arm.name,
            &arm.links.len().to_string(),
            &short(arm.mass()),
            &short(arm.reach()),
            &short(arm.reach_from_base()),
            &format!("{}{angle}", point(arm.mount)),
        ]))?;
    }
    Ok(())
}
