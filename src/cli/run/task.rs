//! One scenario of a run: computed, audited, written.

use super::super::CommandError;
use super::super::optional_outputs::file_per_case;
use super::super::progress::Progress;
use super::super::terminal::note;
use super::product::Printed;
use super::{Arguments, DEFAULT_SAMPLE};
use crate::capture::{StudyError, study_registered};
use crate::check::study_report;
use crate::engine::Choice;
use crate::laws::RegisteredLaw;
use crate::output::console::table_of_parts;
use crate::output::html_report::write_report;
use crate::output::result_folder::ResultFolder;
use crate::output::run_folder::{REPORT, SUMMARY, files_of, summary_in};
use crate::output::run_manifest::RunManifest;
use crate::output::study_part::StudyPart;
use crate::output::summary::summary_of_parts;
use crate::output::time_series::CsvWriter;
use crate::scenario::{Scenario, ScenarioSource, Source, Variant};
use serde_json::Value;
use std::borrow::Cow;
use std::env::consts::EXE_SUFFIX;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// A scenario that can be computed.
pub struct Task<'a> {
    /// As the argument has it.
    pub path: &'a Path,
    pub scenario: &'a Scenario,
    pub source: &'a ScenarioSource,
    pub folder: ResultFolder<'a>,
    /// Of the scenario.
    pub choice: Choice,
    /// Of each of its variants.
    pub own: Vec<Choice>,
    /// That scenarios may name.
    pub laws: &'a [RegisteredLaw],
    /// What its messages begin with.
    pub named: String,
}

/// What the audit objects to, and what would keep its bounds.
pub struct Objections {
    pub failures: Vec<String>,
    pub advice: Vec<String>,
}

