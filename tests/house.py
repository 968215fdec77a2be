"""Checks the structure of the workspace; exits with 1 and a line for each violation.

    python3 tests/house.py

- A published crate depends only on those before it in ORDER; only tests depend on planar-proof.
- No `#[path]`, no `include_str!` or `include_bytes!` that leaves its crate, no dead code allowed.
- A target with `test = false` has no tests; every nested workspace has its lock committed.
- A crate with a robot of one's own builds few crates.
- An exact requirement of a dependency has its reason on the line; Cargo.toml, CITATION.cff and CHANGELOG.md have one
  version.
- Modules of a crate, and those of each of its folders, use each other in one direction: no circles.
- Every public module has an example that rustdoc runs, in its own files or in those of its private modules.
"""

import argparse
import json
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
ORDER = ["planar-dynamics", "planar-layout", "planar-build", "planar-capture"]
FIXTURES = "planar-proof"
OWN_ROBOT, MOST_CRATES = "examples/own_robot/Cargo.lock", 40
OWN_FILES = {"lib", "main", "mod"}


def output(*command):
    """Standard output of a command."""
    return subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True).stdout


def tracked(pattern):
    """The repository's files, as paths from its root."""
    names = output("git", "ls-files", "-z", "--cached", "--others", "--exclude-standard", pattern).split("\0")
    return [Path(name) for name in sorted(names) if name and (ROOT / name).exists()]


def directions(packages):
    """Dependencies between this workspace's packages in a direction that ORDER excludes."""
    names = {package["name"] for package in packages}
    for package in packages:
        name, published = package["name"], package["publish"] is None
        if published != (name in ORDER):
            yield f"{name}: ORDER names the crates that are published"
            continue
        before = ORDER[: ORDER.index(name)] if published else ORDER[:-1]
        for dependency in (d for d in package["dependencies"] if d["name"] in names):
            other, tests_only = dependency["name"], dependency["kind"] == "dev"
            if not tests_only and other not in before:
                yield f"{name} depends on {other}: allowed are {', '.join(before) or 'none'}"
            if tests_only and other == FIXTURES and dependency["req"] != "*":
                yield f"{name}: {FIXTURES} with a version cannot be left out when the crate is packaged"


def own_robot():
    """The crates of a crate with a robot of one's own, where they are too many."""
    crates = (ROOT / OWN_ROBOT).read_text(encoding="utf-8").count("[[package]]")
    if crates > MOST_CRATES:
        yield f"{OWN_ROBOT}: {crates} crates, at most {MOST_CRATES}"


def crate_of(path):
    """The folder of the crate that a file belongs to."""
    return next(folder for folder in path.parents if (ROOT / folder / "Cargo.toml").exists())


def code(path):
    """A file's text without comments."""
    return re.sub(r"(?m)(^|\s)//.*$", "", (ROOT / path).read_text(encoding="utf-8"))


def texts(path):
    """Texts that a source file must not contain."""
    text = code(path)
    if re.search(r"#!?\[path\b", text):
        yield f"{path}: #[path]"
    if re.search(r"(allow|expect)\(dead_code", text):
        yield f"{path}: dead code is allowed"
    own = ROOT / crate_of(path)
    for start, name in re.findall(
        r'include_(?:str|bytes)!\(\s*(concat!\(env!\("CARGO_MANIFEST_DIR"\),\s*)?"([^"]+)"', text
    ):
        file = (own / name.lstrip("/") if start else (ROOT / path).parent / name).resolve()
        if not file.is_relative_to(own) or ROOT / crate_of(file.relative_to(ROOT)) != own:
            yield f"{path}: includes {name}, which is not its crate's"


def untested(packages):
    """Tests in targets that are not tested."""
    for package in packages:
        for target in package["targets"]:
            if target["test"] or target["kind"] == ["custom-build"]:
                continue
            main = Path(target["src_path"]).relative_to(ROOT)
            modules = re.findall(r"(?m)^\s*(?:pub )?mod (\w+);", code(main))
            for path in [main, *(p for p in tracked(f"{main.parent}/*.rs") if place(p, main.parent) in modules)]:
                if re.search(r"#\[(cfg\()?test\b", code(path)):
                    yield f"{path}: a test in a target that is not tested ({target['name']} of {package['name']})"


def requirements():
    """Exact requirements without a reason."""
    for path in tracked("*Cargo.toml"):
        for number, line in enumerate((ROOT / path).read_text(encoding="utf-8").splitlines(), 1):
            if re.search(r"""["']=\s*\d""", line) and "#" not in line:
                yield f"{path}:{number}: an exact requirement without its reason on the line"


def versions(packages):
    """Where the version of the published crates is another."""
    (version,) = {package["version"] for package in packages if package["name"] in ORDER}
    for file, pattern in [("CITATION.cff", r"^version: (\S+)"), ("CHANGELOG.md", r"^## ([\d.]+\S*?)(?:,| |$)")]:
        found = re.search(pattern, (ROOT / file).read_text(encoding="utf-8"), flags=re.M)
        if not found or found[1] != version:
            yield f"{file}: the version is {version} in Cargo.toml, and here {found and found[1]}"


