//! The columns of a time series, for every file format.

use super::TimeSeriesRow;
use crate::capture::CaseResult;
use crate::scenario::Scenario;
use std::fmt;

const POSE: [(&str, &str); 3] = [("yaw", "rad"), ("x", "m"), ("y", "m")];
const TWIST: [(&str, &str); 3] = [("omega", "rad/s"), ("vx", "m/s"), ("vy", "m/s")];

/// One scalar quantity over time.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// `base_yaw`, `arm1_joint2_rate`; unique in its series.
    pub name: String,
    /// SI.
    pub unit: &'static str,
    /// Its topic in MCAP: `state`, `tips`, `momentum`, `energy` or `targets`.
    pub group: &'static str,
}

impl Column {
    /// Name and unit: `base_yaw [rad]`.
    #[must_use]
    pub fn heading(&self) -> String {
        format!("{} [{}]", self.name, self.unit)
    }
}

/// Appends the values of consecutive columns at one instant.
type Part = Box<dyn Fn(&TimeSeriesRow<'_>, &mut Vec<f64>)>;

/// The columns of a case's time series after time and phase, in their order.
#[derive(Default)]
pub struct Columns {
    list: Vec<Column>,
    parts: Vec<Part>,
}

impl Columns {
    /// Momentum and kinetic energy are those of robot and targets together. If a torque acts on the base, there are columns
    /// for it, its work and its impulse; the torque is 0 in a phase without one. Work and impulse count from the start of
    /// each phase.
    #[must_use]
    pub fn of(scenario: &Scenario, case: &CaseResult) -> Self {
        let arms = &scenario.layout.arms;
        let mut columns = Self::default();
        let joints: Vec<String> =
            arms.iter().flat_map(|arm| (1..=arm.links.len()).map(|k| format!("{}_joint{k}", arm.name))).collect();
        columns.vector("state", "base", POSE, |row| row.sample.state.base_pose);
        columns.each("state", &joints, ("angle", "rad"), |row| &row.sample.state.joint_angles);
        columns.vector("state", "base", TWIST, |row| row.sample.state.base_twist);
        columns.each("state", &joints, ("rate", "rad/s"), |row| &row.sample.state.joint_rates);
        columns.each("state", &joints, ("torque", "N m"), |row| &row.sample.joint_torques);
        for (i, arm) in arms.iter().enumerate() {
            columns.vector("tips", &format!("{}_tip", arm.name), POSE, move |row| row.sample.end_effector_poses[i]);
        }
        for (i, arm) in arms.iter().enumerate() {
            columns.vector("tips", &format!("{}_tip", arm.name), TWIST, move |row| row.sample.end_effector_twists[i]);
        }
        columns.vector("momentum", "linear_momentum", [("x", "N s"), ("y", "N s")], |row| {
            row.total_momentum.linear_momentum
        });
        columns.one("momentum", "angular_momentum", "N m s", |row| row.total_momentum.angular_momentum);
        columns.one("energy", "kinetic_energy", "J", |row| row.total_momentum.kinetic_energy);
        columns.one("energy", "joint_work", "J", |row| row.sample.work.joint_work);
        if has_base_torque(case) {
            columns.one("state", "base_torque", "N m", |row| row.sample.base_torque.unwrap_or_default());
            columns.one("energy", "base_work", "J", |row| row.sample.work.base_work);
            columns.one("momentum", "base_impulse", "N m s", |row| row.sample.work.base_impulse);
        }
        // `_com` keeps these names apart from the columns of the robot
        for (i, target) in scenario.targets.iter().enumerate() {
            let owner = format!("{}_com", target.name);
            columns.vector("targets", &owner, POSE, move |row| row.targets[i].pose);
            columns.vector("targets", &owner, TWIST, move |row| row.targets[i].twist);
        }
        columns
    }

    /// What they are.
    #[must_use]
    pub fn list(&self) -> &[Column] {
        &self.list
    }

    /// Replaces `values` by theirs at one instant.
    pub fn values(&self, row: &TimeSeriesRow<'_>, values: &mut Vec<f64>) {
        values.clear();
        self.parts.iter().for_each(|part| part(row, values));
    }

    fn one(
        &mut self,
        group: &'static str,
        name: &str,
        unit: &'static str,
        value: impl Fn(&TimeSeriesRow<'_>) -> f64 + 'static,
    ) {
        self.list.push(Column { name: name.to_owned(), unit, group });
        self.parts.push(Box::new(move |row, values| values.push(value(row))));
    }

    /// Columns `owner_part` for the parts of a vector, each with its unit.
    fn vector<const N: usize>(
        &mut self,
        group: &'static str,
        owner: &str,
        parts: [(&str, &'static str); N],
        value: impl Fn(&TimeSeriesRow<'_>) -> [f64; N] + 'static,
    ) {
        self.list.extend(parts.map(|(part, unit)| Column { name: format!("{owner}_{part}"), unit, group }));
        self.parts.push(Box::new(move |row, values| values.extend(value(row))));
    }

    /// Columns `owner_part` for one quantity of several owners.
    fn each(
        &mut self,
        group: &'static str,
        owners: &[String],
        (part, unit): (&str, &'static str),
        of_row: impl for<'a> Fn(&'a TimeSeriesRow<'_>) -> &'a [f64] + 'static,
    ) {
        self.list.extend(owners.iter().map(|owner| Column { name: format!("{owner}_{part}"), unit, group }));
        self.parts.push(Box::new(move |row, values| values.extend_from_slice(of_row(row))));
    }
}

impl fmt::Debug for Columns {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(&self.list).finish()
    }
}

fn has_base_torque(case: &CaseResult) -> bool {
    case.capture.iter().any(|captured| captured.post_impact.end().base_torque.is_some())
}

#[cfg(test)]
mod tests {
    use super::Columns;
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
        let columns = Columns::of(&scenario, &study.cases[0]);
        let place = |name: &str| columns.list().iter().position(|column| column.name == name).expect("a column");
        let [torque, omega, impulse, work] = ["base_torque", "base_omega", "base_impulse", "base_work"].map(place);
        assert_eq!([impulse, work].map(|place| columns.list()[place].unit), ["N m s", "J"]);
        let after = rows(&study, &study.cases[0]).filter(|row| row.phase == "post_impact").map(|row| {
            let mut values = Vec::new();
            columns.values(&row, &mut values);
            (row.time, values)
        });
        let after: Vec<_> = after.collect();
        let [mut impulses, mut works, mut most] = [0.0_f64; 3];
        for pair in after.windows(2) {
            let half = 0.5 * (pair[1].0 - pair[0].0);
            impulses += half * pair.iter().map(|(_, row)| row[torque]).sum::<f64>();
            works += half * pair.iter().map(|(_, row)| row[torque] * row[omega]).sum::<f64>();
            most = most.max(impulses.abs());
            let found = pair[1].1[impulse];
            assert!((found - impulses).abs() < 1e-4 * most, "{found}: {impulses}");
        }
        let (_, end) = after.last().expect("rows");
        assert!((end[work] / works - 1.0).abs() < 1e-3, "{}: {works}", end[work]);
        assert!(most > 1e-2 && (works - impulses).abs() > 0.1 * most, "{impulses} {works}");
    }
}
