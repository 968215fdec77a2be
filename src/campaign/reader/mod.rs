//! Sweeps from TOML. Every key that varies is tried once before anything is computed.

mod collect;
mod distribution;
mod keys;

use super::copula::Copula;
use super::distribution::Distribution;
use super::keys::{FORMAT, MOST_CASES};
use super::outputs::{OutputGroup, outputs};
use super::sampling::{MOST_DIMENSIONS, Sampling};
use super::sweep::{Sweep, Varied};
use crate::diagnostic::{DocumentKind, Report, Table, Value, every, listing, read_text};
use crate::laws::RegisteredLaw;
use crate::layout::Layout;
use crate::scenario::variation::Variation;
use crate::scenario::{Known, Scenario, ScenarioSource, Source, Variant};
use std::collections::HashSet;
use std::path::{Path, PathBuf};

/// A sweep with what it varies.
#[derive(Clone, Debug)]
pub struct Campaign {
    /// What varies.
    pub sweep: Sweep,
    /// Its file.
    pub source: Source,
    /// The scenario, with all its cases; where the case that is computed has values of its own, with these and it alone.
    pub scenario: Scenario,
    /// That case with its values.
    pub variant: Option<Variant>,
    /// Its files.
    pub scenario_source: ScenarioSource,
    /// The texts of the cases.
    pub variation: Variation,
    /// Control laws that the scenario may name beside the shipped ones; none of them after reading.
    pub laws: Vec<RegisteredLaw>,
}

impl Campaign {
    /// Reads a sweep file, the scenario that it names, and that one's layout; `layouts` are those known by name.
    ///
    /// # Errors
    /// All that is wrong with them.
    pub fn read<'k>(path: &Path, layouts: impl Into<Known<'k>>) -> Result<Self, Report> {
        let text = read_text(path, "TOML")?;
        let file = path.display().to_string();
        let folder = path.parent().unwrap_or(Path::new(""));
        Self::parse(&text, &file, folder, layouts)
    }

    /// Reads a sweep from TOML text; `file` is the name that problems are reported under, and the path of the scenario is
    /// relative to `folder`.
    ///
    /// # Errors
    /// All that is wrong with the content, and with the files of scenario and layout.
    pub fn parse<'k>(text: &str, file: &str, folder: &Path, layouts: impl Into<Known<'k>>) -> Result<Self, Report> {
        let known = layouts.into();
        let read = |root: &Table<'_>| read_root(root, folder, &known);
        let (sweep, (mut scenario, scenario_source), variation) =
            DocumentKind::Sweep.read(text, file, &FORMAT, read)?;
        let source = Source { text: text.to_owned(), file: file.to_owned() };
        let variant = scenario.variant(&sweep.case).cloned();
        if let Some(variant) = &variant {
            scenario = variant.scenario.clone();
        }
        Ok(Self { sweep, source, scenario, variant, scenario_source, variation, laws: Vec::new() })
    }

    /// A layout for the choice of what computes the cases: what varies has the first value that is not 0, so that code
    /// for it computes all of them.
    #[must_use]
    pub fn general_layout(&self) -> Layout {
        let value = |varied: &Varied| {
            let values = (1..8).map(|i| varied.distribution.quantile(f64::from(i) / 8.0));
            let general = values.clone().find(|value| value.number() != Some(0.0));
            general.unwrap_or_else(|| varied.distribution.quantile(0.5))
        };
        let values: Vec<_> = self.sweep.varied.iter().map(value).collect();
        // where these do not fit together, the scenario's own
        self.variation.layout(&values).unwrap_or_else(|_| self.scenario.layout.clone())
    }
}

type Read = (Sweep, (Scenario, ScenarioSource), Variation);

