//! Medians and ratios as Markdown and JSON.

use crate::builds::{BUILDS, Measured};
use crate::engines::{ENGINES, PACKAGE};
use evaluation::Problem;
use serde_json::json;
use std::fmt::Write;
use std::path::Path;
use std::process::Command;

const HEAD: &str = "# Performance

<!-- Written by the command below. -->

Processor time of one evaluation for the paper's robot (two arms of three links, 9 degrees of freedom), in one run in which all
builds take turns. CasADi's C code is that of the same formulation with the robot's numbers in it, compiled with `-O3
-march=native`; generated code takes its numbers at run time. It computes both arms at once, as modules do that a build script renders, and
those of `generate --pairs`. Builds that are fused have the feature [`fused`](book/src/guide/library.md#bits). All results agree to
1e-11 before anything is measured. Times depend on the machine: compare ratios. On yours:

    cargo run --release --manifest-path benches/evaluation/Cargo.toml

It writes this page, and the numbers as JSON. Engines beside C, and criterion, are described in that file; instructions are counted by
`python3 tests/instruction_counts.py`.

SUMMARY

Single calls of both sides read the same records, one of 248 bytes per state, in order: 64 of them, time and again, or 16,384, which
are 4 MB. C is slower on the latter, probably because the sines of the C library branch by the angle, which a processor predicts for
angles that it has just seen; generated sines have no such branch.

A step is one of a motion of 20 s, by a loop by hand around evaluations, the same text for both. C is called. Generated code is inlined
into it: functions with `#[inline(always)]` that the loop calls by name, over arrays. In the second row it is called, too. Which of the
two is faster depends on processor and build: what is called returns its numbers through memory, where a processor waits for vectors
that are put together from several stores; four evaluations in the text of a step are some 3000 instructions, more than some processors
keep decoded. The library's step, [below](#simulation), has them in its text, too.

";

/// Flags of the C compiler, those of the build script.
const C_FLAGS: &str = "-O3 -march=native";

/// Measurements with a counterpart in C: title, names without the implementation.
const COMPARED: [(&str, &str); 8] = [
    ("forward dynamics", "forward dynamics"),
    ("forward dynamics, 16,384 states", "forward dynamics, many states"),
    ("derivatives of forward dynamics", "derivatives"),
    ("GIM, generalized bias and GJM", "reduced dynamics"),
    ("impact, paper's equations", "reduced impact"),
    ("impact, exact", "full impact"),
    ("Runge–Kutta step with PD control", "step"),
    ("the same, evaluations called", "called step"),
];

const SIMULATION: &str = "
## Simulation

Runge–Kutta steps of 1 ms with PD control, 20 s of motion, per step. By hand: the loop of the first table, over arrays, which looks at
neither pivot nor numbers. The library's integrator, law and equation take slices, check the pivot and that numbers
are finite, and integrate the work of the joints too. All are generic over robot and law; those of any are `dyn`, and vectors of any
length: a step is one call of the robot then, and four of the law. A simulation, of any robot and law, also audits momentum, energy
and centre of mass at every step, estimates the error of its path by a second motion in steps of twice the length, which are half of
a step each time, and keeps its path. The audit alone is that of states in order, of which it takes eight at once.

| |";

/// Ratios of simulations: title, measurement, and what it is compared with.
const SIMULATED: [(&str, &str, &str); 5] = [
    ("the library's, to that by hand", "library, step", "f64, step"),
    ("the library's, to that by hand with calls", "library, step", "f64, called step"),
    ("the same of any robot and law, to the library's", "library, step of any robot", "library, step"),
    ("a simulation, to the library's", "simulation, step", "library, step"),
    ("its audit alone, to the library's", "audit, step", "library, step"),
];

const STUDIES: &str = "
## Studies

Whole studies in memory, without files, ms: an approach, three captures and the motion after each, with audits, estimates of errors,
contacts and clearance. The shipped scenario has fixed steps of 5 ms, 34,000 of them. Without its key `integrator` steps are adaptive, to
1e-10. Samples, and audits between adaptive steps, are 0.05 s apart, of one case alone 0.5 s; its joint rates at the end of the approach
are given, as in a sweep, which designs them once.

| |";

/// Studies: title and measurement.
const STUDIED: [(&str, &str); 3] = [
    ("the paper's, fixed steps", "study, fixed steps"),
    ("the paper's, adaptive steps", "study, adaptive"),
    ("one of its cases, adaptive steps, end rates given: 1 is meant to be the most", "study, one case"),
];

const LANES: [&str; 7] = ["f32", "f32x4", "f32x8", "f32x16", "f64x2", "f64x4", "f64x8"];

const BATCHES: &str = "
## Batches

The feature `batch`: states as structures of arrays, in vectors of the instruction set that the program finds when it runs. Time
per state, and the ratio to one state of CasADi's C, which takes one after the other: 64 states stay in the first-level cache,
16,384 do not. Batches of exact impacts give velocities alone, and C all results, with matrix and impulses: their ratio is that of these
calls and not of the same work. Generalized inertia, bias and Jacobian are 78 numbers per state to store, which takes most of the time
where they leave the cache: blocks of 64 are better there. A step of a batch is under constant torques, C's under PD control,
which adds 24 operations to each evaluation.

| | C, ns |";

/// Measurements of batches: title, name, name of the counterpart in C.
const BATCHED: [(&str, &str, &str); 10] = [
    ("forward dynamics, 64 states", "forward dynamics", "forward dynamics"),
    ("forward dynamics, 16,384 states", "forward dynamics, many states", "forward dynamics, many states"),
    ("GIM, generalized bias and GJM, 64 states", "reduced dynamics", "reduced dynamics"),
    ("GIM, generalized bias and GJM, 16,384 states", "reduced dynamics, many states", "reduced dynamics, many states"),
    ("impact, paper's equations, 64 states", "reduced impact", "reduced impact"),
    ("impact, paper's equations, 16,384 states", "reduced impact, many states", "reduced impact, many states"),
    ("impact, exact, 64 states", "full impact", "full impact"),
    ("impact, exact, 16,384 states", "full impact, many states", "full impact, many states"),
    ("Runge–Kutta step, 64 states", "step", "step"),
    ("Runge–Kutta step, 16,384 states", "step, many states", "step"),
];

const BOUNDS: &str = "
## Bounds

The ratio of this run, the largest that is meant to be, and whether it is above. The bounds of `f64x8` and of batches are for
processors with AVX-512, which batches take from Ice Lake and Zen 4 on. The step of the first rows is the loop by hand.

| | default x86-64 | native, fused |
|---|---|---|
";

/// Largest ratio that is meant to be.
struct Bound {
    title: &'static str,
    /// The measurement, and what it is compared with.
    of: [&'static str; 2],
    /// In the default build, and in that native and fused.
    most: [Option<f64>; 2],
}

const fn bound(title: &'static str, of: [&'static str; 2], most: [Option<f64>; 2]) -> Bound {
    Bound { title, of, most }
}

const BOUNDED: [Bound; 11] = [
    bound("forward dynamics", ["f64, forward dynamics", "C, forward dynamics"], [Some(0.73), Some(0.42)]),
    bound("GIM, generalized bias and GJM", ["f64, reduced dynamics", "C, reduced dynamics"], [Some(0.64), Some(0.43)]),
    bound("impact, paper's equations", ["f64, reduced impact", "C, reduced impact"], [Some(0.86), Some(0.60)]),
    bound("impact, exact", ["f64, full impact", "C, full impact"], [Some(0.70), Some(0.44)]),
    bound("Runge–Kutta step with PD control", ["f64, step", "C, step"], [Some(0.72), Some(0.48)]),
    bound("forward dynamics in `f64x8`", ["f64x8, forward dynamics", "C, forward dynamics"], [None, Some(0.13)]),
    bound("batches of forward dynamics", ["batch, forward dynamics", "C, forward dynamics"], [Some(0.15), None]),
    bound("derivatives of forward dynamics", ["f64, derivatives", "C, derivatives"], [Some(1.0), Some(1.0)]),
    bound("the same, to Pinocchio's", ["f64, derivatives", "Pinocchio, derivatives"], [None, Some(0.125)]),
    bound("the library's step, to that by hand", ["library, step", "f64, step"], [Some(1.10), Some(1.10)]),
    bound("the audit of a step, to the library's", ["audit, step", "library, step"], [Some(0.30), Some(0.30)]),
];

const LIMIT: &str = "
## The limit

Products and sums of independent numbers that are in registers, fused, in this run: PEAK·10⁹ operations a second (build native,
fused). Operations are the sums, products and divisions of the module's manifest, and 35 for a sine with its cosine. In brackets is
how many times as long an evaluation takes as these at the peak. A division is not as fast as a product, not every product meets a sum, and
exchanges of signs and quadrants are not counted. One by one, operations wait for each other, and a sum of scalars takes as long as one
of vectors. In vectors they wait for what does not fit into registers, and batches for copying results.
How operations grow with links and arms is in [scaling.md](scaling.md).

| | operations | at the peak, ns | one by one | `f64x8` | batch of 64 |
|---|---|---|---|---|---|
";

const ARRAYS: &str = "
## From Python

The functions of `planar_capture.Robot` on numpy arrays, in one thread, with all that a call takes: ns per state, and the ratio to the
compiled batch of the default build in the same run";

const ARRAYS_MADE: &str = ".
A call of 64 states takes mostly what a call of any function takes. Generalized inertia, bias and Jacobian are 78 numbers per state
where accelerations are 9, in arrays that are new with every call, while a compiled batch writes where it wrote before.";

/// Measurements from Python: title and name, those of batches.
const FROM_PYTHON: [(&str, &str); 4] = [
    (BATCHED[0].0, BATCHED[0].1),
    (BATCHED[1].0, BATCHED[1].1),
    (BATCHED[2].0, BATCHED[2].1),
    (BATCHED[3].0, BATCHED[3].1),
];

const OTHERS: &str = "
## Pinocchio and MuJoCo

C++ of Pinocchio, header only and compiled by clang with `-O3 -march=native`, with a planar joint for the base, and MuJoCo's library with
two slides and a hinge: ns, and in brackets how many times that of generated code (native, fused). What they compute agrees with it to
1e-10 and 1e-9. Both are for robots in space of any structure, which generated code is not. Derivatives are those of
`computeABADerivatives`; generalized inertia, bias and Jacobian follow from `crba`, `nonLinearEffects` and the Jacobians of frames by
elimination of the base; MuJoCo's step is `mj_step` with its own Runge–Kutta integrator, and the control as springs and dampers.

| |";

/// Measurements of other engines: title and name.
const OF_OTHERS: [(&str, &str); 4] = [COMPARED[0], COMPARED[2], COMPARED[3], COMPARED[6]];

/// Writes `docs/performance.md`, and `performance.json` beside the builds.
pub fn write(measured: &[Measured]) -> Result<(), Problem> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let text = markdown(measured)?;
    print!("{text}");
    std::fs::write(folder.join("../../docs/performance.md"), text)?;
    let nanoseconds: serde_json::Map<_, _> = measured
        .iter()
        .map(|Measured { build, times }| {
            let times: serde_json::Map<_, _> = times.iter().map(|(name, times)| (name.clone(), json!(times))).collect();
            ((*build).to_owned(), times.into())
        })
        .collect();
    let builds: serde_json::Map<_, _> = BUILDS
        .iter()
        .map(|(name, flags, fused)| ((*name).to_owned(), json!({ "rustflags": flags, "fused": fused })))
        .collect();
    let all = json!({ "measured_on": machine(), "c_flags": C_FLAGS, "builds": builds, "nanoseconds": nanoseconds });
    Ok(std::fs::write(folder.join("target/performance.json"), serde_json::to_string_pretty(&all)?)?)
}

