//! A moving picture of a case: an SVG file with animations of its own (SMIL), which browsers play in any page, without a
//! program or a network.
//!
//! # Example
//! ```
//! use planar_capture::capture::{Silent, study};
//! use planar_capture::output::animation::{Excerpt, animation};
//! use planar_capture::registry;
//! use planar_capture::scenario::Scenario;
//!
//! let path = "scenarios/redysim_single_arm_3r.toml";
//! let scenario = Scenario::read(path.as_ref(), registry::SHIPPED).expect("a scenario");
//! let robot = registry::generated(&scenario.layout)?;
//! let study = study(&scenario, &|| robot.clone_box(), 1.0, &mut Silent)?;
//! let svg = animation(&scenario, &study, &study.cases[0], Excerpt { seconds: 10.0, until: 20.0 });
//! assert!(svg.starts_with("<svg"));
//! assert!(svg.contains("2 × real time")); // 20 s of motion in 10 s
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod bodies;
pub(super) mod clip;
mod labels;
pub(super) mod view;

use crate::capture::impact::ContactResult;
use crate::capture::{CaseResult, Study};
use crate::frames::poses;
use crate::output::impacts::{ImpactEvent, impacts};
use crate::output::markup;
use crate::output::scene::{target_colour_index, visuals};
use crate::output::time_series::{TimeSeriesRow, rows};
use crate::scenario::Scenario;
use bodies::{Hold, Motion};
pub(super) use bodies::{colour, path};
use clip::{Clip, short};
use labels::{Labels, Place};
use std::fmt::Write as _;
use view::{Arrow, View, WIDTH, round_number};

/// Instants per second of the picture.
pub const RATE: f64 = 12.5;
/// How long an impulse is seen, s of the picture.
const IMPULSE_SHOWN: f64 = 1.6;
/// Of the largest impulse, px.
const ARROW: f64 = 90.0;
/// Below the scene, px.
const RAIL: f64 = 64.0;
/// Of an arrow to what is outside, from the edge, px.
const EDGE: f64 = 10.0;
/// Free space at the ends of the axis of time, px.
const SIDE: f64 = 24.0;

/// Colours as those of the HTML report.
pub(super) const STYLE: &str = "\
:root { --ink: #1c2733; --soft: #5b6b7b; --stage: #fbfcfd; --grid: #e6ebf0; --body: #dfe6ed; --edge: #44525f; --impulse: #b3261e; }
@media (prefers-color-scheme: dark) { :root { --ink: #e4eaf0; --soft: #9fadba; --stage: #151b21; --grid: #28323b; --body: #33404c; --edge: #a9b7c4; --impulse: #ff8a80; } }
text { font: 15px system-ui, sans-serif; fill: var(--soft); }
.stage { fill: var(--stage); } .grid { stroke: var(--grid); fill: none; } .trace { fill: none; stroke-width: 1.5px; opacity: 0.35; }
.base { fill: var(--body); stroke: var(--edge); stroke-width: 1.5px; } .mark { fill: var(--edge); } .edge { stroke-width: 1.5px; }
.base, .edge, .body, .joint, .hold { vector-effect: non-scaling-stroke; } .base + .edge { stroke: var(--edge); }
.body { fill-opacity: 0.16; stroke-width: 1.5px; } .joint { fill: var(--stage); stroke-width: 1.5px; }
.hold { fill: none; stroke-width: 2.5px; } .impulse { stroke: var(--impulse); stroke-width: 3px; fill: none; }
.impulse + text, .head { fill: var(--impulse); } .time { stroke: var(--soft); stroke-width: 1px; } .now { fill: var(--ink); }
";

/// What of a case is shown, and how long that takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Excerpt {
    /// Time to play it, s.
    pub seconds: f64,
    /// Since the start of the approach, s: the motion after it is left out.
    pub until: f64,
}

/// The picture of a case; empty of what the case has not, as targets or an impact.
#[must_use]
pub fn animation(scenario: &Scenario, study: &Study, case: &CaseResult, excerpt: Excerpt) -> String {
    let Excerpt { seconds, until } = excerpt;
    let rows = instants(study, case, until);
    let times: Vec<_> = rows.iter().map(|row| row.time).collect();
    let clip = Clip::new(&times, seconds);
    let frames = scenario.frames();
    let of_row = |row: &TimeSeriesRow<'_>| {
        let targets: Vec<_> = row.targets.iter().map(|target| target.pose).collect();
        poses(&frames, &row.sample.state, &targets)
    };
    let mut events = impacts(study, case);
    events.retain(|event| event.time <= until);
    let arrows = arrows(&events);
    let ends: Vec<_> = arrows.iter().map(|arrow| arrow.ends).collect();
    let view = View::new(&frames, &visuals(scenario), &rows.iter().map(of_row).collect::<Vec<_>>(), &ends);
    let still = events.first().map_or(rows.len() - 1, |event| times.partition_point(|time| *time < event.time));
    let holds: Vec<_> = events.iter().flat_map(holds).collect();
    let motion =
        Motion { scenario, frames: &frames, rows: &rows, holds: &holds, clip: &clip, still, scale: view.scale };
    let height = view.height + RAIL;
    let title = markup::attribute(&format!(
        "{}, case {}: {} s, from the approach to the motion after the capture",
        scenario.name,
        case.name,
        times[times.len() - 1]
    ));
    let [left, top] = view.offset();
    let scale = short(view.scale, 4);
    let (left, top) = (short(left, 2), short(top, 2));
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height}\" role=\"img\" aria-label=\"{title}\">\n\
         <title>{title}</title>\n<style>\n{STYLE}</style>\n\
         <rect class=\"stage\" width=\"{WIDTH}\" height=\"{height}\"/>\n\
         {}{}<g transform=\"matrix({scale} 0 0 -{scale} {left} {top})\">{}</g>\n{}{}{}</svg>\n",
        view.grid(),
        traces(&view, &rows),
        motion.bodies(),
        pointers(&view, &clip, scenario, &rows, still),
        impulses(&view, &clip, &arrows),
        rail(&view, &clip, &events, times[times.len() - 1]),
    )
}

