//! Reads states from a JSON array of any length, one at a time, and writes states and values as JSON.
//!
//! `[{base_pose, joint_angles, base_twist, joint_rates, joint_torques?, base_wrench?, end_effector_wrenches?,
//! targets?}, …]`; an optional entry may be `null`.
//!
//! # Example
//! ```
//! use planar_capture::eval::{States, result_to_json};
//! use planar_capture::evaluation::evaluate;
//! use planar_capture::layout::Layout;
//! use planar_capture::registry::generic;
//!
//! let layout = Layout::read("codegen/layouts/single_arm_3r.toml".as_ref())?;
//! let text = r#"[{ "base_pose": [0, 0, 0], "joint_angles": [0.3, -0.6, 1.2],
//!                  "base_twist": [0, 0.1, 0], "joint_rates": [0, 0, 0] }]"#;
//! let mut states = States::new(text.as_bytes(), &layout);
//! let state = states.next_state()?.expect("the first state");
//! let values = result_to_json(&evaluate(&*generic(&layout), &state)?, &state.targets);
//! // 530 kg at 0.1 m/s
//! let energy = values["kinetic_energy"].as_f64().expect("a number");
//! assert!((energy - 0.5 * 530.0 * 0.1 * 0.1).abs() < 1e-12);
//! assert_eq!(states.next_state()?, None);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod elements;
mod magnitude;
mod places;
mod reader;
mod result;
mod write;

use crate::evaluation::EvaluationInput;
use crate::layout::Layout;
use elements::Elements;
pub use result::result_to_json;
use std::io::{self, BufRead};
pub use write::to_json;

/// Why a state cannot be read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StateError {
    /// The file cannot be read.
    #[error("cannot be read: {0}")]
    Unreadable(#[from] io::Error),
    /// The text is not an array of states.
    #[error("line {line}: {message}")]
    Text {
        /// Counted from 1.
        line: usize,
        /// Expected and found text.
        message: String,
    },
    /// One state is invalid; those before it are valid.
    #[error("line {line}: state {index}: {message}")]
    State {
        /// Line of the invalid value, counted from 1.
        line: usize,
        /// Counted from 0.
        index: usize,
        /// Key, value and what is expected.
        message: String,
    },
}

/// The states of a JSON text; holds one state in memory at a time.
pub struct States<'a, R> {
    elements: Elements<R>,
    layout: &'a Layout,
    /// Of the last state.
    line: usize,
}

impl<'a, R: BufRead> States<'a, R> {
    /// States of a robot, read from `input`.
    pub fn new(input: R, layout: &'a Layout) -> Self {
        Self { elements: Elements::new(input), layout, line: 1 }
    }

    /// The line that the last state starts on, counted from 1.
    pub fn line(&self) -> usize {
        self.line
    }

    /// The next state; `None` after the last.
    ///
    /// # Errors
    /// [`StateError`]; the states after it cannot be read.
    pub fn next_state(&mut self) -> Result<Option<EvaluationInput>, StateError> {
        let Some(element) = self.elements.next_element()? else { return Ok(None) };
        self.line = element.line;
        let read = reader::read(element.text, self.layout);
        read.map(Some).map_err(|(line, message)| StateError::State {
            line: element.line + line,
            index: element.index,
            message,
        })
    }
}
