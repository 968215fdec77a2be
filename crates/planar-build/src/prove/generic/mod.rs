//! The dynamics of any layout, computed from the equations: the reference for generated code.
//!
//! Written for clarity, by another formulation than the generated one, and from no code in common with it: every
//! body has a twist Jacobian `B_i(q)`, [ω, vx, vy] of its COM being `B_i v` with v the base twist and the joint rates.
//! With `I_i` = diag(inertia, mass, mass), eq. (1) is
//!
//! - M = Σ Bᵢᵀ Iᵢ Bᵢ, bias = Σ Bᵢᵀ Iᵢ Ḃᵢ v (a planar body has no gyroscopic term),
//!
//! and every system of equations is solved whole, by a dense Cholesky factorisation. Any number of arms and links,
//! centres of mass off the link's axis, mount angles, links of length zero. It allocates, and is many
//! times slower than generated code.
//!
//! # Example
//! ```
//! use planar_build::prove::generic::Generic;
//! use planar_dynamics::dynamics::Kinematics;
//! use planar_layout::layout::Layout;
//!
//! let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../codegen");
//! let layout = Layout::read(format!("{folder}/layouts/dual_arm_3r.toml").as_ref())?;
//! let (robot, mut poses) = (Generic::new(&layout), [[0.0; 3]; 2]);
//! robot.end_effector_poses(&[0.0; 3], &[0.0; 6], &mut poses)?;
//! // both arms stretched along x: three links of 1 m from mounts at 0.5 m and −0.5 m
//! assert_eq!(poses, [[0.0, 3.5, 0.0], [0.0, 2.5, 0.0]]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod configuration;
mod equations;
mod functions;
mod impact;
mod merge;
mod momentum;
mod reduced;

use configuration::{Configuration, GenericState};
use nalgebra::{Cholesky, DMatrix, DVector, Dyn};
use planar_dynamics::dynamics::Robot;
use planar_dynamics::error::Error;
use planar_dynamics::validate::{array, finite, length, pivot, store, store_rows};
use planar_layout::layout::{Base, Layout, Link};

/// A rigid body with its frame at its joint; the base has no joint and its frame at its COM.
#[derive(Clone, Debug, PartialEq)]
struct Body {
    /// kg.
    mass: f64,
    /// About its COM, kg m².
    inertia: f64,
    /// In its frame, m.
    com: [f64; 2],
    /// The frame of its joint; `None` for the base.
    joint: Option<MountedFrame>,
}

/// A frame fixed to a body: of a joint, or of an end effector.
#[derive(Clone, Debug, PartialEq)]
struct MountedFrame {
    /// Which body.
    body: usize,
    /// In the body's frame, m.
    position: [f64; 2],
    /// Direction from the body's x axis, rad.
    angle: f64,
}

/// A robot of any layout, with its numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Generic {
    /// The base, then the links arm by arm; body i > 0 is moved by joint i − 1.
    bodies: Vec<Body>,
    /// One per arm.
    end_effectors: Vec<MountedFrame>,
}

impl Generic {
    /// The robot that a layout describes.
    #[must_use]
    pub fn new(layout: &Layout) -> Self {
        let Base { mass, inertia, .. } = layout.base;
        let mut bodies = vec![Body { mass, inertia, com: [0.0; 2], joint: None }];
        let mut end_effectors = Vec::with_capacity(layout.arms.len());
        for arm in &layout.arms {
            // of the next joint, at last of the end effector
            let mut frame = MountedFrame { body: 0, position: arm.mount, angle: arm.mount_angle };
            for link in &arm.links {
                let Link { mass, inertia, com, .. } = *link;
                bodies.push(Body { mass, inertia, com, joint: Some(frame) });
                frame = MountedFrame { body: bodies.len() - 1, position: [link.length, 0.0], angle: 0.0 };
            }
            end_effectors.push(frame);
        }
        Self { bodies, end_effectors }
    }

    /// Number of full coordinates: the base's three, then the joints.
    fn size(&self) -> usize {
        3 + self.joints()
    }
}

impl Robot<f64> for Generic {
    fn arms(&self) -> usize {
        self.end_effectors.len()
    }

    fn joints(&self) -> usize {
        self.bodies.len() - 1
    }

    fn body_inertias(&self, inertias: &mut [[f64; 2]]) -> Result<(), Error> {
        let values: Vec<[f64; 2]> = self.bodies.iter().map(|body| [body.mass, body.inertia]).collect();
        store_rows("body_inertias", &values, inertias)
    }
}

/// v: the base twist, then the joint rates.
fn velocity(base_twist: &[f64; 3], joint_rates: &[f64]) -> DVector<f64> {
    DVector::from_iterator(3 + joint_rates.len(), base_twist.iter().chain(joint_rates).copied())
}

/// Copies a matrix out, row by row.
fn store_matrix(quantity: &'static str, matrix: &DMatrix<f64>, into: &mut [f64]) -> Result<(), Error> {
    // columns of the transpose are rows
    store(quantity, matrix.transpose().as_slice(), into)
}

/// Copies a velocity or an acceleration out: the joints' part to a slice, the base's as the result.
fn store_split(names: [&'static str; 2], vector: &DVector<f64>, joints: &mut [f64]) -> Result<[f64; 3], Error> {
    let (base, rest) = vector.as_slice().split_at(3);
    finite(names[0], base)?;
    store(names[1], rest, joints)?;
    array(names[0], base).copied()
}

/// The Cholesky factorisation A = L Lᵀ.
///
/// # Errors
/// [`Error::NotFinite`]; [`Error::Singular`] with the smallest pivot `L_kk²` over `A_kk`, or 0 where the factorisation
/// met a pivot that is not positive.
fn factor(what: &'static str, matrix: &DMatrix<f64>) -> Result<Cholesky<f64, Dyn>, Error> {
    finite(what, matrix.as_slice())?;
    let limit = 8.0 * f64::EPSILON;
    let Some(factors) = matrix.clone().cholesky() else {
        return Err(Error::Singular { what, pivot: failing_pivot(matrix), limit });
    };
    let lower = factors.l_dirty();
    let ratios = (0..matrix.nrows()).map(|k| lower[(k, k)] * lower[(k, k)] / matrix[(k, k)]);
    pivot(what, ratios.fold(1.0, f64::min))?;
    Ok(factors)
}

/// The first pivot that is not positive, relative to its diagonal entry: the Schur complement of the leading block.
fn failing_pivot(matrix: &DMatrix<f64>) -> f64 {
    let pivots = (0..matrix.nrows()).filter_map(|k| {
        let (leading, column) = (matrix.view((0, 0), (k, k)).into_owned().cholesky()?, matrix.view((0, k), (k, 1)));
        Some((matrix[(k, k)] - column.dot(&leading.solve(&column))) / matrix[(k, k)].abs().max(f64::MIN_POSITIVE))
    });
    pivots.fold(f64::INFINITY, f64::min)
}
