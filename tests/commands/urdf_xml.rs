//! URDF files as XML: what is ignored, what is nested, what no other parser should be asked to read.

use crate::said;
use planar_capture::layout::Layout;
use planar_capture::urdf::{ImportOptions, ImportedLayout, import};
use planar_proof::file;
use planar_proof::linear_time::assert_linear_time;
use std::fs;
use tempfile::TempDir;

/// A base and one link, with texts in the base, in the robot and before it.
fn robot(in_base: &str, in_robot: &str, before: &str) -> String {
    format!(
        "{before}<robot name=\"bot\" version=\"1.0\">\n<link name=\"base\">{in_base}<inertial><mass value=\"100\"/>\
         <inertia ixx=\"20\" iyy=\"20\" izz=\"20\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>\n\
         <joint name=\"shoulder\" type=\"continuous\"><parent link=\"base\"/><child link=\"arm\"/>\
         <origin xyz=\"0.5 0 0\" rpy=\"0 0 0.25\"/><axis xyz=\"0 0 1\"/></joint>\n\
         <link name=\"arm\"><inertial><origin xyz=\"0.5 0 0\"/><mass value=\"10\"/>\
         <inertia ixx=\"1\" iyy=\"1\" izz=\"1\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>\n{in_robot}</robot>"
    )
}

fn read(text: &str) -> Result<ImportedLayout, String> {
    import(text, &ImportOptions::default()).map_err(|problem| problem.to_string())
}

fn layout(text: &str) -> Layout {
    read(text).unwrap_or_else(|problem| panic!("{problem}\n{text}")).layout
}

#[test]
fn visuals_and_all_that_is_no_element_are_ignored() {
    let plain = layout(&robot("", "", ""));
    let visual = "<visual><origin xyz=\"oops\"/><geometry><mesh filename=\"&file;\"/></geometry><material name=\"m\">\
                  <color/><texture/></material></visual><collision/><visual/><collision/>";
    for (in_base, in_robot, before) in [
        (visual, "", ""),
        ("<![CDATA[</link><link name=\"no\">]]>", "<![CDATA[<joint/>]]>", ""),
        ("<?pi <link name=\"no\"> ?>", "<?pi </robot>?>", "<?xml version=\"1.0\"?><?pi <a> ?>"),
        ("<!-- <link> </robot> -- > -->", "<!--<joint>-->", "<!-- <robot> -->\n"),
        ("<extra a='/>' b=\"</link>\"/>", "<extra a=\"/>\"><link name='no'/></extra>", "\u{feff}"),
        ("&amp;&#65;&unknown; text", "<gazebo reference=\"base\"><mass value=\"x\"/></gazebo>", ""),
        ("", "<transmission name=\"t\"><joint name=\"shoulder\"/></transmission>", "<!DOCTYPE robot>"),
        ("", "", "<!DOCTYPE robot [<!ENTITY a \"<link>\"><!ENTITY b \"&a;&a;\"><!ELEMENT robot ANY>]>"),
    ] {
        let text = robot(in_base, in_robot, before);
        assert_eq!(layout(&text), plain, "{text}");
    }
}

/// iCub's models have an empty texture in each visual.
#[test]
fn the_command_reads_a_visual_with_an_empty_texture() {
    let folder = TempDir::new().expect("a folder");
    let urdf = folder.path().join("icub.urdf");
    let visual =
        "<visual><geometry><box size=\"1 1 1\"/></geometry><material name=\"m\"><texture/></material></visual>";
    fs::write(&urdf, robot(visual, "", "")).expect("written");
    let (code, out, err) = said(&["import", &urdf.display().to_string()]);
    assert_eq!(code, 0, "{err}");
    assert!(out.contains("name = \"bot\""), "{out}");
}

#[test]
fn attributes_are_read_as_xml_says() {
    let plain = robot("", "", "");
    for (from, to) in [
        ("\"0.5 0 0\" rpy", "'&#48;.5\n\t0 &#x30;' rpy"),
        ("name=\"arm\">", "name = '&#97;rm' >"),
        ("<origin xyz=\"0.5 0 0\"/>", "<origin xyz=\"0.5 0 0\"></origin>"),
    ] {
        assert!(plain.contains(from));
        assert_eq!(layout(&plain.replacen(from, to, 1)), layout(&plain), "{to}");
    }
}

