//! Converts URDF files to layouts and layouts to URDF files.
//!
//! [`import`] reads a tree of links with parallel revolute joints as a free-floating planar robot, with the relation of
//! the joint angles and remarks on what is omitted; [`export`] writes a layout for other simulators. What a layout
//! cannot represent is an [`UrdfError`] that names the link or joint.

mod chain;
mod description;
mod end_effector;
mod error;
mod export;
mod finite;
mod import;
mod imported_layout;
mod link_group;
mod names;
mod omissions;
mod planar_body;
mod planar_part;
mod plane;
mod reader;
mod remark;
mod spatial_body;
mod tree;
mod xml;

pub use error::UrdfError;
pub use export::export;
pub use import::{ImportOptions, import};
pub use imported_layout::{ImportedJoint, ImportedLayout};
pub use planar_part::HeldJoint;
pub use remark::Remark;
