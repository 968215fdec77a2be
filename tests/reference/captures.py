"""Writes captures.json: rigid captures where masses and inertias differ by many orders of magnitude.

    python3 tests/reference/captures.py            # writes it
    python3 tests/reference/captures.py --check    # compares it

Independent of the project's code: the kinetic energies of all bodies as sums of squares, in 60 decimal digits, and
Gaussian elimination. A capture minimizes the weighted squares of all changes of velocity.
"""

import argparse
import json
import random
import sys
from decimal import Decimal, getcontext
from pathlib import Path

FILE = Path(__file__).resolve().parent / "captures.json"
SEED = 20170614
getcontext().prec = 60
# (mass of the last links, masses and inertias of the targets)
RATIOS = [
    (1e-6, [(4e3, 2e2), (5e2, 2e5)]),
    (1e-9, [(1e4, 6e5), (8e3, 8e3)]),
    (1e-12, [(18.0, 1.4e4), (9.8, 4e4)]),
    (1e-12, [(1e-9, 3.0), (2e5, 1e-3)]),
    (10.0, [(3e6, 4e-8), (1e-8, 8e-6)]),
    (10.0, [(1e-12, 1e-12), (5e8, 5e8)]),
    (1e-9, [(12.0, 4.0), None]),
]


def sin_cos(angle):
    """Both by their series."""
    sine, cosine, term, k = Decimal(0), Decimal(0), Decimal(1), 0
    while abs(term) > Decimal("1e-65") or k < 8:
        if k % 2:
            sine += term if k % 4 == 1 else -term
        else:
            cosine += term if k % 4 == 0 else -term
        k += 1
        term = term * angle / k
    return sine, cosine


def solve(matrix, right):
    """The solution of a system, by elimination with the largest pivot of scaled rows."""
    rows = [[x / max(map(abs, row)) for x in [*row, value]] for row, value in zip(matrix, right, strict=True)]
    for i in range(len(rows)):
        k = max(range(i, len(rows)), key=lambda k: abs(rows[k][i]))
        rows[i], rows[k] = rows[k], rows[i]
        for k, row in enumerate(rows):
            if k != i and row[i]:
                factor = row[i] / rows[i][i]
                rows[k] = [a - factor * b for a, b in zip(row, rows[i], strict=True)]
    return [row[-1] / row[i] for i, row in enumerate(rows)]


def exact(values):
    """Numbers as they are in binary."""
    return [exact(value) if isinstance(value, list) else Decimal(value) for value in values]


def bodies(layout, state):
    """(mass, inertia, rows of [omega, vx, vy] by all velocities) of each body, and the rows of each end effector."""
    size = 3 + len(state["joint_angles"])
    angles = iter(exact(state["joint_angles"]))

    def rows(point, joints):
        angular, x, y = ([Decimal(0)] * size for _ in range(3))
        for column, (px, py) in [(0, (Decimal(0), Decimal(0))), *joints]:
            angular[column], x[column], y[column] = Decimal(1), py - point[1], point[0] - px
        x[1] = y[2] = Decimal(1)
        return angular, x, y

    base = layout["base"]
    found = [(*exact([base["mass"], base["inertia"]]), rows((Decimal(0), Decimal(0)), []))]
    tips, column = [], 3
    for arm in layout["arm"]:
        yaw = Decimal(state["base_pose"][0])
        sine, cosine = sin_cos(yaw)
        mx, my = exact(arm["mount"])
        place, joints = (cosine * mx - sine * my, sine * mx + cosine * my), []
        for link in arm["link"]:
            joints.append((column, place))
            column += 1
            yaw += next(angles)
            sine, cosine = sin_cos(yaw)
            length, mass, inertia = exact([link["length"], link["mass"], link["inertia"]])
            ahead = lambda along: (place[0] + cosine * along, place[1] + sine * along)  # noqa: E731, B023
            found.append((mass, inertia, rows(ahead(length / 2), joints)))
            place = ahead(length)
        tips.append(rows(place, joints))
    return found, tips