/// From version 1.1 on an origin may have a quaternion; before it is no attribute.
#[test]
fn quaternions_turn_as_rpy_does() {
    let (half, plain) = (0.125_f64, robot("", "", ""));
    let quaternion = format!("quat_xyzw=\"0 0 {:?} {:?}\"", half.sin(), half.cos());
    let turned = plain.replace("rpy=\"0 0 0.25\"", &quaternion);
    let angle = |text: &str| layout(text).arms[0].mount_angle;
    assert!((angle(&turned.replace("\"1.0\"", "\"1.1\"")) - 0.25).abs() < 1e-15);
    assert!(angle(&turned).abs() < 1e-15);
    let both = plain.replace("rpy=", &format!("{quaternion} rpy=")).replace("\"1.0\"", "\"1.1\"");
    assert!(read(&both).expect_err("both").contains("both `rpy` and `quat_xyzw`"));
}

/// Before version 1.2 a limit that is not given is 0, from then on there is none: read as the version says.
#[test]
fn limits_that_are_not_given_are_those_of_the_version() {
    let plain = robot("", "", "").replace("\"continuous\"", "\"revolute\"");
    let limited = plain.replace("<axis", "<limit velocity=\"2.0\"/><axis");
    for (version, angles) in [("1.0", true), ("1.1", true), ("1.2", false), ("1.3", false)] {
        let text = limited.replace("version=\"1.0\"", &format!("version=\"{version}\""));
        let omitted = format!("{:?}", read(&text).unwrap_or_else(|problem| panic!("{problem}")));
        assert_eq!(omitted.contains("angle [-0.0, 0.0] rad"), angles, "{version}: {omitted}");
        assert!(omitted.contains("2.0 rad/s"), "{version}: {omitted}");
    }
}

#[test]
fn what_is_no_document_is_refused_with_its_line() {
    let plain = robot("", "", "");
    let changed = |from: &str, to: &str| {
        assert!(plain.contains(from), "{from}");
        plain.replacen(from, to, 1)
    };
    for (text, hints) in [
        (format!("{plain}\n<robot/>"), &["line 6", "second root element"][..]),
        (format!("text\n{plain}"), &["line 1", "text outside"]),
        (format!("<![CDATA[x]]>{plain}"), &["text outside"]),
        (format!("{plain}&amp;"), &["line 5", "text outside"]),
        (changed("</link>\n<joint", "\n<joint"), &["line 5", "</link>"]),
        (changed("</robot>", "</robot></robot>"), &["line 5", "robot"]),
        (changed("</robot>", ""), &["line 1: `<robot>` is not closed"]),
        (changed("<link name=\"arm\">", "<link name=\"arm\" name=\"b\">"), &["line 4, link ``", "duplicate"]),
        (changed("<link name=\"arm\">", "<link name=arm>"), &["line 4, link ``", "<link>"]),
        (changed("<link name=\"arm\">", "<link>"), &["line 4", "no `name`"]),
        (changed("value=\"10\"", "value=\"&ten;\""), &["line 4, link `arm`", "`value` of <mass>", "ten"]),
        (changed("value=\"10\"", "value=\"&#0;10\""), &["line 4, link `arm`", "`value` of <mass>"]),
        (changed("value=\"10\"", "value=\"\""), &["line 4, link `arm`", "0 numbers, expected 1 number"]),
        (changed("value=\"10\"", ""), &["line 4, link `arm`", "<mass> has no `value`"]),
        (
            changed("\"0.5 0 0\"/>", "\"0.5 0\"/>"),
            &["line 4, link `arm`", "`xyz` of <origin>", "2 numbers, expected 3"],
        ),
        (changed("<mass value=\"10\"/>", "<mass value=\"1\"/><mass value=\"2\"/>"), &["link `arm`", "second <mass>"]),
        (changed("<axis", "<axis xyz=\"1 0 0\"/><axis"), &["line 3, joint `shoulder`", "second <axis>"]),
        (changed("<parent link=\"base\"/>", ""), &["line 3, joint `shoulder`", "no <parent>"]),
        (changed("<robot", "<!DOCTYPE robot [<!ENTITY a \"b\"]"), &["not a URDF"]),
        ("<!-- never closed".to_owned(), &["line 1", "comment"]),
        ("<?xml".to_owned(), &["not a URDF"]),
        ("<!DOCTYPE robot>".to_owned(), &["no elements"]),
    ] {
        let problem = read(&text).expect_err(&text);
        for hint in hints {
            assert!(problem.contains(hint), "no `{hint}` in `{problem}` of\n{text}");
        }
    }
}

