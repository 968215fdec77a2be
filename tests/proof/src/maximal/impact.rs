//! Simultaneous impact at several contacts: rigid and pinned captures, and frictionless bounces with restitution.

use super::body::BodyPoint;
use super::complementarity::{complementary, is_definite};
use super::constraint::{Constraint, wrenches};
use super::kkt_system::KktSystem;
use super::system::System;
use crate::{assert_close, close};
use nalgebra::{DMatrix, DVector, Vector2};

/// Contact law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// Zero relative twist after the impact.
    Rigid,
    /// Zero relative velocity of the contact points after the impact; no moment.
    Pin,
    /// Frictionless: a non-negative impulse along the target's outward normal.
    Bounce {
        /// Unit vector, inertial axes.
        normal: [f64; 2],
        /// Poisson's coefficient, 0 to 1.
        restitution: f64,
    },
}

/// A contact between two bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Where the impulse acts, on the robot.
    pub robot: BodyPoint,
    /// Where the opposite impulse acts.
    pub target: BodyPoint,
    /// Its law.
    pub kind: Kind,
}

impl Contact {
    /// Between an arm's end effector and the point of a body at its position.
    pub fn new(all: &System, arm: usize, body: usize, kind: Kind) -> Self {
        Self { robot: all.end_effectors[arm], target: all.body_point(body, all.end_effector(arm)), kind }
    }

    /// The constraint after a capture; `None` for a bounce.
    pub fn constraint(&self, all: &System) -> Option<Constraint> {
        let yaw = |point: &BodyPoint| all.bodies[point.body].pose[0];
        let angle = match self.kind {
            Kind::Rigid => Some(yaw(&self.robot) - yaw(&self.target)),
            Kind::Pin => None,
            Kind::Bounce { .. } => return None,
        };
        Some(Constraint { a: self.robot, b: self.target, angle })
    }

    /// n · (velocity of the robot's point − velocity of the target's point), m/s: negative while they approach.
    pub fn normal_velocity(&self, all: &System) -> Option<f64> {
        let Kind::Bounce { normal, .. } = self.kind else { return None };
        Some(Vector2::from(normal).dot(&(self.robot.velocity(&all.bodies) - self.target.velocity(&all.bodies))))
    }

    /// Row that gives [`normal_velocity`](Self::normal_velocity) from all twists; its transpose is a unit impulse.
    fn row(&self, all: &System, normal: [f64; 2]) -> DVector<f64> {
        let mut row = DVector::zeros(3 * all.bodies.len());
        for (point, sign) in [(&self.robot, 1.0), (&self.target, -1.0)] {
            let arm = point.lever_arm(&all.bodies);
            let [nx, ny] = normal;
            row[3 * point.body] = sign * (arm.x * ny - arm.y * nx);
            row[3 * point.body + 1] = sign * nx;
            row[3 * point.body + 2] = sign * ny;
        }
        row
    }
}

/// Result of an impact.
#[derive(Clone, Debug, PartialEq)]
pub struct Impact {
    /// Twists of all bodies after the impact.
    pub twists: DVector<f64>,
    /// [n, fx, fy] on the robot at each contact, n about the contact point.
    pub impulses: Vec<[f64; 3]>,
    /// The same at the captures from before the impact, on each constraint's a.
    pub capture_impulses: Vec<[f64; 3]>,
    /// Constraints depend on each other: twists are unique, the constraint impulses are not.
    pub redundant: bool,
    /// [`KktSystem::margin`].
    pub margin: f64,
    /// Bounces depend on each other: twists are unique, the impulses of the bounces are not.
    pub bounces_redundant: bool,
    /// Impulses of compression and of restitution, one per bounce, N s.
    pub phases: [Vec<f64>; 2],
}