fn markdown(all: &[Measured]) -> Result<String, Problem> {
    let (measured, others) = all.split_at(BUILDS.len());
    let c = |name: &str| of_c(measured, &format!("C, {name}"));
    let mut text = HEAD.replace("SUMMARY", &summary(measured, others)?);
    let flags = BUILDS.map(|(name, flags, _)| format!("{name} `{flags}`").replace(" ``", " none"));
    writeln!(text, "Measured on: {}. `RUSTFLAGS`: {}.\n", machine().join("; "), flags.join(", "))?;
    text += "## Against CasADi's C\n\nRatio to the time of C; in brackets ns. C has the same flags in all builds: its time is the least of their medians.
Spread is the larger quartile over the median, of all builds.\n\n| | C, ns |";
    text += &heads(" spread |");
    for (title, name) in COMPARED {
        // C is called in any case
        let base = c(name.trim_start_matches("called "))?;
        write!(text, "| {title} | {base:.0} |")?;
        let key = format!("f64, {name}");
        for build in measured {
            let time = build.median(&key).ok_or(format!("no time of {key}"))?;
            write!(text, " **{:.2}** ({time:.0}) |", time / base)?;
        }
        let spread = measured.iter().filter_map(|build| build.spread(&key)).fold(0.0, f64::max);
        writeln!(text, " {:.0} % |", 100.0 * spread)?;
    }
    text += &bounds(measured, others)?;
    text += &of_engines(measured, others)?;
    text += "\n## Other scalars\n\nForward dynamics, ns per state (one per lane), and the ratio to one state of CasADi's C.
A single `f32` is slower than an `f64` although it has fewer terms: an `f64` has the sines of a state computed in four lanes, an `f32` one by
one. It is there for processors that have `f32` alone, and as lanes.\n\n| |";
    text += &heads("");
    let base = c("forward dynamics")?;
    for scalar in LANES {
        write!(text, "| `{scalar}` |")?;
        for build in measured {
            let key = format!("{scalar}, forward dynamics");
            let time = build.median(&key).ok_or(format!("no time of {key}"))?;
            write!(text, " {time:.1} ({:.2}) |", time / base)?;
        }
        text += "\n";
    }
    text += SIMULATION;
    text += &heads("");
    for (title, name, base) in SIMULATED {
        write!(text, "| {title} |")?;
        for build in measured {
            let (time, base) = (build.median(name), build.median(base));
            let (time, base) = (time.ok_or("no time of steps")?, base.ok_or("no time of steps")?);
            write!(text, " **{:.2}** ({time:.0}) |", time / base)?;
        }
        text += "\n";
    }
    text += STUDIES;
    text += &heads("");
    for (title, name) in STUDIED {
        write!(text, "| {title} |")?;
        for build in measured {
            write!(text, " {:.2} |", 1e-6 * build.median(name).ok_or(format!("no time of {name}"))?)?;
        }
        text += "\n";
    }
    text += BATCHES;
    text += &heads(" spread |");
    for (title, name, c_name) in BATCHED {
        let base = c(c_name)?;
        write!(text, "| {title} | {base:.0} |")?;
        let key = format!("batch, {name}");
        for build in measured {
            let time = build.median(&key).ok_or(format!("no time of {key}"))?;
            write!(text, " **{:.3}** ({time:.1}) |", time / base)?;
        }
        let spread = measured.iter().filter_map(|build| build.spread(&key)).fold(0.0, f64::max);
        writeln!(text, " {:.0} % |", 100.0 * spread)?;
    }
    text += &limit(measured)?;
    text += &from_python(measured, others)?;
    text += "\n## The generic implementation\n\nDense matrices of nalgebra, what one would write by hand: ratio to generated code of the same build.\n\n| |";
    text += &heads("");
    for (title, name) in [COMPARED[0], COMPARED[3], COMPARED[5]] {
        write!(text, "| {title} |")?;
        for build in measured {
            let times = ["generic", "f64"].map(|of| build.median(&format!("{of}, {name}")));
            let [Some(generic), Some(generated)] = times else {
                return Err(format!("no time of generic, {name}").into());
            };
            write!(text, " {:.0} |", generic / generated)?;
        }
        text += "\n";
    }
    Ok(text)
}

