"""Approaches of a minute under PD control, by the independent model: longer than their trajectories, and other angles.

    python tests/reference/long_approaches.py

needs numpy and scipy, and writes long_approaches.json next to this file. The joints go along a cycloid from rest to
rest and are held at its end; the integration is begun anew there, where the third derivative jumps.
"""

import json
from pathlib import Path

import numpy as np
from independent_model import DERIVATIVE, PROPORTIONAL, cycloidal, forward, integrate, paper_robot, record

DURATION, EVERY = 60.0, 10.0
ONE = [0.3803, -0.6198, 1.2867], [-np.pi / 2] * 3
TWO = [0.3803, -0.6198, 1.2867, 2.4411, 1.7062, -1.0058], [-0.2530, -1.8050, -0.0364, 3.3946, 1.8050, 0.0364]
SERIES = [  # layout, initial and final angles, s of the trajectory
    ("single_arm_3r", *ONE, 20.0),
    ("single_arm_3r", *ONE, 60.0),
    ("single_arm_3r", [-1.2, 2.3, 0.4], [1.9, -2.0, -1.1], 12.5),
    ("dual_arm_3r", *TWO, 30.0),
    ("dual_arm_3r", *TWO, 60.0),
    (
        "dual_arm_3r",
        [0.698, -1.571, 1.047, 2.444, 1.571, -1.047],
        [-0.524, -1.393, -0.035, 2.618, -1.393, -0.035],
        20.0,
    ),
    ("dual_arm_3r", [-1.0, 2.0, -2.5, 1.5, -0.5, 3.0], [2.0, -1.0, 1.5, 4.5, 1.5, -2.0], 45.0),
]


def series(layout, initial, final, duration):
    """States every ten seconds."""
    initial, final = np.array(initial), np.array(final)
    robot = paper_robot(1 if layout == "single_arm_3r" else 2)
    moving = cycloidal(initial, final, duration)

    def law(trajectory):
        def torques(t, angles, rates):
            wanted, wanted_rates = trajectory(t)
            return PROPORTIONAL * (wanted - angles) + DERIVATIVE * (wanted_rates - rates)

        return torques

    times = np.arange(EVERY, DURATION + 0.5 * EVERY, EVERY)
    early, late = times[times < duration], times[times >= duration]
    start = np.concatenate([np.zeros(3), initial, np.zeros(3 + len(initial))])
    states = integrate(forward(robot, law(moving)), start, [*early, duration])
    rows = list(states[:-1])
    held = forward(robot, law(lambda t: (final, np.zeros_like(final))))
    for until in late - duration:
        rows.append(integrate(held, states[-1], [until])[-1] if until > 0 else states[-1])
    return [{"time": t, **record(*np.split(row, 2))} for t, row in zip(times, rows, strict=True)]


def main():
    """Write long_approaches.json."""
    result = [
        {"layout": layout, "initial": initial, "final": final, "trajectory_duration": duration, "states": states}
        for layout, initial, final, duration in SERIES
        for states in [series(layout, initial, final, duration)]
    ]
    result = {"source": "tests/reference/long_approaches.py", "duration": DURATION, "series": result}
    text = json.dumps(result, indent=1, default=lambda array: array.tolist())
    Path(__file__).with_name("long_approaches.json").write_text(text + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
