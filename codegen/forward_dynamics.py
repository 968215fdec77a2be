"""Computes accelerations from forces, eq. (1), by the articulated-body algorithm: one division per link.

`articulated_body.py` has the step from body to body. The base is one more body, whose joint is the mount of the first
arm: a 2 x 2 balance of forces remains there.
"""

import math
from itertools import chain

import casadi as ca

from .articulated_body import (
    ArticulatedBody,
    Child,
    GeneralBody,
    LeafBody,
    LengthRatios,
    TipBody,
    TwoMassBody,
    articulated_body,
    is_collinear,
)
from .inputs import STATE, Inputs
from .kinematics import angular_velocities
from .layout import Layout
from .plane_vectors import (
    ZERO,
    ZERO_VECTOR,
    Rotation,
    Vector,
    add,
    cross,
    perpendicular,
    rotate,
    rotate_inverse,
    rotation,
    scale,
    subtract,
)
from .rigid_body_inertia import RigidBodyInertia
from .signatures import Family, Function, Section, smallest_pivot, vector
from .symbols import ArmSymbols, Symbols


class ArticulatedArm:
    """The articulated bodies of one arm, from the last link to the mount, at one configuration.

    The axes of the last link are along and across its COM, and its rotation is (C, S), the COM in the parent's frame;
    ``last_link`` is its direction there. A point mass ``added`` of the base is at the mount, which is at
    ``offset`` from that of the first arm.
    """

    def __init__(
        self, symbols: Symbols, arm: ArmSymbols, inputs: Inputs, index: int, added: ca.SX, offset: Vector
    ) -> None:
        self.symbols, self.inputs, self.index = arm, inputs, index
        self.bodies: list[ArticulatedBody] = []
        self.rotations: list[Rotation] = []
        children: list[Child] = []
        for k in reversed(range(self.links)):
            link = arm.links[k]
            own = RigidBodyInertia(link.label, link.mass, link.inertia, link.com)
            angle = inputs.joint_angles[arm.first_joint + k]
            to_parent = rotation(angle + arm.mount_angle if k == 0 else angle)
            at_joint = added if k == 0 else ZERO
            if k == self.links - 1:
                body = TipBody(symbols, own, at_joint)
                self.last_link = to_parent
                to_parent = rotate(to_parent, link.com)
            else:
                body = articulated_body(symbols, own, children, at_joint)
            self.bodies.insert(0, body)
            self.rotations.insert(0, to_parent)
            position = (arm.links[k - 1].length, ZERO) if k > 0 else offset
            children = [Child(position, body.inertia.rotate(to_parent))]
        self.child = children[0]  # of the base
        values = [body.configuration_values for body in self.bodies]
        self.inertia_section = Section(f"{arm.title}, articulated inertia", values, self.child.inertia.elements)

    @property
    def links(self) -> int:
        return len(self.symbols.links)

    def bias_force(self, base_rotation: Rotation, with_wrench: bool) -> Vector:
        """b at the mount, base frame, by an inward recursion; `accelerations` can be called after it."""
        inputs, first = self.inputs, self.symbols.first_joint
        velocities = angular_velocities(self.symbols, inputs)
        torques = [inputs.joint_torques[first + k] for k in range(self.links)]
        moment = torques[-1]
        external = ZERO_VECTOR
        if with_wrench:
            wrench = inputs.end_effector_wrenches[:, self.index]
            external = rotate_inverse(base_rotation, (wrench[1], wrench[2]))
            for link_rotation in self.rotations[:-1]:
                external = rotate_inverse(link_rotation, external)
            lever = self.symbols.links[-1].length * cross(self.last_link, external)
            moment = moment + (wrench[0] + lever)
        forces: list[Vector] = []
        for k in reversed(range(self.links)):
            if k < self.links - 1:
                moment = torques[k] - torques[k + 1]
            force = self.bodies[k].bias_force(velocities[k] * velocities[k], moment, forces)
            force = rotate(self.rotations[k], force)
            if k == self.links - 1 and with_wrench:
                force = subtract(force, external)
            forces = [force]
        return forces[0]

    def accelerations(self, a: Vector, base_acceleration: ca.SX) -> list[ca.SX]:
        """Joint accelerations from the acceleration of the mount, base frame, by an outward recursion."""
        accelerations, parent = [], base_acceleration
        for link_rotation, body in zip(self.rotations, self.bodies, strict=True):
            alpha, points = body.accelerations(rotate_inverse(link_rotation, a))
            accelerations.append(alpha - parent)
            parent = alpha
            if points:
                a = points[0]
        return accelerations


