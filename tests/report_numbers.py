"""Numbers, words and drawing of the report against summary.json and the time series; `report_browser.py` opens it."""

import csv
import math

from report_contacts import SIX_DIGITS, curves, end_effectors_at, near, scrub

ROW = """([place, head]) => [...document.querySelectorAll(`#own ${place} tr`)]
    .filter((row) => row.cells[0]?.textContent === head)
    .map((row) => [...row.cells].slice(1).map((cell) => cell.textContent))"""
# what draws is recorded while the scene is drawn once
RECORD = """() => {
    const seen = { circles: [], squares: 0, heads: [], ellipses: [], strokes: 0 }, kept = {};
    for (const name of ["drawBase", "drawAttachment", "circle", "area", "arrowHead"]) kept[name] = window[name];
    let attaching = false;
    window.drawBase = (layout, now, screen, ...rest) => {
        seen.axes = [[0, 0], [1, 0], [0, 1]].map(screen); kept.drawBase(layout, now, screen, ...rest); };
    window.drawAttachment = (hold, ...rest) => {
        attaching = true; seen.attached = [...(seen.attached ?? []), { kind: hold.kind, as: null }];
        kept.drawAttachment(hold, ...rest); attaching = false; };
    const last = () => seen.attached[seen.attached.length - 1];
    window.circle = (...all) => { if (attaching) last().as = "circle"; kept.circle(...all); };
    window.area = (...all) => { if (attaching) last().as = "area"; kept.area(...all); };
    window.arrowHead = (at, angle, ...rest) => { seen.heads.push(angle); kept.arrowHead(at, angle, ...rest); };
    const pens = CanvasRenderingContext2D.prototype, ellipse = pens.ellipse;
    pens.ellipse = function (...all) { seen.ellipses.push(all); ellipse.apply(this, all); };
    try { draw(); } finally { Object.assign(window, kept); pens.ellipse = ellipse; }
    return seen; }"""


def number(text):
    """The number of a cell."""
    return float(text.split(" ")[0])


def close(text, wanted, what):
    """A cell of four digits, or of three and a power of ten; none where there is no number."""
    if wanted is None:
        assert text == "–", f"{what}: {text}"
        return
    share = 6e-3 if "e" in text else 6e-4
    assert abs(number(text) - wanted) <= share * abs(wanted) + 1e-9, f"{what}: {text}, wanted {wanted}"


def impacts_of(case):
    """Its impacts in their order."""
    later = case.get("post_impact", {}).get("impacts", [])
    return [case["impact"], *later] if "impact" in case else []


def contacts_table(page, case):
    """Every row has the numbers of the summary, contact by contact."""
    contacts = [contact for impact in impacts_of(case) for contact in impact["contacts"]]
    if not contacts:
        return
    masses = [contact["effective_masses"] or [None] * 3 for contact in contacts]
    rows = {
        "impulse on the robot |f| [N s]": [math.hypot(*contact["impulse"][1:]) for contact in contacts],
        "mean force |f| [N]": [
            math.hypot(*contact["mean_force"][1:]) if "mean_force" in contact else None for contact in contacts
        ],
        "end effector relative to target before: ω [rad/s]": [contact["relative_twist"][0] for contact in contacts],
        "effective mass of the robot [kg]": [mass[0] for mass in masses],
        "– of the target": [mass[1] for mass in masses],
        "– of both": [mass[2] for mass in masses],
        "impulse index [N s per m/s]": [contact["impulse_index"] for contact in contacts],
    }
    for head, wanted in rows.items():
        found = page.evaluate(ROW, [".impact", head])
        if not found:
            assert all(one is None for one in wanted), f"no row `{head}`"
            continue
        for text, one in zip(found[0], wanted, strict=True):
            close(text, one, head)
    pairs = {
        "– fx, fy [N s]": [contact["impulse"][1:] for contact in contacts],
        "– vx, vy [m/s]": [contact["relative_twist"][1:] for contact in contacts],
        "impulse ellipse, semi-axes [N s per m/s]": [contact["impulse_ellipse"]["semi_axes"] for contact in contacts],
    }
    for head, wanted in pairs.items():
        (found,) = page.evaluate(ROW, [".impact", head])
        for text, pair in zip(found, wanted, strict=True):
            for part, one in zip(text.split(", "), pair, strict=True):
                close(part, one, head)
    (kinds,) = page.evaluate(ROW, [".impact", "kind"])
    (speeds,) = page.evaluate(ROW, [".impact", "closing speed [m/s]"])
    for kind, speed, contact in zip(kinds, speeds, contacts, strict=True):
        assert kind.split(",")[0] == contact["kind"], kind
        # an impulse of a bounce, and of no other contact, is along its normal
        if contact["kind"] == "bounce" and contact["impulse_index"]:
            restitution = float(kind.rpartition("= ")[2])
            impulse = math.hypot(*contact["impulse"][1:])
            # of contacts at one time each has a part in the other's impulse
            if all(len(impact["contacts"]) == 1 for impact in impacts_of(case)):
                close(speed, impulse / contact["impulse_index"] / (1 + restitution), "closing speed")