def capture(layout, state):
    """The velocities after it, and the impulses [n, fx, fy] on the robot at the end effectors."""
    robot, tips = bodies(layout, state)
    before = exact(state["base_twist"]) + exact(state["joint_rates"])
    size = len(before)
    matrix, right = [[Decimal(0)] * size for _ in range(size)], [Decimal(0)] * size

    def add(weight, row, velocity):
        for i in range(size):
            right[i] += weight * row[i] * velocity
            for j in range(size):
                matrix[i][j] += weight * row[i] * row[j]

    def along(row, velocities):
        return sum(a * b for a, b in zip(row, velocities, strict=True))

    for mass, inertia, rows in robot:
        for weight, row in zip([inertia, mass, mass], rows, strict=True):
            add(weight, row, along(row, before))
    caught = []
    for target, (angular, x, y) in zip(state["targets"], tips, strict=True):
        if target is None:
            caught.append(None)
            continue
        mass, inertia, rx, ry = exact([target["mass"], target["inertia"], *target["contact"]])
        # the COM is at -r from the end effector
        rows = (
            angular,
            [a + ry * w for a, w in zip(x, angular, strict=True)],
            [a - rx * w for a, w in zip(y, angular, strict=True)],
        )
        weights, twist = [inertia, mass, mass], exact(target["twist"])
        for weight, row, velocity in zip(weights, rows, twist, strict=True):
            add(weight, row, velocity)
        caught.append((rows, weights, twist, rx, ry))
    after = solve(matrix, right)
    twists, impulses = [], []
    for target in caught:
        if target is None:
            twists.append(None)
            impulses.append(None)
            continue
        rows, weights, twist, rx, ry = target
        new = [along(row, after) for row in rows]
        spin, fx, fy = (weight * (old - value) for weight, old, value in zip(weights, twist, new, strict=True))
        twists.append(new)
        impulses.append([spin + ry * fx - rx * fy, fx, fy])
    return {
        "base_twist_after": after[:3],
        "joint_rates_after": after[3:],
        "target_twists_after": twists,
        "impulses": impulses,
    }


def rounded(value):
    """Decimals as floats."""
    if isinstance(value, list):
        return [rounded(entry) for entry in value]
    return value if value is None else float(value)


def cases():
    """Layout, state and capture for every entry of RATIOS."""
    draw = random.Random(SEED)

    def several(count, bound):
        return [round(draw.uniform(-bound, bound), 6) for _ in range(count)]

    for light, targets in RATIOS:
        links = [{"length": 1.0, "mass": mass, "inertia": 0.105 * mass} for mass in (10.0, 10.0, light)]
        arms = [{"name": f"arm{i}", "mount": [x, 0.0], "link": links} for i, x in ((1, 0.5), (2, -0.5))]
        layout = {"name": "dual_arm_3r", "base": {"mass": 500.0, "inertia": 83.61}, "arm": arms}
        state = {
            "base_pose": several(3, 3.0),
            "joint_angles": several(6, 3.0),
            "base_twist": several(3, 1.0),
            "joint_rates": several(6, 1.0),
            "targets": [
                target
                and {"mass": target[0], "inertia": target[1], "contact": several(2, 0.8), "twist": several(3, 1.0)}
                for target in targets
            ],
        }
        expect = {name: rounded(value) for name, value in capture(layout, state).items()}
        yield {"layout": layout, "state": state, "expect": expect}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true", help="compare the file")
    arguments = parser.parse_args()
    text = json.dumps(list(cases()), indent=1) + "\n"
    if not arguments.check:
        FILE.write_text(text, encoding="utf-8")
    elif FILE.read_text(encoding="utf-8") != text:
        sys.exit(f"{FILE.name} is not what this command writes: python3 tests/reference/captures.py")


if __name__ == "__main__":
    main()
