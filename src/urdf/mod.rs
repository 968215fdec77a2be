//! Layouts from URDF files, and URDF files from layouts.
//!
//! [`import`] takes a tree of links with parallel revolute joints as a free-floating planar robot and says what each
//! joint became and what was left out; [`export`] writes a layout for other simulators. What a layout cannot hold is an
//! [`UrdfError`] that names the link or joint.

mod body;
mod chain;
mod document;
mod error;
mod export;
mod group;
mod import;
mod names;
mod omission;
mod planar_body;
mod plane;
mod reader;
mod scan;
mod tip;
mod tree;

pub use document::Remark;
pub use error::UrdfError;
pub use export::export;
pub use import::{ImportOptions, ImportedJoint, ImportedLayout, import};
