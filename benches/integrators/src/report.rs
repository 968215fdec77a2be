//! The report: what to take, two tables, and how they were made.

use crate::Problem;
use crate::long_time::LongTime;
use crate::work::{Effort, Line, Work};
use planar_capture::generated::dual_arm_3r::MANIFEST;
use std::fmt::Write;

/// Errors that work is compared at.
const ERRORS: [f64; 4] = [1e-3, 1e-6, 1e-9, 1e-12];

const HEAD: &str = "# Integrators

<!-- Written by `cargo run --release --manifest-path benches/integrators/Cargo.toml`; `-- --check` compares. -->

`integrator` and `coordinates` in `[approach]` and `[post_impact]` say how a phase is integrated. This page compares all of
them on the paper's robot, by evaluations of the derivative and not by time, which depends on the machine.

## Which to take

| for | `integrator` | why |
|---|---|---|
| most studies | `\"rk4\"`, the default, at the default step of 5 ms | explicit, the same work in every step; its error is far \
below the audit's bounds in motions as fast as the paper's |
| accuracy, long runs, references | `\"adaptive\"` | the fewest evaluations for errors below some 1e-8; energy and momentum \
to some ten times its tolerance over 1,000 s |
| momentum to rounding in full coordinates, at long fixed steps, with bodies beside the robot too | `\"gauss_legendre\"` | \
symplectic: in regular motion the energy error does not grow either, over any time; dear per step, for it is implicit |
| a quick look | `\"semi_implicit_euler\"` | one evaluation per step, and first order: the audit will object |

`coordinates = \"reduced\"` integrates joints and base pose alone and takes the base twist from the momentum, eq. (17). Momentum
is then kept to rounding by any integrator, at twice the operations; the error of the motion and of its energy is as in full
coordinates, so that the audit of the momentum no longer tells of it. Take it to compare with, or where the momentum must not
stray. It is for a robot alone, and not for `gauss_legendre`, which has no use for it.

## What they are

| `integrator` | order | evaluations per step | what |
|---|---|---|---|
| `rk4` | 4 | 4 | classical Runge–Kutta |
| `semi_implicit_euler` | 1 | 1 | rates first, positions by the new rates |
| `gauss_legendre` | 6 | 3 per round of iteration: 8 to 12 rounds, more under a stiff law | Gauss–Legendre collocation of three stages, on canonical \
variables |
| `adaptive` | 9 | 26 per accepted step, 15 per rejected one | Verner's pair 9(8) with an interpolant of order 9, by the \
crate `differential-equations`; `tolerance` is of each step, relative and per unit |

Gauss methods keep every invariant that is at most quadratic in what they integrate. In positions and rates the momenta are
not, for the mass matrix depends on the positions. In positions q and canonical momenta p = M v they are: linear momentum is
[p_x, p_y], angular momentum p_yaw + x p_y − y p_x, and joint torques leave both alone. There the method is symplectic too:
steps that resolve the motion have no drift of the energy. ∂T/∂q needs no derivative of M: for a joint k it is
−v_k × P_k, its velocity and the linear momentum of what is beyond it (`motion::Canonical`).

The adaptive integrator has steps of its own; `step` is then how often the law is asked where it is sampled, and how often the
motion is audited and looked at for events, by dense output. Where torques are held it starts anew with every sample. Events are
located by steps of the integrator itself, to 1e-13 of the time.

";

/// Markdown.
pub fn write(works: &[Work], motions: &[LongTime]) -> Result<String, Problem> {
    let mut text = HEAD.to_owned();
    costs(&mut text)?;
    text.push_str(
        "\n## Work and precision\n\nError: the largest of any position or rate at the end, against the adaptive integrator \
         at 1e-14.\n\n![Error over evaluations](integrators/work_precision.svg)\n",
    );
    for work in works {
        precision(&mut text, work)?;
    }
    text.push_str(
        "\nUnder control, errors die out; what tumbles freely is chaotic, and all errors, rounding too, grow there. A stiff \
         law limits\nthe steps of every method here, that of `gauss_legendre` most, whose iteration does not settle beyond: \
         the run then stops and\nsays so. \"<\": the coarsest run was better; \"–\": none was so good.\n\n## A thousand seconds\n\nThe same robot moves freely: it turns by 0.5 rad/s with both arms out, which swing about that, a \
         regular motion; or it\ntumbles, its joints turning by up to 0.9 rad/s at first, which is chaotic. Errors are relative: \
         the kinetic energy's to\nitself, the momenta's to the sum of the bodies' at the start. The curves are the largest errors \
         of every 8 s.\n\n![Energy and momentum errors over time](integrators/long_time.svg)\n",
    );
    for motion in motions {
        long(&mut text, motion)?;
    }
    text.push_str(
        "\nIn the regular motion the energy error of `rk4` grows with the time, that of `gauss_legendre` stays what it is in the \
         first\nseconds: it pays over times much longer than this, for in 1,000 s the adaptive integrator gets as far with half \
         the work.\nWhen the robot tumbles no method follows the true path for long, and the energy error of\n\
         `gauss_legendre` moves by jumps, in swings that are too fast for the step; halving the step makes it some hundred times\n\
         smaller. The audit of every run bounds momentum drift at 1e-9 and energy error at 1e-6.\n",
    );
    Ok(text)
}

