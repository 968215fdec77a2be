"""Controls of the report: screens, colours, address, keys, arrows, two cases; `report_browser.py` opens it."""

import json
import math
from pathlib import Path
from urllib.parse import urlencode
from xml.etree import ElementTree

from report_contacts import OVERLAPS, near, picture, red_pixels, scrub

SIZES = ((390, 844), (768, 1024), (1280, 800), (1920, 1080))
SVG = "{http://www.w3.org/2000/svg}"
NAMELESS = """() => [...document.querySelectorAll("button, select, input, summary, canvas#scene, [role=region]")]
    .filter((one) => !(one.getAttribute("aria-label") || one.textContent.trim() || one.labels?.length))
    .map((one) => one.outerHTML)"""


COVERED = """() => {
    const { texts, lines } = state.shown, outside = ([left, top, right, bottom]) =>
        left < 0 || top < 0 || right > canvas.clientWidth || bottom > canvas.clientHeight;
    const tips = lines.map(([, [x, y]]) => [x, y, x, y]);
    return { count: texts.length, outside: texts.filter(outside), tips: tips.filter(outside),
        arrows: texts.filter((text) => lines.some((line) => passes(line, text))) };
}"""


def box(page, selector):
    """Place and size of an element on the screen."""
    return page.locator(selector).bounding_box()


def screens(page, file, pictures):
    """Nothing sticks out; on a phone the animation and its two rows of controls are on the first screen."""
    for width, height in SIZES:
        page.set_viewport_size({"width": width, "height": height})
        for scheme in ("light", "dark"):
            page.emulate_media(color_scheme=scheme)
            page.wait_for_timeout(100)
            page.evaluate("scrollTo(0, 0)")
            if pictures:
                page.screenshot(path=pictures / f"{file.parent.name}_{width}_{scheme}.png")
        wide = page.evaluate("document.documentElement.scrollWidth - document.documentElement.clientWidth")
        assert wide <= 0, f"{wide} pixels stick out at {width}"
        scene, play, case, rail = (box(page, name) for name in ("#scene", "#play", "#case", "#rail"))
        assert rail["y"] + rail["height"] <= height, f"{width}: the time is below the first screen"
        assert scene["height"] > 0.4 * height and abs(play["y"] - case["y"]) < 2, (scene, play, case)
        if width < 500:
            assert rail["width"] > 0.85 * width and min(play["height"], rail["height"]) >= 38, (rail, play)
    page.emulate_media(color_scheme="light")


def colours(page):
    """Dark by preference and by a key; the canvas follows."""

    def shown():
        return page.evaluate("document.documentElement.dataset.theme")

    light = picture(page)
    page.emulate_media(color_scheme="dark")
    page.wait_for_timeout(50)
    assert shown() == "dark" and picture(page) != light
    page.keyboard.press("d")
    assert shown() == "light" and picture(page) == light
    page.emulate_media(color_scheme="light")
    # an arm has one colour in the scene and in the plots
    curves = page.evaluate("plots[0].series.slice(1).map((curve) => [curve.label, curve.stroke()])")
    for i, name in enumerate(page.evaluate("arms.map(({ name }) => name)")):
        own = {colour for label, colour in curves if label.startswith(f"{name} ")}
        assert own == {page.evaluate(f"armColour({i})")}, (name, own)


def address(page, file):
    """The address holds case and time, and sets them."""
    names = page.locator("#case option").all_inner_texts()
    end = float(page.get_attribute("#scrub", "max"))
    wanted = urlencode({"case": names[-1], "t": 3.25})
    page.goto("about:blank")
    page.goto(f"{file.as_uri()}#{wanted}")
    assert page.evaluate("[study.cases[state.chosen].name, state.time]") == [names[-1], 3.25]
    scrub(page, 0.5 * end)
    page.wait_for_timeout(500)
    assert page.url.endswith("#" + urlencode({"case": names[-1], "t": f"{0.5 * end:g}"})), page.url
    page.evaluate("location.hash = 't=1.5'")
    page.wait_for_timeout(100)
    assert page.evaluate("state.time") == 1.5
    legend = page.locator(".u-legend .u-value").all_inner_texts()
    assert legend and not [value for value in legend if value in ("", "--")], "values from the start"


def labels(page):
    """No label lies on an arrow, whether velocities are shown or not; labels and impulses are inside the picture."""
    page.click("#more summary")
    found = 0
    for index in range(page.locator("#case option").count()):
        page.select_option("#case", index=index)
        for shown in (False, True):
            page.set_checked("#velocities", shown)
            for time in page.evaluate("current()[1].impacts.map(({ time }) => time)"):
                for later in (0, 0.5, 2):
                    scrub(page, time + later)
                    at = f"{time + later} s of case {index}"
                    covered = page.evaluate(COVERED)
                    assert not covered["arrows"] and not covered["outside"], (at, covered)
                    assert shown or not covered["tips"], (at, covered)
                    found += covered["count"]
    page.uncheck("#velocities")
    page.keyboard.press("Escape")
    page.select_option("#case", index=0)
    return found


def origin(page, summary):
    """The page says what it is of."""
    said, run = page.inner_text("#origin"), summary["run"]
    for part in (summary["scenario"], run["version"], run["scenario_sha256"], run["layout_sha256"]):
        assert part in said, part
    # one with and one without the option for this page is a run of the same
    assert run["command"] in said and "--report" in said, said
    assert page.text_content("#scenario") == run["scenario_toml"]


