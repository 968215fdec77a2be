//! Where a key is in the tree of a scenario or layout. What is left at its default there is written out first.

use super::key_path::KeyPath;
use crate::diagnostic::{listing, nearest};
use crate::format::Step;
use crate::scenario::{KeyFile, PostCaptureControl, Scenario, Tracking};
use toml::{Table, Value};

/// Keys of tables and indices of lists.
pub type Place = Vec<Step>;

/// The place of a path, whose tables and lists are in the tree afterwards; the value may be absent.
///
/// # Errors
/// What there is not in this tree.
///
/// # Panics
/// Where the tree is not that of a file of its format.
pub fn place(tree: &mut Table, path: &KeyPath, scenario: &Scenario) -> Result<Place, String> {
    let mut place = Vec::new();
    let mut rest = &path.steps[..];
    let mut inner = tree;
    loop {
        let [Step::Key(key), after @ ..] = rest else { unreachable!("tables have keys") };
        place.push(Step::Key(key.clone()));
        let Some(next) = after.first() else { return Ok(place) };
        if let Step::Key(_) = next {
            rest = after;
            let table = inner.entry(key.clone()).or_insert_with(|| Value::Table(Table::new()));
            inner = table.as_table_mut().expect("a table, by the format");
            continue;
        }
        if !is_list_of_tables(inner.get(key)) {
            if let Step::Named(name) = next {
                return Err(format!("there is no `{key}` of the name `{name}`, there is none at all"));
            }
            write_out(inner, key, || default_list(path, scenario), scenario)?;
            let mut list = &inner[key];
            for step in after {
                let Step::Index(index) = *step else { unreachable!("lists have elements") };
                element(list, &mut place, index)?;
                list = &list[index];
            }
            return Ok(place);
        }
        let tables = inner.get_mut(key).and_then(Value::as_array_mut).expect("a list of tables");
        let index = index_in(tables, key, next)?;
        place.push(Step::Index(index));
        rest = &after[1..];
        inner = tables[index].as_table_mut().expect("a list of tables");
    }
}

/// Puts a value at a place.
pub fn set(tree: &mut Table, place: &Place, value: Value) {
    let [Step::Key(first), rest @ ..] = &place[..] else { unreachable!("a place begins with a key") };
    let mut slot = tree.entry(first.clone()).or_insert(Value::Boolean(false));
    for step in rest {
        slot = match (slot, step) {
            (Value::Table(table), Step::Key(name)) => table.entry(name.clone()).or_insert(Value::Boolean(false)),
            (Value::Array(items), Step::Index(index)) => &mut items[*index],
            _ => unreachable!("a place in this tree"),
        };
    }
    *slot = value;
}

fn is_list(items: &[Value]) -> bool {
    !items.is_empty() && items.iter().all(Value::is_table)
}

fn is_list_of_tables(value: Option<&Value>) -> bool {
    value.and_then(Value::as_array).is_some_and(|items| is_list(items))
}

/// The index of the table that a step names; links have no names.
fn index_in(tables: &[Value], key: &str, step: &Step) -> Result<usize, String> {
    let names: Vec<&str> = tables.iter().filter_map(|table| table.get("name")?.as_str()).collect();
    match step {
        Step::Index(index) if names.is_empty() && *index < tables.len() => Ok(*index),
        Step::Index(index) if names.is_empty() => {
            Err(format!("there is no `{key}[{index}]`, expected `{key}[0]` to `{key}[{}]`", tables.len() - 1))
        }
        Step::Index(_) => Err(format!("tables of `{key}` are named, expected {}", listing(&names, "or"))),
        Step::Key(name) | Step::Named(name) => names.iter().position(|known| known == name).ok_or_else(|| {
            let near =
                nearest(name, names.iter().copied()).map_or(String::new(), |near| format!(": did you mean `{near}`?"));
            format!("there is no `{key}` of the name `{name}`, expected {}{near}", listing(&names, "or"))
        }),
    }
}

/// Makes the value of a key the list that it stands for: a number is one per joint, a missing key its default.
fn write_out(
    table: &mut Table,
    key: &str,
    default: impl FnOnce() -> Option<Vec<f64>>,
    scenario: &Scenario,
) -> Result<(), String> {
    let list = match table.get(key) {
        Some(Value::Array(_)) => return Ok(()),
        Some(number @ (Value::Float(_) | Value::Integer(_))) => vec![number.clone(); scenario.layout.joints()],
        Some(other) => return Err(format!("`{key}` is {}, expected a list", other.type_str())),
        None => {
            let default = default().ok_or_else(|| format!("`{key}` is not given, and has no list as its default"))?;
            default.into_iter().map(Value::from).collect()
        }
    };
    table.insert(key.to_owned(), Value::Array(list));
    Ok(())
}

fn element(list: &Value, place: &mut Place, index: usize) -> Result<(), String> {
    let count = list.as_array().map_or(0, Vec::len);
    if index >= count {
        return Err(format!("there is no element {index}: the list has {count}, counted from 0"));
    }
    place.push(Step::Index(index));
    Ok(())
}

