//! States of `eval`: read, evaluated by generated code, and written.

use super::{Target, file, refused};
use planar_capture::eval::{States, result_to_json};
use planar_capture::evaluation::evaluate;
use planar_capture::layout::Layout;
use planar_capture::registry;
use serde_json::Value;

pub fn target() -> Target {
    let reference: Value = serde_json::from_str(&file("tests/reference/pinocchio_dual_arm_3r.json")).expect("JSON");
    let states = reference["states"].as_array().expect("states").iter().map(|state| {
        let mut state = state.clone();
        state.as_object_mut().expect("a state").shift_remove("expect");
        format!("[{state}]")
    });
    Target { name: "states", share: 38, seeds: states.collect(), read }
}

fn read(bytes: &[u8]) -> Result<bool, String> {
    thread_local! {
        static MODEL: (Layout, Box<dyn planar_capture::owned::CloneModel>) = {
            let layout = Layout::parse(&file("codegen/layouts/dual_arm_3r.toml"), "layout").expect("a layout");
            let model = registry::generated(&layout).expect("generated code");
            (layout, model)
        };
    }
    MODEL.with(|(layout, model)| {
        let mut states = States::new(bytes, layout);
        loop {
            match states.next_state() {
                Ok(None) => return Ok(true),
                Err(error) => return refused(&error),
                Ok(Some(state)) => match evaluate(&**model, &state) {
                    Ok(values) => drop(result_to_json(&values, &state.targets).to_string()),
                    Err(error) => return refused(&error),
                },
            }
        }
    })
}
