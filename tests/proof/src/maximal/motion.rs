//! Accelerations and motion of bodies under constraints and joint torques.

use super::constraint::{centripetal, residual};
use super::kkt_system::KktSystem;
use super::system::{Joint, System};
use nalgebra::DVector;

/// Joint torques from time, joint angles and joint rates.
pub type Torques<'a> = dyn Fn(f64, &[f64], &[f64]) -> Vec<f64> + 'a;

/// Largest errors over all steps.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Monitor {
    /// Change of [l, p], relative to the largest [`System::momentum_scale`].
    pub momentum: [f64; 2],
    /// |E − E₀ − work of the torques| over the largest E.
    pub energy: f64,
    /// Constraint residual before projection, rad or m.
    pub constraint: f64,
    /// Constraint residual after projection, rad or m.
    pub projected: f64,
    /// Smallest [`KktSystem::margin`]: zero where the constraints of a loop depend on each other.
    pub margin: f64,
    /// Work of the joint torques, J.
    pub work: f64,
}

/// [α, ax, ay] of every body: M a = f + Aᵀλ, A a = −Ȧ v. A joint's torque acts on its child, the opposite on its
/// parent.
pub fn accelerations(all: &System, torques: &[f64]) -> DVector<f64> {
    let constraints = all.constraints();
    let mut forces = DVector::zeros(3 * all.bodies.len());
    for (joint, torque) in all.joints.iter().zip(torques) {
        forces[3 * joint.constraint.a.body] += torque;
        forces[3 * joint.constraint.b.body] -= torque;
    }
    KktSystem::new(all, &constraints).solve(&forces, &-centripetal(&all.bodies, &constraints)).0
}

/// Base and joint accelerations from those of the bodies.
pub fn joint_accelerations(all: &System, bodies: &DVector<f64>) -> ([f64; 3], Vec<f64>) {
    let joints = all.joints.iter().map(|Joint { constraint: c, .. }| bodies[3 * c.a.body] - bodies[3 * c.b.body]);
    ([bodies[0], bodies[1], bodies[2]], joints.collect())
}

/// Poses, twists and work as one vector.
fn pack(all: &System, work: f64) -> DVector<f64> {
    let poses = all.bodies.iter().flat_map(|body| body.pose);
    let twists = all.bodies.iter().flat_map(|body| body.twist);
    DVector::from_iterator(6 * all.bodies.len() + 1, poses.chain(twists).chain([work]))
}

fn unpack(y: &DVector<f64>, all: &mut System) -> f64 {
    let (poses, rest) = y.as_slice().split_at(3 * all.bodies.len());
    let (twists, work) = rest.split_at(3 * all.bodies.len());
    for ((body, pose), twist) in all.bodies.iter_mut().zip(poses.chunks_exact(3)).zip(twists.chunks_exact(3)) {
        body.pose.copy_from_slice(pose);
        body.twist.copy_from_slice(twist);
    }
    work[0]
}

fn derivative(all: &mut System, time: f64, y: &DVector<f64>, law: &Torques<'_>) -> DVector<f64> {
    unpack(y, all);
    let rates = all.joint_rates();
    let torques = law(time, &all.joint_angles(), &rates);
    let power = torques.iter().zip(&rates).map(|(torque, rate)| torque * rate).sum::<f64>();
    let twists = all.twists();
    let accelerations = accelerations(all, &torques);
    DVector::from_iterator(y.len(), twists.iter().chain(&accelerations).copied().chain([power]))
}

/// Substeps of the midpoint rule whose results are extrapolated: order 12.
const SUBSTEPS: [u8; 6] = [2, 4, 6, 8, 10, 12];

/// Error per step, per unit of poses, twists and work, above which a step is halved.
const ERROR: f64 = 1e-13;

