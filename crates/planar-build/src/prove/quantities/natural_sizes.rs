//! The natural size of every entry, and the condition numbers that magnify rounding.
//!
//! An entry's size is the sum of the magnitudes of what makes it up, computed from the layout's lengths alone: the
//! bounds |B| of the body Jacobians put into the same equations. So a folded arm's small inertia is measured against
//! the lengths that cancel in it, and an arm's entries never against the base's.

use super::magnitudes::{Magnitudes, Point, captured, convective, inertia};
use super::system::System;
use crate::prove::evaluation::Values;
use crate::prove::sampling::RegimeSample;
use nalgebra::{DMatrix, DVector, Vector3};
use planar_dynamics::quantity::Quantity;
use planar_dynamics::with_quantities;
use std::collections::BTreeMap;

/// Sizes of one quantity's entries.
#[derive(Clone, Debug, PartialEq)]
pub struct NaturalSize {
    /// One per entry, row-major.
    pub sizes: Vec<f64>,
    /// Of the matrices solved on the way, 1 without any.
    pub condition: f64,
}

/// Of every quantity that a sample has; `values` are those of the reference.
#[must_use]
pub fn natural_sizes(sample: &RegimeSample, values: &Values) -> BTreeMap<Quantity, NaturalSize> {
    let at_com = SizesAt::new([0.0; 2], sample, values);
    // where forward dynamics balances the base
    let at_mount = SizesAt::new(sample.layout.arms.first().map_or([0.0; 2], |arm| arm.mount), sample, values);
    let mut all = Sizes::default();
    at_com.functions(&mut all);
    at_com.momentum(&mut all);
    at_com.reduced(&mut all);
    at_mount.accelerations(&mut all);
    if sample.instant.targets.iter().any(Option::is_some) {
        at_com.reduced_impact(&mut all);
        at_com.capture(&mut all);
        at_mount.merged_accelerations(&mut all);
    }
    all.0
}

/// Sizes by quantity.
#[derive(Default)]
struct Sizes(BTreeMap<Quantity, NaturalSize>);

impl Sizes {
    /// Of a quantity that no equation is solved for.
    fn direct(&mut self, quantity: Quantity, sizes: impl Into<Vec<f64>>) {
        self.solved(quantity, sizes, 1.0);
    }

    fn solved(&mut self, quantity: Quantity, sizes: impl Into<Vec<f64>>, condition: f64) {
        self.0.insert(quantity, NaturalSize { sizes: sizes.into(), condition });
    }
}

/// Magnitudes of everything at one state, with the twist of one point of the base as its coordinates; hats are left out of
/// the names.
struct SizesAt<'a> {
    sample: &'a RegimeSample,
    /// The point from the base's COM, inertial axes.
    point: [f64; 2],
    magnitudes: Magnitudes,
    mass_matrix: DMatrix<f64>,
    end_effector_jacobian: DMatrix<f64>,
    /// |v|.
    speeds: DVector<f64>,
    /// Of the reference, for the matrices and solutions.
    values: &'a Values,
}