def keys(page):
    """The page is used without a mouse."""
    page.locator("h1").click()
    page.keyboard.press("End")
    end = page.evaluate("endOfAll()")
    assert page.evaluate("state.time") == end
    page.keyboard.press("Home")
    page.keyboard.press("Shift+ArrowRight")
    assert page.evaluate("state.time") == 1
    impacts = page.evaluate("current()[1].impacts.map(({ time }) => time)")
    for key, times in (("n", impacts), ("p", impacts[-2::-1])):
        for time in times:
            page.keyboard.press(key)
            assert page.evaluate("state.time") == time, key
    page.keyboard.press("Space")
    assert page.get_attribute("#play", "aria-pressed") == "true"
    page.keyboard.press("Space")
    assert page.get_attribute("#play", "aria-pressed") == "false"
    page.locator("#scrub").focus()
    page.keyboard.press("Home")
    assert page.evaluate("state.time") == 0 and "0.00 seconds" in page.get_attribute("#scrub", "aria-valuetext")
    assert page.evaluate(NAMELESS) == []


def arrows(page, summary):
    """Velocities are those of the summary; torques are those of the plot."""
    page.select_option("#case", index=0)
    case = summary["cases"][0]
    page.click("#more summary")
    time = case["approach"]["duration"] - 1e-7
    scrub(page, time)
    without = picture(page)
    assert page.evaluate("state.shown.moving") is None
    page.check("#velocities")
    page.check("#forces")
    shown = page.evaluate("state.shown")
    for found, (_, *wanted) in zip(
        shown["moving"]["end_effectors"], case["approach"]["end_effector_twists"], strict=True
    ):
        near(found, wanted, "velocity of an end effector", 1e-4)
    near(shown["moving"]["base"], case["approach"]["base_twist"][1:], "velocity of the base", 1e-4)
    assert len(shown["torques"]) == len(case["approach"]["joint_angles"]) and all(map(math.isfinite, shown["torques"]))
    if max(math.hypot(*v) for v in shown["moving"]["end_effectors"]) > 1e-3:
        assert picture(page) != without
    page.uncheck("#velocities")
    page.uncheck("#forces")
    page.keyboard.press("Escape")


def overlaps(page, summary):
    """Bodies that overlap are red while they do."""
    first = summary["cases"][0]["clearance"]["first_overlap"]
    scrub(page, 0 if first is None else max(0, first - 0.5))
    assert page.evaluate("state.shown.overlapping") == [] and red_pixels(page, OVERLAPS) == 0
    if first is not None:
        one = page.evaluate("current()[0].overlaps.reduce((a, b) => (b.to - b.from > a.to - a.from ? b : a))")
        scrub(page, 0.5 * (one["from"] + one["to"]))
        assert set(one["bodies"]) <= set(page.evaluate("state.shown.overlapping")) and red_pixels(page, OVERLAPS) > 50


def two_cases(page):
    """A second case stands beside the first, at the same time and in the same ranges."""
    if page.locator("#case option").count() < 2:
        assert page.locator("#beside").count() == 0
        return
    page.click("#more summary")
    page.select_option("#beside", index=2)
    page.keyboard.press("Escape")
    assert page.locator("#scene-beside").is_visible() and page.locator("#other .plot").count() > 5
    assert page.locator("#other .impact").inner_text() != page.locator("#own .impact").inner_text()
    first, second = (box(page, name) for name in ("#scene", "#scene-beside"))
    assert first["y"] == second["y"] and first["width"] == second["width"], (first, second)
    ranges = page.evaluate(
        """() => { const found = new Map();
        for (const plot of plots) { const title = plot.root.parentElement.querySelector("h2").textContent;
            found.set(title, [...(found.get(title) || []), [plot.scales.y.min, plot.scales.y.max]]); }
        return [...found.values()]; }"""
    )
    assert all(len(pair) == 1 or pair[0] == pair[1] for pair in ranges) and any(len(pair) == 2 for pair in ranges)
    page.click("#more summary")
    page.select_option("#beside", index=0)
    page.keyboard.press("Escape")
    assert not page.locator("#scene-beside").is_visible() and not page.locator("#other").is_visible()


def saved(page, summary):
    """The picture is an SVG of its own."""
    page.click("#more summary")
    with page.expect_download() as waiting:
        page.click("#save")
    file = waiting.value
    assert file.suggested_filename.startswith(summary["scenario"]) and file.suggested_filename.endswith("s.svg")
    root = ElementTree.parse(file.path()).getroot()
    assert (
        root.tag == f"{SVG}svg" and root[0].tag == f"{SVG}title" and summary["run"]["scenario_sha256"] in root[0].text
    )
    assert len(root.findall(f"{SVG}path")) > 20 and root.find(f"{SVG}text") is not None
    assert "NaN" not in ElementTree.tostring(root, encoding="unicode")
    page.keyboard.press("Escape")


def printed(page):
    """On paper there are no controls, and the page is white."""
    page.keyboard.press("d")
    page.evaluate("dispatchEvent(new Event('beforeprint'))")
    page.emulate_media(media="print")
    assert not page.locator("#controls").is_visible() and page.locator("#origin").is_visible()
    assert page.evaluate("document.documentElement.dataset.theme") == "light"
    page.emulate_media(media="screen")
    page.evaluate("dispatchEvent(new Event('afterprint'))")
    assert page.evaluate("document.documentElement.dataset.theme") == "dark"
    page.keyboard.press("d")


def use_controls(page, file, pictures):
    """All of them."""
    summary = json.loads(Path(file.parent / "summary.json").read_text())
    page.select_option("#case", index=0)
    screens(page, file, pictures)
    page.set_viewport_size({"width": 1280, "height": 900})
    page.wait_for_timeout(100)
    page.locator("h1").click()
    colours(page)
    address(page, file)
    origin(page, summary)
    keys(page)
    arrows(page, summary)
    assert labels(page) or not summary["cases"][0].get("impact")
    overlaps(page, summary)
    two_cases(page)
    saved(page, summary)
    printed(page)
