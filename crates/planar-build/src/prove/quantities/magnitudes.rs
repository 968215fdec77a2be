//! Magnitudes of the body Jacobians, from lengths alone.

use crate::prove::sampling::RegimeSample;
use nalgebra::{DMatrix, DVector, Matrix3, Matrix3xX, Vector3};
use planar_dynamics::target::Target;

/// A body, or an end effector without mass.
pub struct Point {
    /// kg.
    pub mass: f64,
    /// kg m².
    pub inertia: f64,
    /// |B| (3 × size): a joint moves the point by at most the lengths between them.
    pub jacobian: Matrix3xX<f64>,
    /// Sum of the magnitudes of the angles that turn it.
    pub angle: f64,
}

/// Those of all bodies and end effectors of a robot.
pub struct Magnitudes {
    /// The base, then the links arm by arm.
    pub bodies: Vec<Point>,
    /// One per arm.
    pub end_effectors: Vec<Point>,
    /// Length and distance of the COM from the joint of each arm's last link.
    pub last: Vec<[f64; 2]>,
}

impl Magnitudes {
    /// For the twist of a point of the base, in the base's frame from its COM, as the base's coordinates.
    pub fn about([x, y]: [f64; 2], RegimeSample { layout, instant }: &RegimeSample) -> Self {
        let size = 3 + layout.joints();
        let point = |mass: f64, inertia: f64, levers: &[(usize, f64)], angle: f64| {
            let mut jacobian = Matrix3xX::zeros(size);
            jacobian[(1, 1)] = 1.0;
            jacobian[(2, 2)] = 1.0;
            for (column, lever) in levers {
                jacobian.set_column(*column, &Vector3::new(1.0, *lever, *lever));
            }
            Point { mass, inertia, jacobian, angle }
        };
        let yaw = instant.state.base_pose[0].abs();
        let mut bodies = vec![point(layout.base.mass, layout.base.inertia, &[(0, libm::hypot(x, y))], yaw)];
        let (mut end_effectors, mut last, mut column) = (Vec::new(), Vec::new(), 3);
        for arm in &layout.arms {
            let mut angle = yaw + arm.mount_angle.abs();
            let mut levers = vec![(0, libm::hypot(arm.mount[0] - x, arm.mount[1] - y))];
            let mut end = [0.0; 2];
            for link in &arm.links {
                levers.push((column, 0.0));
                angle += instant.state.joint_angles.get(column - 3).map_or(0.0, |angle| angle.abs());
                column += 1;
                let com = libm::hypot(link.com[0], link.com[1]);
                let reach: Vec<_> = levers.iter().map(|(column, lever)| (*column, lever + com)).collect();
                bodies.push(point(link.mass, link.inertia, &reach, angle));
                for (_, lever) in &mut levers {
                    *lever += link.length;
                }
                end = [link.length, com];
            }
            end_effectors.push(point(0.0, 0.0, &levers, angle));
            last.push(end);
        }
        Self { bodies, end_effectors, last }
    }

    /// M̂ = Σ |B|ᵀ I |B|.
    pub fn mass_matrix(&self, size: usize) -> DMatrix<f64> {
        let part = |body: &Point| body.jacobian.transpose() * inertia(body.mass, body.inertia) * &body.jacobian;
        self.bodies.iter().fold(DMatrix::zeros(size, size), |sum, body| sum + part(body))
    }

    /// `[Ĵ_be Ĵ_me]` of all arms.
    pub fn end_effector_jacobian(&self, size: usize) -> DMatrix<f64> {
        let mut jacobian = DMatrix::zeros(3 * self.end_effectors.len(), size);
        for (arm, point) in self.end_effectors.iter().enumerate() {
            jacobian.rows_mut(3 * arm, 3).copy_from(&point.jacobian);
        }
        jacobian
    }
}

/// |B|ᵀ m [0, a, a] with the convective acceleration a = |ω| |ω × r| of the point with this Jacobian.
pub fn convective(mass: f64, jacobian: &Matrix3xX<f64>, speeds: &DVector<f64>) -> DVector<f64> {
    let mut turning = speeds.clone();
    turning.rows_mut(1, 2).fill(0.0);
    let twist = jacobian * turning;
    let force = mass * twist[0] * twist[1].max(twist[2]);
    jacobian.transpose() * Vector3::new(0.0, force, force)
}

/// |`J_t⁻¹`| |J|: from the end effector to the target's COM.
pub fn captured(target: &Target<f64>, jacobian: &Matrix3xX<f64>) -> Matrix3xX<f64> {
    let [rx, ry] = target.contact.map(f64::abs);
    Matrix3::new(1.0, 0.0, 0.0, ry, 1.0, 0.0, rx, 0.0, 1.0) * jacobian
}

/// diag(inertia, mass, mass).
pub fn inertia(mass: f64, inertia: f64) -> Matrix3<f64> {
    Matrix3::from_diagonal(&Vector3::new(inertia, mass, mass))
}
