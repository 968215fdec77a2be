"""What functions of a state take and return. Shapes are those of one state: a batch has its own axes before them."""

from typing import NamedTuple

import numpy as np


class State(NamedTuple):
    """Position and velocity of a robot; ``robot.bias(*state)``.

    - ``base_pose``: (3,) [yaw, x, y] of the base COM in the inertial frame; rad, m.
    - ``joint_angles``: (joints,) relative, arm by arm; rad.
    - ``base_twist``: (3,) [ω, vx, vy] of the base COM, inertial axes; rad/s, m/s.
    - ``joint_rates``: (joints,) arm by arm; rad/s.
    """

    base_pose: np.ndarray
    joint_angles: np.ndarray
    base_twist: np.ndarray
    joint_rates: np.ndarray


class Targets(NamedTuple):
    """One target for each arm, rigidly held at its contact point; ``robot.capture(*state, *targets)``.

    - ``target_masses``: (arms,) kg; 0, with an inertia of 0, where the arm captures nothing.
    - ``target_inertias``: (arms,) about the COM; kg m².
    - ``contacts``: (arms, 2) from the target's COM to the contact point, inertial axes; m.
    - ``target_twists``: (arms, 3) [ω, vx, vy] of the target's COM before the impact, inertial axes; rad/s, m/s.
    """

    target_masses: np.ndarray
    target_inertias: np.ndarray
    contacts: np.ndarray
    target_twists: np.ndarray


class Accelerations(NamedTuple):
    """Forward dynamics.

    - ``base_acceleration``: (3,) [α, ax, ay] of the base COM, inertial axes; rad/s², m/s².
    - ``joint_accelerations``: (joints,) rad/s².
    """

    base_acceleration: np.ndarray
    joint_accelerations: np.ndarray


class ReducedDynamics(NamedTuple):
    """The terms of I θ̈ + c = τ, eq. (2).

    - ``generalized_inertia``: (joints, joints) I; kg m².
    - ``generalized_bias``: (joints,) c; N m.
    - ``generalized_jacobian``: (3 arms, joints) J: rows [ω, vx, vy] per arm, inertial axes; 1, m, m.
    """

    generalized_inertia: np.ndarray
    generalized_bias: np.ndarray
    generalized_jacobian: np.ndarray


class Momentum(NamedTuple):
    """Of all bodies of the robot.

    - ``linear_momentum``: (2,) [px, py], inertial axes; N s.
    - ``angular_momentum``: () about the inertial origin; N m s.
    - ``kinetic_energy``: () J.
    """

    linear_momentum: np.ndarray
    angular_momentum: np.ndarray
    kinetic_energy: np.ndarray


class ReducedImpact(NamedTuple):
    """The paper's reduced equations, (15) and (16): G θ̇_f = H.

    - ``impact_matrix``: (joints, joints) G; kg m².
    - ``impact_momentum``: (joints,) H; N m s.
    - ``joint_rates_after``: (joints,) rad/s.
    """

    impact_matrix: np.ndarray
    impact_momentum: np.ndarray
    joint_rates_after: np.ndarray


class FullImpact(NamedTuple):
    """The exact impact in full coordinates; G is the mass matrix of the robot that holds its targets.

    - ``impact_matrix``: (3 + joints, 3 + joints) G, base then joints; kg m², kg m, kg.
    - ``impact_momentum``: (3 + joints,) H, base then joints; N m s, N s, N s, then N m s.
    - ``base_twist_after``: (3,) [ω, vx, vy] of the base COM, inertial axes; rad/s, m/s.
    - ``joint_rates_after``: (joints,) rad/s.
    """

    impact_matrix: np.ndarray
    impact_momentum: np.ndarray
    base_twist_after: np.ndarray
    joint_rates_after: np.ndarray


class Capture(NamedTuple):
    """The exact impact by the balance of momentum, with impulses.

    - ``base_twist_after``: (3,) [ω, vx, vy] of the base COM, inertial axes; rad/s, m/s.
    - ``joint_rates_after``: (joints,) rad/s.
    - ``target_twists_after``: (arms, 3) [ω, vx, vy] of each target's COM, inertial axes; rad/s, m/s; zeros where the
      arm captures nothing.
    - ``impulses``: (arms, 3) [n, fx, fy] on the robot at each end effector, inertial axes; N m s, N s; zeros where
      the arm captures nothing.
    """

    base_twist_after: np.ndarray
    joint_rates_after: np.ndarray
    target_twists_after: np.ndarray
    impulses: np.ndarray
