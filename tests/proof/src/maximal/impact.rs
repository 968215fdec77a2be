//! Impact of many contacts at once: captures, rigid or pinned, and frictionless bounces with restitution.

use super::complementarity::{complementary, is_definite};
use super::constraint::{BodyPoint, Tie, wrenches};
use super::kkt_system::Constrained;
use super::system::System;
use crate::{assert_close, close};
use nalgebra::{DMatrix, DVector, Vector2};

/// What a contact does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// Relative twist zero afterwards.
    Rigid,
    /// Relative velocity of the contact points zero afterwards; no moment.
    Pin,
    /// Frictionless: an impulse along the target's outward normal alone, and it pushes.
    Bounce {
        /// Of length one, inertial axes.
        normal: [f64; 2],
        /// Poisson's, 0 to 1.
        restitution: f64,
    },
}

/// A contact of the robot with a target, or with itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Where the impulse acts.
    pub robot: BodyPoint,
    /// Where the opposite impulse acts.
    pub target: BodyPoint,
    /// What it does.
    pub kind: Kind,
}

impl Contact {
    /// Of an arm's tip with a body, at the point of the body where the tip is.
    pub fn new(all: &System, arm: usize, body: usize, kind: Kind) -> Self {
        let robot = all.tips[arm];
        Self { robot, target: all.place(body, all.position(&robot)), kind }
    }

    /// What holds afterwards; `None` of a bounce.
    pub fn tie(&self, all: &System) -> Option<Tie> {
        let yaw = |place: &BodyPoint| all.bodies[place.body].pose[0];
        let angle = match self.kind {
            Kind::Rigid => Some(yaw(&self.robot) - yaw(&self.target)),
            Kind::Pin => None,
            Kind::Bounce { .. } => return None,
        };
        Some(Tie { a: self.robot, b: self.target, angle })
    }

    /// n · (velocity of the robot's point − that of the target's): below 0 they approach.
    pub fn opening(&self, all: &System) -> Option<f64> {
        let Kind::Bounce { normal, .. } = self.kind else { return None };
        Some(Vector2::from(normal).dot(&(all.velocity(&self.robot) - all.velocity(&self.target))))
    }

    /// Row of all twists that is [`opening`](Self::opening), and force on all bodies of a unit impulse.
    fn row(&self, all: &System, normal: [f64; 2]) -> DVector<f64> {
        let mut row = DVector::zeros(3 * all.bodies.len());
        for (place, sign) in [(&self.robot, 1.0), (&self.target, -1.0)] {
            let arrow = all.bodies[place.body].turned(place.at);
            let [nx, ny] = normal;
            row[3 * place.body] = sign * (arrow.x * ny - arrow.y * nx);
            row[3 * place.body + 1] = sign * nx;
            row[3 * place.body + 2] = sign * ny;
        }
        row
    }
}

/// What an impact did.
#[derive(Clone, Debug, PartialEq)]
pub struct Impact {
    /// Of all bodies.
    pub twists: DVector<f64>,
    /// [n, fx, fy] on the robot at each contact, n about the contact point.
    pub impulses: Vec<[f64; 3]>,
    /// The same of what was held before, on each tie's a.
    pub held: Vec<[f64; 3]>,
    /// Constraints say something twice: twists are unique, the impulses of the constraints are not.
    pub redundant: bool,
    /// How near the constraints are to that, see [`Constrained::margin`].
    pub margin: f64,
    /// The bounces' impulses do not follow from the velocities alone: twists are unique, these are not.
    pub bounces_redundant: bool,
    /// Of compression and of restitution, one per bounce.
    pub phases: [Vec<f64>; 2],
}

