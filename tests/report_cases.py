"""Cases with values of their own in the report, beside the others; `report_browser.py` calls it."""

import json
import subprocess
from pathlib import Path
from urllib.parse import urlencode

from report_contacts import picture, scrub
from report_controls import COVERED, SIZES

ROOT = Path(__file__).resolve().parent.parent
VALUES = {
    "layout.base.mass": 300.0,
    "approach.duration": 12.0,
    "layout.arm.arm1.link[2].length": 0.8,
    "target.target1.radius": 0.4,
}

# a light box between two stretched arms: its impulses point out of what they reach
BOUNCES = """name = "bounces"
layout = "dual_arm_3r"
[initial]
joint_angles = [0.698, -1.571, 1.047, 2.444, 1.571, -1.047]
[approach]
duration = 3.0
trajectory = "cycloidal"
tracking = "exact"
final_joint_angles = [0.698, -1.571, 1.047, 2.444, 1.571, -1.047]
[contact]
detection = "event"
[[target]]
name = "box"
arm = ["arm1", "arm2"]
kind = "bounce"
restitution = 1.0
mass = 0.1
inertia = 1e3
polygon = [[-0.2, -0.1], [0.2, -0.1], [0.2, 0.1], [-0.2, 0.1]]
position = [0.0, 0.05]
twist = [0.0, 3.0, 0.0]
[post_impact]
duration = 9.0
control = "hold"
"""


def scenario(folder):
    """The paper's study, of which a case has other values."""
    text = (ROOT / "scenarios" / "raina_shah_2017.toml").read_text()
    values = ", ".join(f'"{key}" = {value}' for key, value in VALUES.items())
    file = folder / "own_values.toml"
    file.write_text(text.replace('name = "case2"\n', f'name = "light"\nset = {{ {values} }}\n'))
    return file


def own_values(chromium, binary, folder, pictures):
    """One report has all cases; each is drawn with its own robot, target and approach, alone and beside any other."""
    out = folder / "own_values"
    run = [binary, "run", scenario(folder), "--out", out, "--report"]
    subprocess.run(run, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    summary = json.loads((out / "summary.json").read_text())
    assert [name for name in summary["files"] if name.endswith(".html")] == ["report.html"], summary["files"]
    page = chromium.new_page(viewport={"width": 1280, "height": 900})
    heard = []
    page.on("pageerror", lambda error: heard.append(str(error)))
    uri = (out / "report.html").as_uri()
    page.goto(uri)
    options = page.locator("#case option").all_inner_texts()
    assert options[0] == "case1" and options[1].startswith("light · approach.duration = 12.0, layout.arm"), options
    alone = {}
    for index, case in enumerate(summary["cases"]):
        page.goto("about:blank")
        page.goto(f"{uri}#{urlencode({'case': case['name'], 't': 5})}")
        alone[index] = picture(page)
        said = page.inner_text("#about")
        assert (f"base {300 if index == 1 else 500} kg" in said) and (("values of its own" in said) == (index == 1)), (
            said
        )
        sha = (case.get("run") or summary["run"])["layout_sha256"]
        assert sha in page.inner_text("#origin"), case["name"]
        approach = case["approach"]["duration"]
        scrub(page, approach - 1e-6)
        shown = page.evaluate("state.shown.arms.map((arm) => arm.end_effector)")
        for found, (_, x, y) in zip(shown, case["approach"]["end_effector_poses"], strict=True):
            assert abs(found[0] - x) < 1e-4 and abs(found[1] - y) < 1e-4, (case["name"], found, x, y)
    assert len(set(alone.values())) == 3

    beside(page, uri, heard)
    for width, height in SIZES if pictures else ():
        page.set_viewport_size({"width": width, "height": height})
        for scheme in ("light", "dark"):
            page.emulate_media(color_scheme=scheme)
            page.wait_for_timeout(100)
            page.screenshot(path=pictures / f"own_values_{width}_{scheme}.png")
            page.click("#more summary")
            page.screenshot(path=pictures / f"own_values_{width}_{scheme}_options.png")
            page.keyboard.press("Escape")
    for width, height in SIZES:
        page.set_viewport_size({"width": width, "height": height})
        page.click("#more summary")
        wide = page.evaluate("document.documentElement.scrollWidth - document.documentElement.clientWidth")
        left = page.locator("#options").bounding_box()["x"]
        assert wide <= 0 and left >= 0, f"{wide} pixels stick out at {width}, {left}"
        page.keyboard.press("Escape")
    page.close()


def beside(page, uri, heard):
    """Two cases of different robots and durations: their own scenes and tables, one scale of time."""
    for chosen, other in (("case1", "light"), ("light", "case3")):
        page.goto("about:blank")
        page.goto(f"{uri}#{urlencode({'case': chosen, 'beside': other, 't': 13})}")
        said = page.inner_text("#about")
        assert f"{chosen}: " in said and f"{other}: " in said and "base 300 kg" in said and "base 500 kg" in said, said
        assert page.evaluate("endOfAll()") == 70
        assert {tuple(ends) for ends in page.evaluate("plots.map(({ scales: { x } }) => [x.min, x.max])")} == {(0, 70)}
        assert page.locator("#own .impact").inner_text() != page.locator("#other .impact").inner_text()
        pictures = page.evaluate("[...document.querySelectorAll('#scenes canvas')].map((one) => one.toDataURL())")
        assert len(set(pictures)) == 2
    assert not heard, heard


def outward_impulses(chromium, binary, folder):
    """Arrows that point out of what the arms reach are in the picture all the same, on a phone too."""
    file, out = folder / "bounces.toml", folder / "bounces"
    file.write_text(BOUNCES)
    run = [binary, "run", file, "--out", out, "--report"]
    subprocess.run(run, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    page = chromium.new_page(viewport={"width": 1280, "height": 900})
    page.goto((out / "report.html").as_uri())
    for width, height in SIZES:
        page.set_viewport_size({"width": width, "height": height})
        times = page.evaluate("current()[1].impacts.map(({ time }) => time)")
        assert len(times) > 4, times
        for time in times:
            scrub(page, time)
            covered = page.evaluate(COVERED)
            assert not covered["tips"] and not covered["outside"] and not covered["arrows"], (width, time, covered)
    page.close()
