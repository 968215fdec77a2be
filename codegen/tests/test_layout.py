"""The layout reader: what is wrong is named, and the hash follows the content alone."""

import pytest

from codegen.derive import derive_text, layout_names, layout_path
from codegen.layout import LayoutError, content_hash, read

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

BROKEN = [  # what is replaced, by what, and what the message must name besides the file
    ("mass = 500.0", "mas = 500.0", ["unknown key `base.mas`", "500.0", "did you mean `mass`?"]),
    ("mass = 500.0\n", "", ["missing key `base.mass`"]),
    ("mass = 500.0", "mass = 0.0", ["`base.mass`", "0.0", "greater than 0"]),
    ("mass = 500.0", "mass = -5", ["`base.mass`", "-5", "greater than 0"]),
    ("mass = 500.0", "mass = true", ["`base.mass`", "True", "finite number in kg"]),
    ("mass = 500.0", 'mass = "500"', ["`base.mass`", "'500'", "finite number in kg"]),
    ("inertia = 83.61", "inertia = nan", ["`base.inertia`", "nan", "finite number in kg m^2"]),
    ("inertia = 83.61", "inertia = inf", ["`base.inertia`", "inf"]),
    ('name = "one_arm"', 'name = "One arm"', ["`name`", "One arm", "lower-case letters"]),
    ('name = "one_arm"', 'name = "loop"', ["`name`", "loop", "Rust keyword"]),
    ('name = "one_arm"', "name = 3", ["`name`", "3", "text in quotes"]),
    ('name = "one_arm"', 'name = "one_arm"\ncolour = "red"', ["unknown key `colour`", "red", "name, base, arm"]),
    ('name = "left"', 'name = " "', ["`arm[0].name`", "not blank"]),
    ("[0.5, 0.25]", "[0.5]", ["`arm[0].mount`", "[0.5]", "[x, y] in m"]),
    ("[0.5, 0.25]", "[500.0, 20000.0]", ["`arm[0].mount`", "20000.0", "millimetres"]),
    ("[0.5, 0.25]", '["a", 0]', ["`arm[0].mount`", "[x, y] in m"]),
    ("[0.5, 0.25]", "[0.5, 0.25]\nmount_angle = 90", ["`arm[0].mount_angle`", "90", "is it degrees? 1.57"]),
    ("length = 2.0", "length = -2.0", ["`arm[0].link[1].length`", "-2.0", "0 or more"]),
    ("length = 2.0", "length = 20000", ["`arm[0].link[1].length`", "20000", "millimetres? 20.0 m"]),
    ("length = 2.0", "length = 2.0\ncom = 1.0", ["`arm[0].link[1].com`", "1.0", "[x, y] in m"]),
    ("length = 2.0", "length = 2.0\ncom_x = 1.0", ["unknown key `arm[0].link[1].com_x`", "1.0"]),
    ("mass = 9.0", "mass = " + "9" * 400, ["`arm[0].link[1].mass`", "finite number in kg"]),
    ("[base]", "[base", ["not valid TOML", "line 2"]),
    ("mass = 9.0", "mass = 9.0\nmass = 9.0", ["not valid TOML"]),
    (TEXT[TEXT.index("[[arm]]") :], "", ["missing key `arm`", "[[arm]]"]),
    (TEXT[TEXT.index("[[arm]]") :], "[arm]\n", ["`arm`", "{}", "[[arm]]"]),
    (TEXT[TEXT.index("[[arm.link]]") :], "", ["missing key `arm[0].link`", "[[link]]"]),
    (TEXT[TEXT.index("[base]") : TEXT.index("[[arm]]")], "base = 3\n", ["`base`", "3", "a table"]),
    (TEXT[TEXT.index("[[arm]]") :], TEXT[TEXT.index("[[arm]]") :] * 2, ["`arm[1].name`", "left", "`arm[0]`"]),
]


@pytest.fixture
def layout_from(tmp_path):
    def layout_from(text: str | bytes):
        path = tmp_path / "one_arm.toml"
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return read(path)

    return layout_from


@pytest.mark.parametrize(("old", "new", "named"), BROKEN, ids=[named[0] for *_, named in BROKEN])
def test_what_is_wrong_is_named(old, new, named, layout_from):
    assert TEXT.count(old) == 1
    with pytest.raises(LayoutError) as caught:
        layout_from(TEXT.replace(old, new))
    for part in ["one_arm.toml", *named]:
        assert part in str(caught.value)


def test_files_that_are_no_text_are_named(layout_from, tmp_path):
    with pytest.raises(LayoutError, match=r"one_arm\.toml: byte 0xff at offset 8 is not UTF-8"):
        layout_from(b'name = "\xff"')
    with pytest.raises(LayoutError, match=r"absent\.toml: cannot read it"):
        read(tmp_path / "absent.toml")
    with pytest.raises(LayoutError, match="cannot read it"):
        read(tmp_path)


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


@pytest.mark.parametrize("change", SAME)
def test_the_hash_ignores_how_it_is_written(change, layout_from):
    assert SAME[change] != TEXT
    assert content_hash(layout_from(SAME[change])) == content_hash(layout_from(TEXT))


def test_the_hash_follows_the_content(layout_from):
    hashes = [content_hash(layout_from(text)) for text in [TEXT, *OTHER.values()]]
    assert len(set(hashes)) == len(hashes)
    shipped = {content_hash(read(layout_path(name))) for name in layout_names()}
    assert len(shipped) == len(layout_names())
