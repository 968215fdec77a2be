//! The tables of keys: paths to keys, and the tables themselves.

use planar_capture::format::{Default, Key, Shape, ShapeAt, Step, TableFormat, With};
use planar_capture::scenario::{KeyFile, find_key};
use planar_capture::{layout, scenario};

/// Every table of a file, each once.
fn tables(root: &'static TableFormat) -> Vec<&'static TableFormat> {
    let inner = root.keys.iter().filter_map(|key| match key.shape {
        Shape::Table(table) | Shape::Tables(table) => Some(table),
        _ => None,
    });
    let mut all = vec![root];
    for table in inner.flat_map(tables) {
        if !all.iter().any(|known| std::ptr::eq(*known, table)) {
            all.push(table);
        }
    }
    all
}

fn choices(key: &Key) -> Vec<&'static str> {
    match &key.shape {
        Shape::Choice(of) | Shape::OneOrList(Shape::Choice(of), _) => of().iter().map(|choice| choice.name).collect(),
        _ => Vec::new(),
    }
}

#[test]
fn tables_of_keys_agree_with_themselves() {
    for table in [&layout::FORMAT, &scenario::FORMAT].into_iter().flat_map(tables) {
        let names = table.names();
        assert!(table.one_of.iter().all(|name| names.contains(name)), "{}", table.doc);
        for (i, name) in names.iter().enumerate() {
            assert!(!names[..i].contains(name), "entries of `{name}` are not beside each other");
        }
        for key in table.keys {
            match key.with {
                Some(With::Choice(selector, with)) => {
                    let known = choices(table.key(selector).expect(selector));
                    assert!(with.iter().all(|choice| known.contains(choice)), "{}: {with:?} of {known:?}", key.name);
                }
                Some(With::Key(others)) => assert!(others.iter().all(|other| names.contains(other)), "{}", key.name),
                None => assert_eq!(table.variants(key.name).count(), 1, "{} without a choice", key.name),
            }
            match key.default {
                Default::Choice(choice) => assert!(choices(key).contains(&choice), "{}", key.name),
                Default::Number(_) => assert!(key.shape.rule().is_some(), "{}", key.name),
                _ => {}
            }
            let doc = key.doc;
            assert!(!doc.is_empty() && !doc.ends_with('.') && !doc.contains('\n'), "{}: {doc}", key.name);
        }
    }
}