class ForwardDynamics:
    """The robot at one configuration, for any velocities and forces."""

    def __init__(self, symbols: Symbols, inputs: Inputs) -> None:
        self.inputs = inputs
        mounts = [arm.mount for arm in symbols.arms]
        self.com = (-mounts[0][0], -mounts[0][1])  # of the base, from the first mount
        offsets = [ZERO_VECTOR]
        for arm, mount in list(zip(symbols.arms, mounts, strict=True))[1:]:
            text = f"mount of {arm.title} from that of arm 1, base frame"
            offset = subtract(mount, mounts[0])
            offsets.append(symbols.constant_vector(f"{arm.label}_mount_offset", offset, "m", text))
        own = RigidBodyInertia("base", symbols.base_mass, symbols.base_inertia, self.com)
        distinct = len(mounts) == 2 and not mounts_coincide(symbols.layout)
        self.needs_distinct_mounts = distinct and is_collinear(self.com, offsets[1])
        at_mounts = [ZERO] * len(mounts)
        if self.needs_distinct_mounts:
            ratios = LengthRatios(symbols, own, offsets[1][0])
            rest = symbols.constant("base_mass_at_mount", own.mass - ratios.first_moment, "kg", "m - mu of the base")
            at_mounts = [rest, ratios.first_moment]
        self.arms = [
            ArticulatedArm(symbols, arm, inputs, i, at_mounts[i], offsets[i]) for i, arm in enumerate(symbols.arms)
        ]
        first, *children = [arm.child for arm in self.arms]
        if self.needs_distinct_mounts:
            self.base = TwoMassBody(symbols, ratios, children[0].inertia)
        else:
            self.base = (GeneralBody if children else LeafBody)(symbols, own, children, ZERO)
        # the articulated inertia of the whole robot at the first mount
        inertia = self.inertia = self.base.inertia.plus(first.inertia)
        self.diagonal = inertia.xx * inertia.yy
        self.determinant = self.diagonal - inertia.xy * inertia.xy
        self.inverse_determinant = symbols.reciprocal(self.determinant)
        self.base_rotation = rotation(inputs.base_pose[0])

    @property
    def sections(self) -> list[Section]:
        """The parts that depend on the configuration alone."""
        solution = [*self.inertia.elements, self.inverse_determinant, self.smallest_pivot()]
        base = Section("base, articulated inertia", self.base.configuration_values, solution)
        return [*(arm.inertia_section for arm in self.arms), base]

    def smallest_pivot(self) -> ca.SX:
        """The last pivot relative to its diagonal entry, (yy - xy^2 / xx) / yy; those before it are bounded by the
        parameters."""
        return self.determinant / self.diagonal

    def accelerations(self, base_wrench: bool, end_effector_wrenches: bool) -> tuple[ca.SX, ca.SX, list[Section]]:
        """(base acceleration, joint accelerations, sections) of eq. (1), without the operations of absent wrenches."""
        inputs, base_rotation = self.inputs, self.base_rotation
        forces = [arm.bias_force(base_rotation, end_effector_wrenches) for arm in self.arms]
        moment = -inputs.joint_torques[self.arms[0].symbols.first_joint]
        for arm in self.arms[1:]:
            moment = moment - inputs.joint_torques[arm.symbols.first_joint]
        external = ZERO_VECTOR
        if base_wrench:
            wrench = inputs.base_wrench
            external = rotate_inverse(base_rotation, (wrench[1], wrench[2]))
            moment = moment + (wrench[0] + cross(self.com, external))
        base_rate_squared = inputs.base_twist[0] * inputs.base_twist[0]
        b = add(self.base.bias_force(base_rate_squared, moment, forces[1:]), forces[0])
        if base_wrench:
            b = subtract(b, external)
        # A a + b = 0 at the first mount
        x, y = self.inertia.balance(b, self.inverse_determinant)
        alpha, points = self.base.accelerations((x, y))
        points = [(x, y), *points]
        tangential, centripetal = scale(alpha, perpendicular(self.com)), scale(base_rate_squared, self.com)
        linear = rotate(base_rotation, add((x, y), subtract(tangential, centripetal)))
        accelerations = [arm.accelerations(point, alpha) for arm, point in zip(self.arms, points, strict=True)]
        sections = [
            *(Section(f"arm {i}, inward pass", force) for i, force in enumerate(forces, start=1)),
            Section("base, acceleration", alpha, points, linear),
            *(Section(f"arm {i}, outward pass", values) for i, values in enumerate(accelerations, start=1)),
        ]
        return ca.vertcat(alpha, *linear), ca.vertcat(*chain(*accelerations)), sections


def mounts_coincide(layout: Layout) -> bool:
    """Whether the second mount is at the first, or so close that the result of dividing by their distance is rounding.

    The Rust reader of layouts has the same bound.
    """
    if len(layout.arms) < 2:
        return False
    first, second = layout.arms[0].mount, layout.arms[1].mount
    return math.dist(first, second) <= 1e-6 * (math.hypot(*first) + math.hypot(*second))


def forward_dynamics_family(dynamics: ForwardDynamics) -> Family:
    wrenches = ["base_wrench", "end_effector_wrenches"]
    cases = [  # suffix, forces, wrenches, right-hand side
        ("", "joint torques alone", [], "[0; tau_m]"),
        ("_with_base_wrench", "joint torques and a base wrench", wrenches[:1], "[F_b; tau_m]"),
        (
            "_with_wrenches",
            "joint torques, a base wrench and end-effector wrenches",
            wrenches,
            "[F_b; tau_m] + [J_be J_me]^T F_e",
        ),
    ]
    functions = []
    for suffix, forces, present, right in cases:
        base, joints, sections = dynamics.accelerations(*(wrench in present for wrench in wrenches))
        base_text = "[alpha, ax, ay] of the base COM, inertial axes"
        outputs = [
            vector("base_acceleration", "rad/s^2, m/s^2, m/s^2", base_text, base),
            vector("joint_accelerations", "rad/s^2", "arm by arm", joints),
            smallest_pivot(dynamics.smallest_pivot()),
        ]
        functions.append(
            Function(
                f"forward_dynamics{suffix}",
                f"Accelerations of the free-floating robot under {forces}.",
                f"M [base_acceleration; joint_accelerations] + [c_b; c_m] = {right}",
                "Raina & Shah (2017), eq. (1)",
                [*STATE, "joint_torques", *present],
                outputs,
                sections,
            )
        )
    description = "Forward dynamics by the articulated-body algorithm, in link frames."
    return Family("forward_dynamics", description, functions, dynamics.sections)