/// The rows of a case, those of the same time once; the first one at least.
fn instants<'a>(study: &'a Study, case: &'a CaseResult, until: f64) -> Vec<TimeSeriesRow<'a>> {
    let mut all: Vec<_> = rows(study, case).take_while(|row| row.time <= until.max(0.0)).collect();
    all.dedup_by(|later, earlier| later.time <= earlier.time);
    all
}

/// The contacts of an impact that hold from then on.
fn holds(event: &ImpactEvent<'_>) -> Vec<Hold> {
    let contacts = event.solution.contacts.iter().map(|result| result.contact);
    contacts
        .filter(|contact| contact.law.kind().holds())
        .map(|contact| Hold { arm: contact.arm, since: event.time })
        .collect()
}

/// Arrows at the edge towards the targets that are outside of the picture, while they are.
fn pointers(view: &View, clip: &Clip, scenario: &Scenario, rows: &[TimeSeriesRow<'_>], still: usize) -> String {
    let mut drawn = String::new();
    for target in 0..scenario.targets.len() {
        let places: Vec<_> = rows
            .iter()
            .map(|row| {
                let [_, x, y] = row.targets[target].pose;
                view.pixel([x, y])
            })
            .collect();
        let head: Vec<_> =
            places.iter().map(|[x, y]| [x.clamp(EDGE, WIDTH - EDGE), y.clamp(EDGE, view.height - EDGE)]).collect();
        let is_outside: Vec<_> =
            places.iter().map(|[x, y]| !(0.0..=WIDTH).contains(x) || !(0.0..=view.height).contains(y)).collect();
        let turned = |([x, y], [from_x, from_y]): (&[f64; 2], &[f64; 2])| {
            short(libm::atan2(y - from_y, x - from_x).to_degrees(), 1)
        };
        let angles: Vec<_> = places.iter().zip(&head).map(turned).collect();
        let translations: Vec<_> = head.iter().map(|at| at.map(|pixel| short(pixel, 1)).join(" ")).collect();
        let arrow = format!(
            "<path class=\"edge\" d=\"M0 0l-14 -6v12Z\" fill=\"{0}\" stroke=\"{0}\"/>",
            colour(target_colour_index(scenario.layout.arms.len(), target))
        );
        let arrow = clip.moving("translate", &translations, still, &clip.moving("rotate", &angles, still, &arrow));
        let mut first = 0;
        while let Some(begin) = (first..rows.len()).find(|i| is_outside[*i]) {
            let end = (begin..rows.len()).find(|i| !is_outside[*i]);
            first = end.unwrap_or(rows.len());
            let group = clip.seen(rows[begin].time, end.map(|end| rows[end].time), &arrow);
            // without animation it is seen where the target is outside then
            let group =
                if (begin..first).contains(&still) { group } else { group.replacen("<g>", "<g opacity=\"0\">", 1) };
            drawn += &group;
            drawn.push('\n');
        }
    }
    drawn
}

/// The paths of the end effectors.
fn traces(view: &View, rows: &[TimeSeriesRow<'_>]) -> String {
    let arms = rows.first().map_or(0, |row| row.sample.end_effector_poses.len());
    let path = |arm: usize| {
        let points = rows.iter().map(|row| {
            let [_, x, y] = row.sample.end_effector_poses[arm];
            view.pixel([x, y]).map(|pixel| short(pixel, 1)).join(" ")
        });
        let points = points.collect::<Vec<_>>().join("L");
        format!("<path class=\"trace\" stroke=\"{}\" d=\"M{points}\"/>\n", colour(arm))
    };
    (0..arms).map(path).collect()
}

/// The impulse on the robot at a contact.
struct Impulse {
    /// Of the impact, s.
    time: f64,
    /// N s.
    size: f64,
    ends: Arrow,
}

/// Of all impacts, in their order, of one scale.
fn arrows(events: &[ImpactEvent<'_>]) -> Vec<Impulse> {
    let contacts = events.iter().flat_map(|event| event.solution.contacts.iter().map(move |contact| (event, contact)));
    let sized = contacts.map(|(event, contact)| (event, contact, libm::hypot(contact.impulse[1], contact.impulse[2])));
    let most = sized.clone().fold(0.0, |most: f64, (.., size)| most.max(size));
    let arrow = |(event, contact, size): (&ImpactEvent<'_>, &ContactResult, f64)| {
        let [_, x, y] = event.before.end_effector_poses[contact.contact.arm];
        let [_, fx, fy] = contact.impulse;
        let way = [fx, fy].map(|part| part / size * (ARROW * size / most).max(16.0));
        Impulse { time: event.time, size, ends: Arrow { from: [x, y], way } }
    };
    sized.filter(|(.., size)| *size > 1e-9).map(arrow).collect()
}

/// At each impact the impulses on the robot, as arrows with their magnitudes.
fn impulses(view: &View, clip: &Clip, arrows: &[Impulse]) -> String {
    let (mut drawn, mut labels) = (String::new(), Labels::new(view.height));
    let seen = |time: f64| [time, time + IMPULSE_SHOWN * clip.speed()];
    let pixels = |Arrow { from, way }: Arrow| {
        let [x, y] = view.pixel(from);
        [[x, y], [x + way[0], y - way[1]]]
    };
    // before the first label
    for Impulse { time, ends, .. } in arrows {
        labels.arrow(pixels(*ends), seen(*time));
    }
    for together in arrows.chunk_by(|a, b| a.time.total_cmp(&b.time).is_eq()) {
        let (seen, mut group) = (seen(together[0].time), String::new());
        for Impulse { size, ends, .. } in together {
            let [[x, y], [tip_x, tip_y]] = pixels(*ends);
            let length = libm::hypot(tip_x - x, tip_y - y);
            let way = [(tip_x - x) / length, (tip_y - y) / length];
            let corner = |side: f64| {
                let [a, b] = [tip_x - 12.0 * way[0] - side * way[1], tip_y - 12.0 * way[1] + side * way[0]];
                format!("{} {}", short(a, 1), short(b, 1))
            };
            let [x, y, ends_x, ends_y] =
                [x, y, tip_x - 8.0 * way[0], tip_y - 8.0 * way[1]].map(|value| short(value, 1));
            let text = format!("{} N s", significant(*size));
            let Place { at: [label_x, label_y], anchor } = labels.place([tip_x, tip_y], way, &text, seen);
            let _ = write!(
                group,
                "<path class=\"head\" d=\"M{} {}L{}L{}Z\"/><path class=\"impulse\" d=\"M{x} {y}L{ends_x} {ends_y}\"/>\
                 <text x=\"{}\" y=\"{}\" text-anchor=\"{anchor}\">{text}</text>",
                short(tip_x, 1),
                short(tip_y, 1),
                corner(5.0),
                corner(-5.0),
                short(label_x, 1),
                short(label_y, 1),
            );
        }
        drawn += &clip.seen(seen[0], Some(seen[1]), &group);
        drawn.push('\n');
    }
    drawn
}

/// Three digits.
pub(super) fn significant(value: f64) -> String {
    let before = libm::log10(value.abs()).floor();
    let digits = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0].iter().position(|count| count + before >= 2.0).unwrap_or(9);
    format!("{value:.digits$}")
}

/// The axis of time, with the impacts and where the picture is.
fn rail(view: &View, clip: &Clip, events: &[ImpactEvent<'_>], end: f64) -> String {
    let (top, length) = (view.height + 16.0, WIDTH - 2.0 * SIDE);
    let at = |time: f64| short(SIDE + length * if end > 0.0 { time / end } else { 0.0 }, 1);
    let mut drawn = format!("<path class=\"time\" d=\"M{SIDE} {top}h{length}\"/>\n");
    let spacing = round_number(end / 8.0);
    let mut time = 0.0;
    while spacing > 0.0 && time <= end * (1.0 + 1e-9) {
        let anchor = match time {
            0.0 => "start",
            time if time > 0.98 * end => "end",
            _ => "middle",
        };
        let _ = write!(
            drawn,
            "<path class=\"time\" d=\"M{0} {top}v5\"/><text x=\"{0}\" y=\"{1}\" text-anchor=\"{anchor}\">{2} s</text>",
            at(time),
            top + 21.0,
            short(time, 3)
        );
        time += spacing;
    }
    for event in events {
        let _ = write!(drawn, "<path class=\"impulse\" d=\"M{} {}v16\"/>", at(event.time), top - 8.0);
    }
    if let Some(event) = events.first() {
        let _ =
            write!(drawn, "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">impact</text>", at(event.time), top + 39.0);
    }
    let speed = format!("{} × real time", significant(clip.speed()).trim_end_matches('0').trim_end_matches('.'));
    let _ = write!(drawn, "<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{speed}</text>", WIDTH - SIDE, top + 39.0);
    let moving = clip.even("cx", &short(length, 1));
    let _ = write!(
        drawn,
        "\n<g transform=\"translate({SIDE} 0)\"><circle class=\"now\" cx=\"0\" cy=\"{top}\" r=\"6\">{moving}</circle></g>\n"
    );
    drawn
}
