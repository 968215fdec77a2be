//! The columns of a time series, once for every kind of file.

use super::TimeSeriesRow;
use crate::capture::CaseResult;
use crate::scenario::Scenario;
use std::fmt;

const POSE: [(&str, &str); 3] = [("yaw", "rad"), ("x", "m"), ("y", "m")];
const TWIST: [(&str, &str); 3] = [("omega", "rad/s"), ("vx", "m/s"), ("vy", "m/s")];

/// One quantity over time.
pub struct Column {
    /// `base_yaw`, `arm1_joint2_rate`; unique in its series.
    pub name: String,
    /// SI.
    pub unit: &'static str,
    /// What it belongs to: `state`, `tips`, `momentum`, `energy` or `targets`.
    pub group: &'static str,
    value: Box<dyn Fn(&TimeSeriesRow<'_>) -> f64>,
}

impl Column {
    /// Name and unit, as they head a column: `base_yaw [rad]`.
    #[must_use]
    pub fn heading(&self) -> String {
        format!("{} [{}]", self.name, self.unit)
    }

    /// The quantity at one instant.
    #[must_use]
    pub fn value(&self, row: &TimeSeriesRow<'_>) -> f64 {
        (self.value)(row)
    }
}

impl fmt::Debug for Column {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ({})", self.heading(), self.group)
    }
}

/// All columns of a case's time series but time and phase, in their order.
///
/// Momentum and kinetic energy are of robot and targets together. Where a torque acts on the base, there are columns
/// for it, its work and its impulse; the torque is 0 in phases without. Work and impulse are counted from the start of
/// each phase.
#[must_use]
pub fn columns(scenario: &Scenario, case: &CaseResult) -> Vec<Column> {
    let arms = &scenario.layout.arms;
    let mut list = List::default();
    let joints: Vec<String> =
        arms.iter().flat_map(|arm| (1..=arm.links.len()).map(|k| format!("{}_joint{k}", arm.name))).collect();
    list.vector("state", "base", POSE, |row| row.sample.state.base_pose);
    list.each("state", &joints, ("angle", "rad"), |row| &row.sample.state.joint_angles);
    list.vector("state", "base", TWIST, |row| row.sample.state.base_twist);
    list.each("state", &joints, ("rate", "rad/s"), |row| &row.sample.state.joint_rates);
    list.each("state", &joints, ("torque", "N m"), |row| &row.sample.joint_torques);
    for (i, arm) in arms.iter().enumerate() {
        list.vector("tips", &format!("{}_tip", arm.name), POSE, move |row| row.sample.end_effector_poses[i]);
    }
    for (i, arm) in arms.iter().enumerate() {
        list.vector("tips", &format!("{}_tip", arm.name), TWIST, move |row| row.sample.end_effector_twists[i]);
    }
    list.vector("momentum", "linear_momentum", [("x", "N s"), ("y", "N s")], |row| row.whole().linear_momentum);
    list.one("momentum", "angular_momentum", "N m s", |row| row.whole().angular_momentum);
    list.one("energy", "kinetic_energy", "J", |row| row.whole().kinetic_energy);
    list.one("energy", "joint_work", "J", |row| row.sample.work.joint_work);
    if has_base_torque(case) {
        list.one("state", "base_torque", "N m", |row| row.sample.base_torque.unwrap_or_default());
        list.one("energy", "base_work", "J", |row| row.sample.work.base_work);
        list.one("momentum", "base_impulse", "N m s", |row| row.sample.work.base_impulse);
    }
    // of the COM: no name of theirs can be that of a column of the robot
    for (i, target) in scenario.targets.iter().enumerate() {
        let place = move |row: &TimeSeriesRow<'_>| row.targets.get(i).copied();
        list.vector("targets", &format!("{}_com", target.name), POSE, move |row| {
            place(row).map_or([0.0; 3], |t| t.pose)
        });
        list.vector("targets", &format!("{}_com", target.name), TWIST, move |row| {
            place(row).map_or([0.0; 3], |t| t.twist)
        });
    }
    list.0
}

fn has_base_torque(case: &CaseResult) -> bool {
    case.capture.iter().filter_map(|captured| captured.post_impact.end()).any(|end| end.base_torque.is_some())
}

/// Columns being listed.
#[derive(Default)]
struct List(Vec<Column>);

impl List {
    fn one(
        &mut self,
        group: &'static str,
        name: &str,
        unit: &'static str,
        value: impl Fn(&TimeSeriesRow<'_>) -> f64 + 'static,
    ) {
        self.0.push(Column { name: name.to_owned(), unit, group, value: Box::new(value) });
    }

    /// A quantity of a fixed number of parts, each with its unit: `owner_part`.
    fn vector<const N: usize>(
        &mut self,
        group: &'static str,
        owner: &str,
        parts: [(&str, &'static str); N],
        value: impl Fn(&TimeSeriesRow<'_>) -> [f64; N] + Copy + 'static,
    ) {
        for (i, (part, unit)) in parts.into_iter().enumerate() {
            self.one(group, &format!("{owner}_{part}"), unit, move |row| value(row)[i]);
        }
    }

    /// The same quantity of several owners: `owner_part`.
    fn each(
        &mut self,
        group: &'static str,
        owners: &[String],
        (part, unit): (&str, &'static str),
        values: impl for<'a> Fn(&'a TimeSeriesRow<'_>) -> &'a [f64] + Copy + 'static,
    ) {
        for (i, owner) in owners.iter().enumerate() {
            self.one(group, &format!("{owner}_{part}"), unit, move |row| values(row)[i]);
        }
    }
}
