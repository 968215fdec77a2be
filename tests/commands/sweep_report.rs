//! `planar-capture sweep --report`: the page and its pictures.

use crate::command;
use planar_proof::{file, said};
use std::fs;
use std::path::Path;
use tempfile::TempDir;

/// The page of a sweep of the scenario for sweeps, with what varies.
fn page(folder: &Path, rest: &str) -> String {
    let scenario = file("scenarios/sweeps/capture.toml");
    let head = format!("name = \"reported\"\nscenario = '{}'\nseed = 1\n", scenario.display());
    fs::write(folder.join("sweep.toml"), head + rest).expect("written");
    let mut command = command();
    command.arg("sweep").arg("sweep.toml").args(["--out", "out", "--report", "-q"]).current_dir(folder);
    let (code, _, err) = said(command.output().expect("it runs"));
    assert_eq!(code, 0, "{err}");
    written(folder)
}

/// The page, without the places where names may go on in the next line.
fn written(folder: &Path) -> String {
    fs::read_to_string(folder.join("out/report.html")).expect("a report").replace("<wbr>", "")
}

/// Outputs are asked for by the first words of their names; of an unknown one nothing is computed.
#[test]
fn pictures_of_some_outputs_can_be_asked_for() {
    let folder = TempDir::new().expect("a folder");
    let rest = format!("cases = 20\n{MASS}distribution = {{ uniform = {{ min = 8.0, max = 12.0 }} }}\n");
    let default = page(folder.path(), &rest);
    let with = |list: &str| {
        let mut command = command();
        command
            .arg("sweep")
            .arg("sweep.toml")
            .args(["--out", "out", "--report", "-q", list])
            .current_dir(folder.path());
        said(command.output().expect("it runs"))
    };
    let (code, _, err) = with("--figures=least_distance,arm1_impulse");
    if cfg!(not(feature = "figures")) {
        assert!(code == 2 && err.contains("--features figures"), "{err}");
        return;
    }
    assert_eq!((code, err.as_str()), (0, ""));
    let some = fs::read_to_string(folder.path().join("out/report.html")).expect("a report");
    let names: Vec<_> = some.split("<h3>").skip(1).filter_map(|rest| rest.split('<').next()).collect();
    assert!(
        names.len() > 1
            && names.iter().all(|name| name.starts_with("least_distance") || name.starts_with("arm1_impulse")),
        "{names:?}"
    );
    assert!(some.contains("<h3>arm1_impulse") && some != default, "{names:?}");
    let (code, _, err) = with("--figures=arm1_impulze_n");
    assert!(
        code == 2 && err.contains("the sweep has no output `arm1_impulze_n`: did you mean `arm1_impulse_n`?"),
        "{err}"
    );
}

const MASS: &str = "[[vary]]\nkey = \"target.target1.mass\"\n";

#[test]
fn the_page_needs_nothing_beside_it_and_has_the_same_bytes_again() {
    let folder = TempDir::new().expect("a folder");
    let sweep = format!("cases = 60\n{MASS}distribution = {{ uniform = {{ min = 8.0, max = 12.0 }} }}\n");
    let found = page(folder.path(), &sweep);
    assert_eq!(found, page(folder.path(), &sweep));
    assert!(!found.contains("<script") && !found.contains("href=\"http") && !found.contains("src=\"http"));
    let images = found.matches("src=\"data:image/svg+xml;charset=utf-8,%3Csvg").count();
    assert_eq!(images, found.matches("<img").count());
    if cfg!(feature = "figures") {
        assert_eq!(images, 3 * found.matches("<h3>").count(), "three of each output");
        assert!(images > 20, "{images}");
        for expected in ["60 of 60 cases in", "all 60 cases", "target.target1.mass [kg]"] {
            assert!(found.contains(expected), "no `{expected}`");
        }
    } else {
        assert!(found.contains("without the feature <code>figures</code>"));
    }
}

#[test]
fn sweeps_without_anything_to_draw_have_a_page_all_the_same() {
    for (choices, expected) in [("[10.0]", "1 case: 1 done"), ("[-1.0, 10.0, -2.0]", "3 cases: 1 done, 2 refused")] {
        let folder = TempDir::new().expect("a folder");
        let rest = format!("sampling = \"grid\"\n{MASS}distribution = {{ choice = {choices} }}\n");
        let found = page(folder.path(), &rest);
        assert!(found.contains(expected) && found.ends_with("</html>\n"), "{found}");
        assert!(!found.contains("<img"), "{found}");
    }
}

