//! `planar-capture compare`: its table, and its states as input of `eval`.

use crate::said;
use planar_capture::compare::{Comparison, LargestError, Refusal};
use planar_capture::engine::Choice;
use planar_capture::error::Error;
use planar_capture::layout::Layout;
use planar_capture::quantities::Difference;
use planar_capture::quantity::Quantity;
use planar_capture::registry::{Robots, SHIPPED};
use planar_capture::sampling::REGIMES;
use planar_proof::file;
use std::fs;
use std::path::Path;

#[test]
fn every_quantity_is_printed_and_its_worst_state_can_be_replayed() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("compare");
    let folder = folder.to_str().expect("UTF-8");
    let arguments = ["compare", "dual_arm_3r", "--samples", "5", "--seed", "7", "--out", folder];
    let (code, table, problems) = said(&arguments);
    assert_eq!((code, problems.as_str()), (0, ""));
    assert!(table.contains("65 states, 5 of each regime, seed 7"), "{table}");
    assert_eq!(said(&arguments).1, table, "the same seed, the same states");
    for quantity in Quantity::ALL.iter().map(|quantity| quantity.row()) {
        assert!(table.lines().any(|line| line.trim_start().starts_with(quantity.name)), "{} is missing", quantity.name);
        let name = quantity.name.replace([' ', '.'], "_");
        for dynamics in ["generated", "generic"] {
            let (layout, states) = (format!("{folder}/{name}.toml"), format!("{folder}/{name}.json"));
            let (code, results, problems) = said(&["eval", &layout, &states, "--dynamics", dynamics]);
            assert_eq!((code, problems.as_str()), (0, ""));
            assert!(results.contains("mass_matrix"));
        }
    }
}

/// Mounts two micrometres apart cost the generated accelerations six digits: over the bound, exit code 1.
#[test]
fn the_exit_code_says_that_a_bound_is_exceeded() {
    let folder = tempfile::tempdir().expect("a folder");
    let (_, text) = SHIPPED.iter().find(|(name, _)| *name == "dual_arm_3r").expect("shipped");
    let path = folder.path().join("close.toml");
    std::fs::write(&path, text.replace("[-0.5, 0.0]", "[0.499998, 0.0]")).expect("written");
    let (path, results) = (path.display().to_string(), folder.path().join("worst").display().to_string());
    let (code, out, err) = said(&["compare", &path, "--samples", "20", "--out", &results]);
    assert_eq!(code, 1, "{out}{err}");
    assert!(out.contains("over its bound"), "{out}");
}

#[test]
fn a_layout_is_written_so_that_it_reads_back() {
    for (name, text) in SHIPPED {
        let layout = Layout::parse(text, name).expect("good");
        for regime in REGIMES {
            let layout = regime.sample(&layout, 3, 4).layout;
            let again = Layout::parse(&layout.to_toml(), name).expect("good");
            assert_eq!(again, layout);
        }
    }
}

/// One state in which every quantity has this error.
fn comparison(error: f64) -> Comparison {
    let (_, text) = SHIPPED.first().expect("there are some");
    let sample = REGIMES[0].sample(&Layout::parse(text, "shipped").expect("good"), 1, 0);
    Comparison {
        states: 1,
        largest_errors: Quantity::ALL
            .iter()
            .map(|&quantity| LargestError {
                difference: Difference { quantity, error, condition: 1.0 },
                regime: REGIMES[0],
                index: 0,
                sample: sample.clone(),
            })
            .collect(),
        refusals: Vec::new(),
    }
}

#[test]
fn an_error_over_its_bound_is_no_agreement() {
    assert!(comparison(1e-14).agrees());
    assert!(!comparison(2e-12).agrees());
    assert!(!comparison(f64::NAN).agrees());
    assert!(!Comparison::default().agrees(), "what was not compared does not agree");
}

/// States that both implementations refuse are no difference, states that one of them refuses are.
#[test]
fn a_refusal_of_one_side_is_no_agreement() {
    let singular = || Some(Error::Singular { what: "a matrix", pivot: 0.0, limit: 1e-15 });
    let agrees = |generated: Option<Error>, generic: Option<Error>| {
        let refusals = vec![Refusal { regime: REGIMES[0], index: 0, generated, generic }];
        Comparison { refusals, ..comparison(1e-14) }.agrees()
    };
    assert!(agrees(singular(), singular()));
    assert!(!agrees(singular(), None) && !agrees(None, singular()));
}

/// Links far shorter or longer than the rest: the reference, which once subtracted positions, has their digits too.
#[test]
fn links_of_any_length_agree() {
    let text = fs::read_to_string(file("codegen/layouts/single_arm_3r.toml")).expect("a layout");
    let valid = Layout::parse(&text, "single_arm_3r.toml").expect("a layout");
    for (link, length) in [(0, 1e4), (0, 1e-6), (1, 1e-9), (1, 1e-12), (2, 1e-6), (2, 1e-20), (2, 1e-90)] {
        let mut layout = valid.clone();
        let changed = &mut layout.arms[0].links[link];
        (changed.length, changed.com) = (length, [length / 2.0, 0.0]);
        let comparison = planar_capture::compare::compare(
            &layout,
            &Choice::generated(&layout, Robots::SHIPPED).expect("its code"),
            100,
            7,
        );
        let over = comparison.largest_errors.iter().filter(|largest| largest.difference.ratio() > 1.0);
        let over: Vec<_> = over.map(|largest| (&largest.difference, largest.index)).collect();
        assert!(comparison.agrees(), "link {link} of {length} m: {over:?}");
    }
}
