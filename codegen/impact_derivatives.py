"""Computes the velocities and impulses after a rigid capture and their derivatives, by implicit differentiation.

The velocities v' solve G v' = H of `impact.py`, or M (v' - v) = sum K^T I_t (t - K v') with K = J_t^-1 J: the impulses
on the robot are those that the targets lose. With the factors of G,

    dv'/dt = P = G^-1 K^T I_t for each target,    dv'/dv = G^-1 M = 1 - sum P K,
    dv'/dx = G^-1 d/dx [M (v - v') + sum K^T I_t (t - K v')] at fixed v, v', t,  x a position or contact.

The targets follow with t' = K v', and the impulses with J_t^-T I_t (t - t').
"""

from dataclasses import dataclass

import casadi as ca

from .equations_of_motion import EquationsOfMotion
from .impact import impact_equations, target_jacobian
from .inputs import CONFIGURATION, STATE, TARGETS, Inputs
from .linear_algebra import LdltFactors, matrix_times
from .plane_vectors import ZERO, Vector, perpendicular, scale, subtract
from .reduced_dynamics import ReducedDynamics
from .signatures import Family, Function, Output, list_of_vectors, matrix, smallest_pivot, vector
from .symbols import Symbols
from .tangent import Tangent

Column = list[ca.SX]
RESULTS = ["base_twist_after", "joint_rates_after", "target_twists_after", "impulses"]


@dataclass(frozen=True)
class Coordinates:
    """Those in which the impact is solved: Jacobian of the end effectors, inertia, velocity, order of elimination.

    The base twist after the impact is ``base`` + ``base_response`` (velocity before - after) where the coordinates are
    the joints' alone, else the first three velocities.
    """

    jacobian: ca.SX
    inertia: ca.SX
    velocity: ca.SX
    order: list[int]
    base: ca.SX | None = None
    base_response: ca.SX | None = None


def full_coordinates(equations: EquationsOfMotion, inputs: Inputs) -> Coordinates:
    """Base twist and joint rates, in which the impact is exact."""
    jacobian, mass = equations.kinematics.end_effector_jacobian(), equations.mass_matrix()
    order = [*reversed(range(3, 3 + equations.symbols.joints)), 1, 2, 0]
    return Coordinates(jacobian, mass, ca.vertcat(inputs.base_twist, inputs.joint_rates), order)


def joint_coordinates(reduced: ReducedDynamics, inputs: Inputs) -> Coordinates:
    """Joint rates of the paper; eq. (17) keeps the robot's momentum: t_b' = t_b + I_b^-1 I_bm (rates - rates')."""
    inertia, jacobian = reduced.generalized_inertia(), reduced.generalized_jacobian()
    columns = []
    for lever, response in zip(reduced.com_lever, reduced.rotation_response, strict=True):
        linear: Vector = perpendicular(subtract(lever, scale(response, reduced.com)))
        columns.append(ca.vertcat(response, *linear))
    order = [*reversed(range(reduced.symbols.joints))]
    return Coordinates(jacobian, inertia, inputs.joint_rates, order, inputs.base_twist, ca.horzcat(*columns))