macro_rules! functions {
    (
        functions { $($(#[$doc:meta])* trait $trait:ident {
            $($(#[$of_method:meta])* $quantity:ident $method:ident($inputs:ident) $kind:ident $extents:tt $unit:literal, $shown:expr;)*
        })* }
        results $results:tt
    ) => {
        /// The functions of configuration or state alone, each by the method of its name.
        fn functions(&self, all: &mut Sizes) {
            $($(all.direct(Quantity::$quantity, self.$method());)*)*
        }
    };
}

/// Functions of configuration or state alone: the formulas of the generic implementation, of magnitudes.
impl SizesAt<'_> {
    fn body_poses(&self) -> Vec<f64> {
        self.magnitudes.bodies.iter().flat_map(|body| self.pose(body)).collect()
    }

    fn body_twists(&self) -> Vec<f64> {
        self.magnitudes.bodies.iter().flat_map(|body| self.twist(body)).collect()
    }

    fn end_effector_poses(&self) -> Vec<f64> {
        self.magnitudes.end_effectors.iter().flat_map(|point| self.pose(point)).collect()
    }

    fn end_effector_twists(&self) -> Vec<f64> {
        self.magnitudes.end_effectors.iter().flat_map(|point| self.twist(point)).collect()
    }

    fn end_effector_jacobian(&self) -> Vec<f64> {
        rows(&self.end_effector_jacobian)
    }

    fn mass_matrix(&self) -> Vec<f64> {
        rows(&self.mass_matrix)
    }

    fn bias(&self) -> Vec<f64> {
        self.convective_forces().as_slice().to_vec()
    }
}

impl<'a> SizesAt<'a> {
    /// `point` in the base's frame.
    fn new(point: [f64; 2], sample: &'a RegimeSample, values: &'a Values) -> Self {
        let magnitudes = Magnitudes::about(point, sample);
        let state = &sample.instant.state;
        let (sin, cos) = libm::sincos(state.base_pose[0]);
        let point = [cos * point[0] - sin * point[1], sin * point[0] + cos * point[1]];
        let size = 3 + sample.layout.joints();
        let speeds = state.base_twist.iter().chain(&state.joint_rates).map(|v| v.abs());
        let speeds = DVector::from_iterator(size, speeds);
        let mass_matrix = magnitudes.mass_matrix(size);
        let end_effector_jacobian = magnitudes.end_effector_jacobian(size);
        Self { sample, point, magnitudes, mass_matrix, end_effector_jacobian, speeds, values }
    }

    with_quantities!(functions);

    /// The reference's values; empty where it has none.
    fn value(&self, quantity: Quantity) -> &[f64] {
        self.values.get(quantity).unwrap_or_default()
    }

    fn matrix(&self, quantity: Quantity) -> DMatrix<f64> {
        let values = self.value(quantity);
        let size = values.len().isqrt();
        DMatrix::from_row_slice(size, size, values)
    }

    /// M in these coordinates: `Tᵀ M T` with the base COM's velocity v + ω × -d.
    fn mass_matrix_of(&self, quantity: Quantity) -> DMatrix<f64> {
        let matrix = self.matrix(quantity);
        let mut shift = DMatrix::identity(matrix.nrows(), matrix.nrows());
        let [x, y] = self.point;
        shift[(1, 0)] = y;
        shift[(2, 0)] = -x;
        shift.transpose() * matrix * shift
    }

    fn pose(&self, point: &Point) -> [f64; 3] {
        let [_, x, y] = self.sample.instant.state.base_pose;
        let reach = point.jacobian[(1, 0)];
        [point.angle, x.abs() + reach, y.abs() + reach]
    }

    fn twist(&self, point: &Point) -> [f64; 3] {
        let twist = &point.jacobian * &self.speeds;
        [twist[0], twist[1], twist[2]]
    }

    fn convective_forces(&self) -> DVector<f64> {
        let parts = self.magnitudes.bodies.iter().map(|body| convective(body.mass, &body.jacobian, &self.speeds));
        parts.fold(DVector::zeros(self.speeds.len()), |sum, part| sum + part)
    }

    /// Momentum and energy, and the bodies' own inertias.
    fn momentum(&self, all: &mut Sizes) {
        let (mut linear, mut angular, mut energy) = ([0.0; 2], 0.0, 0.0);
        for body in &self.magnitudes.bodies {
            let ([omega, vx, vy], [_, x, y]) = (self.twist(body), self.pose(body));
            linear[0] += body.mass * vx;
            linear[1] += body.mass * vy;
            angular += body.inertia * omega + body.mass * (x * vy + y * vx);
            energy += body.inertia * omega * omega + body.mass * (vx * vx + vy * vy);
        }
        let inertias: Vec<f64> = self.magnitudes.bodies.iter().flat_map(|body| [body.mass, body.inertia]).collect();
        all.direct(Quantity::BodyInertias, inertias);
        all.direct(Quantity::LinearMomentum, linear);
        all.direct(Quantity::AngularMomentum, [angular]);
        all.direct(Quantity::KineticEnergy, [energy / 2.0]);
    }

    /// The base's block of M, which the reduced quantities solve with.
    fn base_condition(&self) -> f64 {
        let matrix = self.matrix(Quantity::MassMatrix).view((0, 0), (3, 3)).into_owned();
        System { sizes: &self.base(), matrix: &matrix }.condition()
    }

    fn base(&self) -> DMatrix<f64> {
        self.mass_matrix.view((0, 0), (3, 3)).into_owned()
    }

    /// I, c and J: what is subtracted is as large as what it is subtracted from.
    fn reduced(&self, all: &mut Sizes) {
        let (base, bias, condition) = (self.base(), self.convective_forces(), self.base_condition());
        let in_base = System { sizes: &base, matrix: &base }.norm(&bias.rows(0, 3).into_owned());
        let responses = self.base_responses();
        let bias: Vec<f64> = (3..bias.len()).map(|j| bias[j] + responses[j - 3] * in_base).collect();
        all.solved(Quantity::GeneralizedInertia, rows(&self.reduced_inertia()), condition);
        all.solved(Quantity::GeneralizedBias, bias, condition);
        all.solved(Quantity::GeneralizedJacobian, rows(&self.reduced_jacobian()), condition);
    }

    /// √ of a diagonal entry of M.
    fn root(&self, j: usize) -> f64 {
        self.mass_matrix[(j, j)].sqrt()
    }

    /// Sizes of D^½ `I_b⁻¹ I_bm`, one per joint: those of the solution and of what is solved for, √ of M's diagonal entry.
    fn base_responses(&self) -> Vec<f64> {
        let matrix = self.matrix(Quantity::MassMatrix);
        let base = matrix.view((0, 0), (3, 3)).into_owned();
        let Some(factor) = base.cholesky() else { return vec![f64::INFINITY; self.speeds.len() - 3] };
        let of_joint = |j: usize| {
            let response = factor.solve(&matrix.view((0, j), (3, 1)));
            self.root(j) + (0..3).map(|k| (self.root(k) * response[k]).powi(2)).sum::<f64>().sqrt()
        };
        (3..self.speeds.len()).map(of_joint).collect()
    }

    fn reduced_inertia(&self) -> DMatrix<f64> {
        let joints = self.speeds.len() - 3;
        DMatrix::from_fn(joints, joints, |j, k| self.root(3 + j) * self.root(3 + k))
    }

    fn reduced_jacobian(&self) -> DMatrix<f64> {
        let (jacobian, responses) = (&self.end_effector_jacobian, self.base_responses());
        DMatrix::from_fn(jacobian.nrows(), responses.len(), |row, j| {
            let of_base: f64 = (0..3).map(|k| jacobian[(row, k)] / self.root(k)).sum();
            jacobian[(row, 3 + j)] + of_base * responses[j]
        })
    }

    /// |F| + |bias|.
    fn forces(&self) -> DVector<f64> {
        let instant = &self.sample.instant;
        let [n, fx, fy] = instant.base_wrench.unwrap_or_default().map(f64::abs);
        let [x, y] = self.point.map(f64::abs);
        let wrench = [n + y * fx + x * fy, fx, fy];
        let forces = wrench.iter().chain(&instant.joint_torques).map(|force| force.abs());
        let forces = DVector::from_iterator(self.speeds.len(), forces) + self.convective_forces();
        let wrenches = instant.end_effector_wrenches.iter().flatten();
        let at_points = self.magnitudes.end_effectors.iter().zip(wrenches);
        at_points.fold(forces, |sum, (point, w)| sum + point.jacobian.transpose() * Vector3::from(w.map(f64::abs)))
    }

    fn accelerations(&self, all: &mut Sizes) {
        let matrix = self.mass_matrix_of(Quantity::MassMatrix);
        let system = System { sizes: &self.mass_matrix, matrix: &matrix };
        self.solution(&system, &self.forces(), [Quantity::BaseAcceleration, Quantity::JointAccelerations], all);
    }

    /// Sizes of a solution, which are those of two quantities: of the base and of the joints.
    fn solution(
        &self,
        system: &System<'_>,
        right: &DVector<f64>,
        quantities: [Quantity; 2],
        all: &mut Sizes,
    ) -> DVector<f64> {
        let condition = system.condition();
        let [x, y] = self.point;
        let mut solution = quantities.map(|part| self.value(part)).concat();
        if let [omega, vx, vy, ..] = solution.as_mut_slice() {
            *vx -= *omega * y;
            *vy += *omega * x;
        }
        let mut sizes = system.solution_sizes(right, &solution);
        if let [omega, vx, vy, ..] = sizes.as_mut_slice() {
            *vx += *omega * y.abs();
            *vy += *omega * x.abs();
        }
        let (base, joints) = sizes.split_at(3);
        all.solved(quantities[0], base, condition);
        all.solved(quantities[1], joints, condition);
        DVector::from_vec(sizes)
    }

    /// G, H and the joint rates after it; the base's condition goes into all of them.
    fn reduced_impact(&self, all: &mut Sizes) {
        let mut sizes = self.reduced_inertia();
        let mut momentum = &sizes * self.speeds.rows(3, self.speeds.len() - 3);
        self.add_contacts(&self.reduced_jacobian(), &mut sizes, &mut momentum);
        let (matrix, base) = (self.matrix(Quantity::ImpactMatrix), self.base_condition());
        let system = System { sizes: &sizes, matrix: &matrix };
        let after = system.solution_sizes(&momentum, self.value(Quantity::ImpactJointRates));
        all.solved(Quantity::ImpactMatrix, rows(&sizes), base);
        all.solved(Quantity::ImpactMomentum, momentum.as_slice(), base);
        all.solved(Quantity::ImpactJointRates, after, base * system.condition());
    }

    /// The exact capture, and the inertias of the robot that holds its targets: its mass matrix is M + `J_eᵀ N J_e`.
    fn capture(&self, all: &mut Sizes) {
        let (mut sizes, mut momentum) = (self.mass_matrix.clone(), &self.mass_matrix * &self.speeds);
        self.add_contacts(&self.end_effector_jacobian, &mut sizes, &mut momentum);
        let matrix = self.matrix(Quantity::MergedMassMatrix);
        let system = System { sizes: &sizes, matrix: &matrix };
        let velocities = [Quantity::CaptureBaseTwist, Quantity::CaptureJointRates];
        let speeds = self.solution(&system, &momentum, velocities, all);
        let condition = system.condition();
        let [twists, impulses] = self.targets(&speeds);
        all.solved(Quantity::CaptureTargetTwists, twists, condition);
        all.solved(Quantity::CaptureImpulses, impulses, condition);
        let roots = sizes.diagonal().map(f64::sqrt);
        let mass_matrix = &roots * roots.transpose();
        all.direct(Quantity::CaptureMomentum, (&mass_matrix * &speeds).as_slice());
        all.direct(Quantity::MergedBodyInertias, self.merged_inertias());
        all.direct(Quantity::MergedMassMatrix, rows(&mass_matrix));
    }

    /// Accelerations of the robot that holds its targets.
    fn merged_accelerations(&self, all: &mut Sizes) {
        let (mut sizes, mut forces) = (self.mass_matrix.clone(), self.forces());
        self.add_contacts(&self.end_effector_jacobian, &mut sizes, &mut DVector::zeros(self.speeds.len()));
        for (point, target) in self.magnitudes.end_effectors.iter().zip(&self.sample.instant.targets) {
            if let Some(target) = target {
                forces += convective(target.mass, &captured(target, &point.jacobian), &self.speeds);
            }
        }
        let matrix = self.mass_matrix_of(Quantity::MergedMassMatrix);
        let system = System { sizes: &sizes, matrix: &matrix };
        let accelerations = [Quantity::MergedBaseAcceleration, Quantity::MergedJointAccelerations];
        self.solution(&system, &forces, accelerations, all);
    }

    /// Twists after the capture and impulses, from the sizes of the velocities after it.
    fn targets(&self, speeds: &DVector<f64>) -> [Vec<f64>; 2] {
        let (mut twists, mut impulses) = (Vec::new(), Vec::new());
        for (point, target) in self.magnitudes.end_effectors.iter().zip(&self.sample.instant.targets) {
            let Some(target) = target else {
                twists.extend([0.0; 3]);
                impulses.extend([0.0; 3]);
                continue;
            };
            let twist = captured(target, &point.jacobian) * speeds;
            twists.extend(twist.iter());
            let change = twist + Vector3::from(target.twist.map(f64::abs));
            let change = inertia(target.mass, target.inertia) * change;
            let [rx, ry] = target.contact.map(f64::abs);
            impulses.extend([change[0] + ry * change[1] + rx * change[2], change[1], change[2]]);
        }
        [twists, impulses]
    }

    /// [mass, inertia] of every body, the last links with their targets.
    fn merged_inertias(&self) -> Vec<f64> {
        let mut bodies = self.magnitudes.bodies.iter().map(|body| [body.mass, body.inertia]);
        let mut inertias: Vec<_> = bodies.next().into_iter().collect();
        let RegimeSample { layout, instant } = self.sample;
        for ((arm, target), [length, com]) in layout.arms.iter().zip(&instant.targets).zip(&self.magnitudes.last) {
            inertias.extend(bodies.by_ref().take(arm.links.len()));
            if let (Some(target), Some([mass, inertia])) = (target, inertias.last_mut()) {
                let lever = length + com + libm::hypot(target.contact[0], target.contact[1]);
                *inertia += target.inertia + (*mass + target.mass) * lever * lever;
                *mass += target.mass;
            }
        }
        inertias.concat()
    }

    /// Adds Σ Kᵀ `I_t` K and Σ Kᵀ `I_t` |`t_ti`|, K = `J_t⁻¹` J.
    fn add_contacts(&self, jacobian: &DMatrix<f64>, matrix: &mut DMatrix<f64>, momentum: &mut DVector<f64>) {
        for (arm, target) in self.sample.instant.targets.iter().enumerate() {
            let Some(target) = target else { continue };
            let rows = captured(target, &jacobian.fixed_rows::<3>(3 * arm).into_owned());
            let inertia = inertia(target.mass, target.inertia);
            *matrix += rows.transpose() * inertia * &rows;
            *momentum += rows.transpose() * (inertia * Vector3::from(target.twist.map(f64::abs)));
        }
    }
}

/// Row-major.
fn rows(matrix: &DMatrix<f64>) -> Vec<f64> {
    matrix.transpose().as_slice().to_vec()
}