/// What matters most, in a sentence or two.
fn summary(measured: &[Measured], others: &[Measured]) -> Result<String, Problem> {
    let ends = [measured.first(), measured.last()].map(|build| build.ok_or("no build"));
    let ([default, best], base) = ([ends[0]?, ends[1]?], of_c(measured, "C, forward dynamics")?);
    let ratio = |build: &Measured, name: &str| {
        let time = build.median(&format!("{name}, forward dynamics")).ok_or(format!("no time of {name}"))?;
        Ok::<_, Problem>(time / base)
    };
    let mut text = format!(
        "**In short:** forward dynamics of one state takes {:.2} of the time of CasADi's C in a default build, and {:.2} in one for this
processor with fused products; in batches {:.2} and {:.2}.",
        ratio(default, "f64")?,
        ratio(best, "f64")?,
        ratio(default, "batch")?,
        ratio(best, "batch")?
    );
    let times = ENGINES.iter().filter_map(|engine| {
        let other = others.iter().find(|other| other.build == *engine)?.median("forward dynamics")?;
        Some(format!("{engine} takes {:.1} times that of C", other / base))
    });
    let times: Vec<_> = times.collect();
    if !times.is_empty() {
        write!(text, " {}.", times.join(", "))?;
    }
    Ok(text)
}

