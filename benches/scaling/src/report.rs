//! The text of the report: two tables and conclusions.

use crate::compilation::MINIMUM_STACK;
use crate::fit::{Fit, exponent};
use crate::{Problem, REPEATS, Row, shape::Shape};
use std::env::consts::ARCH;
use std::fmt::Write;
use std::process::Command;
use std::thread::available_parallelism;

/// (function, growth, reason), as `codegen/tests/test_scaling.py` proves them.
const GROWTH: [(&str, &str, &str); 6] = [
    ("`forward_dynamics`, with wrenches or without", "linear", "articulated bodies, one division per link"),
    ("kinematics, `bias`, `momentum`", "linear", "sweeps and sums; a Jacobian has only the arm's columns"),
    ("`mass_matrix`", "quadratic in the links of an arm, linear in the arms", "the entries of an arm's block"),
    (
        "`generalized_jacobian`",
        "quadratic in the links of an arm and in the arms",
        "every end effector times every joint",
    ),
    ("`reduced_dynamics`", "quadratic in all links", "the entries of the generalized inertia"),
    (
        "`full_impact`",
        "linear; quadratic in the links of an arm with its matrix",
        "articulated bodies, as forward dynamics; the matrix has the entries of an arm's block",
    ),
];

/// Markdown.
pub fn write(rows: &[Row]) -> Result<String, Problem> {
    let [Some(first), Some(last)] = [rows.first(), rows.last()] else { return Err("no robots".into()) };
    let mut text = String::from(
        "# Scaling\n\n\
         <!-- Written by `cargo run --release --manifest-path benches/scaling/Cargo.toml`. -->\n\n\
         Regular robots of one to four arms with two to seven links each, one arm of thirty and four of ten, none of \
         whose mounts\nis on an axis, so that nothing is a structural zero. The operations are counted in the graphs and \
         the same everywhere; the\ntimes are of one machine and noisy: only their ratios matter.\n\n![Operations and times over the number of \
         links](scaling.svg)\n\n## Operations and sizes\n\nFlops (multiplications, additions, divisions) of one call, \
         run-time parameters, configuration included.\n\n",
    );
    operations(&mut text, rows)?;
    linearity(&mut text, rows)?;
    text.push_str("\n| function | growth of operations | reason |\n|---|---|---|\n");
    for (function, growth, why) in GROWTH {
        writeln!(text, "| {function} | {growth} | {why} |")?;
    }
    text.push_str(
        "| `reduced_impact` | cubic in all links | LDLᵀ of G, which is dense across the arms |\n\n\
         The degrees are exact: `codegen/tests/test_scaling.py` takes finite differences of the counts. Only the \
         paper's impact\nbecomes long; the exact impact, the default, treats the arms separately. Modules compute the \
         paper's in loops where its\nassignments would be too many, from three arms of three links, two of six and one \
         of twelve on (`codegen/impact.py`): the\nstatements of the longest function are then in the graph alone.\n\n\
         ## Times\n\n",
    );
    times(&mut text, rows)?;
    conclusions(&mut text, rows, first, last)?;
    method(&mut text)?;
    Ok(text)
}

fn operations(text: &mut String, rows: &[Row]) -> Result<(), Problem> {
    text.push_str(
        "| arms × links | degrees of freedom | forward dynamics | sin/cos pairs | reduced dynamics | impact, exact | \
         impact, the paper's | longest function, statements | graph, kB | module, lines |\n\
         |---|---|---|---|---|---|---|---|---|---|\n",
    );
    for Row { shape, derivation, .. } in rows {
        writeln!(
            text,
            "| {} × {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |",
            shape.arms,
            shape.links,
            shape.joints() + 3,
            derivation.flops("forward_dynamics"),
            derivation.count("forward_dynamics", "sin_cos"),
            derivation.flops("reduced_dynamics"),
            derivation.flops("full_impact"),
            derivation.flops("reduced_impact"),
            derivation.longest(),
            derivation.graph_bytes / 1000,
            derivation.item.lines().count(),
        )?;
    }
    Ok(())
}

fn linearity(text: &mut String, rows: &[Row]) -> Result<(), Problem> {
    let counts = |least: u8| -> Vec<(Shape, u32)> {
        let rows = rows.iter().filter(|row| row.shape.arms >= least);
        rows.map(|row| (row.shape, row.derivation.flops("forward_dynamics"))).collect()
    };
    let [all, several] = [1, 2].map(|least| Fit::of(&counts(least)));
    let (all, several) = (all.ok_or("too few robots")?, several.ok_or("too few robots")?);
    writeln!(
        text,
        "\n**Forward dynamics are linear**: flops = {:.1} + {:.1} · links + {:.1} · arms with an error of {:.1} flops at \
         most.\nFrom two arms on, the error of {:.0} + {:.0} · links + {:.0} · arms is {:.0}; one arm needs no sum over mounts.",
        all.constant,
        all.per_link,
        all.per_arm,
        all.residual,
        several.constant,
        several.per_link,
        several.per_arm,
        several.residual,
    )?;
    Ok(())
}

