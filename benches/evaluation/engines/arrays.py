"""Times of the Python package on numpy arrays: ``arrays.py INPUT``, in one thread."""

import json
import sys
import time

import numpy as np
import planar_capture as pc

JOINTS, ARMS = 6, 2
# of the Rust program's batches
MANY = 16384
# numbers of a state in the input, and of the results for it
SIZES = [3, JOINTS, 3, JOINTS, JOINTS, 3 + JOINTS, JOINTS * JOINTS, JOINTS, 3 * ARMS * JOINTS]


def seconds_each(function, arguments, count):
    """Processor time per state, over calls for at least 20 ms, as in ``measure.rs``."""
    function(*arguments, threads=1)
    calls = 1
    while True:
        start = time.process_time()
        for _ in range(calls):
            function(*arguments, threads=1)
        elapsed = time.process_time() - start
        if elapsed >= 0.02:
            return elapsed / (calls * count)
        calls *= 2


def main(path):
    with open(path) as file:
        numbers = np.array([float(line) for line in file])
    states = numbers[-64 * sum(SIZES) :].reshape(64, -1)
    pose, angles, twist, rates, torques, accelerations, inertia, bias, _ = np.split(states, np.cumsum(SIZES)[:-1], axis=1)
    robot = pc.Robot.from_toml("dual_arm_3r")
    found = robot.forward_dynamics(pose, angles, twist, rates, torques)
    reduced = robot.reduced_dynamics(pose, angles, twist, rates)
    for what, found, expected in [
        ("base accelerations", found.base_acceleration, accelerations[:, :3]),
        ("joint accelerations", found.joint_accelerations, accelerations[:, 3:]),
        ("generalized inertia", reduced.generalized_inertia, inertia.reshape(64, JOINTS, JOINTS)),
        ("generalized bias", reduced.generalized_bias, bias),
    ]:
        np.testing.assert_allclose(found, expected, rtol=1e-11, atol=1e-11, err_msg=what)

    times = {}
    for suffix, copies in [("", 1), (", many states", MANY // 64)]:
        forward = [np.tile(part, (copies, 1)) for part in (pose, angles, twist, rates, torques)]
        count = 64 * copies
        times["forward dynamics" + suffix] = 1e9 * seconds_each(robot.forward_dynamics, forward, count)
        times["reduced dynamics" + suffix] = 1e9 * seconds_each(robot.reduced_dynamics, forward[:4], count)
    print(json.dumps(times))


main(sys.argv[1])
