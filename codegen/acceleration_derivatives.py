"""Computes the derivatives of forward dynamics, eq. (1), by position, velocity and forces.

In absolute angles, a rotation of link k alone turns its own vectors, and nothing else: sigma_k and d_k by z x. The term
that they enter is (i alpha_k - omega_k^2) times a vector, so that its derivative is alpha_k times what the squared rate
omega_k^2 gives, plus omega_k^2 times what -alpha_k gives. With the columns C_k = d(accelerations)/d(omega_k^2) and
N_k = d(accelerations)/d(moment on link k) of `mobility.py`,

    d(accelerations)/d(phi_k)   = alpha_k C_k + (sigma_k . a_k + d_k . F'_k - omega_k^2 I_P,k) N_k + omega_k^2 e_k,
    d(accelerations)/d(omega_k) = 2 omega_k C_k,

where a_k is the acceleration of its joint, F'_k the force on its child, and e_k selects alpha_k. A joint turns its link
and all outboard ones: derivatives by joint angles and rates are sums over these. Nothing depends on the base's position
and velocity; its yaw turns accelerations and forces together.
"""

import casadi as ca

from .inputs import CONFIGURATION, STATE, Inputs
from .kinematics import angular_velocities
from .link_accelerations import Forces, LinkAccelerations
from .mobility import Mobility
from .plane_vectors import ZERO, dot, perpendicular
from .signatures import Family, Function, Section, matrix, smallest_pivot, vector
from .symbols import Symbols

Column = list[ca.SX]  # rows base [alpha, a_x, a_y], then joint accelerations
BASE = 3
RESULTS = ["base_acceleration", "joint_accelerations"]


class AccelerationDerivatives:
    """Derivatives at one configuration, for any velocities and forces."""

    def __init__(self, symbols: Symbols, inputs: Inputs) -> None:
        self.symbols, self.inputs = symbols, inputs
        self.mobility = mobility = Mobility(symbols, inputs)
        self.moments = [mobility.of_joints(column) for column in mobility.moments]
        self.rates = [mobility.of_joints(column) for column in mobility.rates]
        self.base_rate = mobility.of_joints(mobility.base_rate)
        self.inverse_mass_matrix = self._inverse_mass_matrix()

    def _inverse_mass_matrix(self) -> list[list[ca.SX]]:
        """Columns base wrench, joint torques: the torque of a joint acts on its link, its reaction before it."""
        size = BASE + self.symbols.joints
        inverse = [[ZERO] * size for _ in range(size)]
        for i in range(BASE):
            inverse[i][:BASE] = self.mobility.inverse[i]
        for arm in self.symbols.arms:
            for k in range(len(arm.links)):
                column = BASE + arm.first_joint + k
                here = self.moments[arm.first_joint + k]
                for row in range(column + 1):  # upwards: the row of the base's moment is the first
                    before = self.moments[arm.first_joint + k - 1][row] if k > 0 else inverse[row][0]
                    inverse[row][column] = inverse[column][row] = here[row] - before
        return inverse

    @property
    def sections(self) -> list[Section]:
        """The parts that depend on the configuration alone."""
        joints = Section("accelerations of the joints", self.moments, self.rates, self.base_rate)
        return [*self.mobility.sections, joints, Section("inverse mass matrix", *self.inverse_mass_matrix)]

    def derivatives(self, forces: Forces) -> tuple[Column, list[Column], list[Column], list[Section]]:
        """(accelerations, columns by position, columns by velocity, sections)."""
        accelerations = LinkAccelerations(self.mobility, forces)
        size = BASE + self.symbols.joints
        by_position: list[Column] = [[ZERO] * size for _ in range(size)]
        by_velocity: list[Column] = [[ZERO] * size for _ in range(size)]
        base_rate = self.inputs.base_twist[0]
        by_velocity[0] = [(base_rate + base_rate) * entry for entry in self.base_rate]
        for arm, part in zip(self.symbols.arms, accelerations.arms, strict=True):
            velocities = angular_velocities(arm, self.inputs)
            by_angle, by_rate = [ZERO] * size, [ZERO] * size
            for k in reversed(range(len(arm.links))):
                joint = arm.first_joint + k
                rate, moment = self.rates[joint], self.moments[joint]
                angle = self._by_angle(part.angular[k], rate, part.rotation_moments[k], moment)
                row = BASE + joint
                angle[row] = angle[row] + part.squares[k]
                if k < len(arm.links) - 1:
                    angle[row + 1] = angle[row + 1] - part.squares[k]
                twice = velocities[k] + velocities[k]
                by_angle = [a + b for a, b in zip(by_angle, angle, strict=True)]
                by_rate = [a + twice * b for a, b in zip(by_rate, rate, strict=True)]
                by_position[row], by_velocity[row] = by_angle, by_rate
            by_velocity[0] = [a + b for a, b in zip(by_velocity[0], by_rate, strict=True)]
        by_position[0] = self._by_yaw(accelerations, forces)
        sections = [
            *accelerations.sections,
            Section("by position", *by_position),
            Section("by velocity", *by_velocity),
        ]
        return self.mobility.of_joints(accelerations.column), by_position, by_velocity, sections

    @staticmethod
    def _by_angle(alpha: ca.SX, rate: Column, moment: ca.SX, by_moment: Column) -> Column:
        return [alpha * c + moment * n for c, n in zip(rate, by_moment, strict=True)]

    def _by_yaw(self, accelerations: LinkAccelerations, forces: Forces) -> Column:
        """The accelerations turn with the forces on the robot: z x a, less the response to these turned."""
        _, x, y = accelerations.base
        column = [ZERO, -y, x, *[ZERO] * self.symbols.joints]
        turned: list[tuple[ca.SX, Column]] = []  # forces turned backwards, and the accelerations by each
        inverse = self.inverse_mass_matrix
        total = [ZERO, ZERO]
        if forces.base_wrench:
            total = [self.inputs.base_wrench[2], -self.inputs.base_wrench[1]]
        if forces.end_effector_wrenches:
            moment = ZERO
            for index, arm in enumerate(self.mobility.arms):
                wrench = self.inputs.end_effector_wrenches[:, index]
                force = (wrench[2], -wrench[1])
                total = [total[0] + force[0], total[1] + force[1]]
                moment = moment + dot(self.mobility.levers[index], force)
                for k, body in enumerate(arm.bodies):
                    lever = body.lever if k < arm.links - 1 else perpendicular(arm.end_effector)
                    turned.append((dot(lever, force), self.moments[arm.symbols.first_joint + k]))
            turned.append((moment, inverse[0]))
        if forces.base_wrench or forces.end_effector_wrenches:
            turned += [(total[0], inverse[1]), (total[1], inverse[2])]
        for force, response in turned:
            column = [a + force * b for a, b in zip(column, response, strict=True)]
        return column