fn read_root(root: &Table<'_>, folder: &Path, known: &Known<'_>) -> Option<Read> {
    let name = root.file_name("name");
    let scenario = root.require("scenario").and_then(|value| {
        let path = value.text()?;
        // collecting the components drops `./`
        let path: PathBuf = folder.join(path).components().collect();
        Scenario::read_with_source(&path, known).map_err(|report| value.adopt(report)).ok()
    });
    let case = scenario.as_ref().and_then(|(scenario, _)| case(root, scenario));
    let sampling = root.choice("sampling", &Sampling::ALL);
    let seed = root.whole("seed");
    let block = root.whole("block");
    let tables = root.tables("vary")?;
    let distribution = |table: &Table<'_>| {
        let value = table.require_as("distribution", &table.wanted("distribution"))?;
        distribution::distribution(&value)
    };
    let distributions: Vec<_> = tables.iter().map(distribution).collect();
    let cases = sampling.and_then(|sampling| cases(root, sampling, &tables, &distributions));
    let read = scenario?;
    let (scenario, source) = &read;
    let case = case?;
    // a case with values of its own is a scenario with these
    let own = scenario.variant(&case).map(|own| (&own.scenario, own.sources([&source.scenario, &source.layout])));
    let (scenario, source) = own.as_ref().map_or((scenario, source), |(scenario, source)| (*scenario, source));
    let (paths, variation) = keys::keys(&tables, &distributions, (scenario, source, &known.laws), &case)?;
    let keys: Vec<String> = paths.iter().map(ToString::to_string).collect();
    let copula = root.read_or("correlation", None, |value| correlations(value, &keys, sampling?).map(Some));
    let collect = collect::collect(root, cases, scenario);
    if let (Some(collect), Some(value)) = (&collect, root.get("scenario")) {
        distinct_columns(&value, scenario, &collect.outputs)?;
    }
    let distributions: Vec<Distribution> = distributions.into_iter().collect::<Option<_>>()?;
    let sweep = Sweep {
        name: name?.to_owned(),
        case,
        cases: cases?,
        seed: seed?,
        sampling: sampling?,
        block: block?,
        varied: keys.into_iter().zip(distributions).map(|(key, distribution)| Varied { key, distribution }).collect(),
        copula: copula?,
        collect: collect?,
    };
    Some((sweep, read, variation))
}

/// Refuses a scenario whose names give two outputs one name, as a target called `base` does.
fn distinct_columns(value: &Value<'_>, scenario: &Scenario, groups: &[OutputGroup]) -> Option<()> {
    let mut names = HashSet::new();
    let outputs = outputs(scenario, groups);
    let Some(twice) = outputs.iter().find(|output| !names.insert(output.name.as_str())) else { return Some(()) };
    value.reject(&format!(
        "two outputs of this scenario would be columns of one name, `{}`, expected another name of a target or an arm",
        twice.name
    ));
    None
}

/// The case that is computed.
fn case(root: &Table<'_>, scenario: &Scenario) -> Option<String> {
    let names = scenario.case_names();
    let Some(value) = root.get("case") else {
        if let [only] = names[..] {
            return Some(only.to_owned());
        }
        let wanted = format!("one of the scenario's cases, {}", listing(&names, "or"));
        return root.require_as("case", &wanted).and(None);
    };
    let found = names.iter().find(|name| value.as_str() == Some(name));
    if found.is_none() {
        value.expected_one_of(&names, Some("these are the cases of the scenario"));
    }
    found.map(|name| (*name).to_owned())
}

