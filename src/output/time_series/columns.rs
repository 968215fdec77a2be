//! The columns of a time series, for every file format.

use super::TimeSeriesRow;
use crate::capture::CaseResult;
use crate::scenario::Scenario;
use std::fmt;

const POSE: [(&str, &str); 3] = [("yaw", "rad"), ("x", "m"), ("y", "m")];
const TWIST: [(&str, &str); 3] = [("omega", "rad/s"), ("vx", "m/s"), ("vy", "m/s")];

/// One scalar quantity over time.
pub struct Column {
    /// `base_yaw`, `arm1_joint2_rate`; unique in its series.
    pub name: String,
    /// SI.
    pub unit: &'static str,
    /// Its topic in MCAP: `state`, `tips`, `momentum`, `energy` or `targets`.
    pub group: &'static str,
    value: Box<dyn Fn(&TimeSeriesRow<'_>) -> f64>,
}

impl Column {
    /// Name and unit: `base_yaw [rad]`.
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

/// The columns of a case's time series after time and phase, in their order.
///
/// Momentum and kinetic energy are those of robot and targets together. If a torque acts on the base, there are columns
/// for it, its work and its impulse; the torque is 0 in a phase without one. Work and impulse count from the start of
/// each phase.
#[must_use]
pub fn columns(scenario: &Scenario, case: &CaseResult) -> Vec<Column> {
    let arms = &scenario.layout.arms;
    let mut list = ColumnList::default();
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
    list.vector("momentum", "linear_momentum", [("x", "N s"), ("y", "N s")], |row| {
        row.total_momentum().linear_momentum
    });
    list.one("momentum", "angular_momentum", "N m s", |row| row.total_momentum().angular_momentum);
    list.one("energy", "kinetic_energy", "J", |row| row.total_momentum().kinetic_energy);
    list.one("energy", "joint_work", "J", |row| row.sample.work.joint_work);
    if has_base_torque(case) {
        list.one("state", "base_torque", "N m", |row| row.sample.base_torque.unwrap_or_default());
        list.one("energy", "base_work", "J", |row| row.sample.work.base_work);
        list.one("momentum", "base_impulse", "N m s", |row| row.sample.work.base_impulse);
    }
    // `_com` keeps these names apart from the columns of the robot
    for (i, target) in scenario.targets.iter().enumerate() {
        let owner = format!("{}_com", target.name);
        list.vector("targets", &owner, POSE, move |row| row.targets[i].pose);
        list.vector("targets", &owner, TWIST, move |row| row.targets[i].twist);
    }
    list.0
}

fn has_base_torque(case: &CaseResult) -> bool {
    case.capture.iter().any(|captured| captured.post_impact.end().base_torque.is_some())
}

#[derive(Default)]
struct ColumnList(Vec<Column>);

impl ColumnList {
    fn one(
        &mut self,
        group: &'static str,
        name: &str,
        unit: &'static str,
        value: impl Fn(&TimeSeriesRow<'_>) -> f64 + 'static,
    ) {
        self.0.push(Column { name: name.to_owned(), unit, group, value: Box::new(value) });
    }

    /// Columns `owner_part` for the parts of a vector, each with its unit.
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

    /// Columns `owner_part` for one quantity of several owners.
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

#[cfg(test)]
mod tests {
    use super::columns;
    use crate::capture::{Silent, study};
    use crate::output::time_series::rows;
    use crate::registry;
    use crate::scenario::fixture::two_discs;
    use planar_proof::layout;

    #[test]
    fn impulse_and_work_of_the_base_torque_are_its_integrals() {
        let scenario = two_discs(
            "duration = 4.0\ncontrol = \"stabilise\"\nderivative_gain = 0.5\nbase_gain = 0.2\nbase_torque_limit = 20.0\n",
        );
        let model = registry::generic(&layout("dual_arm_3r"));
        let study = study(&scenario, &|| model.clone_box(), 0.01, &mut Silent).expect("a study");
        let columns = columns(&scenario, &study.cases[0]);
        let column = |name: &str| columns.iter().find(|column| column.name == name).expect("a column");
        let [torque, omega, impulse, work] = ["base_torque", "base_omega", "base_impulse", "base_work"].map(column);
        assert_eq!((impulse.unit, work.unit), ("N m s", "J"));
        let after: Vec<_> = rows(&study, &study.cases[0]).filter(|row| row.phase == "post_impact").collect();
        let [mut impulses, mut works, mut most] = [0.0_f64; 3];
        for pair in after.windows(2) {
            let half = 0.5 * (pair[1].time - pair[0].time);
            impulses += half * pair.iter().map(|row| torque.value(row)).sum::<f64>();
            works += half * pair.iter().map(|row| torque.value(row) * omega.value(row)).sum::<f64>();
            most = most.max(impulses.abs());
            assert!(
                (impulse.value(&pair[1]) - impulses).abs() < 1e-4 * most,
                "{}: {impulses}",
                impulse.value(&pair[1])
            );
        }
        let end = after.last().expect("rows");
        assert!((work.value(end) / works - 1.0).abs() < 1e-3, "{}: {works}", work.value(end));
        assert!(most > 1e-2 && (works - impulses).abs() > 0.1 * most, "{impulses} {works}");
    }
}
