"""The layout reader: what cannot be read is named in one line, and the hash follows the content alone."""

import hashlib
import os
import subprocess
import sys

import pytest

from codegen.derive import HERE, derive_text, layout_path
from codegen.layout import LayoutError, content_hash, layout_names, read

TEXT = """\
name = "one_arm"
[base]
mass = 500.0
inertia = 83.61
[[arm]]
name = "left"
mount = [0.5, 0.25]
[[arm.link]]
length = 1.0
mass = 10.0
inertia = 1.05
[[arm.link]]
length = 2.0
mass = 9.0
inertia = 1.25
"""

UNREADABLE = [  # a text, what replaces it, and what is then said of the file
    ("mass = 9.0\n", "", "arm[0].link[1].mass is missing"),
    ("mass = 500.0\n", "", "base.mass is missing"),
    ('name = "one_arm"\n', "", "name is missing"),
    (TEXT[TEXT.index("[[arm]]") :], "", "arm is missing"),
    (TEXT[TEXT.index("[[arm.link]]") :], "", "arm[0].link is missing"),
    ("mass = 500.0", "mass = 500.0\nmas = 500.0", "base.mas is unknown"),
    ("length = 2.0", "length = 2.0\ncom_x = 1.0", "arm[0].link[1].com_x is unknown"),
    ('name = "one_arm"', 'name = "one_arm"\n"two\\nlines" = 1', "two lines is unknown"),
    ("mass = 500.0", "mass = true", "base.mass is not a finite number"),
    ("mass = 500.0", 'mass = "500"', "base.mass is not a finite number"),
    ("mass = 500.0", "mass = nan", "base.mass is not a finite number"),
    ("mass = 500.0", "mass = " + "9" * 400, "base.mass is not a finite number"),
    ("[0.5, 0.25]", "[0.5]", "arm[0].mount is not a pair [x, y]"),
    ("[0.5, 0.25]", "[0.5, 0.25, 0.0]", "arm[0].mount is not a pair [x, y]"),
    ("[0.5, 0.25]", "[0.5, inf]", "arm[0].mount[1] is not a finite number"),
    ('name = "left"', "name = 3", "arm[0].name is not a string"),
    (TEXT[TEXT.index("[base]") : TEXT.index("[[arm]]")], "base = 3\n", "base is not a table"),
    (TEXT[TEXT.index("[[arm]]") :], "[arm]\n", "arm is not a list of tables"),
    (TEXT[TEXT.index("[base]") :], "arm = []\nbase = { mass = 1, inertia = 1 }", "arm is not a list of tables"),
    (TEXT[TEXT.index("[base]") :], "arm = [3]\nbase = { mass = 1, inertia = 1 }", "arm[0] is not a table"),
]

CANONICAL = """\
name=one_arm
base.mass=407f400000000000
base.inertia=4054e70a3d70a3d7
arm[0].name=left
arm[0].mount[0]=3fe0000000000000
arm[0].mount[1]=3fd0000000000000
arm[0].mount_angle=0000000000000000
arm[0].link[0].length=3ff0000000000000
arm[0].link[0].mass=4024000000000000
arm[0].link[0].inertia=3ff0cccccccccccd
arm[0].link[0].com[0]=3fe0000000000000
arm[0].link[0].com[1]=0000000000000000
arm[0].link[1].length=4000000000000000
arm[0].link[1].mass=4022000000000000
arm[0].link[1].inertia=3ff4000000000000
arm[0].link[1].com[0]=3ff0000000000000
arm[0].link[1].com[1]=0000000000000000
"""


@pytest.fixture
def layout_from(tmp_path):
    def layout_from(text: str):
        path = tmp_path / "one_arm.toml"
        path.write_bytes(text.encode())
        return read(path)

    return layout_from


def problem(path) -> str:
    """The problem in the error message of a file that cannot be read."""
    with pytest.raises(LayoutError) as caught:
        read(path)
    start, end = f"{path}: ", f"; planar-capture check {path} says what is wrong"
    message = str(caught.value)
    assert message.startswith(start) and message.endswith(end) and "\n" not in message
    return message[len(start) : -len(end)]


@pytest.mark.parametrize(
    ("old", "new", "said"), UNREADABLE, ids=[f"{n} {said}" for n, (*_, said) in enumerate(UNREADABLE)]
)
def test_one_line_names_what_cannot_be_read(old, new, said, tmp_path):
    assert TEXT.count(old) == 1
    path = tmp_path / "one_arm.toml"
    path.write_text(TEXT.replace(old, new))
    assert problem(path) == said