fn costs(text: &mut String) -> Result<(), Problem> {
    let flops = |names: &[&str]| -> usize {
        let counted = MANIFEST.operations.iter().filter(|operations| names.contains(&operations.function));
        counted.map(planar_capture::manifest::Operations::flops).sum()
    };
    let full = flops(&["forward_dynamics"]);
    let reduced = flops(&["mass_matrix", "reduced_dynamics"]);
    let canonical = flops(&["forward_dynamics", "forward_dynamics_with_base_wrench", "body_poses", "body_twists"]);
    writeln!(
        text,
        "One evaluation of the paper's robot takes {full} flops of generated code in full coordinates, {reduced} in reduced \
         ones and the\nsolution of 6 equations beside, {canonical} in canonical variables and a sweep over the bodies beside.",
    )?;
    Ok(())
}

fn precision(text: &mut String, work: &Work) -> Result<(), Problem> {
    write!(text, "\n**{}.** Evaluations for an error of", work.title)?;
    writeln!(
        text,
        " …; the reference is known to {}, by the two coordinates.\n\n| `integrator` | `coordinates` | {} | best error | \
         at |\n|---|---|{}---|---|",
        power(work.reference_error),
        ERRORS.map(power).join(" | "),
        "---|".repeat(ERRORS.len()),
    )?;
    for line in &work.lines {
        let work = ERRORS.map(|error| match line.evaluations_for(error) {
            Effort::About(evaluations) => rounded(evaluations),
            Effort::AtMost(evaluations) => format!("< {}", rounded(evaluations)),
            Effort::More => "–".to_owned(),
        });
        let (best, at) = best(line);
        let (name, coordinates) = (line.method.name(), line.method.coordinates());
        writeln!(text, "| {name} | {coordinates} | {} | {best} | {at} |", work.join(" | "))?;
    }
    Ok(())
}

/// The smallest error, and its step or tolerance.
fn best(line: &Line) -> (String, String) {
    let computed = line.points.iter().filter_map(|(fineness, point)| point.map(|point| (*fineness, point)));
    let best = computed.min_by(|(_, a), (_, b)| a.error.total_cmp(&b.error));
    best.map_or_else(Default::default, |(fineness, point)| (power(point.error), fineness.to_string()))
}

fn long(text: &mut String, motion: &LongTime) -> Result<(), Problem> {
    writeln!(text, "\n**{}.**\n", motion.title)?;
    text.push_str(
        "| `integrator` | `coordinates` | step | evaluations | energy error in 10 s | 100 s | 1,000 s | momentum error in 10 s \
         | 100 s | 1,000 s |\n|---|---|---|---|---|---|---|---|---|---|\n",
    );
    for run in &motion.runs {
        let times = [10.0, 100.0, 1000.0];
        let energy = times.map(|time| power(run.energy_until(time)));
        let momentum = times.map(|time| power(run.momentum_until(time)));
        #[allow(clippy::cast_precision_loss, reason = "far below 2^52")]
        let evaluations = rounded(run.evaluations as f64);
        writeln!(
            text,
            "| {} | {} | {} | {evaluations} | {} | {} |",
            run.method.name(),
            run.method.coordinates(),
            run.fineness,
            energy.join(" | "),
            momentum.join(" | "),
        )?;
    }
    Ok(())
}

/// With one digit, as 3e-7.
fn power(value: f64) -> String {
    format!("{value:.0e}")
}

/// With two digits, and commas.
fn rounded(value: f64) -> String {
    let unit = 10_f64.powf(value.log10().floor() - 1.0).max(1.0);
    let digits = format!("{:.0}", (value / unit).round() * unit);
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}