def clearance_table(page, case):
    """Overlaps as negative distances, in the order of the summary; a note where outlines are defaults."""
    found = page.evaluate("""[...document.querySelectorAll("#own .clearance tr.bad")]
        .map((row) => [...row.cells].map((cell) => cell.textContent))""")
    overlaps = (case["clearance"] or {}).get("overlaps", [])
    for (bodies, depth, span), overlap in zip(found, overlaps, strict=True):
        assert bodies == " – ".join(overlap["bodies"]) + (" *" if overlap["default_outline"] else ""), bodies
        close(depth, -overlap["depth"], "depth")
        assert span == f"{overlap['from']:.2f} to {overlap['to']:.2f}", span
    hidden = page.evaluate("document.querySelector('#own .defaults').hidden")
    assert hidden != any(overlap["default_outline"] for overlap in overlaps), "the note on default outlines"
    # red as long as they last
    instants = [overlap[end] + shift for overlap in overlaps for end in ("from", "to") for shift in (-1e-3, 1e-3)]
    times = [time for time in instants if all(abs(time - o[end]) > 5e-4 for o in overlaps for end in ("from", "to"))]
    for time in times[:40]:
        last = page.evaluate("current()[1].end")
        if not 0 < time < last:
            continue
        shown = page.evaluate("time => overlapsAt(...current(), time).map(({ bodies }) => bodies)", time)
        assert shown == [o["bodies"] for o in overlaps if o["from"] <= time < o["to"]], f"overlaps at {time} s"


def curves_of(page, folder, case):
    """The curves have the names of what they show, and the legend the nearest row; energy less work has no slope."""
    with (folder / f"{case['name']}.csv").open() as rows:
        last = list(csv.DictReader(rows))[-1]
    labels = page.evaluate("""Object.fromEntries([...document.querySelectorAll("#own .plot h2")]
        .map((head, i) => [head.textContent, plots[i].series.slice(1).map(({ label }) => label)]))""")
    columns = {
        "Base yaw [rad]": {"yaw": "base_yaw [rad]"},
        "Base position [m]": {"x": "base_x [m]", "y": "base_y [m]"},
        "Base twist [rad/s, m/s]": {"ω": "base_omega [rad/s]", "vx": "base_vx [m/s]", "vy": "base_vy [m/s]"},
    }
    for title, wanted in columns.items():
        _, found = curves(page, title)
        assert labels[title] == list(wanted), labels[title]
        for curve, column in zip(found, wanted.values(), strict=True):
            size = max(map(abs, curve), default=0.0)
            near([curve[-1]], [float(last[column])], column, 1e-5 * size + SIX_DIGITS * 1e-3)
    time, (whole, left) = curves(page, "Kinetic energy")
    size = max(max(map(abs, whole)), max(abs(a - b) for a, b in zip(whole, left, strict=True)))
    for t, u, a, b in zip(time, time[1:], left, left[1:], strict=False):
        assert t == u or abs(b - a) < 2e-5 * size, f"energy less work changes from {a} to {b} J at {t} s"
    for part in (0.3, 0.7):
        between = page.evaluate(
            "part => { const { time } = current()[1], i = time.findIndex((t, k) => time[k + 1] > t + 1e-6);"
            "setTime(time[i] + part * (time[i + 1] - time[i])); plots[0].redraw(false); return i; }",
            part,
        )
        page.wait_for_timeout(50)
        index = page.evaluate("plots[0].legend.idx ?? plots[0].cursor.idx")
        assert index == between + (part > 0.5), f"the legend has row {index} at {between + part}"


def drawn(page, folder, case):
    """x to the right, y up; traces until now; contacts by their kinds; impulses and ellipses by their directions."""
    end = float(page.get_attribute("#scrub", "max"))
    scrub(page, 0.5 * end)
    (x0, y0), (x1, y1), (x2, y2) = page.evaluate(RECORD)["axes"]
    assert x1 > x0 and y2 < y0, "axes of the scene"
    near([x1 - x0, y1, x2], [y0 - y2, y0, x0], "axes of the scene", 1e-6)
    until = page.evaluate("""() => { const ends = [], kept = window.stroke;
        window.stroke = (points) => ends.push(points[points.length - 1]);
        try { traces(current()[1], (point) => point); } finally { window.stroke = kept; }
        return [ends, current()[1].time[place(current()[1], state.time)]]; }""")
    wanted, _ = end_effectors_at(folder, case["name"], until[1])
    for found, one in zip(until[0], wanted, strict=True):
        near(found, one, "the end of a trace", 1e-4)
    if "impact" not in case:
        return
    first = case["approach"]["duration"]
    instants = [first, *(first + later["time"] for later in case["post_impact"].get("impacts", []))]
    kinds = [contact["kind"] for impact in impacts_of(case) for contact in impact["contacts"]]
    holding = [kind for kind in kinds if kind in ("rigid", "pin")]
    scrub(page, end)
    attached = page.evaluate(RECORD).get("attached", [])
    assert [one["kind"] for one in attached] == holding
    assert all(one["as"] == ("circle" if one["kind"] == "pin" else "area") for one in attached), attached
    scrub(page, 0.5 * first)
    assert "attached" not in page.evaluate(RECORD), "nothing is held before it is met"
    for time, impact in zip(instants, impacts_of(case), strict=True):
        scrub(page, time + 0.01)
        page.evaluate("() => { const box = element('ellipse'); if (box) box.checked = true; draw(); }")
        seen = page.evaluate(RECORD)
        for contact in impact["contacts"]:
            _, fx, fy = contact["impulse"]
            if math.hypot(fx, fy) < 1e-9:
                continue
            # on the screen y points down
            turns = [abs(math.remainder(head - math.atan2(-fy, fx), math.tau)) for head in seen["heads"]]
            assert min(turns) < 1e-5, f"no arrow along {fx}, {fy}"
            direction = contact["impulse_ellipse"]["direction"]
            turns = [abs(math.remainder(one[4] + direction, math.pi)) for one in seen["ellipses"]]
            assert min(turns) < 1e-4, f"no ellipse along {direction}"
    page.evaluate("() => { const box = element('ellipse'); if (box) box.checked = false; draw(); }")