/// The list that a path, with an index at its end, stands for where its key is not given.
fn default_list(path: &KeyPath, scenario: &Scenario) -> Option<Vec<f64>> {
    let names = path.names();
    if path.file == KeyFile::Layout {
        let (["arm", arm, "link", "com"], [_, _, _, Step::Index(link), ..]) = (&names[..], &path.steps[..]) else {
            return None;
        };
        let arm = scenario.layout.arms.iter().find(|known| known.name == *arm)?;
        return Some(arm.links.get(*link)?.com.to_vec());
    }
    let target = |name: &str| scenario.targets.iter().position(|target| target.name == name);
    match names[..] {
        ["initial", "base_pose"] => Some(scenario.initial.base_pose.to_vec()),
        ["initial", "base_twist"] => Some(scenario.initial.base_twist.to_vec()),
        ["initial", "joint_rates"] => Some(scenario.initial.joint_rates.clone()),
        ["approach", gain] => match &scenario.approach.tracking {
            Tracking::ProportionalDerivative { proportional_gain, derivative_gain }
            | Tracking::ComputedTorque { proportional_gain, derivative_gain } => match gain {
                "proportional_gain" => Some(proportional_gain.clone()),
                "derivative_gain" => Some(derivative_gain.clone()),
                _ => None,
            },
            Tracking::InverseDynamics | Tracking::ResolvedMotionRate { .. } | Tracking::Own { .. } => None,
        },
        ["post_impact", gain] => match (&scenario.post_impact.as_ref()?.control, gain) {
            (PostCaptureControl::Hold { proportional_gain, .. }, "proportional_gain") => {
                Some(proportional_gain.clone())
            }
            (
                PostCaptureControl::Hold { derivative_gain, .. }
                | PostCaptureControl::Damping { derivative_gain }
                | PostCaptureControl::Stabilise { derivative_gain, .. },
                "derivative_gain",
            ) => Some(derivative_gain.clone()),
            _ => None,
        },
        ["target", name, "twist"] => Some(scenario.targets[target(name)?].twist.to_vec()),
        ["case", case, "target_twists", name] => {
            let case = scenario.cases.iter().find(|known| known.name == case)?;
            Some(case.target_twists[target(name)?].to_vec())
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::registry::SHIPPED;

    const TEXT: &str = r#"
name = "defaults"
layout = "dual_arm_2r"
initial = { joint_angles = [0.6, -1.2, 2.5, 1.2], base_pose = [0.1, 0.2, 0.3] }
approach = { duration = 1.0, trajectory = "cycloidal", final_joint_angles = [0.6, -1.2, 2.5, 1.2], proportional_gain = 7.0 }
[[target]]
name = "ball"
arm = "arm1"
mass = 1.0
inertia = 0.1
contact = [0.1, 0.0]
radius = 0.1
twist = [0.4, 0.5, 0.6]
[[case]]
name = "given"
target_twists = { ball = [0.7, 0.8, 0.9] }
[post_impact]
duration = 1.0
control = "hold"
derivative_gain = [1.0, 2.0, 3.0, 4.0]
"#;

    /// The default of a link's COM is that of this link.
    #[test]
    fn centres_of_mass_are_those_of_their_links() {
        let mut scenario = Scenario::parse(TEXT, "it.toml", "".as_ref(), SHIPPED).unwrap_or_else(|e| panic!("{e}"));
        for (arm, known) in scenario.layout.arms.iter_mut().enumerate() {
            for (link, known) in known.links.iter_mut().enumerate() {
                known.com = [[0.1, 0.2], [0.3, 0.4]][arm].map(|x| x + [0.0, 1.0][link]);
            }
        }
        let layout = scenario.layout.to_toml();
        for (arm, known) in scenario.layout.arms.iter().enumerate() {
            for (link, known) in known.links.iter().enumerate() {
                let lines = layout.lines().filter(|line| !line.starts_with("com"));
                let mut tree: Table = lines.collect::<Vec<_>>().join("\n").parse().expect("TOML");
                let path = KeyPath::parse(&format!("layout.arm.arm{}.link[{link}].com[0]", arm + 1)).expect("a path");
                let place = place(&mut tree, &path, &scenario).expect("a place");
                set(&mut tree, &place, Value::Float(5.5));
                let com = tree["arm"][arm]["link"][link]["com"].clone();
                assert_eq!(com, Value::from(vec![5.5, known.com[1]]), "{arm} {link}");
            }
        }
    }

    /// A list that is not given, or one number for all joints, is written out with the scenario's values before one of its
    /// elements is set.
    #[test]
    fn lists_are_written_out_with_the_values_that_hold() {
        let scenario = Scenario::parse(TEXT, "it.toml", "".as_ref(), SHIPPED).unwrap_or_else(|e| panic!("{e}"));
        for (path, values) in [
            ("initial.base_pose[1]", vec![0.1, 0.2, 0.3]),
            ("initial.base_twist[1]", vec![0.0; 3]),
            ("initial.joint_rates[1]", vec![0.0; 4]),
            ("approach.proportional_gain[1]", vec![7.0; 4]),
            ("approach.derivative_gain[1]", vec![14.0; 4]),
            ("post_impact.proportional_gain[1]", vec![49.0; 4]),
            ("post_impact.derivative_gain[1]", vec![1.0, 2.0, 3.0, 4.0]),
            ("target.ball.twist[1]", vec![0.4, 0.5, 0.6]),
            ("case.given.target_twists.ball[1]", vec![0.7, 0.8, 0.9]),
        ] {
            let mut tree: Table = TEXT.parse().expect("TOML");
            let place = place(&mut tree, &KeyPath::parse(path).expect("a path"), &scenario).expect(path);
            set(&mut tree, &place, Value::Float(5.5));
            let list = place[..place.len() - 1]
                .iter()
                .fold(&Value::Table(tree), |value, step| match step {
                    Step::Key(key) => &value[key.as_str()],
                    Step::Index(index) => &value[*index],
                    Step::Named(name) => panic!("{name}: a place has indices"),
                })
                .clone();
            let expected: Vec<_> =
                values.iter().enumerate().map(|(i, value)| Value::Float(if i == 1 { 5.5 } else { *value })).collect();
            assert_eq!(list, Value::Array(expected), "{path}");
        }
    }
}