class ImpactDerivatives:
    """Results of an impact, ``velocity`` v', ``base_twist``, ``joint_rates``, ``target_twists`` and ``impulses`` (rows
    of three per arm), and columns of their derivatives."""

    def __init__(self, symbols: Symbols, inputs: Inputs, coordinates: Coordinates) -> None:
        self.symbols, self.inputs, self.coordinates = symbols, inputs, coordinates
        self.arms = range(inputs.contacts.shape[1])
        self.size = coordinates.velocity.shape[0]
        variables = [inputs.base_pose, inputs.joint_angles, inputs.contacts]
        sizes = [variable.numel() for variable in variables]
        self.tangents = []  # by yaw, by joint angles, by contacts
        for place in [0, *range(3, sum(sizes))]:
            unit = ca.vertsplit(ca.SX([float(i == place) for i in range(sum(sizes))]), [0, *cumulated(sizes)])
            self.tangents.append(Tangent(symbols, variables, unit))
        g, h, self.sections = impact_equations(
            coordinates.jacobian, coordinates.inertia, matrix_times(coordinates.inertia, coordinates.velocity), inputs
        )
        self.factors = LdltFactors(symbols, g, coordinates.order)
        solution, sections = self.factors.solve(h)
        self.sections += [self.factors.section, *sections]
        self.velocity = ca.vertcat(*symbols.variables(ca.vertsplit(solution)))
        contact = [(inputs.contacts[0, arm], inputs.contacts[1, arm]) for arm in self.arms]
        self.rows = [target_jacobian(coordinates.jacobian, arm, contact[arm]) for arm in self.arms]
        self.lost = [self._lost(arm) for arm in self.arms]  # I_t (t - K v')
        self.base_twist, self.joint_rates = self._split()
        self.target_twists = [[dot(row, self.velocity) for row in rows] for rows in self.rows]
        self.impulses = [self._impulse(arm, *self.lost[arm]) for arm in self.arms]

    def _weights(self, arm: int) -> Column:
        mass = self.inputs.target_masses[arm]
        return [self.inputs.target_inertias[arm], mass, mass]

    def _lost(self, arm: int) -> Column:
        twist = ca.vertsplit(self.inputs.target_twists[:, arm])
        parts = zip(self._weights(arm), twist, self.rows[arm], strict=True)
        return self.symbols.variables([weight * (before - dot(row, self.velocity)) for weight, before, row in parts])

    def _impulse(self, arm: int, spin: ca.SX, x: ca.SX, y: ca.SX) -> Column:
        """J_t^-T of a target's lost momentum."""
        return [spin + self.inputs.contacts[1, arm] * x - self.inputs.contacts[0, arm] * y, x, y]

    def _split(self) -> tuple[Column, Column]:
        """(base twist, joint rates) after the impact."""
        values = ca.vertsplit(self.velocity)
        response = self.coordinates.base_response
        if response is None:
            return values[:3], values[3:]
        change = self.coordinates.velocity - self.velocity
        return [self.coordinates.base[i] + dot(response[i, :], change) for i in range(3)], values

    def column(
        self,
        velocity: ca.SX,
        twists: list[Column],
        contact: tuple[int, int] | None = None,
        base: Column | None = None,
        before: dict[tuple[int, int], ca.SX] | None = None,
    ) -> Column:
        """Derivatives of all results from those of v' and of the target twists after.

        ``contact`` is (arm, x or y) of a derivative by a contact, ``base`` what the base twist of the joints'
        coordinates changes by besides v', and ``before`` the derivatives of the target twists before the impact."""
        response, values = self.coordinates.base_response, ca.vertsplit(velocity)
        if response is None:
            column = values
        else:
            change = [ZERO] * 3 if base is None else base
            column = [*(change[i] - dot(response[i, :], velocity) for i in range(3)), *values]
        column = [*column, *(entry for twist in twists for entry in twist)]
        for arm in self.arms:
            lost = [
                weight * ((before or {}).get((arm, i), ZERO) - entry)
                for i, (weight, entry) in enumerate(zip(self._weights(arm), twists[arm], strict=True))
            ]
            impulse = self._impulse(arm, *lost)
            if contact is not None and contact[0] == arm:
                _, x, y = self.lost[arm]
                impulse[0] = impulse[0] + (x if contact[1] == 1 else -y)
            column += impulse
        return column

    def by_target_twists(self) -> list[Column]:
        """P and what follows from it."""
        self.solutions, columns = [], []
        for arm in self.arms:
            for i, (row, weight) in enumerate(zip(self.rows[arm], self._weights(arm), strict=True)):
                solution, _ = self.factors.solve(weight * row.T)
                self.solutions.append(solution)
                columns.append(self.column(solution, self._after(solution), before={(arm, i): ca.SX(1)}))
        return columns

    def by_velocity(self) -> list[Column]:
        """By base twist and joint rates; after `by_target_twists`."""
        size, columns = self.size, []
        rows = [row for rows in self.rows for row in rows]
        for k in range(size):
            velocity = ca.SX(size, 1)
            velocity[k] = 1
            for solution, row in zip(self.solutions, rows, strict=True):
                if row.sparsity().has_nz(0, k):
                    velocity = velocity - solution * row[0, k]
            velocity = ca.vertcat(*self.symbols.variables(ca.vertsplit(ca.densify(velocity))))
            base = None
            if self.coordinates.base_response is not None:
                base = ca.vertsplit(ca.densify(self.coordinates.base_response[:, k]))
            columns.append(self.column(velocity, self._after(velocity), base=base))
        if self.coordinates.base_response is not None:
            rest = [ZERO] * (self.size + 6 * len(self.arms))
            columns = [*([*(ca.SX(float(i == j)) for i in range(3)), *rest] for j in range(3)), *columns]
        return columns

    def by_positions_and_contacts(self) -> tuple[list[Column], list[Column]]:
        """By yaw and joint angles, and by contacts."""
        columns = []
        momentum = matrix_times(self.coordinates.inertia, self.coordinates.velocity - self.velocity)
        for index, tangent in enumerate(self.tangents):
            place = index - 1 - self.symbols.joints  # among the contacts
            columns.append(self._by(tangent, momentum, divmod(place, 2) if place >= 0 else None))
        return columns[: 1 + self.symbols.joints], columns[1 + self.symbols.joints :]

    def _by(self, tangent: Tangent, momentum: ca.SX, contact: tuple[int, int] | None) -> Column:
        right = ca.vertcat(*tangent.of(ca.vertsplit(ca.densify(momentum))))
        moved = []  # dK v'
        for arm in self.arms:
            rates = [ca.horzcat(*tangent.of(ca.horzsplit(ca.densify(row)))) for row in self.rows[arm]]
            moved.append(self.symbols.variables([dot(rate, self.velocity) for rate in rates]))
            parts = zip(rates, self.rows[arm], self._weights(arm), self.lost[arm], moved[-1], strict=True)
            for rate, row, weight, lost, change in parts:
                right = right + ca.sparsify(rate).T * lost - row.T * (weight * change)
        velocity, _ = self.factors.solve(right)
        velocity = ca.vertcat(*self.symbols.variables(ca.vertsplit(velocity)))
        after = self._after(velocity)
        twists = [[a + b for a, b in zip(*parts, strict=True)] for parts in zip(after, moved, strict=True)]
        base = None
        if self.coordinates.base_response is not None:
            change = self.coordinates.velocity - self.velocity
            rows = [ca.horzcat(*tangent.of(ca.horzsplit(self.coordinates.base_response[i, :]))) for i in range(3)]
            base = [dot(row, change) for row in rows]
        return self.column(velocity, twists, contact, base)

    def _after(self, velocity: ca.SX) -> list[Column]:
        return [[dot(row, velocity) for row in rows] for rows in self.rows]


