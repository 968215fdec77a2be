"""Contacts in the report against summary.json and the time series; `report_browser.py` opens the page."""

import csv
import math

SIX_DIGITS = 2e-5  # what the page keeps of a number below 10; m, rad


def picture(page):
    """The canvas as a text to compare."""
    return page.evaluate("document.getElementById('scene').toDataURL()")


def scrub(page, time):
    """Moves the slider to a time."""
    act = "(slider, value) => { slider.value = value; slider.dispatchEvent(new Event('input')); }"
    page.locator("#scrub").evaluate(act, time)


IMPULSES, OVERLAPS = (179, 38, 30), (208, 0, 0)


def red_pixels(page, colour=IMPULSES):
    """Number of pixels in a colour, that of impulses by default."""
    return page.evaluate(
        """([red, green, blue]) => {
        const copy = document.createElement("canvas").getContext("2d", { willReadFrequently: true });
        Object.assign(copy.canvas, { width: canvas.width, height: canvas.height });
        copy.drawImage(canvas, 0, 0);
        const { data } = copy.getImageData(0, 0, canvas.width, canvas.height); let count = 0;
        for (let i = 0; i < data.length; i += 4)
            count += data[i + 3] > 200 && Math.abs(data[i] - red) < 8 && Math.abs(data[i + 1] - green) < 8
                && Math.abs(data[i + 2] - blue) < 8;
        return count; }""",
        colour,
    )


def near(found, wanted, what, bound=SIX_DIGITS):
    """Compares lists of numbers."""
    assert len(found) == len(wanted), what
    worst = max(abs(f - w) for f, w in zip(found, wanted, strict=True))
    assert worst < bound, f"{what}: {found}, wanted {wanted}"


def curves(page, title):
    """Time and curves of a plot."""
    found = page.evaluate(
        """title => { const titles = [...document.querySelectorAll(".plot h2")].map(h => h.textContent);
        const i = titles.findIndex(t => t.startsWith(title));
        return i < 0 ? null : plots[i].data.map(c => [...c]); }""",
        title,
    )
    assert found, f"no plot `{title}`"
    return found[0], found[1:]


def end_effectors_at(folder, case, time):
    """[x, y] of each end effector at the last row nearest to a time, and that row's time."""
    with (folder / f"{case}.csv").open() as rows:
        row = min(reversed(list(csv.DictReader(rows))), key=lambda row: abs(float(row["time [s]"]) - time))
    arms = [name.removesuffix("_tip_x [m]") for name in row if name.endswith("_tip_x [m]")]
    return [[float(row[f"{arm}_tip_{axis} [m]"]) for axis in "xy"] for arm in arms], float(row["time [s]"])


def conserved(page, impacts):
    """Momentum is constant, and energy steps only at impacts, by their losses."""
    for title in ("Angular momentum", "Linear momentum"):
        for curve in curves(page, title)[1]:
            assert max(curve) - min(curve) < 1e-4 * max(map(abs, curve), default=0) + 1e-9, f"{title} changes"
    time, (_, left) = curves(page, "Kinetic energy")
    steps = [(t, b - a) for t, u, a, b in zip(time, time[1:], left, left[1:], strict=False) if t == u]
    costs = [i["exact"]["kinetic_energy_after"] - i["exact"]["kinetic_energy_before"] for i in impacts]
    near([step for _, step in steps], costs, "steps of the energy")
    lost = page.evaluate("""[...document.querySelectorAll("tr")]
        .filter((row) => row.cells[0]?.textContent.includes("– lost"))
        .flatMap((row) => [...row.cells].slice(1).map((cell) => cell.textContent))""")
    assert len(lost) == len(impacts), f"{lost} of {len(impacts)} impacts"
    for text, impact in zip(lost, impacts, strict=True):
        before, after = (impact["exact"][f"kinetic_energy_{when}"] for when in ("before", "after"))
        if before - after > 1e-9 * before:
            difference, percent = (float(part) for part in text.removesuffix(" %)").split(" ("))
            near([difference], [before - after], "the energy that an impact costs")
            assert abs(percent - 100 * (before - after) / before) < 6e-3 * percent, f"{text} of {before} J"


