//! The text of the report.

use crate::Problem;
use crate::long_time::LongTime;
use crate::work::{Cost, Line, Work};
use planar_capture::generated::dual_arm_3r::MANIFEST;
use std::fmt::Write;

/// Errors at which work is compared.
const ERRORS: [f64; 4] = [1e-3, 1e-6, 1e-9, 1e-12];

const HEAD: &str = "# Integrators

<!-- Written by `PLANAR_CAPTURE_WRITE=1 cargo test --features figures --test integrators`; without the variable it compares. -->

`integrator` and `coordinates` in `[approach]` and `[post_impact]` select the integration of a phase. This page compares them
on the paper's robot by evaluations of the derivative; time would depend on the machine. They include those of the second
solution, from which every phase estimates the error of its path: half as many again with fixed steps, a quarter with those of `rk4`
without feedback.

## Recommendations

| for | `integrator` | reason |
|---|---|---|
| most studies, accuracy, long runs, references | `\"adaptive\"`, the default for smooth motion | the fewest evaluations for \
errors below about 1e-8; energy and momentum errors of about ten times its tolerance over 1,000 s; `step` is the spacing of \
the audit and of rows |
| torques that are limited or held, known work per step | `\"rk4\"`, the default there, at the default step of 5 ms | explicit; \
its error is far below the audit's bounds for motions as fast as the paper's |
| momentum to rounding in full coordinates at long fixed steps, also with free bodies | `\"gauss_legendre\"` | \
symplectic: in regular motion the energy error does not grow; expensive per step, because it is implicit |
| quick estimates | `\"semi_implicit_euler\"` | one evaluation per step, first order: the audit will object |

`coordinates = \"reduced\"` integrates joints and base pose and computes the base twist from the momentum, eq. (17). Any integrator
then conserves momentum to rounding, at twice the operations. The errors of motion and energy are as in full coordinates, but
the audit of the momentum no longer shows them. Use it for comparison, or where the momentum must be exact. It is for a robot
alone, and not for `gauss_legendre`, which conserves momentum already.

## Integrators

| `integrator` | order | evaluations per step | method |
|---|---|---|---|
| `rk4` | 4 | 4 | classical Runge–Kutta |
| `semi_implicit_euler` | 1 | 1 | rates first, then positions with the new rates |
| `gauss_legendre` | 6 | 3 per iteration: 8 to 12 iterations, more under a stiff law | Gauss–Legendre collocation with three stages in canonical \
variables |
| `adaptive` | 9 | 16 per accepted step, 15 per rejected one, 9 more where x is asked for within a step: \
steps end where rows are, unless these are much nearer | Verner's pair 9(8) with an interpolant of order 9; each step begins on a polynomial through the last one; `tolerance` per step, relative \
and per unit |
| `adaptive` under a control law | 8 | 12 per accepted step, 11 per rejected one | Dormand and Prince's formula for steps that end at a row, half \
as long as the allowed ones or more, its error estimated by a divided difference of the rates; between nearer rows as above |

Gauss methods conserve invariants that are at most quadratic in the integrated variables. In positions and rates the momenta
are not quadratic, because the mass matrix depends on the positions. In positions q and canonical momenta p = M v they are:
linear momentum is [p_x, p_y], angular momentum p_yaw + x p_y − y p_x, and joint torques change neither. In these variables the
method is also symplectic: with steps that resolve the motion the energy does not drift. ∂T/∂q needs no derivative of M: for
joint k it is −v_k × P_k, with the velocity of the joint and the linear momentum of the bodies outboard of it.

Under fast feedback it is stability that limits the steps of an explicit integrator, and not the accuracy of the motion. On the
negative real axis Verner's pair is stable up to 4.4 times the shortest time constant with 16 evaluations, Dormand and Prince's
formula up to 6.4 times with 12: for each evaluation 1.9 times as far. Its interpolant has order 7 only, so that rows within long
steps are not taken from it.

The adaptive integrator chooses its steps; `step` is then the interval of sampling a discrete law, of the audit and of the
search for events, by dense output. With held torques it restarts at every sample. Events are located by steps of the
integrator itself, to 1e-13 of the time.

";

/// Markdown.
pub fn write(works: &[Work], motions: &[LongTime]) -> Result<String, Problem> {
    let mut text = HEAD.to_owned();
    costs(&mut text)?;
    text.push_str(
        "\n## Work and precision\n\nError: the largest of any position or rate at the end, relative to the adaptive integrator \
         at 1e-14.\n\n![Error over evaluations](integrators/work_precision.svg)\n",
    );
    for work in works {
        precision(&mut text, work)?;
    }
    text.push_str(
        "\nUnder control, errors decay; free tumbling is chaotic, and all errors grow, rounding errors too. A stiff law \
         limits the\nsteps of every method, most of all those of `gauss_legendre`, whose iteration diverges for longer steps: \
         the run then ends with an\nerror. \"<\": the coarsest run was better; \"–\": no run was as good.\n\n## A thousand seconds\n\nFree motion of the same robot: it turns at 0.5 rad/s with extended, oscillating arms, a \
         regular motion; or it\ntumbles with initial joint rates of up to 0.9 rad/s, a chaotic motion. Errors are relative: \
         of the kinetic energy to\nits initial value, of the momenta to the sums of the bodies' at the start. The curves show the \
         largest errors of every 8 s.\n\n![Energy and momentum errors over time](integrators/long_time.svg)\n",
    );
    for motion in motions {
        long(&mut text, motion)?;
    }
    text.push_str(
        "\nIn the regular motion the energy error of `rk4` grows with time, while that of `gauss_legendre` stays at its value of the \
         first\nseconds. It pays only over much longer times: within 1,000 s the adaptive integrator is as accurate with half \
         the work.\nIn the tumbling motion no method follows the true path for long. The energy error of `gauss_legendre` then changes in \
         jumps,\nduring oscillations too fast for the step; half the step makes it about a hundred times smaller. The audit of every run bounds momentum drift at 1e-9 and energy error at 1e-6.\n",
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
        "One evaluation of the paper's robot takes {full} flops of generated code in full coordinates, {reduced} and the \
         solution of 6\nequations in reduced ones, {canonical} and a sweep over the bodies in canonical variables.",
    )?;
    Ok(())
}

fn precision(text: &mut String, work: &Work) -> Result<(), Problem> {
    write!(text, "\n**{}.** Evaluations for an error of", work.title)?;
    writeln!(
        text,
        " …; the reference solutions in the two coordinates differ by {}.\n\n| `integrator` | `coordinates` | {} | best error | \
         at |\n|---|---|{}---|---|",
        power(work.reference_error),
        ERRORS.map(power).join(" | "),
        "---|".repeat(ERRORS.len()),
    )?;
    for line in &work.lines {
        let work = ERRORS.map(|error| match line.evaluations_for(error) {
            Cost::About(evaluations) => rounded(evaluations),
            Cost::AtMost(evaluations) => format!("< {}", rounded(evaluations)),
            Cost::More => "–".to_owned(),
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

/// One digit, such as 3e-7.
fn power(value: f64) -> String {
    format!("{value:.0e}")
}

/// Two digits, with commas.
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