def cumulated(sizes: list[int]) -> list[int]:
    totals, total = [], 0
    for size in sizes:
        total += size
        totals.append(total)
    return totals


def dot(row: ca.SX, column: ca.SX) -> ca.SX:
    """The product of a row and a column, of structural nonzeros alone."""
    total = ZERO
    for k in range(row.shape[1]):
        if row.sparsity().has_nz(0, k):
            total = total + row[0, k] * column[k]
    return total


def impact_functions(name: str, description: str, impact: ImpactDerivatives, source: str) -> list[Function]:
    """The results of the impact, and these with their derivatives."""
    symbols, arms = impact.symbols, len(impact.arms)
    lists = [ca.horzcat(*[ca.vertcat(*part) for part in parts]) for parts in (impact.target_twists, impact.impulses)]
    results = [
        vector("base_twist_after", "rad/s, m/s, m/s", "[omega, vx, vy], inertial axes", ca.vertcat(*impact.base_twist)),
        vector("joint_rates_after", "rad/s", "arm by arm", ca.vertcat(*impact.joint_rates)),
        list_of_vectors("target_twists_after", "rad/s, m/s, m/s", "[omega, vx, vy] of each target's COM", lists[0]),
        list_of_vectors("impulses", "N m s, N s, N s", "[n, fx, fy] on the robot at each end effector", lists[1]),
    ]
    pivot = smallest_pivot(impact.factors.smallest_pivot)
    by_twists = impact.by_target_twists()
    by_velocity = impact.by_velocity()
    by_position, by_contact = impact.by_positions_and_contacts()
    height = 3 + symbols.joints + 6 * arms
    nothing = [[ZERO] * height] * 2  # by the base's position
    text = "rows base twist, joint rates, target twists, impulses; columns "
    matrices = [
        ("by_position", "base pose then joint angles", [by_position[0], *nothing, *by_position[1:]], [*CONFIGURATION]),
        ("by_velocity", "base twist then joint rates", by_velocity, ["base_twist", "joint_rates"]),
        ("by_contacts", "[rx, ry] target by target", by_contact, ["contacts"]),
        ("by_target_twists", "[omega, vx, vy] target by target", by_twists, ["target_twists"]),
    ]
    outputs: list[Output] = [output.deriving(name, [output.name], []) for output in results]
    for output, columns, entries, by in matrices:
        value = ca.horzcat(*[ca.vertcat(*column) for column in entries])
        outputs.append(matrix(output, "row over column", text + columns, value).deriving(name, RESULTS, by))
    equation = "M (v' - v) = sum K^T I_t (t - K v'),  t' = K v',  F = J_t^-T I_t (t - t'),  K = J_t^-1 J"
    inputs = [*STATE, *TARGETS]
    return [
        Function(
            name,
            f"{description}: velocities and impulses.",
            equation,
            source,
            inputs,
            [*results, pivot],
            impact.sections,
        ),
        Function(
            f"{name}_derivatives",
            f"{description}, and its derivatives.",
            equation,
            source,
            inputs,
            [*outputs, pivot],
            impact.sections,
        ),
    ]


def impact_derivatives_family(reduced: ReducedDynamics, inputs: Inputs) -> Family:
    symbols, equations = reduced.symbols, reduced.equations
    source = "Raina & Shah (2017), eqs. (10) to (17)"
    exact = ImpactDerivatives(symbols, inputs, full_coordinates(equations, inputs))
    paper = ImpactDerivatives(symbols, inputs, joint_coordinates(reduced, inputs))
    functions = [
        *impact_functions("exact_impact", "Exact impact, in full coordinates", exact, source),
        *impact_functions("paper_impact", "Impact by the paper's equations", paper, source),
    ]
    return Family(
        "impact_derivatives", "Rigid capture of one target per arm, with derivatives.", functions, reduced.sections
    )
