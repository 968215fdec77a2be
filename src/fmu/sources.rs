//! The sources that are the same for every robot: the functions of FMI, and its headers.

/// Sources of our own, which are compiled with the module and `robot.c`.
pub(super) const COMPILED: [&str; 5] = ["instance.c", "step.c", "saved_state.c", "absent.c", "other_interfaces.c"];

/// (name, text) of the files; the headers of FMI 3.0.2 are those of the Modelica Association, unchanged.
pub(super) fn fixed() -> impl Iterator<Item = (&'static str, &'static str)> {
    [
        ("instance.h", include_str!("sources/instance.h")),
        ("instance.c", include_str!("sources/instance.c")),
        ("step.c", include_str!("sources/step.c")),
        ("saved_state.c", include_str!("sources/saved_state.c")),
        ("absent.c", include_str!("sources/absent.c")),
        ("other_interfaces.c", include_str!("sources/other_interfaces.c")),
        ("fmi3Functions.h", include_str!("fmi3/fmi3Functions.h")),
        ("fmi3FunctionTypes.h", include_str!("fmi3/fmi3FunctionTypes.h")),
        ("fmi3PlatformTypes.h", include_str!("fmi3/fmi3PlatformTypes.h")),
    ]
    .into_iter()
}

/// The name of a module's files without extension: its own, or another one where files of every FMU have that.
pub(super) fn module_file(name: &str) -> String {
    let own = fixed().map(|(file, _)| file).chain(["robot.c"]);
    let mut names = own.filter_map(|file| file.split('.').next());
    // on some systems `A.c` is `a.c`
    if names.any(|own| own.eq_ignore_ascii_case(name)) { format!("{name}_module") } else { name.to_owned() }
}

/// The sources that are compiled, for a module of this name.
pub(super) fn compiled(name: &str) -> Vec<String> {
    [format!("{}.c", module_file(name)), "robot.c".to_owned()].into_iter().chain(COMPILED.map(str::to_owned)).collect()
}