/// The number of cases; of a grid that of all combinations.
fn cases(
    root: &Table<'_>,
    sampling: Sampling,
    tables: &[Table<'_>],
    distributions: &[Option<Distribution>],
) -> Option<u64> {
    if sampling != Sampling::Grid {
        if sampling == Sampling::Sobol && tables.len() > MOST_DIMENSIONS {
            tables[MOST_DIMENSIONS].reject(
                &format!("{} keys vary, expected at most {MOST_DIMENSIONS} by Sobol's sequence", tables.len()),
                "this is one more",
            );
        }
        return root.whole("cases");
    }
    let mut combinations: u64 = 1;
    for (table, distribution) in tables.iter().zip(distributions) {
        let choices = distribution.as_ref()?.choices();
        if choices.is_none()
            && let Some(value) = table.get("distribution")
        {
            value.reject("a grid combines single values, expected `{ choice = [...] }`");
        }
        combinations = combinations.saturating_mul(choices? as u64);
    }
    if combinations > MOST_CASES.into() {
        root.reject(&format!("the grid has {combinations} combinations, expected at most {MOST_CASES}"), "by `vary`");
        return None;
    }
    if let Some(value) = root.get("cases")
        && value.whole()? != combinations
    {
        value.reject(&format!("the grid has {combinations} combinations, expected that number or no such key"));
    }
    Some(combinations)
}

fn correlations(value: &Value<'_>, keys: &[String], sampling: Sampling) -> Option<Copula> {
    let tables = value.tables()?;
    if !sampling.can_correlate() {
        value.reject(&format!(
            "the sampling `{}` keeps keys independent, expected `random` or `latin_hypercube`",
            sampling.name()
        ));
        return None;
    }
    let names: Vec<&str> = keys.iter().map(String::as_str).collect();
    let pairs = every(tables.iter().map(|table| {
        let pair = table.require("keys").and_then(|value| {
            let items = value.items(&value.wanted())?;
            let indices = every(items.iter().map(|item| {
                let index = names.iter().position(|name| item.as_str() == Some(name));
                if index.is_none() {
                    item.expected_one_of(&names, Some("these are the keys that vary"));
                }
                index
            }))?;
            let pair = <[usize; 2]>::try_from(indices).ok().filter(|[a, b]| a != b);
            if pair.is_none() {
                value.expected("two different keys", None);
            }
            pair
        });
        let rank = table.require("rank").and_then(|value| {
            let rank = value.number()?;
            if rank.abs() >= 1.0 {
                value.expected(&value.wanted(), None);
            }
            (rank.abs() < 1.0).then_some(rank)
        });
        Some((pair?, rank?))
    }))?;
    let repeated = |i: usize| pairs[..i].iter().any(|(pair, _)| pair.iter().all(|key| pairs[i].0.contains(key)));
    if let Some(i) = (0..pairs.len()).find(|i| repeated(*i)) {
        tables[i].reject("two keys have one rank correlation", "this is the second");
        return None;
    }
    let why = "no variables have all of these rank correlations together, expected smaller ones";
    Copula::new(&pairs).map_err(|_| value.reject(why)).ok()
}

#[cfg(test)]
mod tests {
    use super::Campaign;
    use crate::registry::SHIPPED;

    fn sweep_of(target: &str, position: &str) -> Result<Campaign, String> {
        let folder = tempfile::tempdir().expect("a folder");
        let scenario = format!(
            "name = \"it\"\nlayout = \"single_arm_2r\"\n[initial]\njoint_angles = [0.4, -0.9]\n[approach]\nduration = 1.0\n\
             trajectory = \"cycloidal\"\nfinal_joint_angles = [0.4, -0.9]\n[[target]]\nname = \"{target}\"\narm = \"arm1\"\n\
             mass = 1.0\ninertia = 1.0\ncontact = [0.0, 0.5]\nradius = 0.5\n{position}[post_impact]\nduration = 1.0\n"
        );
        std::fs::write(folder.path().join("it.toml"), scenario).expect("written");
        let text = "name = \"sweep\"\nscenario = \"it.toml\"\ncases = 2\nseed = 1\n\
                    vary = [{ key = \"layout.base.mass\", distribution = { choice = [400.0, 500.0] } }]\n";
        Campaign::parse(text, "sweep.toml", folder.path(), SHIPPED).map_err(|report| report.to_string())
    }

    #[test]
    fn names_that_give_two_columns_one_name_are_refused() {
        let place = "position = [1.9, 0.0]\n";
        assert!(sweep_of("debris", place).is_ok() && sweep_of("arm1", "").is_ok());
        for (target, position, column) in [("base", "", "base_after_omega"), ("arm1", place, "arm1_miss")] {
            let said = sweep_of(target, position).expect_err("refused");
            assert!(said.contains("sweep.toml:2:12") && said.contains(&format!("`{column}`")), "{target}: {said}");
        }
    }
}