fn times(text: &mut String, rows: &[Row]) -> Result<(), Problem> {
    text.push_str(
        "| arms × links | derive, s | release build, s | debug build, s | stack, release, KiB | stack, debug, KiB | \
         generated, ns | generic, ns | generic ÷ generated | impact, generated, ns | impact, generic, ns |\n\
         |---|---|---|---|---|---|---|---|---|---|---|\n",
    );
    for Row { shape, derivation, release, debug, evaluation } in rows {
        writeln!(
            text,
            "| {} × {} | {:.1} | {:.1} | {:.1} | {} | {} | {:.0} | {:.0} | {:.0} | {:.0} | {:.0} |",
            shape.arms,
            shape.links,
            derivation.seconds,
            release.seconds,
            debug.seconds,
            stack(release.stack),
            stack(debug.stack),
            evaluation.generated,
            evaluation.generic,
            evaluation.ratio(),
            evaluation.impacts[0],
            evaluation.impacts[1],
        )?;
    }
    Ok(())
}

/// As a bound if no thread has less.
fn stack(least: u32) -> String {
    if least <= MINIMUM_STACK { format!("≤ {MINIMUM_STACK}") } else { least.to_string() }
}

fn conclusions(text: &mut String, rows: &[Row], first: &Row, last: &Row) -> Result<(), Problem> {
    let over = |value: fn(&Row) -> f64| {
        exponent(
            rows.iter().map(move |row| (f64::from(row.shape.joints()), value(row))).collect::<Vec<_>>().into_iter(),
        )
    };
    let flops = |row: &Row| f64::from(row.derivation.flops("forward_dynamics"));
    let ratios = || rows.iter().map(|row| row.evaluation.ratio());
    let worst = |value: fn(&Row) -> f64| rows.iter().map(value).fold(0.0, f64::max);
    writeln!(
        text,
        "\n- A call of the generated forward dynamics grows with links^{:.2}, one of the generic implementation with \
         links^{:.2};\n  generic ÷ generated is {:.0} to {:.0}. From {} × {} to {} × {} the operations grow {:.1}-fold, \
         the time of the generated\n  code {:.1}-fold, that of the generic one {:.0}-fold.",
        over(|row| row.evaluation.generated),
        over(|row| row.evaluation.generic),
        ratios().fold(f64::INFINITY, f64::min),
        ratios().fold(0.0, f64::max),
        first.shape.arms,
        first.shape.links,
        last.shape.arms,
        last.shape.links,
        flops(last) / flops(first),
        last.evaluation.generated / first.evaluation.generated,
        last.evaluation.generic / first.evaluation.generic,
    )?;
    writeln!(
        text,
        "- Derivation takes {:.1} s at most, a release build of a module with every function {:.1} s, a debug build \
         {:.1} s.\n  Function bodies of more than five hundred statements are split into blocks: several thousand in one \
         block overflow the\n  compiler's stack when it writes debug information. The optimized code is the same.\n\
         - In a debug build the largest module's test, which calls every function, needs {} KiB of stack: tests have \
         2048.\n  In a release build it needs {} KiB.",
        worst(|row| row.derivation.seconds),
        worst(|row| row.release.seconds),
        worst(|row| row.debug.seconds),
        rows.iter().map(|row| row.debug.stack).max().unwrap_or(0),
        rows.iter().map(|row| row.release.stack).max().unwrap_or(0),
    )?;
    Ok(())
}

fn method(text: &mut String) -> Result<(), Problem> {
    let rustc = Command::new("rustc").arg("--version").output()?;
    let rustc =
        String::from_utf8_lossy(&rustc.stdout).split_whitespace().nth(1).unwrap_or("of some version").to_owned();
    writeln!(
        text,
        "\n## How it was measured\n\n\
         - **Derive**: layout to graph as `planar-capture generate` does it, Python's start included; the fastest of \
         {REPEATS}.\n\
         - **Builds**: `cargo build` of a crate without dependencies with one standalone module and, as its \
         program, the\n  module's self-test, which calls every function; clean, default profiles, the fastest of \
         {REPEATS}.\n\
         - **Stack**: the smallest on which that program passes, to 1/16.\n\
         - **Calls**: criterion's medians of `ForwardDynamics::forward_dynamics` and, for the paper's impact, \
         `Impact::reduced_impact`, the\n  traits with their checks, for the generated module and for the generic \
         implementation, at the same sixteen random states\n  in the same runs; of the fastest of {REPEATS} runs; \
         default release profile, no processor flags.\n\
         - **Machine**: {ARCH}, {} cores, shared with others; rustc {rustc}.",
        available_parallelism()?,
    )?;
    Ok(())
}