/// Impact by Poisson's hypothesis in two phases (Glocker & Pfeiffer 1995); captures are closed in both.
///
/// Compression: u₁ ≥ 0, p₁ ≥ 0, u₁·p₁ = 0. Restitution: p₂ ≥ e p₁, u₂ ≥ 0, (p₂ − e p₁)·u₂ = 0.
///
/// Kinetic energy does not increase for any coefficients in [0, 1]: p₂ minimises T₂ − T₁ = u₁·p + ½ pᵀWp over p ≥ e p₁.
/// p = p₁ is feasible and gives ½ p₁ᵀWp₁, the energy that compression takes from the robot with its captures closed.
/// (Newton's law, u₂ = −e u₀, has no such bound.)
pub fn impact(all: &System, contacts: &[Contact]) -> Impact {
    let mut constraints = all.constraints();
    constraints.extend(contacts.iter().filter_map(|contact| contact.constraint(all)));
    let system = KktSystem::new(all, &constraints);
    let before = all.twists();
    let masses = all.masses();
    let (closed, multipliers) = system.project_twists(&before);

    // response to a unit impulse at each bounce under the constraints
    let mut rows = vec![];
    let mut coefficients = vec![];
    for contact in contacts {
        if let Kind::Bounce { normal, restitution } = contact.kind {
            rows.push(contact.row(all, normal));
            coefficients.push(restitution);
        }
    }
    let count = rows.len();
    let zero = DVector::zeros(multipliers.len());
    let responses: Vec<_> = rows.iter().map(|row| system.solve(row, &zero)).collect();
    let w = DMatrix::from_fn(count, count, |i, j| rows[i].dot(&responses[j].0));
    let w = (&w + w.transpose()) / 2.0;
    let free = rows.iter().map(|row| row.component_div(&masses).dot(row));
    let floor = 1e-11 * free.fold(f64::MIN_POSITIVE, f64::max);
    // scale of the normal velocities, which may be rounding alone where captures lock the contact
    let size = rows.iter().map(|row| row.abs().dot(&before.abs())).fold(0.0, f64::max);
    let e = DVector::from_vec(coefficients);

    let u = DVector::from_iterator(count, rows.iter().map(|row| row.dot(&closed)));
    let first = complementary(&w, &u, floor, size);
    let u = u + &w * &first;
    let minimum = e.component_mul(&first);
    let second = &minimum + complementary(&w, &(&u + &w * &minimum), floor, size);
    let total = &first + &second;
    let (mut twists, mut multipliers) = (closed, multipliers);
    for ((twist, multiplier), p) in responses.iter().zip(&total) {
        twists += twist * *p;
        multipliers += multiplier * *p;
    }

    let mut capture_impulses = wrenches(&constraints, &multipliers).split_off(all.joints.len());
    let mut of_captures = capture_impulses.split_off(all.captures.len()).into_iter();
    let mut of_bounces = total.iter();
    let impulse = |contact: &Contact| match contact.kind {
        Kind::Bounce { normal: [nx, ny], .. } => {
            let p = of_bounces.next().expect("one per bounce");
            [0.0, p * nx, p * ny]
        }
        _ => of_captures.next().expect("one per capture"),
    };
    Impact {
        impulses: contacts.iter().map(impulse).collect(),
        twists,
        capture_impulses,
        redundant: system.redundant,
        margin: system.margin,
        bounces_redundant: !is_definite(&w, floor),
        phases: [first.as_slice().to_vec(), second.as_slice().to_vec()],
    }
}

impl System {
    /// Sets the twists after an impact, and adds the constraints of its captures.
    pub fn apply(&mut self, contacts: &[Contact], impact: &Impact) {
        let captures: Vec<_> = contacts.iter().filter_map(|contact| contact.constraint(self)).collect();
        self.captures.extend(captures);
        self.set_twists(&impact.twists);
    }
}

/// Result of an impact computed by the product.
#[derive(Clone, Debug, PartialEq)]
pub struct ProductImpact {
    /// As [`System::velocities`].
    pub velocities: Vec<f64>,
    /// [n, fx, fy] of each contact.
    pub impulses: Vec<[f64; 3]>,
}

impl ProductImpact {
    /// Fails unless velocities and impulses agree with the reference. The scale of the impulses is at least that of the
    /// linear momentum.
    #[track_caller]
    pub fn assert_agrees(&self, after: &System, impulses: &[[f64; 3]], bound: f64) {
        close("velocities", &self.velocities, &after.velocities(), bound);
        let [_, momentum] = after.momentum_scale();
        let size = impulses.as_flattened().iter().fold(momentum, |most, part| most.max(part.abs()));
        assert_close("impulses", self.impulses.as_flattened(), impulses.as_flattened(), bound * size);
    }
}