/// One step of Gragg's extrapolated midpoint rule (Hairer, Nørsett & Wanner, Solving ODEs I, II.9), or two of half the
/// length where its error estimate is too large. It is of high order and independent of the product's integrators.
fn step(all: &mut System, time: f64, step: f64, y: &DVector<f64>, law: &Torques<'_>) -> DVector<f64> {
    assert!(step > 1e-5, "no step is short enough at t = {time} s");
    let slope = derivative(all, time, y, law);
    let mut table: Vec<DVector<f64>> = vec![];
    for (row, count) in SUBSTEPS.iter().enumerate() {
        let h = step / f64::from(*count);
        let (mut before, mut now) = (y.clone(), y + h * &slope);
        for i in 1..*count {
            let next = before + 2.0 * h * derivative(all, time + f64::from(i) * h, &now, law);
            (before, now) = (now, next);
        }
        // Gragg's smoothing, then Aitken–Neville in h²
        let end = derivative(all, time + step, &now, law);
        table.push(0.5 * (before + &now + h * end));
        for column in (0..row).rev() {
            let ratio = f64::from(*count) / f64::from(SUBSTEPS[column]);
            let correction = (&table[column + 1] - &table[column]) / (ratio * ratio - 1.0);
            table[column] = &table[column + 1] + correction;
        }
    }
    // orders 12 and 10
    let error = (&table[0] - &table[1]).amax();
    if error <= ERROR * (1.0 + y.amax()) {
        return table.swap_remove(0);
    }
    let half = 0.5 * step;
    let middle = self::step(all, time, half, y, law);
    self::step(all, time + half, half, &middle, law)
}

/// Projects poses and twists onto the constraints by the smallest change in the metric of the masses, which does not move
/// the centre of mass. Returns the residual before and after, and the margin.
pub fn project(all: &mut System) -> [f64; 3] {
    let constraints = all.constraints();
    let no_force = DVector::zeros(3 * all.bodies.len());
    let before = residual(&all.bodies, &constraints).amax();
    for _ in 0..2 {
        let violation = residual(&all.bodies, &constraints);
        let (change, _) = KktSystem::new(all, &constraints).solve(&no_force, &-violation);
        for (body, change) in all.bodies.iter_mut().zip(change.as_slice().chunks_exact(3)) {
            body.pose.iter_mut().zip(change).for_each(|(pose, change)| *pose += change);
        }
    }
    let system = KktSystem::new(all, &constraints);
    let (twists, _) = system.project_twists(&all.twists());
    all.set_twists(&twists);
    [before, residual(&all.bodies, &constraints).amax(), system.margin]
}

/// Integrates the motion for `duration`, by equal steps of at most `longest`, s.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "some hundred steps")]
pub fn run(all: &mut System, duration: f64, longest: f64, law: &Torques<'_>) -> Monitor {
    let steps = (duration / longest - 1e-9).ceil().max(1.0) as u32;
    let h = duration / f64::from(steps);
    let (momentum, energy) = (all.momentum(), all.kinetic_energy());
    let (mut largest, mut scale) = (energy, all.momentum_scale());
    let mut monitor = Monitor { margin: 1.0, ..Monitor::default() };
    let (mut drift, mut error) = ([0.0_f64; 2], 0.0_f64);
    for i in 0..steps {
        let y = pack(all, monitor.work);
        let y = step(all, f64::from(i) * h, h, &y, law);
        monitor.work = unpack(&y, all);
        let [before, after, margin] = project(all);
        monitor.margin = monitor.margin.min(margin);
        monitor.constraint = monitor.constraint.max(before);
        monitor.projected = monitor.projected.max(after);
        let now = all.momentum();
        drift[0] = drift[0].max((now[0] - momentum[0]).abs());
        drift[1] = drift[1].max((now[1] - momentum[1]).hypot(now[2] - momentum[2]));
        error = error.max((all.kinetic_energy() - energy - monitor.work).abs());
        largest = largest.max(all.kinetic_energy());
        scale = std::array::from_fn(|k| scale[k].max(all.momentum_scale()[k]));
    }
    monitor.momentum = std::array::from_fn(|k| if scale[k] > 0.0 { drift[k] / scale[k] } else { 0.0 });
    monitor.energy = if largest > 0.0 { error / largest } else { 0.0 };
    monitor
}
