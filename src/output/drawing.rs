//! A drawing of a robot in one pose, as SVG: outlines, joints, mounts, centres of mass and names.
//!
//! # Example
//! ```
//! use planar_capture::layout::Layout;
//! use planar_capture::output::drawing::drawing;
//!
//! let layout = Layout::read("codegen/layouts/dual_arm_3r.toml".as_ref())?;
//! let svg = drawing(&layout, &[0.7, -1.6, 1.0, 2.4, 1.6, -1.0]);
//! assert!(svg.starts_with("<svg") && svg.contains(">arm2<"));
//! assert_eq!(svg.matches("class=\"com\"").count(), 1 + 6 + 1); // of the base, of six links, and in the legend
//! # Ok::<(), planar_capture::diagnostic::Report>(())
//! ```

use super::animation::clip::short;
use super::animation::view::{View, WIDTH};
use super::animation::{STYLE, colour, path};
use super::markup;
use super::scene::robot_visuals;
use crate::frames::{Frame, FrameMotion, point, poses, robot_frames};
use crate::layout::Layout;
use crate::owned::RobotState;
use std::fmt::Write as _;

/// Below the scene, px.
const FOOT: f64 = 58.0;
/// Half the side of a symbol, px.
const SYMBOL: f64 = 5.0;
/// Names begin or end nearer to the sides of the picture than this, px.
const SIDE: f64 = 90.0;

/// Beside those of moving pictures.
const OWN_STYLE: &str = "\
.body { fill-opacity: 0.16; } .axis { stroke-width: 2px; fill: none; } .com { stroke: var(--ink); stroke-width: 1.5px; fill: none; }
.mount { stroke-width: 1.5px; fill: none; } .name { fill: var(--ink); paint-order: stroke; stroke: var(--stage); stroke-width: 4px; }
";

/// The robot with its base's centre of mass at the origin and these joint angles, rad, arm by arm.
#[must_use]
pub fn drawing(layout: &Layout, joint_angles: &[f64]) -> String {
    let frames = robot_frames(layout);
    let (joint_angles, joint_rates) = (joint_angles.to_vec(), vec![0.0; joint_angles.len()]);
    let state = RobotState { base_pose: [0.0; 3], joint_angles, base_twist: [0.0; 3], joint_rates };
    let poses = poses(&frames, &state, &[]);
    let visuals = robot_visuals(layout);
    let view = View::new(&frames, &visuals, std::slice::from_ref(&poses), &[]);
    let at = |pose: [f64; 3], inner: [f64; 2]| view.pixel(point(pose, inner));
    let (mut bodies, mut marks, mut names) = (String::new(), String::new(), String::new());
    for (frame, pose) in frames.iter().zip(&poses) {
        let colour = frame.arm.map(colour);
        let stroke = colour.as_deref().unwrap_or("var(--edge)");
        if let Some(visual) = visuals.iter().find(|visual| visual.frame == frame.name) {
            let outline: Vec<_> = visual.shape.lines()[0].iter().map(|corner| at(*pose, *corner)).collect();
            let _ = writeln!(
                bodies,
                "<path class=\"body\" fill=\"{stroke}\" stroke=\"{stroke}\" d=\"{}\"/>",
                path(&outline)
            );
        }
        let place = at(*pose, [0.0; 2]);
        match frame.motion {
            FrameMotion::Joint(_) => {
                let (link, number) = link_of(layout, &frames, frame);
                let end = at(*pose, [link.length, 0.0]);
                let [from, to] = [place, end].map(|at| at.map(|pixel| short(pixel, 1)).join(" "));
                let _ = writeln!(marks, "<path class=\"axis\" stroke=\"{stroke}\" d=\"M{from}L{to}\"/>");
                if number == 1 {
                    let _ = writeln!(marks, "<path class=\"mount\" stroke=\"{stroke}\" d=\"{}\"/>", square(place));
                }
                let _ = writeln!(marks, "{}", joint(place, stroke));
                marks += &com(at(*pose, link.com));
                names += &name(place, &number.to_string());
            }
            FrameMotion::Base => {
                marks += &com(place);
                names += &name(place, "base");
            }
            // the end of an arm
            _ => {
                let [x, y] = place.map(|pixel| short(pixel, 1));
                let _ = writeln!(marks, "<circle cx=\"{x}\" cy=\"{y}\" r=\"{SYMBOL}\" fill=\"{stroke}\"/>");
                let arm = frame.arm.map_or("", |arm| layout.arms[arm].name.as_str());
                // that of a wheel is where its joint is
                let below = if frame.pose[1] == 0.0 { 34.0 } else { 0.0 };
                names += &name([place[0], place[1] + below], arm);
            }
        }
    }
    let height = view.height + FOOT;
    let title = markup::attribute(&layout.name);
    let angles: Vec<_> = state.joint_angles.iter().map(|angle| short(*angle, 3)).collect();
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height}\" role=\"img\" aria-label=\"{title}\">\n\
         <title>{title}</title>\n<style>\n{STYLE}{OWN_STYLE}</style>\n\
         <rect class=\"stage\" width=\"{WIDTH}\" height=\"{height}\"/>\n{}{bodies}{marks}{names}{}\
         <text x=\"24\" y=\"{}\">{title}, joint angles {} rad</text>\n</svg>\n",
        view.grid(),
        legend(view.height + 18.0),
        view.height + 44.0,
        angles.join(", ").replace('-', "−"),
    )
}

