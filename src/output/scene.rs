//! Shapes and colours of base, links and targets, each in its own frame, shared by figures, MCAP and HTML report.

use crate::frames::{Frame, FrameMotion, robot_frames};
use crate::layout::{Layout, Link};
use crate::outline::Outline;
use crate::scenario::{Scenario, Target};

/// The visual representation of a rigid body.
#[derive(Clone, Debug, PartialEq)]
pub struct Visual {
    /// Name of the frame fixed to the body.
    pub frame: String,
    /// In that frame.
    pub shape: Shape,
    /// Red, green, blue, opacity; 0 to 1.
    pub colour: [f64; 4],
    /// Extent normal to the plane, m.
    pub thickness: f64,
}

/// The projection of a body on the plane; lengths in m.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Sides parallel to the frame's axes.
    Rectangle {
        /// [x, y] in the frame.
        centre: [f64; 2],
        /// Side lengths along x and y.
        size: [f64; 2],
    },
    /// A disc about the frame's origin, or a polygon.
    Outline(Outline),
}

/// The palette of Okabe and Ito, distinguishable with any colour vision, without its yellow, which has too little
/// contrast on white; red, green, blue. The HTML report has the same.
pub const PALETTE: [[u8; 3]; 6] = [
    [0x00, 0x72, 0xb2],
    [0xd5, 0x5e, 0x00],
    [0x00, 0x9e, 0x73],
    [0xcc, 0x79, 0xa7],
    [0xe6, 0x9f, 0x00],
    [0x56, 0xb4, 0xe9],
];
/// The place in the palette of a target's colour: after those of the arms, and never the second one, a red that would be taken
/// for an overlap. The HTML report has the same rule.
#[must_use]
pub fn target_colour_index(arms: usize, target: usize) -> usize {
    arms.max(2) + target
}

const BASE: [u8; 3] = [0xb4, 0xbf, 0xca];
const TARGET: [u8; 3] = [0x6d, 0x6d, 0x6d];
/// Width of a link over the mean length of all links.
const SLENDERNESS: f64 = 0.08;

/// The visuals of base, links and targets, in the order of their frames.
#[must_use]
pub fn visuals(scenario: &Scenario) -> Vec<Visual> {
    visuals_of(&scenario.layout, &scenario.targets, scenario.frames())
}

/// Those of a robot alone.
#[must_use]
pub fn robot_visuals(layout: &Layout) -> Vec<Visual> {
    visuals_of(layout, &[], robot_frames(layout))
}

fn visuals_of(layout: &Layout, targets: &[Target], frames: Vec<Frame>) -> Vec<Visual> {
    let width = link_width(layout);
    let links: Vec<&Link> = layout.arms.iter().flat_map(|arm| &arm.links).collect();
    let each = frames.into_iter().filter_map(|frame| {
        let (shape, colour, thickness) = match frame.motion {
            FrameMotion::Base => (base_shape(layout), colour(BASE, 1.0), 2.0 * width),
            FrameMotion::Joint(joint) => {
                (link_shape(links[joint], width), colour(PALETTE[frame.arm? % PALETTE.len()], 1.0), width)
            }
            FrameMotion::Target(target) => {
                (Shape::Outline(targets[target].outline.clone()), colour(TARGET, 0.5), width)
            }
            // an end effector is a point
            FrameMotion::Fixed => return None,
        };
        Some(Visual { frame: frame.name, shape, colour, thickness })
    });
    each.collect()
}

fn colour(rgb: [u8; 3], opacity: f64) -> [f64; 4] {
    let [r, g, b] = rgb.map(|part| f64::from(part) / 255.0);
    [r, g, b, opacity]
}

fn link_width(layout: &Layout) -> f64 {
    let lengths = layout.arms.iter().flat_map(|arm| &arm.links).map(|link| link.length).filter(|length| *length > 0.0);
    let (sum, count) = lengths.fold((0.0, 0.0), |(sum, count), length| (sum + length, count + 1.0));
    SLENDERNESS * if count > 0.0 { sum / count } else { layout.base.radius_of_gyration() }
}

/// The outline of the base; by default a rectangle about its COM.
pub(crate) fn base_shape(layout: &Layout) -> Shape {
    match &layout.base.outline {
        Some(outline) => Shape::Outline(outline.clone()),
        None => Shape::Rectangle { centre: [0.0; 2], size: layout.default_base_size() },
    }
}

/// The outline of the link; by default a bar along it, and for a reaction wheel the uniform disc of its mass and
/// inertia.
fn link_shape(link: &Link, width: f64) -> Shape {
    if let Some(outline) = &link.outline {
        Shape::Outline(outline.clone())
    } else if link.length > 0.0 {
        Shape::Rectangle { centre: [link.length / 2.0, 0.0], size: [link.length, width] }
    } else {
        Shape::Outline(Outline::disc(wheel_radius(link)))
    }
}

