"""What functions of a state take and return. Shapes are those of one state: a batch has its own axes before them."""

from typing import NamedTuple

import numpy as np


class State(NamedTuple):
    """Position and velocity of a robot; ``robot.bias(*state)``."""

    #: (3,) [yaw, x, y] of the base COM in the inertial frame; rad, m.
    base_pose: np.ndarray
    #: (joints,) relative, arm by arm; rad.
    joint_angles: np.ndarray
    #: (3,) [ω, vx, vy] of the base COM, inertial axes; rad/s, m/s.
    base_twist: np.ndarray
    #: (joints,) arm by arm; rad/s.
    joint_rates: np.ndarray


class Targets(NamedTuple):
    """One target for each arm, rigidly held at its contact point; ``robot.capture(*state, *targets)``."""

    #: (arms,) kg; 0, with an inertia of 0, where the arm captures nothing.
    target_masses: np.ndarray
    #: (arms,) about the COM; kg m².
    target_inertias: np.ndarray
    #: (arms, 2) from the target's COM to the contact point, inertial axes; m.
    contacts: np.ndarray
    #: (arms, 3) [ω, vx, vy] of the target's COM before the impact, inertial axes; rad/s, m/s.
    target_twists: np.ndarray


class Accelerations(NamedTuple):
    """Forward dynamics."""

    #: (3,) [α, ax, ay] of the base COM, inertial axes; rad/s², m/s².
    base_acceleration: np.ndarray
    #: (joints,) rad/s².
    joint_accelerations: np.ndarray


class ReducedDynamics(NamedTuple):
    """The terms of I θ̈ + c = τ, eq. (2)."""

    #: (joints, joints) I; kg m².
    generalized_inertia: np.ndarray
    #: (joints,) c; N m.
    generalized_bias: np.ndarray
    #: (3 arms, joints) rows [ω, vx, vy] per arm, inertial axes.
    generalized_jacobian: np.ndarray


class Momentum(NamedTuple):
    """Of all bodies of the robot."""

    #: (2,) [px, py], inertial axes; N s.
    linear_momentum: np.ndarray
    #: () about the inertial origin; N m s.
    angular_momentum: np.ndarray
    #: () J.
    kinetic_energy: np.ndarray


class ReducedImpact(NamedTuple):
    """The paper's reduced equations, (15) and (16): G θ̇_f = H."""

    #: (joints, joints) G; kg m².
    impact_matrix: np.ndarray
    #: (joints,) H; N m s.
    impact_momentum: np.ndarray
    #: (joints,) rad/s.
    joint_rates_after: np.ndarray


class FullImpact(NamedTuple):
    """The exact impact in full coordinates; G is the mass matrix of the robot that holds its targets."""

    #: (3 + joints, 3 + joints) G, base then joints.
    impact_matrix: np.ndarray
    #: (3 + joints,) H, base then joints.
    impact_momentum: np.ndarray
    #: (3,) [ω, vx, vy] of the base COM, inertial axes; rad/s, m/s.
    base_twist_after: np.ndarray
    #: (joints,) rad/s.
    joint_rates_after: np.ndarray


class Capture(NamedTuple):
    """The exact impact by the balance of momentum, with impulses."""

    #: (3,) [ω, vx, vy] of the base COM, inertial axes; rad/s, m/s.
    base_twist_after: np.ndarray
    #: (joints,) rad/s.
    joint_rates_after: np.ndarray
    #: (arms, 3) [ω, vx, vy] of each target's COM; zeros where the arm captures nothing.
    target_twists_after: np.ndarray
    #: (arms, 3) [n, fx, fy] on the robot at each end effector; N m s, N s; zeros where the arm captures nothing.
    impulses: np.ndarray