/// The link that a joint moves, and its number in the arm, from 1.
fn link_of<'a>(layout: &'a Layout, frames: &[Frame], frame: &Frame) -> (&'a crate::layout::Link, usize) {
    let of_arm = frames.iter().filter(|other| other.arm == frame.arm);
    let place = of_arm.take_while(|other| other.name != frame.name).count();
    let arm = frame.arm.unwrap_or_default();
    (&layout.arms[arm].links[place], place + 1)
}

fn joint([x, y]: [f64; 2], colour: &str) -> String {
    format!("<circle class=\"joint\" cx=\"{}\" cy=\"{}\" r=\"4\" stroke=\"{colour}\"/>", short(x, 1), short(y, 1))
}

fn square([x, y]: [f64; 2]) -> String {
    let half = SYMBOL + 3.0;
    path(&[[x - half, y - half], [x + half, y - half], [x + half, y + half], [x - half, y + half]])
}

/// The symbol of a centre of mass: a cross in a circle.
fn com([x, y]: [f64; 2]) -> String {
    let (left, up) = (short(x - SYMBOL, 1), short(y - SYMBOL, 1));
    let (size, radius) = (2.0 * SYMBOL, SYMBOL);
    format!(
        "<path class=\"com\" d=\"M{left} {}h{size}M{} {up}v{size}M{left} {}a{radius} {radius} 0 1 0 {size} 0a{radius} {radius} 0 1 0 \
         -{size} 0\"/>\n",
        short(y, 1),
        short(x, 1),
        short(y, 1)
    )
}

/// A name above a point.
fn name([x, y]: [f64; 2], text: &str) -> String {
    let anchor = if x < SIDE {
        "start"
    } else if x > WIDTH - SIDE {
        "end"
    } else {
        "middle"
    };
    let (x, y) = (short(x, 1), short((y - 12.0).max(14.0), 1));
    format!("<text class=\"name\" x=\"{x}\" y=\"{y}\" text-anchor=\"{anchor}\">{}</text>\n", markup::text(text))
}

/// What the symbols are.
fn legend(y: f64) -> String {
    let edge = "var(--edge)";
    let entries = [
        (com([34.0, y]), "centre of mass"),
        (joint([204.0, y], edge), "joint, with its number"),
        (format!("<path class=\"mount\" stroke=\"{edge}\" d=\"{}\"/>", square([424.0, y])), "mount of an arm"),
        (format!("<circle cx=\"594\" cy=\"{y}\" r=\"{SYMBOL}\" fill=\"{edge}\"/>"), "end effector"),
    ];
    let places = [34.0, 204.0, 424.0, 594.0];
    let mut drawn = String::new();
    for ((symbol, text), x) in entries.iter().zip(places) {
        let _ = writeln!(drawn, "{}\n<text x=\"{}\" y=\"{}\">{text}</text>", symbol.trim_end(), x + 16.0, y + 5.0);
    }
    drawn
}

#[cfg(test)]
mod tests {
    use super::drawing;
    use crate::layout::Layout;

    fn shown(text: &str, angles: &[f64]) -> String {
        drawing(&Layout::parse(text, "it.toml").expect("a layout"), angles)
    }