/// Of the uniform disc that has a link's mass and inertia, m.
pub(crate) fn wheel_radius(link: &Link) -> f64 {
    (2.0 * link.inertia / link.mass).sqrt()
}

/// `#rrggbb`.
#[must_use]
pub fn hexadecimal([red, green, blue]: [u8; 3]) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

impl Shape {
    /// The closed outline, and a line from the frame's origin along its x axis to the outline, which shows the
    /// orientation.
    #[must_use]
    pub fn lines(&self) -> [Vec<[f64; 2]>; 2] {
        match self {
            Self::Rectangle { centre: [x, y], size: [length, width] } => {
                let corner = |a: f64, b: f64| [x + a * length / 2.0, y + b * width / 2.0];
                let outline = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0), (1.0, 1.0)];
                [outline.map(|(a, b)| corner(a, b)).to_vec(), vec![[0.0; 2], [x + length / 2.0, 0.0]]]
            }
            Self::Outline(outline) => {
                let mut corners = outline.corners();
                corners.extend(corners.first().copied());
                let reach = corners.iter().map(|[x, _]| *x).fold(0.0, f64::max);
                [corners, vec![[0.0; 2], [reach, 0.0]]]
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{PALETTE, Shape, robot_visuals, visuals};
    use crate::layout::Layout;
    use crate::outline::Outline;
    use crate::registry::SHIPPED;
    use crate::scenario::Scenario;

    /// A uniform disc of mass m and radius r has the inertia m r² / 2, by which a wheel is drawn, whatever its link is.
    /// All links of an arm have its colour, and arms have different ones.
    #[test]
    fn arms_have_their_colours() {
        let (name, text) = SHIPPED.iter().find(|(name, _)| *name == "triple_arm_3r").expect("shipped");
        let layout = Layout::parse(text, name).expect("a layout");
        let drawn = robot_visuals(&layout);
        for (i, arm) in layout.arms.iter().enumerate() {
            let own: Vec<_> = drawn.iter().filter(|visual| visual.frame.contains(&format!("/{}/", arm.name))).collect();
            assert_eq!(own.len(), arm.links.len());
            let [r, g, b] = PALETTE[i].map(|part| f64::from(part) / 255.0);
            let expected = [r, g, b, 1.0].map(f64::to_bits);
            assert!(own.iter().all(|visual| visual.colour.map(f64::to_bits) == expected), "{own:?}");
        }
    }

    #[test]
    fn a_wheel_is_drawn_as_the_disc_of_its_inertia() {
        let (mass, radius) = (4.0, 0.3);
        let layout = format!(
            "name = \"wheel\"\n[base]\nmass = 50.0\ninertia = 8.0\n[[arm]]\nname = \"arm\"\nmount = [0.5, 0.0]\n[[arm.link]]\n\
             length = 1.0\nmass = 5.0\ninertia = 0.4\n[[arm]]\nname = \"wheel\"\nmount = [0.0, 0.0]\n[[arm.link]]\nlength = 0.0\n\
             mass = {mass}\ninertia = {}\n",
            0.5 * mass * radius * radius
        );
        let text = "name = \"it\"\nlayout = \"wheel\"\n[initial]\njoint_angles = [0.0, 0.0]\n[approach]\nduration = 1.0\n\
                    trajectory = \"cycloidal\"\nfinal_joint_angles = [0.5, 0.0]\n";
        let shipped: Vec<_> = SHIPPED.iter().copied().chain([("wheel", &*layout)]).collect();
        let scenario =
            Scenario::parse(text, "it.toml", "".as_ref(), &shipped[..]).unwrap_or_else(|report| panic!("{report}"));
        let drawn = visuals(&scenario);
        let wheel = drawn.iter().find(|visual| visual.frame.contains("wheel")).expect("a wheel");
        let Shape::Outline(Outline::Disc { center, radius: found }) = wheel.shape else { panic!("{wheel:?}") };
        assert!((found - radius).abs() < 1e-15 && center.iter().all(|x| *x == 0.0), "{found} m about {center:?}");
        let link = drawn.iter().find(|visual| visual.frame.contains("arm/")).expect("a link");
        let Shape::Rectangle { centre: [0.5, 0.0], size: [1.0, width] } = link.shape else { panic!("{link:?}") };
        // 8 % of the mean length of links, of which the wheel is none; along it a line from joint to joint
        assert!((width - 0.08).abs() < 1e-15 && (link.thickness - width).abs() < 1e-15, "{link:?}");
        let [outline, axis] = link.shape.lines();
        let farthest = outline.iter().map(|[x, y]| x.abs().max(2.0 * y.abs())).fold(0.0, f64::max);
        assert_eq!((outline.len(), axis), (5, vec![[0.0; 2], [1.0, 0.0]]));
        assert!((farthest - 1.0).abs() < 1e-15, "{outline:?}");
    }
}
