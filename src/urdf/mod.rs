//! Converts URDF files to layouts and layouts to URDF files.
//!
//! [`import`] reads a tree of links with parallel revolute joints as a free-floating planar robot, with the relation of
//! the joint angles and remarks on what is omitted; [`export`] writes a layout for other simulators. What a layout
//! cannot represent is an [`UrdfError`] that names the link or joint.
//!
//! # Example
//! ```
//! use planar_capture::layout::Layout;
//! use planar_capture::urdf::{ImportOptions, export, import};
//!
//! let layout = Layout::read("codegen/layouts/dual_arm_3r.toml".as_ref())?;
//! let urdf = export(&layout);
//! // the second arm's first joint turns about an axis into the plane
//! let (before, after) = urdf.split_once("\"arm2_joint1\"").expect("its joint");
//! let urdf = format!("{before}\"arm2_joint1\"{}", after.replacen("\"0 0 1\"", "\"0 0 -1\"", 1));
//! let imported = import(&urdf, &ImportOptions::default())?;
//! assert_eq!(imported.layout.mass(), 560.0); // kg
//! let signs: Vec<f64> = imported.joints.iter().map(|joint| joint.sign).collect();
//! assert_eq!(signs, [1.0, 1.0, 1.0, -1.0, 1.0, 1.0]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

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