#[test]
fn paths_lead_to_keys() {
    for (path, file, name, unit) in [
        ("approach.duration", KeyFile::Scenario, "duration", "s"),
        ("approach.proportional_gain", KeyFile::Scenario, "proportional_gain", "N m/rad"),
        ("approach.proportional_gain[2]", KeyFile::Scenario, "proportional_gain", "N m/rad"),
        ("initial.base_twist[0]", KeyFile::Scenario, "base_twist", "rad/s"),
        ("initial.joint_angles[5]", KeyFile::Scenario, "joint_angles", "rad"),
        ("target.target1.inertia", KeyFile::Scenario, "inertia", "kg m²"),
        ("target.\"my.t\".mass", KeyFile::Scenario, "mass", "kg"),
        ("target.'my t'.contact[1]", KeyFile::Scenario, "contact", "m"),
        ("target.t.contact[1][0]", KeyFile::Scenario, "contact", "m"),
        ("target.t.polygon[3][1]", KeyFile::Scenario, "polygon", "m"),
        ("case.case1.target_twists.target1[0]", KeyFile::Scenario, "target_twists", "rad/s"),
        ("case.case1.restitutions.\"a.b\"", KeyFile::Scenario, "restitutions", ""),
        ("limits.joint_angles[0][1]", KeyFile::Scenario, "joint_angles", "rad"),
        ("limits.joint_angles[1]", KeyFile::Scenario, "joint_angles", "rad"),
        ("layout.base.mass", KeyFile::Layout, "mass", "kg"),
        ("layout.arm.arm1.link[0].com[1]", KeyFile::Layout, "com", "m"),
        ("layout.arm.arm1.link[2].outline.capsule", KeyFile::Layout, "capsule", "m"),
        ("layout.base.outline.box[1]", KeyFile::Layout, "box", "m"),
    ] {
        let (found, place) = find_key(path).unwrap_or_else(|error| panic!("{error}"));
        let rule = place.number().unwrap_or_else(|| panic!("{path} is no number: {place:?}"));
        assert_eq!((found, place.keys[0].name, rule.unit()), (file, name, unit), "{path}");
    }
    let (_, place) = find_key("target.\"my.\\\"t\\\"\".contact[1]").expect("a quoted name");
    let key = |name: &str| Step::Key(name.to_owned());
    let steps = [key("target"), Step::Named("my.\"t\"".to_owned()), key("contact"), Step::Index(1)];
    assert_eq!(place.steps, steps);
    // entries for each law, and what is no single number
    assert_eq!(find_key("approach.proportional_gain").map(|(_, place)| place.keys.len()), Ok(2));
    let (file, place) = find_key("layout").expect("the key of the scenario");
    assert!(file == KeyFile::Scenario && place.number().is_none());
    assert!(matches!(place.shape, ShapeAt::Whole(Shape::Text(_))));
    assert!(find_key("initial.base_pose").is_ok_and(|(_, place)| place.number().is_none()));
    assert!(find_key("target.t").is_ok_and(|(_, place)| matches!(place.shape, ShapeAt::Whole(Shape::Tables(_)))));
}

#[test]
fn wrong_paths_name_the_nearest() {
    for (path, nearest, part) in [
        ("aproach.duration", Some("approach.duration"), "the top level has no key `aproach`"),
        ("approach.proportional_gian[2]", Some("approach.proportional_gain[2]"), "did you mean `approach.prop"),
        ("target.\"my.t\".mas", Some("target.\"my.t\".mass"), "`target.\"my.t\"` has no key `mas`"),
        ("layout.arm.arm1.link[0].mas", Some("layout.arm.arm1.link[0].mass"), "`layout.arm.arm1.link[0]` has no"),
        ("layout.bsae.mass", Some("layout.base.mass"), "`layout` has no key `bsae`"),
        ("approach.xyz", None, "expected `duration`, `step`"),
        ("layout.arm.arm1.link.mass", None, "at `layout.arm.arm1.link`: these tables have no names"),
        ("target[0].mass", None, "at `target`: these tables have names"),
        (
            "approach.duration[0]",
            None,
            "at `approach.duration`: it is a duration in s greater than 0, which has no elements",
        ),
        ("approach.duration.x", None, "which has no keys"),
        ("initial.base_pose[3]", None, "[yaw, x, y] in rad, m, m, expected an index less than 3"),
        ("initial.base_pose[0][0]", None, "it is a number, expected the end of the path"),
        ("layout.base.outline.ends[2][0]", None, "2 elements"),
        ("approach[0]", None, "at `approach`: expected a key of it: `duration`"),
        ("approach.final_joint_angles[x]", None, "`[x]` is no index"),
        ("approach.final_joint_angles[-1]", None, "`[-1]` is no index"),
        ("approach.final_joint_angles[99999999999999999999999]", None, "is no index"),
        ("approach..duration", None, "expected a key at `.duration`"),
        ("approach duration", None, "expected `.` or `[` before ` duration`"),
        ("target.\"my.t.mass", None, "expected a key at `\"my.t.mass`"),
        ("", None, "expected a key at ``"),
    ] {
        let error = find_key(path).expect_err(path);
        assert_eq!(error.nearest.as_deref(), nearest, "{error}");
        assert!(error.to_string().contains(part), "{error}");
        assert!(error.to_string().starts_with(&format!("`{path}`: ")), "{error}");
    }
}