def of_columns(columns: list[Column]) -> ca.SX:
    """The matrix with these columns."""
    return ca.horzcat(*[ca.vertcat(*column) for column in columns])


def acceleration_derivatives_family(symbols: Symbols, inputs: Inputs) -> Family:
    dynamics = AccelerationDerivatives(symbols, inputs)
    pivot = smallest_pivot(dynamics.mobility.base.smallest_pivot())
    source = "Raina & Shah (2017), eq. (1)"
    rows = "rows base [alpha, ax, ay] then joint accelerations"
    inverse = matrix(
        "inverse_mass_matrix",
        "1/(kg m^2), 1/(kg m), 1/kg",
        f"{rows}, columns base wrench [n, fx, fy] then joint torques; symmetric",
        of_columns(dynamics.inverse_mass_matrix),
    ).deriving("forward_dynamics_with_base_wrench", RESULTS, ["base_wrench", "joint_torques"])
    functions = [
        Function(
            "inverse_mass_matrix",
            "Inverse of the mass matrix: the accelerations by the forces.",
            "M^-1",
            source,
            [*CONFIGURATION],
            [inverse, pivot],
        )
    ]
    wrenches = ["base_wrench", "end_effector_wrenches"]
    cases = [
        ("forward_dynamics", "joint torques alone"),
        ("forward_dynamics_with_base_wrench", "joint torques and a base wrench"),
        ("forward_dynamics_with_wrenches", "joint torques, a base wrench and end-effector wrenches"),
    ]
    position_text = f"{rows}, columns [yaw, x, y] of the base then joint angles"
    velocity_text = f"{rows}, columns base twist [omega, vx, vy] then joint rates"
    base_text = "[alpha, ax, ay] of the base COM, inertial axes"
    for present, (function, text) in enumerate(cases):
        accelerations, by_position, by_velocity, sections = dynamics.derivatives(Forces(present > 0, present > 1))
        base, joints = ca.vertcat(*accelerations[:BASE]), ca.vertcat(*accelerations[BASE:])
        positions, velocities = of_columns(by_position), of_columns(by_velocity)
        outputs = [
            vector("base_acceleration", "rad/s^2, m/s^2, m/s^2", base_text, base).deriving(function, RESULTS[:1], []),
            vector("joint_accelerations", "rad/s^2", "arm by arm", joints).deriving(function, RESULTS[1:], []),
            matrix("by_position", "1/s^2, m/s^2, 1/(m s^2)", position_text, positions).deriving(
                function, RESULTS, [*CONFIGURATION]
            ),
            matrix("by_velocity", "1/s, m/s, 1/(m s)", velocity_text, velocities).deriving(
                function, RESULTS, ["base_twist", "joint_rates"]
            ),
            inverse,
            pivot,
        ]
        functions.append(
            Function(
                f"{function}_derivatives",
                f"Accelerations under {text}, and their derivatives by position, velocity and forces.",
                "da/dq, da/dv, da/df = M^-1  of  M a + c = f",
                source,
                [*STATE, "joint_torques", *wrenches[:present]],
                outputs,
                sections,
            )
        )
    description = "Derivatives of forward dynamics, from the inverse mass matrix and the response to squared rates."
    return Family("forward_dynamics_derivatives", description, functions, dynamics.sections)