def motion(page, folder, case):
    """Velocities of end effectors are those of the time series, and torques turn as they are signed."""
    end = float(page.get_attribute("#scrub", "max"))
    with (folder / f"{case['name']}.csv").open() as rows:
        all_rows = list(csv.DictReader(rows))
    for part in (0.1, 0.3, 0.8):
        row = min(all_rows, key=lambda row: abs(float(row["time [s]"]) - part * end))
        time = float(row["time [s]"])
        scrub(page, time)
        found = page.evaluate(
            "time => velocities(current()[1], configuration(current()[1], time), time).end_effectors", time
        )
        arms = [name.removesuffix("_tip_vx [m/s]") for name in row if name.endswith("_tip_vx [m/s]")]
        for velocity, arm in zip(found, arms, strict=True):
            near(velocity, [float(row[f"{arm}_tip_v{axis} [m/s]"]) for axis in "xy"], f"velocity of {arm}", 1e-4)
    arcs = page.evaluate("""() => { const arcs = [], kept = CanvasRenderingContext2D.prototype.arc, line = current()[1];
        CanvasRenderingContext2D.prototype.arc = function (...all) { arcs.push(all); };
        const torques = line.joint_torques;
        try {
            line.joint_torques = torques.map((column, i) => column.map(() => (i % 2 ? -1 : 1)));
            greatest.clear();
            drawTorques(state.chosen, configuration(line, state.time), (point) => point, 1);
        } finally { line.joint_torques = torques; greatest.clear(); CanvasRenderingContext2D.prototype.arc = kept; }
        return arcs.map(([, , , start, end, back]) => [end - start, back]); }""")
    assert arcs and all((turn < 0) == (i % 2 == 0) == back for i, (turn, back) in enumerate(arcs)), arcs


def wheel(page):
    """A wheel is drawn as the uniform disc of its mass and inertia: 0.3 m at 100 pixels per m."""
    radii = page.evaluate("""() => { const radii = [], kept = window.circle;
        const now = { points: [[0, 0], [0, 0]], angles: [0], end_effector: [0, 0] };
        const arm = { name: "wheel", links: [{ length: 0, mass: 4, inertia: 0.18 }] };
        window.circle = (at, radius) => radii.push(radius);
        try {
            drawArm(arm, now, "black", (point) => point, 100, new Set());
        } finally { window.circle = kept; draw(); }
        return radii; }""")
    near([max(radii)], [30.0], "the radius of a wheel", 1e-9)


def outside(page):
    """The name of a target outside the picture has its distance from the base."""
    texts = page.evaluate("""() => {
        const target = { name: "far", radius: 1 }, pose = { point: [4, 6], angle: 0 }, now = { base: [1, 2] };
        const notes = new Notes(800, 600);
        nameTarget(target, pose, now, ([x, y]) => [1000 * x, -1000 * y], 1000, 800, 600, "black", notes);
        draw();
        return notes.texts.map(({ text }) => text); }""")
    assert texts == ["far, 5.0 m away"], texts


def objections(page):
    """Those of a case, of the common approach and of no case are shown with it."""
    names = page.evaluate("study.cases.map(({ name }) => name)")
    shown = page.evaluate(
        """(texts) => { const part = partOf(current()[0]), kept = part.objections; part.objections = texts; audit();
        const found = [...document.querySelectorAll("#audit .bad")].map((one) => one.textContent);
        part.objections = kept; audit(); return [found, current()[0].name]; }""",
        ["approach: it", *(f"{name}: it" for name in names), *(f"{name}, post-impact: it" for name in names)],
    )
    own = shown[1]
    assert shown[0] == ["approach: it", f"{own}: it", f"{own}, post-impact: it"], shown


def numbers(page, folder, summary):
    """All of these, case by case."""
    for index, case in enumerate(summary["cases"]):
        page.select_option("#case", index=index)
        contacts_table(page, case)
        clearance_table(page, case)
        curves_of(page, folder, case)
        drawn(page, folder, case)
        motion(page, folder, case)
    wheel(page)
    outside(page)
    objections(page)
