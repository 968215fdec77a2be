//! The natural size of every entry, and the condition numbers that magnify rounding.
//!
//! An entry's size is the sum of the magnitudes of what makes it up, computed from the layout's lengths alone: the
//! bounds |B| of the body Jacobians put into the same equations. So a folded arm's small inertia is measured against
//! the lengths that cancel in it, and an arm's entries never against the base's.

use super::QUANTITIES;
use super::bounds::{Bounds, Point, captured, convective, inertia};
use super::system::System;
use crate::prove::sampling::Sample;
use nalgebra::{DMatrix, DVector, Vector3};

/// Sizes of one quantity's entries.
pub struct Scale {
    /// One per entry, row-major.
    pub sizes: Vec<f64>,
    /// Of the matrices solved on the way, 1 without any.
    pub condition: f64,
}

/// Sizes of everything at one state; hats are left out of the names.
pub struct Scales<'a> {
    sample: &'a Sample,
    bounds: Bounds,
    mass_matrix: DMatrix<f64>,
    tip_jacobian: DMatrix<f64>,
    /// |v|.
    speeds: DVector<f64>,
    /// What the reference says, for the matrices and solutions.
    values: &'a [Option<Vec<f64>>],
}

impl<'a> Scales<'a> {
    /// At a sample, of what [`values`](super::values) says there.
    #[must_use]
    pub fn new(sample: &'a Sample, values: &'a [Option<Vec<f64>>]) -> Self {
        let bounds = Bounds::new(sample);
        let motion = &sample.instant.state;
        let size = 3 + sample.layout.joints();
        let speeds = motion.base_twist.iter().chain(&motion.joint_rates).map(|v| v.abs());
        let (mass_matrix, tip_jacobian) = (bounds.mass_matrix(size), bounds.tip_jacobian(size));
        Self { sample, bounds, mass_matrix, tip_jacobian, speeds: DVector::from_iterator(size, speeds), values }
    }

    /// In the order of [`QUANTITIES`].
    #[must_use]
    pub fn all(&self) -> Vec<Option<Scale>> {
        let polynomial = |sizes: Vec<f64>| Some(Scale { sizes, condition: 1.0 });
        let (bodies, tips) = (&self.bounds.bodies, &self.bounds.tips);
        let mut all = vec![
            polynomial(bodies.iter().flat_map(|body| [body.mass, body.inertia]).collect()),
            polynomial(bodies.iter().flat_map(|body| self.pose(body)).collect()),
            polynomial(bodies.iter().flat_map(|body| self.twist(body)).collect()),
            polynomial(tips.iter().flat_map(|tip| self.pose(tip)).collect()),
            polynomial(tips.iter().flat_map(|tip| self.twist(tip)).collect()),
            polynomial(rows(&self.tip_jacobian)),
            polynomial(rows(&self.mass_matrix)),
            polynomial(self.bias().as_slice().to_vec()),
        ];
        all.extend(self.momentum().map(polynomial));
        all.extend(self.reduced().map(Some));
        all.extend(self.accelerations().map(Some));
        if self.sample.instant.targets.iter().any(Option::is_some) {
            all.extend(self.reduced_impact().map(Some));
            all.extend(self.capture().map(Some));
        }
        all.resize_with(QUANTITIES.len(), || None);
        all
    }

    /// The reference's numbers; none where it has none.
    fn value(&self, name: &str) -> &[f64] {
        let place = QUANTITIES.iter().position(|quantity| quantity.name == name);
        place.and_then(|place| self.values.get(place)?.as_deref()).unwrap_or_default()
    }