impl Task<'_> {
    /// Computes the study and writes its files: what is printed, and what the audit objects to. What the last task computed is not
    /// freed part by part, which would take a thirtieth of a short run: the process ends.
    pub fn run(&self, arguments: &Arguments, is_last: bool) -> Result<(Printed, Objections), CommandError> {
        let Self { path, scenario, source, folder, choice, own, named, .. } = self;
        if let Some((sample, step)) = arguments.sample.and_then(|sample| Some((sample, longer_step(scenario, sample)?)))
        {
            note(format_args!(
                "{named}warning: --sample {sample:?} s is shorter than the scenario's step of {step:?} s: rows are at \
                 every step"
            ));
        }
        if !arguments.display.quiet {
            arguments.dynamics.announce(choice, &source.layout.file, named);
            for (variant, own) in scenario.variants.iter().zip(own).filter(|(_, own)| own.origin != choice.origin) {
                let of = format!("{named}case `{}`: ", variant.name());
                arguments.dynamics.announce(own, &source.layout.file, &of);
            }
        }
        let manifest = RunManifest::new(scenario, (*source).clone(), command());
        if arguments.verbose {
            self.note_inputs(&manifest);
        }
        let begin = Instant::now();
        let parts = scenario.parts().map(|(scenario, variant)| {
            let own = |variant| scenario_choice(self, variant);
            let choice = variant.map_or(choice, own);
            let model = choice.model(&scenario.layout);
            let mut progress = Progress::new(arguments.display);
            let sample = arguments.sample.unwrap_or(DEFAULT_SAMPLE);
            let result = study_registered(scenario, &|| model.clone_box(), self.laws, sample, &mut progress);
            progress.finish();
            let study = result.map_err(|error| study_error(&error, scenario, variant, &source.scenario))?;
            let manifest = manifest.of_part(variant);
            let study = Cow::Owned(study);
            Ok(StudyPart { scenario, variant, dynamics: choice.engine.name(), study, manifest })
        });
        let parts = parts.collect::<Result<Vec<_>, CommandError>>()?;
        let computed = begin.elapsed();
        let summary = summary_of_parts(scenario, choice.engine.name(), &parts, &manifest)
            .map_err(|source| CommandError::Numbers { file: path.display().to_string(), source })?;
        let summary = self.write_results(arguments, (&parts, &manifest), summary)?;
        if arguments.verbose {
            let written = begin.elapsed().saturating_sub(computed);
            note(format_args!("{named}computed in {computed:.2?}, written in {written:.2?}"));
            self.note_files(&summary);
        }
        let table = format!("{}\nResults in {}\n", table_of_parts(&parts), folder.path().display());
        let objections = Objections {
            failures: parts.iter().flat_map(StudyPart::audit_failures).collect(),
            advice: parts.iter().flat_map(StudyPart::step_advice).collect(),
        };
        if is_last {
            std::mem::forget(parts);
        }
        Ok((Printed { table, summary }, objections))
    }

    /// Says what the audit objects to.
    pub fn note_objections(&self, objections: &Objections) {
        for failure in &objections.failures {
            note(format_args!("{}audit: {failure}", self.named));
        }
        for advice in &objections.advice {
            note(format_args!("{}{advice}", self.named));
        }
    }

    /// What is computed, from which files, and how.
    fn note_inputs(&self, manifest: &RunManifest) {
        let Self { scenario, source, named, .. } = self;
        let hash = manifest.scenario_sha256();
        note(format_args!("{named}scenario: {}, sha256 {}", source.scenario.file, &hash[..12]));
        for (scenario, variant) in scenario.parts() {
            let of = variant.map_or_else(|| named.clone(), |variant| format!("{named}case `{}`: ", variant.name()));
            let manifest = manifest.of_part(variant);
            let (layout, hash) = (&scenario.layout.name, &manifest.layout_sha256[..12]);
            note(format_args!("{of}robot: {layout} of {}, sha256 {hash}", source.layout.file));
            for phase in &manifest.phases {
                let (name, steps, integrator) = (phase.phase, phase.steps, phase.integrator);
                note(format_args!("{of}{name}: {steps} steps, {integrator}"));
            }
        }
    }

    fn note_files(&self, summary: &Value) {
        for file in files_of(summary) {
            let path = self.folder.path().join(file);
            let size = fs::metadata(&path).map_or(0, |data| data.len());
            note(format_args!("{}{}: {size} bytes", self.named, path.display()));
        }
    }

    /// Writes all files before the first gets its place, so that a full disk leaves no mixture of two runs; returns the
    /// summary with their names.
    fn write_results(
        &self,
        arguments: &Arguments,
        (parts, manifest): (&[StudyPart<'_>], &RunManifest),
        mut summary: Value,
    ) -> Result<Value, CommandError> {
        let folder = &self.folder;
        let staged = folder.stage()?;
        for part in parts {
            let StudyPart { scenario, study, .. } = part;
            let mut csv = CsvWriter::new(scenario, study);
            file_per_case(&staged, study, "csv", |case, to| csv.write(case, to))?;
            for output in arguments.optional_outputs.requested() {
                output.write(&staged, part, &arguments.optional_outputs)?;
            }
        }
        if arguments.report {
            staged.write(REPORT, |to| write_report(self.scenario, parts, manifest, to))?;
        }
        let mut files = staged.files()?;
        files.push(SUMMARY.to_owned());
        files.sort();
        summary["files"] = files.into();
        staged.write(SUMMARY, |to| {
            serde_json::to_writer_pretty(&mut *to, &summary)?;
            writeln!(to)
        })?;
        // of another scenario, the user has asked for it by --force
        let earlier = summary_in(folder.path()).filter(|earlier| earlier["scenario"] == self.scenario.name.as_str());
        let other = earlier.as_ref().and_then(|earlier| self.other_file(earlier, &summary));
        let dropped = earlier.as_ref().map_or_else(Vec::new, |earlier| self.dropped(earlier, &summary));
        folder.commit(staged, SUMMARY)?;
        if let Some(command) = other {
            let (named, folder) = (&self.named, folder.path().display());
            note(format_args!("{named}the results of another file were in {folder} and are replaced: {command}"));
        } else if !dropped.is_empty() {
            let (named, folder, dropped) = (&self.named, folder.path().display(), in_words(&dropped));
            note(format_args!("{named}removed from {folder}, as this run has no such files: {dropped}"));
        }
        Ok(summary)
    }

    /// The files in the folder that are results of an earlier run, and that these results have not.
    fn dropped(&self, earlier: &Value, summary: &Value) -> Vec<String> {
        let (folder, now) = (self.folder.path(), files_of(summary).collect::<Vec<_>>());
        let dropped = files_of(earlier).filter(|file| !now.contains(file) && folder.join(file).is_file());
        dropped.map(str::to_owned).collect()
    }

    /// The command of an earlier run, where that had another file of the same scenario's name: one that was edited since has
    /// the same path.
    fn other_file(&self, earlier: &Value, summary: &Value) -> Option<String> {
        let command = earlier["run"]["command"].as_str()?;
        let [before, now] = [earlier, summary].map(|summary| summary["run"]["scenario_sha256"].as_str());
        let plain = |path: &Path| path.components().collect::<PathBuf>();
        let is_this = |word: &String| plain(Path::new(word)) == plain(self.path);
        let is_other = before? != now? && !shlex::split(command)?.iter().any(is_this);
        is_other.then(|| command.to_owned())
    }
}

/// Most files that are named.
const NAMED: usize = 4;

/// Names of sorted files, several in a folder as their number, and how many more there are.
fn in_words(files: &[String]) -> String {
    let folder = |file: &str| file.split_once('/').map(|(folder, _)| folder.to_owned());
    let mut names: Vec<_> = files
        .chunk_by(|a, b| folder(a).is_some() && folder(a) == folder(b))
        .map(|inside| match (folder(&inside[0]), inside.len()) {
            (Some(folder), count) if count > 1 => format!("{count} files in {folder}"),
            _ => inside[0].clone(),
        })
        .collect();
    // what reruns leave out most
    names.sort_by_key(|name| name != REPORT);
    let more = match names.len().saturating_sub(NAMED) {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    names.truncate(NAMED);
    names.join(", ") + &more
}

/// What computes a variant of the task's scenario.
fn scenario_choice<'a>(task: &'a Task<'_>, variant: &Variant) -> &'a Choice {
    let own = task.scenario.variants.iter().zip(&task.own).find(|(other, _)| other.index() == variant.index());
    own.map_or(&task.choice, |(_, own)| own)
}

/// The longest step of a phase that is longer than the interval of rows, s.
fn longer_step(scenario: &Scenario, sample: f64) -> Option<f64> {
    let steps = [Some(scenario.approach.step), scenario.post_impact.as_ref().map(|phase| phase.step)];
    // the least that is not rounding
    steps.into_iter().flatten().filter(|step| sample < step * (1.0 - 1e-6)).reduce(f64::max)
}

/// The error at its key in the scenario, or at the values that a variant of it has; exit code 1 where a valid simulation
/// broke down.
pub fn study_error(
    error: &StudyError,
    scenario: &Scenario,
    variant: Option<&Variant>,
    source: &Source,
) -> CommandError {
    let exit_code = if error.is_breakdown() { 1 } else { 2 };
    CommandError::Computation { report: study_report(error, scenario, variant, source), exit_code }
}

/// The command line, as it can be typed again.
fn command() -> String {
    let mut words: Vec<_> = std::env::args_os().map(|argument| argument.to_string_lossy().into_owned()).collect();
    if let Some(program) = words.first_mut() {
        // without the folder, in which others do not have it
        let name = Path::new(program).file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
        name.strip_suffix(EXE_SUFFIX).unwrap_or(&name).clone_into(program);
    }
    // only a NUL cannot be quoted, which no argument has
    shlex::try_join(words.iter().map(String::as_str)).unwrap_or_default()
}
