//! Reaction wheels after a capture.
//!
//! # Example
//! ```
//! use planar_capture::capture::post_capture::wheels;
//! use planar_capture::layout::Layout;
//!
//! // arms of three and two links, and a reaction wheel
//! let layout = Layout::read("codegen/layouts/asymmetric_wheel.toml".as_ref()).expect("a layout");
//! assert_eq!(wheels(&layout, &[]), [false, false, false, false, false, true]);
//! ```

use crate::capture::assembly::Attachment;
use crate::layout::{Arm, Layout};

/// Which joints turn balanced reaction wheels: arms of one link of length 0 with its COM on the axis that hold no
/// target.
#[must_use]
pub fn wheels(layout: &Layout, attachments: &[Attachment]) -> Vec<bool> {
    let arms = layout.arms.iter().enumerate();
    let free = |i: usize| attachments.iter().all(|attachment| attachment.arm != i);
    arms.flat_map(|(i, arm)| std::iter::repeat_n(free(i) && is_wheel(arm), arm.links.len())).collect()
}

fn is_wheel(arm: &Arm) -> bool {
    matches!(arm.links.as_slice(), [link] if [link.length, link.com[0], link.com[1]].iter().all(|size| *size == 0.0))
}