def test_files_that_are_no_toml_are_named(tmp_path):
    assert problem(tmp_path / "absent.toml") == "cannot be read: No such file or directory"
    assert problem(tmp_path) == "cannot be read: Is a directory"
    path = tmp_path / "one_arm.toml"
    for content, said in [
        (b'name = "\xff"', "'utf-8' codec can't decode byte 0xff in position 8"),
        (b'name = "one_arm"\n[base\n', "at line 2"),
        (b"a = " + b"[" * 10_000, "recursion"),
    ]:
        path.write_bytes(content)
        assert said in problem(path)


def test_the_command_prints_that_line_and_writes_nothing(tmp_path):
    path, graph = tmp_path / "one_arm.toml", tmp_path / "one_arm.json"
    path.write_text(TEXT.replace("mass = 9.0\n", ""))
    command = [sys.executable, "-m", "codegen", "--layout", str(path), "--graph", str(graph)]
    inside = {**os.environ, "PLANAR_CAPTURE_CODEGEN_INSIDE": "1"}
    result = subprocess.run(command, cwd=HERE.parent, env=inside, capture_output=True, text=True)
    said = f"error: {path}: arm[0].link[1].mass is missing; planar-capture check {path} says what is wrong\n"
    assert (result.returncode, result.stdout, result.stderr) == (2, "", said)
    assert not graph.exists()


def test_the_file_bears_the_layouts_name(tmp_path):
    path = tmp_path / "other.toml"
    path.write_text(TEXT)
    with pytest.raises(LayoutError, match='name = "one_arm" must be the file\'s own name, "other"'):
        derive_text(path)


def test_defaults(layout_from):
    arm = layout_from(TEXT).arms[0]
    assert arm.mount_angle == 0.0
    assert [link.com for link in arm.links] == [(0.5, 0.0), (1.0, 0.0)]
    assert layout_from(TEXT).joints == 2


SAME = {
    "comment": TEXT.replace("[base]", "# the bus\n[base]").replace("500.0", "500.0 # kg"),
    "byte order mark and line ends": "\ufeff" + TEXT.replace("\n", "\r\n"),
    "key order": TEXT.replace("mass = 500.0\ninertia = 83.61", "inertia = 83.61\nmass = 500.0"),
    "table order": TEXT.replace("[base]\nmass = 500.0\ninertia = 83.61\n", "")
    + "[base]\nmass = 500.0\ninertia = 83.61\n",
    "written-out com": TEXT.replace("length = 2.0", "length = 2.0\ncom = [1.0, 0.0]"),
    "written-out mount angle": TEXT.replace("[0.5, 0.25]", "[0.5, 0.25]\nmount_angle = 0.0"),
    "negative zero": TEXT.replace("length = 2.0", "length = 2.0\ncom = [1.0, -0.0]"),
    "integers": TEXT.replace("length = 1.0", "length = 1").replace("500.0", "500"),
    "exponents": TEXT.replace("500.0", "5e2").replace("83.61", "8.361e+1"),
}
OTHER = {
    "name": TEXT.replace("one_arm", "my_arm"),
    "arm name": TEXT.replace("left", "right"),
    "last bit": TEXT.replace("83.61", "83.61000000000001"),
    "mount": TEXT.replace("[0.5, 0.25]", "[0.25, 0.5]"),
    "swapped mass and length": TEXT.replace("length = 2.0\nmass = 9.0", "length = 9.0\nmass = 2.0\ncom = [1.0, 0.0]"),
    "com": TEXT.replace("length = 2.0", "length = 2.0\ncom = [1.0, 1e-300]"),
    "one link more": TEXT + TEXT[TEXT.rindex("[[arm.link]]") :],
}


def test_the_hash_is_that_of_the_canonical_text(layout_from):
    """The text that `Layout::sha256` of planar-layout describes."""
    assert content_hash(layout_from(TEXT)) == hashlib.sha256(CANONICAL.encode()).hexdigest()


@pytest.mark.parametrize("change", SAME)
def test_the_hash_ignores_how_it_is_written(change, layout_from):
    assert SAME[change] != TEXT
    assert content_hash(layout_from(SAME[change])) == content_hash(layout_from(TEXT))


def test_the_hash_follows_the_content(layout_from):
    hashes = [content_hash(layout_from(text)) for text in [TEXT, *OTHER.values()]]
    assert len(set(hashes)) == len(hashes)
    shipped = {content_hash(read(layout_path(name))) for name in layout_names()}
    assert len(shipped) == len(layout_names())