    const ROBOT: &str = "name = \"it\"\nbase = { mass = 60.0, inertia = 10.0, outline = { box = [1.0, 1.0] } }\n[[arm]]\n\
                         name = \"left\"\nmount = [0.5, 0.0]\nlink = [{ length = 1.0, mass = 4.0, inertia = 0.3, com = [0.25, 0.0] }, \
                         { length = 1.0, mass = 4.0, inertia = 0.3 }]\n[[arm]]\nname = \"wheel\"\nmount = [0.0, 0.0]\nlink = [{ \
                         length = 0.0, mass = 4.0, inertia = 0.1, com = [0.0, 0.0] }]\n";

    /// The end of the arm is where the angles put it: seen by the lengths in pixels, which are one scale.
    #[test]
    fn a_drawing_has_the_pose_of_its_angles() {
        let axis = |svg: &str, link: usize| -> [f64; 4] {
            let line = svg.lines().filter(|line| line.contains("class=\"axis\"")).nth(link).expect("a link");
            let path = line.split(" d=\"M").nth(1).and_then(|rest| rest.split('"').next()).expect("its path");
            let numbers: Vec<f64> = path.split(['L', ' ']).map(|number| number.parse().expect("a number")).collect();
            numbers.try_into().expect("two points")
        };
        let svg = shown(ROBOT, &[0.0, std::f64::consts::FRAC_PI_2, 0.0]);
        let ([x, y, elbow, same], [from, _, to, tip]) = (axis(&svg, 0), axis(&svg, 1));
        let scale = elbow - x;
        assert!(scale > 50.0 && (same - y).abs() < 0.2, "the first link is along x");
        assert!(
            (to - from).abs() < 0.2 && (y - tip - scale).abs() < 0.3,
            "the second one is upwards: y grows downwards"
        );
    }

    /// The first link's centre of mass is a quarter of its length from the joint, or beside the link.
    #[test]
    fn centres_of_mass_are_where_they_are() {
        let circle = |svg: &str, class: &str, at: usize| -> [f64; 2] {
            let line = svg.lines().filter(|line| line.contains(&format!("class=\"{class}\""))).nth(at).expect("one");
            let number = |name: &str| {
                let (_, rest) = line.split_once(&format!("{name}=\"")).expect("a place");
                rest.split('"').next().and_then(|text| text.parse().ok()).expect("a number")
            };
            [number("cx"), number("cy")]
        };
        // its first stroke is level, through its middle
        let mark = |svg: &str, at: usize| -> [f64; 2] {
            let line = svg.lines().filter(|line| line.contains("class=\"com\"")).nth(at).expect("one");
            let (_, path) = line.split_once(" d=\"M").expect("a path");
            let (left, rest) = path.split_once(' ').expect("a place");
            let (y, rest) = rest.split_once('h').expect("a stroke");
            let (length, _) = rest.split_once('M').expect("its end");
            let [left, y, length] = [left, y, length].map(|text| text.parse::<f64>().expect("a number"));
            [left + 0.5 * length, y]
        };
        for com in [[0.25, 0.0], [0.4, -0.3]] {
            let svg = shown(&ROBOT.replace("com = [0.25, 0.0]", &format!("com = {com:?}")), &[0.0, 0.0, 0.0]);
            // base, then the links
            let ([x, y], [elbow, _], [at_x, at_y]) =
                (circle(&svg, "joint", 0), circle(&svg, "joint", 1), mark(&svg, 1));
            let scale = elbow - x;
            // a tenth of a pixel is written
            assert!(
                (at_x - x - scale * com[0]).abs() < 0.3 && (y - at_y - scale * com[1]).abs() < 0.3,
                "{com:?}: {svg}"
            );
        }
    }

    #[test]
    fn everything_has_its_symbol_and_its_name() {
        let svg = shown(ROBOT, &[0.0, -0.5, 0.0]);
        let count = |what: &str| svg.matches(what).count();
        // one of each is in the legend
        assert_eq!([count("class=\"com\""), count("class=\"joint\""), count("class=\"mount\"")], [5, 4, 3]);
        for name in ["base", "left", "wheel", "1", "2"] {
            assert!(svg.contains(&format!(">{name}</text>")), "{name}");
        }
        assert!(svg.contains("it, joint angles 0, −0.5, 0 rad"), "{svg}");
    }
}