/// The time of a measurement of C, which is compiled in the same way for every build.
fn of_c(measured: &[Measured], name: &str) -> Result<f64, Problem> {
    let of_builds = measured.iter().filter_map(|build| build.median(name));
    of_builds.min_by(f64::total_cmp).ok_or(format!("no time of {name}").into())
}

/// Ratios beside those that are meant to be.
fn bounds(measured: &[Measured], others: &[Measured]) -> Result<String, Problem> {
    let mut text = BOUNDS.to_owned();
    for Bound { title, of: [name, base], most } in BOUNDED {
        let time_of_base = |build: &Measured| match base.split_once(", ") {
            Some(("C", _)) => of_c(measured, base).ok(),
            Some((engine, name)) if ENGINES.contains(&engine) => {
                others.iter().find(|other| other.build == engine).and_then(|other| other.median(name))
            }
            _ => build.median(base),
        };
        write!(text, "| {title} |")?;
        for (build, most) in [measured.first(), measured.last()].into_iter().flatten().zip(most) {
            let ratio = build.median(name).zip(time_of_base(build)).map(|(time, base)| time / base);
            match ratio.zip(most) {
                Some((ratio, most)) if ratio > most => write!(text, " {ratio:.3} of {most}: **above** |")?,
                Some((ratio, most)) => write!(text, " {ratio:.3} of {most} |")?,
                None => text += " – |",
            }
        }
        text += "\n";
    }
    Ok(text)
}