    fn matrix(&self, name: &str) -> DMatrix<f64> {
        let values = self.value(name);
        let size = values.len().isqrt();
        DMatrix::from_row_slice(size, size, values)
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

    fn bias(&self) -> DVector<f64> {
        let parts = self.bounds.bodies.iter().map(|body| convective(body.mass, &body.jacobian, &self.speeds));
        parts.fold(DVector::zeros(self.speeds.len()), |sum, part| sum + part)
    }

    /// Linear, angular, energy.
    fn momentum(&self) -> [Vec<f64>; 3] {
        let (mut linear, mut angular, mut energy) = ([0.0; 2], 0.0, 0.0);
        for body in &self.bounds.bodies {
            let ([omega, vx, vy], [_, x, y]) = (self.twist(body), self.pose(body));
            linear[0] += body.mass * vx;
            linear[1] += body.mass * vy;
            angular += body.inertia * omega + body.mass * (x * vy + y * vx);
            energy += body.inertia * omega * omega + body.mass * (vx * vx + vy * vy);
        }
        [linear.to_vec(), vec![angular], vec![energy / 2.0]]
    }

    /// The base's block of M, which the reduced quantities solve with.
    fn base_condition(&self) -> f64 {
        let matrix = self.matrix("mass_matrix").view((0, 0), (3, 3)).into_owned();
        System { sizes: &self.base(), matrix: &matrix }.condition()
    }

    fn base(&self) -> DMatrix<f64> {
        self.mass_matrix.view((0, 0), (3, 3)).into_owned()
    }

    /// I, c and J: what is subtracted is as large as what it is subtracted from.
    fn reduced(&self) -> [Scale; 3] {
        let (base, bias, condition) = (self.base(), self.bias(), self.base_condition());
        let in_base = System { sizes: &base, matrix: &base }.norm(&bias.rows(0, 3).into_owned());
        let bias = (3..bias.len()).map(|j| bias[j] + self.root(j) * in_base).collect();
        [
            Scale { sizes: rows(&self.reduced_inertia()), condition },
            Scale { sizes: bias, condition },
            Scale { sizes: rows(&self.reduced_jacobian()), condition },
        ]
    }

    /// √ of a diagonal entry of M.
    fn root(&self, j: usize) -> f64 {
        self.mass_matrix[(j, j)].sqrt()
    }

    fn reduced_inertia(&self) -> DMatrix<f64> {
        let joints = self.speeds.len() - 3;
        DMatrix::from_fn(joints, joints, |j, k| self.root(3 + j) * self.root(3 + k))
    }

    fn reduced_jacobian(&self) -> DMatrix<f64> {
        let jacobian = &self.tip_jacobian;
        DMatrix::from_fn(jacobian.nrows(), self.speeds.len() - 3, |row, j| {
            let of_base: f64 = (0..3).map(|k| jacobian[(row, k)] / self.root(k)).sum();
            jacobian[(row, 3 + j)] + of_base * self.root(3 + j)
        })
    }

    /// |F| + |bias|.
    fn forces(&self) -> DVector<f64> {
        let instant = &self.sample.instant;
        let wrench = instant.base_wrench.unwrap_or_default();
        let forces = wrench.iter().chain(&instant.joint_torques).map(|force| force.abs());
        let forces = DVector::from_iterator(self.speeds.len(), forces) + self.bias();
        let wrenches = instant.end_effector_wrenches.iter().flatten();
        let at_tips = self.bounds.tips.iter().zip(wrenches);
        at_tips.fold(forces, |sum, (tip, w)| sum + tip.jacobian.transpose() * Vector3::from(w.map(f64::abs)))
    }

    fn accelerations(&self) -> [Scale; 2] {
        let matrix = self.matrix("mass_matrix");
        let system = System { sizes: &self.mass_matrix, matrix: &matrix };
        self.split(&system, &self.forces(), ["base_acceleration", "joint_accelerations"])
    }

    /// Sizes of a solution in two parts, base and joints.
    fn split(&self, system: &System<'_>, right: &DVector<f64>, names: [&str; 2]) -> [Scale; 2] {
        let condition = system.condition();
        let sizes = system.solution_sizes(right, &names.map(|name| self.value(name)).concat());
        let (base, joints) = sizes.split_at(3.min(sizes.len()));
        [Scale { sizes: base.to_vec(), condition }, Scale { sizes: joints.to_vec(), condition }]
    }

    /// G, H and the joint rates after it; the base's condition goes into all of them.
    fn reduced_impact(&self) -> [Scale; 3] {
        let mut sizes = self.reduced_inertia();
        let mut momentum = &sizes * self.speeds.rows(3, self.speeds.len() - 3);
        self.add_contacts(&self.reduced_jacobian(), &mut sizes, &mut momentum);
        let (matrix, base) = (self.matrix("impact.G"), self.base_condition());
        let system = System { sizes: &sizes, matrix: &matrix };
        let after = system.solution_sizes(&momentum, self.value("impact.joint_rates_after"));
        [
            Scale { sizes: rows(&sizes), condition: base },
            Scale { sizes: momentum.as_slice().to_vec(), condition: base },
            Scale { sizes: after, condition: base * system.condition() },
        ]
    }

    /// The exact capture, then the robot that holds its targets: its mass matrix is M + `J_eᵀ N J_e`.
    fn capture(&self) -> [Scale; 8] {
        let (mut sizes, mut momentum) = (self.mass_matrix.clone(), &self.mass_matrix * &self.speeds);
        self.add_contacts(&self.tip_jacobian, &mut sizes, &mut momentum);
        let matrix = self.matrix("merged mass_matrix");
        let system = System { sizes: &sizes, matrix: &matrix };
        let after = self.split(&system, &momentum, ["capture.base_twist_after", "capture.joint_rates_after"]);
        let [twists, impulses] = self.targets(&after);
        let mut forces = self.forces();
        for (tip, target) in self.bounds.tips.iter().zip(&self.sample.instant.targets) {
            if let Some(target) = target {
                forces += convective(target.mass, &captured(target, &tip.jacobian), &self.speeds);
            }
        }
        let accelerations = self.split(&system, &forces, ["merged base_acceleration", "merged joint_accelerations"]);
        let roots = sizes.diagonal().map(f64::sqrt);
        let [base, joints] = after;
        let [merged_base, merged_joints] = accelerations;
        let inertias = Scale { sizes: self.merged_inertias(), condition: 1.0 };
        let mass_matrix = Scale { sizes: rows(&(&roots * roots.transpose())), condition: 1.0 };
        [base, joints, twists, impulses, inertias, mass_matrix, merged_base, merged_joints]
    }

    /// Twists after the capture and impulses.
    fn targets(&self, after: &[Scale; 2]) -> [Scale; 2] {
        let [base, joints] = after;
        let speeds = DVector::from_vec([base.sizes.as_slice(), &joints.sizes].concat());
        let (mut twists, mut impulses) = (Vec::new(), Vec::new());
        for (tip, target) in self.bounds.tips.iter().zip(&self.sample.instant.targets) {
            let Some(target) = target else {
                twists.extend([0.0; 3]);
                impulses.extend([0.0; 3]);
                continue;
            };
            let twist = captured(target, &tip.jacobian) * &speeds;
            twists.extend(twist.iter());
            let change = twist + Vector3::from(target.twist.map(f64::abs));
            let change = inertia(target.mass, target.inertia) * change;
            let [rx, ry] = target.contact.map(f64::abs);
            impulses.extend([change[0] + ry * change[1] + rx * change[2], change[1], change[2]]);
        }
        [Scale { sizes: twists, condition: base.condition }, Scale { sizes: impulses, condition: base.condition }]
    }

    /// [mass, inertia] of every body, the last links with their targets.
    fn merged_inertias(&self) -> Vec<f64> {
        let mut bodies = self.bounds.bodies.iter().map(|body| [body.mass, body.inertia]);
        let mut inertias: Vec<_> = bodies.next().into_iter().collect();
        let Sample { layout, instant } = self.sample;
        for ((arm, target), [length, com]) in layout.arms.iter().zip(&instant.targets).zip(&self.bounds.last) {
            inertias.extend(bodies.by_ref().take(arm.links.len()));
            if let (Some(target), Some([mass, inertia])) = (target, inertias.last_mut()) {
                let lever = length + com + target.contact[0].hypot(target.contact[1]);
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
            let rows = captured(target, &jacobian.rows(3 * arm, 3).into_owned());
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
