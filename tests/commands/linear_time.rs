//! Layouts and scenarios with thousands of mistakes: the time of their report is linear in their size.

use planar_capture::check::inspect;
use planar_capture::registry::SHIPPED;
use planar_proof::linear_time::assert_linear_time;
use planar_proof::{file, layout};
use std::fs;

const LAYOUT: &str = "name = \"robot\"\n[base]\nmass = 1\ninertia = 1\n";
const ARM: &str = "[[arm]]\nname = \"arm\"\nmount = [0, 0]\n[[arm.link]]\nlength = 1\nmass = 1\ninertia = 1\n";

fn many(count: usize, one: &dyn Fn(usize) -> String) -> String {
    (0..count / 10).map(one).collect()
}

#[test]
fn a_layout_is_reported_in_linear_time() {
    let is_linear = |what: &str, text: &dyn Fn(usize) -> String| {
        assert_linear_time(what, text, |text| {
            let report = inspect(text, "robot.toml", &file(""), SHIPPED).expect_err("mistakes").to_string();
            assert!(report.len() < 10_000, "{what}: {report:.1000}");
        });
    };
    is_linear("errors on a line", &|count| format!("{LAYOUT}x {}", "=".repeat(count)));
    is_linear("errors on many lines", &|count| LAYOUT.to_owned() + &many(count, &|i| format!("x{i} =\n")));
    is_linear("an array without commas", &|count| format!("{LAYOUT}x = [{}]", many(count, &|_| "1 ".to_owned())));
    is_linear("unknown keys", &|count| many(count, &|i| format!("mass{i} = 1\n")) + LAYOUT + ARM);
    is_linear("unknown tables", &|count| LAYOUT.to_owned() + ARM + &many(count, &|i| format!("[[arm{i}]]\nx = 1\n")));
    is_linear("misplaced tables", &|count| LAYOUT.to_owned() + &many(count, &|_| ARM.replace("arm.link", "link")));
    is_linear("the same names", &|count| LAYOUT.to_owned() + &many(count, &|_| ARM.to_owned()));
    is_linear("wrong numbers", &|count| LAYOUT.to_owned() + &many(count, &|_| ARM.replace("1\n", "-1\n")));
    is_linear("corners of an outline", &|count| {
        let corners = many(10 * count, &|i| format!("[{i}e-4, {}e-8], ", i * i));
        LAYOUT.to_owned() + &format!("outline = {{ polygon = [{corners}] }}\n") + &ARM.replace("mass = 1", "mass = 0")
    });
    is_linear("hidden characters", &|count| {
        LAYOUT.to_owned() + &many(count, &|_| ARM.replace("\"arm\"", "\"\u{202e}\""))
    });
}

#[test]
fn a_scenario_is_reported_in_linear_time() {
    let text = fs::read_to_string(file("scenarios/raina_shah_2017.toml")).expect("a scenario");
    let is_linear = |what: &str, more: &dyn Fn(usize) -> String| {
        assert_linear_time(
            what,
            |count| text.clone() + &more(count),
            |text| {
                let report =
                    inspect(text, "study.toml", &file("scenarios"), SHIPPED).map(|checked| checked.description);
                assert!(report.is_err_and(|report| report.to_string().len() < 20_000), "{what}");
            },
        );
    };
    is_linear("the same cases", &|count| many(count, &|_| "[[case]]\nname = \"a\"\n".to_owned()));
    is_linear("unknown targets", &|count| {
        many(count, &|i| format!("[[case]]\nname = \"a{i}\"\ntarget_twists = {{ x = [0, 0, 0] }}\n"))
    });
    is_linear("targets", &|count| {
        many(count, &|i| format!("[[target]]\nname = \"a{i}\"\narm = \"arm{i}\"\nmass = 0\n"))
    });
}

/// Many arms are a layout.
#[test]
fn a_large_layout_is_read_in_linear_time() {
    let arms = |count: usize| {
        let mut robot = layout("single_arm_2r");
        let arm = robot.arms[0].clone();
        robot.arms =
            (0..count / 10).map(|i| planar_capture::layout::Arm { name: format!("a{i}"), ..arm.clone() }).collect();
        robot.to_toml()
    };
    assert_linear_time("arms", arms, |text| {
        assert!(inspect(text, "robot.toml", &file(""), SHIPPED).is_ok());
    });
}
