//! Writes a state as JSON; its numbers read back exactly.

use crate::evaluation::EvaluationInput;
use crate::target::Target;
use serde_json::{Value, json};

/// The object that [`States`](super::States) reads as this input; optional entries without value are absent.
#[must_use]
pub fn to_json(instant: &EvaluationInput) -> Value {
    let state = &instant.state;
    let mut value = json!({
        "base_pose": state.base_pose,
        "joint_angles": state.joint_angles,
        "base_twist": state.base_twist,
        "joint_rates": state.joint_rates,
        "joint_torques": instant.joint_torques,
    });
    if let Some(wrench) = instant.base_wrench {
        value["base_wrench"] = json!(wrench);
    }
    if let Some(wrenches) = &instant.end_effector_wrenches {
        value["end_effector_wrenches"] = json!(wrenches);
    }
    if instant.targets.iter().any(Option::is_some) {
        let target = |target: &Target<f64>| {
            json!({
                "mass": target.mass,
                "inertia": target.inertia,
                "contact": target.contact,
                "twist": target.twist,
            })
        };
        value["targets"] = instant.targets.iter().map(|entry| entry.as_ref().map(target)).collect();
    }
    value
}

#[cfg(test)]
mod tests {
    use super::to_json;
    use crate::eval::States;
    use planar_build::prove::sampling::Regime;
    use planar_proof::layout;

    /// What is written reads back, with and without wrenches and targets.
    #[test]
    fn inputs_read_back() {
        let layout = layout("dual_arm_3r");
        let inputs: Vec<_> = (0..40).map(|i| Regime::Moving.sample(&layout, 7, i).instant).collect();
        let (mut wrenches, mut targets) = ([0; 2], [0; 3]);
        for input in &inputs {
            wrenches[usize::from(input.end_effector_wrenches.is_some())] += 1;
            targets[input.targets.iter().flatten().count()] += 1;
            let text = serde_json::json!([to_json(input)]).to_string();
            let read = States::new(text.as_bytes(), &layout).next_state().expect("a state").expect("one");
            assert_eq!(read, *input);
        }
        assert!(wrenches.iter().chain(&targets).all(|count| *count > 0), "{wrenches:?} {targets:?}");
    }
}
