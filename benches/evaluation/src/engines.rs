//! Pinocchio and MuJoCo, compiled as C++ against the headers and the library of their Python packages, and this project's own
//! package of Python.

use evaluation::Problem;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Names of their columns.
pub const ENGINES: [&str; 2] = ["Pinocchio", "MuJoCo"];

/// The name of what is measured of the Python package.
pub const PACKAGE: &str = "Python package";

/// Boost's lists are as long as Pinocchio's choice of joints.
const OF_PINOCCHIO: [&str; 3] =
    ["-DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS", "-DBOOST_MPL_LIMIT_LIST_SIZE=30", "-DBOOST_MPL_LIMIT_VECTOR_SIZE=30"];

/// Programs that measure, one for each of [`ENGINES`], with the packages of a Python interpreter.
pub fn compile(python: &str, target: &Path) -> Result<Vec<PathBuf>, Problem> {
    let folder = folder();
    let packages = output(Command::new(python).args(["-c", "import sysconfig; print(sysconfig.get_path('purelib'))"]))?;
    let packages = Path::new(packages.trim());
    let mujoco = packages.join("mujoco");
    let library = std::fs::read_dir(&mujoco)
        .ok()
        .and_then(|files| {
            files.flatten().map(|file| file.path()).find(|path| path.to_string_lossy().contains("libmujoco.so"))
        })
        .ok_or(format!("{python} has no MuJoCo: python3 -m codegen.environment --reference makes one that has"))?;
    // clang's code of Pinocchio is the faster one
    let compiler = if Command::new("clang++").arg("--version").output().is_ok() { "clang++" } else { "c++" };
    let program = |name: &str| target.join(name);
    let compiling = |name: &str| {
        eprintln!("compiling {name}");
        let mut command = Command::new(compiler);
        command.args(["-O3", "-march=native", "-DNDEBUG", "-std=c++17"]).arg(folder.join(name).with_extension("cpp"));
        command.arg("-o").arg(program(name));
        command
    };
    let mut pinocchio = compiling("pinocchio");
    pinocchio.args(OF_PINOCCHIO).arg("-isystem").arg(packages.join("cmeel.prefix/include"));
    // the package has no headers of Eigen: libeigen3-dev of Debian has
    pinocchio.args(["-isystem", "/usr/include/eigen3"]);
    output(&mut pinocchio)?;
    let mut other = compiling("mujoco");
    other.arg("-isystem").arg(mujoco.join("include")).arg(&library).arg(format!("-Wl,-rpath,{}", mujoco.display()));
    output(&mut other)?;
    Ok(vec![program("pinocchio"), program("mujoco")])
}

/// Of the sources of the programs that measure.
pub fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("engines")
}

/// What a command prints.
pub fn output(command: &mut Command) -> Result<String, Problem> {
    let output = command.output().map_err(|error| format!("{}: {error}", command.get_program().display()))?;
    if !output.status.success() {
        let said = String::from_utf8_lossy(&output.stderr);
        let lines: Vec<_> = said.lines().take(20).collect();
        return Err(format!("{}: {}", command.get_program().display(), lines.join("\n")).into());
    }
    Ok(String::from_utf8(output.stdout)?)
}