def large_target(page, folder, summary, _scenario):
    """The panel is drawn with contacts at the end effectors; constraints are marked, and their errors plotted."""
    for index, case in enumerate(summary["cases"]):
        page.select_option("#case", index=index)
        contacts = case["impact"]["contacts"]
        end = float(page.get_attribute("#scrub", "max"))
        for wanted in (20.05, 0.5 * end, 0.97 * end):
            end_effectors, time = end_effectors_at(folder, case["name"], wanted)
            scrub(page, time)
            shown = page.evaluate("state.shown")
            (panel,) = shown["targets"]
            c, s = math.cos(panel["angle"]), math.sin(panel["angle"])
            for contact, end_effector, arm in zip(contacts, end_effectors, shown["arms"], strict=True):
                near(arm["end_effector"], end_effector, f"{case['name']}: end_effector at {time} s")
                x, y = contact["offset"]  # the panel's yaw at the impact is 0
                point = [panel["point"][0] + c * x - s * y, panel["point"][1] + s * x + c * y]
                near(point, end_effector, f"{case['name']}: contact at {time} s")
        kinds = [hold["kind"] for hold in page.evaluate("current()[1].holds")]
        assert kinds == [contact["kind"] for contact in contacts], kinds
        conserved(page, [case["impact"]])
        held = case["post_impact"]["constraint_errors"][0]
        open_by = [v for curve in curves(page, "Openings of constraints")[1] for v in curve if v is not None]
        assert open_by and max(open_by) < 10 * held + 1e-14, f"{max(open_by)} against {held}"
        table = page.inner_text("#own .impact")
        # a pin passes no moment
        moments = page.evaluate("""[...document.querySelectorAll("#own .impact tr")]
            .filter((row) => row.cells[0]?.textContent.startsWith("– moment n"))
            .flatMap((row) => [...row.cells].slice(1).map((cell) => cell.textContent !== "–"))""")
        kinds = [contact["kind"] == "rigid" for contact in contacts]
        assert moments == (kinds if any(kinds) else []), f"moments of {kinds}: {moments}"
        for contact in contacts:
            wanted = f"{math.hypot(*contact['impulse'][1:]):.4g}"
            assert wanted in table and f"{contact['impulse_index']:.4g}" in table, (wanted, table)
    scrub(page, 20.5)
    without = picture(page)
    page.click("#more summary")
    page.check("#ellipse")
    page.keyboard.press("Escape")
    assert picture(page) != without, "the ellipse is not drawn"


def elastic_rebound(page, folder, summary, scenario):
    """Targets move freely between impacts; each impact has its arrows, marks and text."""
    for index, case in enumerate(summary["cases"]):
        page.select_option("#case", index=index)
        first = case["approach"]["duration"]
        further = case["post_impact"].get("impacts", [])
        impacts = [(first, case["impact"]), *((first + one["time"], one) for one in further)]
        conserved(page, [impact for _, impact in impacts])
        marks = page.locator("#instants button")
        assert marks.count() == len(impacts)
        for i, (time, impact) in enumerate(impacts):
            marks.nth(i).click()
            near([float(page.input_value("#scrub"))], [time], "the mark of an impact")
            end_effectors, _ = end_effectors_at(folder, case["name"], time)
            arrows = [
                one for one in page.evaluate("state.shown.arrows") if one["impulse"] == impact["contacts"][0]["impulse"]
            ]
            assert len(arrows) == 1, f"{case['name']}: no arrow at {time} s"
            near(arrows[0]["end_effector"], end_effectors[arrows[0]["arm"]], "where the arrow starts")
            assert red_pixels(page) > 100, f"{case['name']}: no arrow is seen at {time} s"
        scrub(page, impacts[-1][0] + 4.5)
        assert red_pixels(page) < 20, "the arrow stays"
        own = {target["name"]: dict(target) for target in scenario["target"]}
        asked = scenario["case"][index].get("target_twists", {})
        for time in (0.5 * first, first + 1.0, impacts[-1][0] + 10.0):
            scrub(page, time)
            for shown, (name, target) in zip(page.evaluate("state.shown.targets"), own.items(), strict=True):
                pose, since = [target.get("yaw", 0.0), *target["position"]], 0.0
                twist = asked.get(name, target["twist"])
                for when, impact in impacts:
                    arm = [one["arm"] for one in impact["contacts"] if one["target"] == name and when <= time]
                    if arm:
                        pose, since = [p + v * (when - since) for p, v in zip(pose, twist, strict=True)], when
                        twist = impact["exact"]["target_twists_after"][int(arm[0].removeprefix("arm")) - 1]
                wanted = [p + v * (time - since) for p, v in zip(pose, twist, strict=True)]
                near([shown["angle"], *shown["point"]], wanted, f"{case['name']}: {name} at {time} s", 2e-4)
        words = page.inner_text("#own .missed")
        for pair in case.get("closest", []):
            assert f"{pair['arm']} never meets {pair['target']}" in words and f"{pair['distance']:.4g}" in words, words
        assert bool(words.strip()) == bool(case.get("closest")), words


CHECKS = {
    "raina_shah_2017": None,
    "redysim_single_arm_3r": None,
    "large_target": large_target,
    "elastic_rebound": elastic_rebound,
}
