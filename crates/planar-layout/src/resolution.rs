//! What is left of a robot's inertias where its joints are free, by which 16 digits resolve its motion or do not.

use crate::layout::Layout;

/// Smallest ratio of the inertia that a joint or the base moves with the joints beyond it free (articulated) to that with
/// them locked (composite). Mass matrices have the composite inertias, and factorisations leave the articulated ones as
/// their differences: accelerations of the generic implementation and captures are wrong by less than 1e-6
/// above this one (950 robots with masses from 1e-6 to 1e6 kg, against 60 digits), and soon by more below it.
pub(crate) const LEAST_SHARE: f64 = 1e-5;

/// Robots are looked at in two poses, neither of which is stretched: all joints at 1 rad, and at −1 and 1 rad in turn. The
/// ratio of the better one counts, as a pose near a singular one says nothing of the robot.
const POSES: [[f64; 2]; 2] = [[1.0, 1.0], [-1.0, 1.0]];

/// Where the least is left.
#[derive(Clone, Copy)]
pub(crate) struct Weakest {
    /// Arm and link; `None` for the base.
    pub link: Option<(usize, usize)>,
    /// The ratio of articulated to composite inertia.
    pub share: f64,
}

/// A body's inertia and the Jacobian of its twist [ω, vx, vy] by [base twist, joint rates].
struct MovingBody {
    mass: f64,
    inertia: f64,
    rows: [Vec<f64>; 3],
}

impl Weakest {
    /// Of a robot.
    pub(crate) fn of(layout: &Layout) -> Self {
        let [one, other] = POSES.map(|angles| Self::in_pose(layout, angles));
        if other.share > one.share { other } else { one }
    }

    fn in_pose(layout: &Layout, angles: [f64; 2]) -> Self {
        let mut matrix = mass_matrix(&bodies(layout, angles));
        let composite: Vec<f64> = matrix.iter().enumerate().map(|(i, row)| row[i]).collect();
        let mut weakest = Self { link: None, share: 1.0 };
        let mut take = |column: usize, link| {
            let share = free(&mut matrix, column) / composite[column];
            if share < weakest.share {
                weakest = Self { link, share };
            }
        };
        let mut first = 3;
        for (i, arm) in layout.arms.iter().enumerate() {
            for k in (0..arm.links.len()).rev() {
                take(first + k, Some((i, k)));
            }
            first += arm.links.len();
        }
        (0..3).for_each(|column| take(column, None));
        weakest
    }
}

fn bodies(layout: &Layout, angles: [f64; 2]) -> Vec<MovingBody> {
    let size = 3 + layout.arms.iter().map(|arm| arm.links.len()).sum::<usize>();
    let still: [Vec<f64>; 3] = std::array::from_fn(|row| (0..size).map(|i| f64::from(u8::from(i == row))).collect());
    let mut all = vec![MovingBody { mass: layout.base.mass, inertia: layout.base.inertia, rows: still.clone() }];
    let mut column = 3;
    for arm in &layout.arms {
        let (mut yaw, mut rows) = (arm.mount_angle, moved(&still, arm.mount));
        for (link, angle) in arm.links.iter().zip(angles.iter().cycle()) {
            yaw += angle;
            rows[0][column] = 1.0;
            column += 1;
            let turned =
                |[x, y]: [f64; 2]| [libm::cos(yaw) * x - libm::sin(yaw) * y, libm::sin(yaw) * x + libm::cos(yaw) * y];
            all.push(MovingBody { mass: link.mass, inertia: link.inertia, rows: moved(&rows, turned(link.com)) });
            rows = moved(&rows, turned([link.length, 0.0]));
        }
    }
    all
}

/// The Jacobian of a point of the same body at `lever` from that of `rows`.
fn moved([angular, x, y]: &[Vec<f64>; 3], lever: [f64; 2]) -> [Vec<f64>; 3] {
    let along = |row: &[f64], factor: f64| row.iter().zip(angular).map(|(v, w)| v + factor * w).collect();
    [angular.clone(), along(x, -lever[1]), along(y, lever[0])]
}

fn mass_matrix(bodies: &[MovingBody]) -> Vec<Vec<f64>> {
    let size = bodies.first().map_or(0, |body| body.rows[0].len());
    let mut matrix = vec![vec![0.0; size]; size];
    for MovingBody { mass, inertia, rows } in bodies {
        for (row, weight) in rows.iter().zip([inertia, mass, mass]) {
            for (entries, left) in matrix.iter_mut().zip(row) {
                entries.iter_mut().zip(row).for_each(|(entry, right)| *entry += weight * left * right);
            }
        }
    }
    matrix
}

/// The articulated inertia of a column, which is free for those that follow.
fn free(matrix: &mut [Vec<f64>], column: usize) -> f64 {
    let row = matrix[column].clone();
    for entries in matrix.iter_mut() {
        let factor = entries[column] / row[column];
        entries.iter_mut().zip(&row).for_each(|(entry, other)| *entry -= factor * other);
    }
    row[column]
}