/// Poisson's hypothesis in two phases (Glocker & Pfeiffer 1995), captures being closed from the first on.
///
/// Compression: u₁ ≥ 0, p₁ ≥ 0, u₁·p₁ = 0. Restitution: p₂ ≥ e p₁, u₂ ≥ 0, (p₂ − e p₁)·u₂ = 0.
///
/// Kinetic energy never grows, whatever the coefficients in [0, 1]: p₂ is the p ≥ e p₁ with the least T₂ − T₁ =
/// u₁·p + ½ pᵀWp, p₁ is such a p, for which it is ½ p₁ᵀWp₁, and that is what compression took from the robot with
/// its captures closed. (Newton's law, u₂ = −e u₀, has no such bound.)
pub fn impact(all: &System, contacts: &[Contact]) -> Impact {
    let captures: Vec<Tie> = contacts.iter().filter_map(|contact| contact.tie(all)).collect();
    let ties: Vec<Tie> = all.ties().copied().chain(captures.iter().copied()).collect();
    let system = Constrained::new(all, &ties);
    let before = all.twists();
    let masses = all.masses();
    let (closed, multipliers) = system.close(&before);

    // what a unit impulse at each bounce does with everything else closed
    let mut rows = vec![];
    let mut coefficients = vec![];
    for contact in contacts {
        if let Kind::Bounce { normal, restitution } = contact.kind {
            rows.push(contact.row(all, normal));
            coefficients.push(restitution);
        }
    }
    let count = rows.len();
    let none = DVector::zeros(multipliers.len());
    let replies: Vec<_> = rows.iter().map(|row| system.solve(row, &none)).collect();
    let w = DMatrix::from_fn(count, count, |i, j| rows[i].dot(&replies[j].0));
    let w = (&w + w.transpose()) / 2.0;
    let alone = rows.iter().map(|row| row.component_div(&masses).dot(row));
    let floor = 1e-11 * alone.fold(f64::MIN_POSITIVE, f64::max);
    // what the openings are differences of: one may be rounding alone, where captures lock the contact
    let size = rows.iter().map(|row| row.abs().dot(&before.abs())).fold(0.0, f64::max);
    let e = DVector::from_vec(coefficients);

    let u = DVector::from_iterator(count, rows.iter().map(|row| row.dot(&closed)));
    let first = complementary(&w, &u, floor, size);
    let u = u + &w * &first;
    let follow = |p: &DVector<f64>| {
        let mut twists = closed.clone();
        let mut multipliers = multipliers.clone();
        for ((twist, multiplier), p) in replies.iter().zip(p) {
            twists += twist * *p;
            multipliers += multiplier * *p;
        }
        (twists, multipliers)
    };
    let least = e.component_mul(&first);
    let second = &least + complementary(&w, &(&u + &w * &least), floor, size);
    let total = &first + &second;
    let (twists, multipliers) = follow(&total);

    let mut of_ties = wrenches(&ties, &multipliers).split_off(all.joints.len());
    let mut of_captures = of_ties.split_off(all.held.len()).into_iter();
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
        held: of_ties,
        redundant: system.redundant,
        margin: system.margin,
        bounces_redundant: !is_definite(&w, floor),
        phases: [first.as_slice().to_vec(), second.as_slice().to_vec()],
    }
}

impl System {
    /// The twists after an impact; what it captured is held from now on.
    pub fn apply(&mut self, contacts: &[Contact], impact: &Impact) {
        let ties: Vec<Tie> = contacts.iter().filter_map(|contact| contact.tie(self)).collect();
        self.held.extend(ties);
        self.set_twists(&impact.twists);
    }
}

/// What an impact left, by the product.
#[derive(Clone, Debug, PartialEq)]
pub struct Left {
    /// As [`System::velocities`].
    pub velocities: Vec<f64>,
    /// [n, fx, fy] of each contact.
    pub impulses: Vec<[f64; 3]>,
}

impl Left {
    /// Fails where the reference has other velocities or impulses, which may be rounding beside the momentum that there
    /// is.
    #[track_caller]
    pub fn assert_is(&self, after: &System, impulses: &[[f64; 3]], bound: f64) {
        close("velocities", &self.velocities, &after.velocities(), bound);
        let [_, momentum] = after.momentum_scale();
        let size = impulses.as_flattened().iter().fold(momentum, |most, part| most.max(part.abs()));
        assert_close("impulses", self.impulses.as_flattened(), impulses.as_flattened(), bound * size);
    }
}
