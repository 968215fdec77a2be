//! Cost and accuracy of the integrators: the paper's approach and free motion by every integrator in both coordinates.
//! `docs/integrators.md` and its figures are what is computed; with the variable [`WRITE`] they are written.
//!
//! Work is counted in evaluations of the derivative, which does not depend on the machine.

mod figure;
mod long_time;
mod method;
mod motion;
mod report;
mod work;

use planar_capture::output::atomic_file::{create_folder, write_text};
use planar_capture::output::figures::Width;
use planar_capture::output::figures::draw::svg;
use planar_proof::file;

/// Any error.
type Problem = Box<dyn std::error::Error + Send + Sync>;

/// With this variable the report is written.
const WRITE: &str = "PLANAR_CAPTURE_WRITE";

const MEND: &str = "PLANAR_CAPTURE_WRITE=1 cargo test --features figures --test integrators";

#[test]
fn the_report_is_what_is_computed() -> Result<(), Problem> {
    for (path, text) in compute()? {
        let file = file(&format!("docs/{path}"));
        if std::env::var_os(WRITE).is_some() {
            create_folder(file.parent().ok_or("no folder")?)?;
            write_text(&file, &text)?;
        }
        let is_fresh = std::fs::read_to_string(&file).is_ok_and(|found| found == text);
        assert!(is_fresh, "docs/{path} is not up to date; run: {MEND}");
    }
    Ok(())
}

/// Path below `docs`, and content.
fn compute() -> Result<Vec<(&'static str, String)>, Problem> {
    let (works, motions) = std::thread::scope(|scope| {
        let others = [scope.spawn(work::approach), scope.spawn(work::tumbling)];
        (others.map(|other| other.join().expect("no panic")), long_time::motions())
    });
    let ([approach, tumbling], motions) = (works, motions?);
    let works = [approach?, tumbling?];
    Ok(vec![
        ("integrators.md", report::write(&works, &motions)?),
        ("integrators/work_precision.svg", svg(&figure::work_precision(&works), Width::Page)),
        ("integrators/long_time.svg", svg(&figure::long_time(&motions), Width::Page)),
    ])
}