/// Failures that differ in numbers alone are one kind, outputs that differ by rounding are no results, and the page says what was
/// computed.
#[test]
fn the_page_says_what_was_computed_and_what_failed() {
    let folder = TempDir::new().expect("a folder");
    let rest = format!(
        "sampling = \"grid\"\n{MASS}distribution = {{ choice = [10.0, -1.0, -2.0, 11.0, -3.0, 12.0, 13.0, 14.0, 15.0, 16.0] }}\n"
    );
    let found = page(folder.path(), &rest);
    for expected in [
        "scenario <b>capture</b>, case <b>case2</b>, robot <b>dual_arm_3r</b>, sampling <b>grid</b>, seed <b>1</b>",
        "<td>target.target1.mass [kg]</td><td>one of 10.0, -1.0, -2.0, 11.0, -3.0, 12.0, 13.0, 14.0, 15.0, 16.0</td>",
        "<td>3</td><td>1</td><td>refused</td><td>",
        "<h2>The same in all cases</h2>",
        "captured in <b>7</b> of 7 cases with a result, 100.0\u{a0}%",
        "arm1_impulse_magnitude <small>N s</small>",
    ] {
        assert!(found.contains(expected), "no `{expected}`");
    }
    assert_eq!(found.matches("<td>refused</td>").count(), 1);
    let (_, same) = found.split_once("The same in all cases").expect("a section");
    for rounding in ["momentum_jump_l", "approach_momentum_drift", "post_impact_energy_error"] {
        assert!(same.contains(rounding), "{rounding}");
        assert!(!found.contains(&format!("<td>{rounding}")), "{rounding} is rounding");
    }
    for without_numbers in ["status (", "message ("] {
        assert!(!same.contains(without_numbers), "{without_numbers}: the same in no case");
    }
}

/// The most frequent kind of failure is the first one, whichever fails first.
#[test]
fn failures_are_in_the_order_of_their_frequency() {
    let folder = TempDir::new().expect("a folder");
    let rest =
        format!("sampling = \"grid\"\n{MASS}distribution = {{ choice = [1e90, -1.0, 10.0, 11.0, -2.0, -3.0] }}\n");
    let found = page(folder.path(), &rest);
    let place = |row: &str| found.find(row).unwrap_or_else(|| panic!("no `{row}` in {found}"));
    let (often, once) = ("<td>3</td><td>1</td><td>refused</td>", "<td>1</td><td>0</td><td>");
    assert!(place(often) < place(once), "the one that failed first is above the one that failed most often");
}

/// A file of cases that is damaged is computed again, and the page is that of the whole ones.
#[test]
fn a_damaged_file_of_cases_is_computed_again() {
    let folder = TempDir::new().expect("a folder");
    let rest = format!("sampling = \"grid\"\n{MASS}distribution = {{ choice = [10.0, 11.0] }}\n");
    let whole = page(folder.path(), &rest);
    let block = folder.path().join("out/cases/000000.parquet");
    let mut bytes = fs::read(&block).expect("cases");
    // but for its end, which has the number of rows
    bytes[4..400].fill(0);
    fs::write(&block, bytes).expect("written");
    let mut again = command();
    again.args(["sweep", "sweep.toml", "--out", "out", "--report", "-q"]).current_dir(folder.path());
    let (code, _, err) = said(again.output().expect("it runs"));
    let expected = "warning: out/cases/000000.parquet is damaged, ";
    assert!(code == 0 && err.starts_with(expected) && err.contains("computed again"), "{code}: {err}");
    assert_eq!(written(folder.path()), whole);
    assert_eq!(page(folder.path(), &rest), whole);
}

/// Extremes are of cases by their own numbers, not by their places among those with a result.
#[test]
fn extremes_are_of_cases_with_results() {
    let folder = TempDir::new().expect("a folder");
    let rest = format!("sampling = \"grid\"\n{MASS}distribution = {{ choice = [-1.0, 10.0, 12.0, -2.0, 14.0] }}\n");
    let found = page(folder.path(), &rest);
    let (_, table) = found.split_once("<h2>Extremes</h2>").expect("a section");
    let (table, _) = table.split_once("</table>").expect("an end");
    let rows = table.lines().skip(2).map(|row| row.split("<td>").skip(1).map(|cell| cell.split('<').next()));
    let cases: Vec<[&str; 2]> = rows.map(|row| row.flatten().collect::<Vec<_>>()).map(|row| [row[2], row[4]]).collect();
    assert!(cases.len() > 5 && cases.iter().flatten().all(|case| ["1", "2", "4"].contains(case)), "{cases:?}");
    // what rises or falls with the mass has its extremes at the ends of it
    for ends in [["1", "4"], ["4", "1"]] {
        assert!(cases.contains(&ends), "{cases:?}");
    }
}