/// The names of the builds after a first cell, or two where a last one follows, with the line under them.
fn heads(last: &str) -> String {
    let names = BUILDS.map(|(build, ..)| build).join(" | ");
    let others = if last.is_empty() { 1 } else { 3 };
    format!(" {names} |{last}\n|{}\n", "---|".repeat(others + BUILDS.len()))
}

/// What other engines need, where they were measured.
fn of_engines(measured: &[Measured], others: &[Measured]) -> Result<String, Problem> {
    let engines: Vec<_> = ENGINES.iter().filter_map(|name| others.iter().find(|other| other.build == *name)).collect();
    let Some(generated) = measured.last().filter(|_| !engines.is_empty()) else { return Ok(String::new()) };
    let mut text = format!("{OTHERS} generated | {} |\n|---|---|---|---|\n", ENGINES.join(" | "));
    for (title, name) in OF_OTHERS {
        let base = generated.median(&format!("f64, {name}")).ok_or(format!("no time of {name}"))?;
        write!(text, "| {title} | {base:.0} |")?;
        for engine in &engines {
            match engine.median(name) {
                Some(time) => write!(text, " {time:.0} (**{:.1}**) |", time / base)?,
                None => text += " – |",
            }
        }
        text += "\n";
    }
    Ok(text)
}

