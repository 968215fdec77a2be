//! Paths to a key of a scenario or of its layout, as sweeps name what they vary.

use super::FORMAT;
use crate::format::{NoKey, Place, find, find_below};
use crate::layout;

/// The file that has a key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum KeyFile {
    /// The scenario.
    Scenario,
    /// The layout that it names.
    Layout,
}

/// The key at a path: `target.ball.mass`, `approach.proportional_gain[2]`, `case."my.case".target_twists.ball[0]`; and of
/// the layout after `layout.`, `layout.arm.arm1.link[0].mass`. [`find`] has the notation.
///
/// ```
/// use planar_capture::scenario::{KeyFile, find_key};
///
/// let (file, place) = find_key("layout.arm.arm1.link[0].mass")?;
/// let rule = place.number().expect("one number");
/// assert_eq!((file, place.keys[0].name, rule.unit()), (KeyFile::Layout, "mass", "kg"));
///
/// let wrong = find_key("approach.proportional_gian[2]").unwrap_err();
/// assert_eq!(wrong.nearest.as_deref(), Some("approach.proportional_gain[2]"));
/// assert_eq!(find_key("base.mass").unwrap_err().nearest.as_deref(), Some("layout.base.mass"));
/// # Ok::<(), planar_capture::format::NoKey>(())
/// ```
///
/// # Errors
/// [`NoKey`] with the nearest path.
pub fn find_key(path: &str) -> Result<(KeyFile, Place), NoKey> {
    match find_below("layout", &layout::FORMAT, path) {
        Some(place) => Ok((KeyFile::Layout, place?)),
        None => find(&FORMAT, path).map(|place| (KeyFile::Scenario, place)).map_err(|wrong| below_layout(path, wrong)),
    }
}

/// What is wrong with a path, with the layout's key where the path would lead to one after `layout.`.
fn below_layout(path: &str, wrong: NoKey) -> NoKey {
    let meant = format!("layout.{path}");
    match find_below("layout", &layout::FORMAT, &meant) {
        Some(Ok(_)) => {
            let why = format!("it is a key of the layout; did you mean `{meant}`?");
            NoKey { why, nearest: Some(meant), ..wrong }
        }
        _ => wrong,
    }
}
