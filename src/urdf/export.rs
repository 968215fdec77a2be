//! Writes a layout as a URDF.

use crate::layout::Layout;
use quick_xml::escape::escape;

/// The layout as a URDF whose base moves freely in the plane z = 0.
///
/// A planar joint connects the link `base` to the link `world`; `MuJoCo` converts it to two slides and a hinge. Arm
/// `NAME` has the links `NAME_link1`, …, the joints `NAME_joint1`, … and the massless link `NAME_tip`, which `MuJoCo`
/// merges with the last link. Numbers read back exactly.
#[must_use]
pub fn export(layout: &Layout) -> String {
    let mut parts = vec![format!(
        "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<!-- Layout {name}: a base that floats in the plane z = 0, arms \
         that turn about z. SI units, radians.\n     Moments of inertia about x and y play no part in planar motion; \
         those of a sphere belong to a body that can be. -->\n<robot name=\"{name}\">\n  <link name=\"world\"/>\n  \
         <joint name=\"base_joint\" type=\"planar\">\n    <parent link=\"world\"/>\n    <child link=\"base\"/>\n    \
         <axis xyz=\"0 0 1\"/>\n  </joint>\n",
        name = layout.name
    )];
    parts.push(link("base", layout.base.mass, layout.base.inertia, [0.0; 2]));
    for arm in &layout.arms {
        let name = escape(&arm.name);
        let mut parent = "base".to_owned();
        let (mut place, mut angle) = (arm.mount, arm.mount_angle);
        for (k, body) in (1..).zip(&arm.links) {
            let child = format!("{name}_link{k}");
            parts.push(joint(&format!("{name}_joint{k}"), "continuous", [&parent, &child], place, angle));
            parts.push(link(&child, body.mass, body.inertia, body.com));
            (parent, place, angle) = (child, [body.length, 0.0], 0.0);
        }
        let tip = format!("{name}_tip");
        parts.push(joint(&format!("{tip}_joint"), "fixed", [&parent, &tip], place, 0.0));
        parts.push(format!("  <link name=\"{tip}\"/>\n"));
    }
    parts.push("</robot>\n".to_owned());
    parts.concat()
}

fn link(name: &str, mass: f64, inertia: f64, [x, y]: [f64; 2]) -> String {
    format!(
        "  <link name=\"{name}\">\n    <inertial>\n      <origin xyz=\"{x:?} {y:?} 0\"/>\n      <mass \
         value=\"{mass:?}\"/>\n      <inertia ixx=\"{inertia:?}\" ixy=\"0\" ixz=\"0\" iyy=\"{inertia:?}\" iyz=\"0\" \
         izz=\"{inertia:?}\"/>\n    </inertial>\n  </link>\n"
    )
}

fn joint(name: &str, kind: &str, [parent, child]: [&str; 2], [x, y]: [f64; 2], angle: f64) -> String {
    let axis = if kind == "fixed" { "" } else { "    <axis xyz=\"0 0 1\"/>\n" };
    format!(
        "  <joint name=\"{name}\" type=\"{kind}\">\n    <parent link=\"{parent}\"/>\n    <child link=\"{child}\"/>\n    \
         <origin xyz=\"{x:?} {y:?} 0\" rpy=\"0 0 {angle:?}\"/>\n{axis}  </joint>\n"
    )
}