/// How far evaluations are from what the core can do at most.
fn limit(measured: &[Measured]) -> Result<String, Problem> {
    let best = measured.last().ok_or("no build")?;
    let of = |name: &str| best.median(name).ok_or(format!("nothing of {name}"));
    let peak = of("operation at the peak")?;
    let mut text = LIMIT.replace("PEAK", &format!("{:.0}", 1.0 / peak));
    for (title, name) in [COMPARED[0], COMPARED[3], COMPARED[4], COMPARED[5]] {
        let operations = of(&format!("operations, {name}"))?;
        let least = operations * peak;
        write!(text, "| {title} | {operations:.0} | {least:.1} |")?;
        for kind in ["f64", "f64x8", "batch"] {
            // a batch of exact impacts has fewer results than these operations
            let is_whole = (kind, name) != ("batch", "full impact");
            match best.median(&format!("{kind}, {name}")).filter(|_| is_whole) {
                Some(time) => write!(text, " {time:.1} (**{:.1}**) |", time / least)?,
                None => text += " – |",
            }
        }
        text += "\n";
    }
    Ok(text)
}

/// What the Python package needs, where it was measured, beside compiled batches and Pinocchio's evaluations one by one.
fn from_python(measured: &[Measured], others: &[Measured]) -> Result<String, Problem> {
    let of = |name: &str| others.iter().find(|other| other.build == name);
    let (Some(package), Some(compiled)) = (of(PACKAGE), measured.first()) else { return Ok(String::new()) };
    let pinocchio = of(ENGINES[0]);
    let mut text = ARRAYS.to_owned();
    if pinocchio.is_some() {
        text += "; how many times as long Pinocchio's C++ takes for one of them";
    }
    text += ARRAYS_MADE;
    text += "\n\n| | compiled batch | numpy arrays | Pinocchio |\n|---|---|---|---|\n";
    for (title, name) in FROM_PYTHON {
        let key = format!("batch, {name}");
        let base = compiled.median(&key).ok_or(format!("no time of {key}"))?;
        let time = package.median(name).ok_or(format!("no time of {name} from Python"))?;
        write!(text, "| {title} | {base:.1} | {time:.1} (**{:.2}**) |", time / base)?;
        // one after the other, however many there are
        match pinocchio.and_then(|engine| engine.median(name.trim_end_matches(", many states"))) {
            Some(other) => writeln!(text, " {other:.0} (**{:.1}**) |", other / time)?,
            None => text += " – |\n",
        }
    }
    Ok(text)
}

/// Processor and compilers.
fn machine() -> Vec<String> {
    let processor = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let of_processor = |key: &str| {
        let (_, value) =
            processor.lines().filter_map(|line| line.split_once(':')).find(|(name, _)| name.trim() == key)?;
        Some(value.trim().to_owned())
    };
    let model = of_processor("model name").map(|name| {
        // the names of servers' processors in virtual machines are those of all of them
        let numbers = ["cpu family", "model"].map(|key| of_processor(key).unwrap_or_default());
        format!("{name} (family {}, model {})", numbers[0], numbers[1])
    });
    let version = |program: &str| {
        let output = Command::new(program).arg("--version").output().ok()?;
        Some(String::from_utf8_lossy(&output.stdout).lines().next()?.to_owned())
    };
    [model, version("rustc"), version("cc")].into_iter().flatten().collect()
}