/// Names reach a terminal and files: nothing in them moves the cursor or reorders the text.
#[test]
fn messages_and_layouts_have_no_control_characters() {
    let plain = robot("", "", "");
    for hidden in ["&#27;[2J", "\u{202e}", "&#x2066;", "\u{200f}", "&#x61c;"] {
        let text = plain.replace("\"shoulder\"", &format!("\"shoul{hidden}der\""));
        for said in [
            read(&text).expect("a layout").to_toml("a"),
            read(&text.replace("\"arm\"", "\"\"")).map_or_else(|p| p, |l| l.to_toml("a")),
        ] {
            let unsafe_character =
                |c: char| c != '\n' && (c.is_control() || "\u{202e}\u{2066}\u{200f}\u{61c}".contains(c));
            assert!(!said.contains(unsafe_character), "{said:?}");
        }
        assert!(!read(&text.replace("continuous", "prismatic")).expect_err("a slide").contains(['\u{1b}', '\u{202e}']));
    }
}

/// Forms of nesting that a search for tags takes for something else; 30,000 levels overflow the stack of a recursive
/// parser.
#[test]
fn deep_nesting_is_refused_however_it_is_written() {
    for (open, close) in [
        ("<a x=\"/>\">", "</a>"),
        ("<a x='/>'>", "</a >"),
        ("<a><![CDATA[</a>]]>", "</a>"),
        ("<a><?pi </a>?>", "</a>"),
        ("<a><!-- </a> -->", "</a>"),
        ("<a\n>", "</a\n>"),
    ] {
        for ends in [30_000, 0] {
            let text = robot("", &(open.repeat(30_000) + &close.repeat(ends)), "");
            let problem = read(&text).expect_err(open);
            assert!(problem.contains("30001 deep") && problem.contains("64"), "{open}: {problem}");
        }
    }
    let depth = |levels: usize| robot("", &("<a>".repeat(levels) + &"</a>".repeat(levels)), "");
    assert!(read(&depth(63)).is_ok());
    assert!(read(&depth(64)).expect_err("65 levels").contains("65 deep"));
}

#[test]
fn the_time_is_linear_in_the_size() {
    let many = |count: usize, one: &dyn Fn(usize) -> String| (0..count).map(one).collect::<String>();
    let moving = |count: usize, parent: &dyn Fn(usize) -> String| {
        let parts = many(count / 10, &|i| {
            let parent = parent(i);
            format!(
                "<link name=\"l{i}\"><inertial><mass value=\"1\"/><inertia ixx=\"1\" iyy=\"1\" izz=\"1\" ixy=\"0\" \
                 ixz=\"0\" iyz=\"0\"/></inertial></link><joint name=\"j{i}\" type=\"revolute\"><parent \
                 link=\"{parent}\"/><child link=\"l{i}\"/><axis xyz=\"0 0 1\"/></joint>"
            )
        });
        robot("", &parts, "")
    };
    let fixed = |i: usize| {
        format!(
            "<link name=\"l{i}\"/><joint name=\"j{i}\" type=\"fixed\"><parent link=\"arm\"/><child link=\"l{i}\"/></joint>"
        )
    };
    let is_linear =
        |what: &str, text: &dyn Fn(usize) -> String| assert_linear_time(what, text, |text| drop(read(text)));
    is_linear("elements", &|count| robot("", &"<a/>".repeat(count), ""));
    is_linear("lines", &|count| robot("", &"<a>\n</a>".repeat(count), ""));
    is_linear("entities", &|count| robot(&"&a;".repeat(count), "", ""));
    is_linear("comments", &|count| robot("", &"<!---->".repeat(count), ""));
    is_linear("attributes", &|count| robot("", &format!("<joint{}/>", many(count, &|i| format!(" a{i}=\"1\""))), ""));
    is_linear("fixed links", &|count| robot("", &many(count, &fixed), ""));
    is_linear("many arms", &|count| moving(count, &|_| "base".to_owned()));
    let before = |i: usize| if i == 0 { "arm".to_owned() } else { format!("l{}", i - 1) };
    is_linear("a long chain", &|count| moving(count, &before));
}

#[test]
fn the_shipped_example_is_read_as_before() {
    let text = fs::read_to_string(file("tests/urdf/clutter.urdf")).expect("a file");
    assert_eq!(layout(&text).arms.iter().map(|arm| arm.links.len()).collect::<Vec<_>>(), [3, 1]);
}