def place(path, folder):
    """The module of a folder that a file is in: its first part below the folder."""
    return path.relative_to(folder).parts[0].removesuffix(".rs")


def named(path, source, folder):
    """The names that a file uses from the module of a folder, by the path from the crate's root or by `super`."""
    supers = len(path.relative_to(folder).parts) - (path.name == "mod.rs")
    absolute = "::".join(["crate", *folder.relative_to(source).parts])
    root = rf"(?:\b{absolute}|(?<!super::)\bsuper(?:::super){{{supers - 1}}})"
    for name, group in re.findall(root + r"::(?:(?!super\b)(\w+)|\{(.*?)\};)", code(path), flags=re.S):
        if name:
            yield name
        else:
            flat = re.sub(r"\{[^{}]*\}", "", re.sub(r"\{[^{}]*\}", "", group))
            yield from re.findall(r"(?:^|,)\s*(\w+)", flat)


def exported(folder):
    """Pairs of name and module for the names that a folder's own file re-exports."""
    file = folder / "mod.rs"
    text = code(file) if (ROOT / file).exists() else ""
    for module, name, group in re.findall(r"\buse (?:self::)?(\w+)::(?:(\w+)|\{(.*?)\});", text, flags=re.S):
        yield from ((found, module) for found in ([name] if name else re.findall(r"\w+", group)))


def circles(source, folder):
    """Circles among the modules of a folder: a shortest one through each module, once."""
    files = [path for path in tracked(f"{folder}/*.rs") if path.parent != folder or path.stem not in OWN_FILES]
    modules = {place(path, folder) for path in files}
    module_of = {name: module for name, module in exported(folder) if module in modules}
    edges = {module: {} for module in modules}
    for path in files:
        module = place(path, folder)
        for other in {module_of.get(name, name) for name in named(path, source, folder)} & modules - {module}:
            edges[module].setdefault(other, path)
    seen = set()
    for start in sorted(modules):
        circle = shortest(edges, start)
        if circle and frozenset(circle) not in seen:
            seen.add(frozenset(circle))
            steps = zip(circle, [*circle[1:], circle[0]], strict=True)
            yield f"circle of modules in {folder}: " + ", ".join(
                f"{a} → {b} ({edges[a][b].relative_to(folder)})" for a, b in steps
            )


def shortest(edges, start):
    """The shortest circle through a module; `None` if there is none."""
    ways, reached = [[start]], {start}
    while ways:
        ways = [[*way, other] for way in ways for other in sorted(edges[way[-1]])]
        for way in ways:
            if way[-1] == start:
                return way[:-1]
        ways = [way for way in ways if way[-1] not in reached and not reached.add(way[-1])]
    return None


def public_modules(file):
    """The files of a public module and of its private ones, then the same of each public module below it."""
    folder = file.parent if file.stem in OWN_FILES else file.with_suffix("")
    own, below = [file], []
    for hidden, public, name in re.findall(r"(?m)^(#\[doc\(hidden\)\]\n)?(pub )?mod (\w+);", (ROOT / file).read_text()):
        (inner,) = [path for path in (folder / f"{name}.rs", folder / name / "mod.rs") if (ROOT / path).exists()]
        modules = public_modules(inner)
        if public and not hidden:
            below += modules
        else:
            own += [path for files in modules for path in files]
    return [own, *below]


def without_example(library):
    """The public modules below a library without an example that rustdoc compiles."""
    for files in public_modules(library)[1:]:
        lines = "\n".join((ROOT / file).read_text(encoding="utf-8") for file in files)
        fences = re.findall(r"(?m)^\s*//[/!] ```(.*)$", lines)[::2]
        if not any(set(fence.split(",")) <= {"", "no_run", "rust"} for fence in fences):
            yield f"{files[0]}: a public module without an example"


def main():
    """Exit code 1 if there is a violation."""
    argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter).parse_args()
    packages = json.loads(output("cargo", "metadata", "--locked", "--no-deps", "--format-version", "1"))["packages"]
    problems = [*directions(packages), *untested(packages), *own_robot(), *requirements(), *versions(packages)]
    problems += [problem for path in tracked("*.rs") for problem in texts(path)]
    locks = set(map(str, tracked("*Cargo.lock")))
    own = [
        path.parent for path in tracked("*Cargo.toml") if re.search(r"(?m)^\[workspace\]", (ROOT / path).read_text())
    ]
    problems += [
        f"{folder}: its Cargo.lock is not committed" for folder in own if str(folder / "Cargo.lock") not in locks
    ]
    for package in packages:
        source = Path(package["manifest_path"]).parent.relative_to(ROOT) / "src"
        folders = sorted({source, *(folder for path in tracked(f"{source}/*.rs") for folder in path.parents[:-1])})
        problems += [
            circle for folder in folders if source in [folder, *folder.parents] for circle in circles(source, folder)
        ]
        library = source / "lib.rs"
        if package["publish"] is None:
            problems += without_example(library)
    for problem in problems:
        print(f"house: {problem}")
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()
