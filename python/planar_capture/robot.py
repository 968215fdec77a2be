"""Robots: closed-form dynamics on numpy arrays."""

# annotations stay text: `help` would have numpy's ArrayLike in full, twenty lines a function
from __future__ import annotations

import json
import os
from collections.abc import Mapping
from typing import Any, TypedDict, Unpack

import numpy as np
from numpy.typing import ArrayLike

from . import _native
from .batch import Array, Batches, Function, OnSingular, Parameter
from .casadi_functions import casadi_function
from .errors import InputError
from .results import Accelerations, Capture, FullImpact, Momentum, ReducedDynamics, ReducedImpact, State

__all__ = ["Robot"]

STATE = ("base_pose", "joint_angles", "base_twist", "joint_rates")
TARGETS = ("target_masses", "target_inertias", "contacts", "target_twists")

Parameters = Mapping[str, ArrayLike] | None


class Options(TypedDict, total=False):
    """The keywords of all functions: see :class:`Robot`."""

    parameters: Parameters
    on_singular: OnSingular
    threads: int | None


class Robot:
    """A free-floating planar robot with arms of revolute joints.

    Every function takes arrays of any batch shape: the axes of one state are the last ones, and the axes before them
    broadcast as numpy's do. A function is computed in the widest vectors of the processor, on several threads, without
    the interpreter's lock; results have the same bits whatever the batch and the number of threads.

    SI units and radians. Poses are [yaw, x, y], twists [ω, vx, vy], wrenches and impulses [n, fx, fy], in inertial
    axes; positive rotation is anticlockwise. Joint angles are relative, arm by arm. The base's pose and twist are those
    of its centre of mass. Generalized velocities have the base twist first. Wrenches and impulses act on the robot.

    Keywords of all functions:

    - ``parameters``: numbers of the robot instead of the layout's, by their names in :attr:`parameters`; numbers or
      arrays that broadcast with the batch.
    - ``on_singular``: ``"raise"`` an exception about the first state without a result (:class:`SingularError`,
      :class:`NotFiniteError`, with its index and inputs), or ``"mask"`` such states: results are then
      :class:`numpy.ma.MaskedArray`. No result is ever NaN.
    - ``threads``: at most so many; one for each processor by default.
    """

    def __init__(self, native: _native.Robot) -> None:
        self._native = native
        self._batches = Batches(native)

    @classmethod
    def from_toml(cls, source: str | os.PathLike[str]) -> Robot:
        """A robot from a layout: a path, the name of a shipped one (:func:`planar_capture.layouts`), or TOML text.

        Raises :class:`InputError` with file, line, key and value of whatever is wrong, and :class:`MissingGraphError`
        where the arms, links and exact zeros are those of no graph yet: :func:`planar_capture.derive` derives one.
        """
        return cls(native_robot(source))

    def __repr__(self) -> str:
        arms = ", ".join(f"{name}: {links} joints" for name, links in self._native.arms)
        return f"<Robot {self.name} ({arms}), {self._native.origin}>"

    def __reduce__(self) -> tuple[Any, tuple[str]]:
        return Robot.from_toml, (self.layout,)

    @property
    def name(self) -> str:
        """The layout's name."""
        return self._native.name

    @property
    def arms(self) -> list[str]:
        """The names of the arms."""
        return [name for name, _ in self._native.arms]

    @property
    def joints(self) -> list[str]:
        """The names of the joints in their order, as columns of results have them: ``arm1_joint1``."""
        return [f"{name}_joint{k}" for name, links in self._native.arms for k in range(1, links + 1)]

    @property
    def layout(self) -> str:
        """The layout as TOML text."""
        return self._native.layout

    @property
    def parameters(self) -> dict[str, Parameter]:
        """The robot's numbers: names, units, and the layout's values.

        No parameters are exact zeros of the structure that the graph (``repr`` names it) was derived for: the y of a
        mount, its angle, and of a link before the last of its arm the y of the COM and the length. General graphs have
        none of them. The COM of a last link, which a target moves, is always a parameter, also where it is zero.
        """
        return dict(self._batches.parameters)

    @property
    def functions(self) -> dict[str, Function]:
        """The functions of the graph, with names, shapes, units and meanings of inputs and outputs."""
        return dict(self._batches.functions)

    @property
    def graph(self) -> dict[str, Any]:
        """The expression graph: single assignments that every function is computed by."""
        graph: dict[str, Any] = json.loads(self._native.graph)
        return graph

    def call(
        self,
        function: str,
        *,
        parameters: Parameters = None,
        on_singular: OnSingular = "raise",
        threads: int | None = None,
        **inputs: ArrayLike,
    ) -> dict[str, Any]:
        """Calls a function of :attr:`functions` by its name; its outputs by their names."""
        known = self._function(function)
        names = [argument.name for argument in known.inputs]
        if set(inputs) != set(names):
            raise InputError(f"`{function}` has the inputs {', '.join(names)}, not {', '.join(inputs) or 'none'}")
        wanted = [True] * len(known.outputs)
        values = [inputs[name] for name in names]
        results = self._batches.call(known, values, wanted, parameters, on_singular, threads)
        return {output.name: result for output, result in zip(known.outputs, results, strict=True)}

    def forward_dynamics(
        self,
        base_pose: ArrayLike,
        joint_angles: ArrayLike,
        base_twist: ArrayLike,
        joint_rates: ArrayLike,
        joint_torques: ArrayLike | None = None,
        base_wrench: ArrayLike | None = None,
        end_effector_wrenches: ArrayLike | None = None,
        **options: Unpack[Options],
    ) -> Accelerations:
        """Eq. (1) solved for the accelerations.

        ``base_pose`` (…, 3), ``joint_angles`` (…, joints), ``base_twist`` (…, 3), ``joint_rates`` (…, joints);
        ``joint_torques`` (…, joints) in N m; ``base_wrench`` (…, 3) at the base COM and ``end_effector_wrenches``
        (…, arms, 3) in N m, N, N. Forces are zero by default, and cost nothing then.
        """
        torques = np.zeros(len(self.joints)) if joint_torques is None else joint_torques
        inputs = [base_pose, joint_angles, base_twist, joint_rates, torques]
        name = "forward_dynamics"
        if end_effector_wrenches is not None:
            name = "forward_dynamics_with_wrenches"
            inputs += [np.zeros(3) if base_wrench is None else base_wrench, end_effector_wrenches]
        elif base_wrench is not None:
            name = "forward_dynamics_with_base_wrench"
            inputs.append(base_wrench)
        return Accelerations(*self._values(name, inputs, **options))

    def mass_matrix(
        self,
        base_pose: ArrayLike,
        joint_angles: ArrayLike,
        **options: Unpack[Options],
    ) -> Array:
        """M (…, 3 + joints, 3 + joints) of eq. (1), base then joints; kg m², kg m, kg."""
        return self._value("mass_matrix", [base_pose, joint_angles], **options)

    def bias(
        self,
        base_pose: ArrayLike,
        joint_angles: ArrayLike,
        base_twist: ArrayLike,
        joint_rates: ArrayLike,
        **options: Unpack[Options],
    ) -> Array:
        """[c_b; c_m] (…, 3 + joints) of eq. (1): centripetal and Coriolis terms; N m, N, N, then N m."""
        inputs = [base_pose, joint_angles, base_twist, joint_rates]
        return self._value("bias", inputs, **options)

    def reduced_dynamics(
        self,
        base_pose: ArrayLike,
        joint_angles: ArrayLike,
        base_twist: ArrayLike,
        joint_rates: ArrayLike,
        **options: Unpack[Options],
    ) -> ReducedDynamics:
        """Generalized inertia I, bias c and Jacobian J: I θ̈ + c = τ, eq. (2), and end effector twists J θ̇ of a robot
        of zero momentum.

        ``base_pose`` (…, 3), ``joint_angles`` (…, joints), ``base_twist`` (…, 3), ``joint_rates`` (…, joints) as in
        :class:`State`; (…, joints, joints) in kg m², (…, joints) in N m and (…, 3 arms, joints) in 1, m, m.
        """
        inputs = [base_pose, joint_angles, base_twist, joint_rates]
        return ReducedDynamics(*self._values("reduced_dynamics", inputs, **options))

    def generalized_jacobian(
        self,
        base_pose: ArrayLike,
        joint_angles: ArrayLike,
        **options: Unpack[Options],
    ) -> Array:
        """J (…, 3 arms, joints): rows [ω, vx, vy] per arm, inertial axes; 1, m, m."""
        return self._value("generalized_jacobian", [base_pose, joint_angles], **options)

    def end_effector_poses(
        self,
        base_pose: ArrayLike,
        joint_angles: ArrayLike,
        **options: Unpack[Options],
    ) -> Array:
        """(…, arms, 3) [yaw, x, y] in the inertial frame; rad, m. The yaw is not wrapped."""
        return self._value("end_effector_poses", [base_pose, joint_angles], **options)

    def end_effector_twists(
        self,
        base_pose: ArrayLike,
        joint_angles: ArrayLike,
        base_twist: ArrayLike,
        joint_rates: ArrayLike,
        **options: Unpack[Options],
    ) -> Array:
        """(…, arms, 3) [ω, vx, vy], inertial axes; rad/s, m/s."""
        inputs = [base_pose, joint_angles, base_twist, joint_rates]
        return self._value("end_effector_twists", inputs, **options)

    def end_effector_jacobian(
        self,
        base_pose: ArrayLike,
        joint_angles: ArrayLike,
        **options: Unpack[Options],
    ) -> Array:
        """[J_be J_me] (…, 3 arms, 3 + joints): rows [ω, vx, vy] per arm, columns base then joints; 1, m."""
        return self._value("end_effector_jacobian", [base_pose, joint_angles], **options)

    def body_poses(
        self,
        base_pose: ArrayLike,
        joint_angles: ArrayLike,
        **options: Unpack[Options],
    ) -> Array:
        """(…, 1 + joints, 3) [yaw, x, y] of every body's COM, inertial frame: base, then links arm by arm; rad, m."""
        return self._value("body_poses", [base_pose, joint_angles], **options)

    def body_twists(
        self,
        base_pose: ArrayLike,
        joint_angles: ArrayLike,
        base_twist: ArrayLike,
        joint_rates: ArrayLike,
        **options: Unpack[Options],
    ) -> Array:
        """(…, 1 + joints, 3) [ω, vx, vy] of every body's COM, inertial axes: base, then links; rad/s, m/s."""
        inputs = [base_pose, joint_angles, base_twist, joint_rates]
        return self._value("body_twists", inputs, **options)

    def momentum(
        self,
        base_pose: ArrayLike,
        joint_angles: ArrayLike,
        base_twist: ArrayLike,
        joint_rates: ArrayLike,
        **options: Unpack[Options],
    ) -> Momentum:
        """Linear momentum (…, 2), inertial axes, N s; angular momentum (…) about the inertial origin, N m s; and
        kinetic energy (…), J."""
        inputs = [base_pose, joint_angles, base_twist, joint_rates]
        return Momentum(*self._values("momentum", inputs, **options))

    def reduced_impact(
        self,
        base_pose: ArrayLike,
        joint_angles: ArrayLike,
        joint_rates: ArrayLike,
        target_masses: ArrayLike,
        target_inertias: ArrayLike,
        contacts: ArrayLike,
        target_twists: ArrayLike,
        **options: Unpack[Options],
    ) -> ReducedImpact:
        """The impact by the paper's reduced equations, (15) and (16), as printed: G θ̇_f = H.

        ``base_pose`` (…, 3) [yaw, x, y] in rad, m; ``joint_angles`` (…, joints) in rad; ``joint_rates`` (…, joints)
        before the impact in rad/s. The targets, one for each arm, are those of :class:`Targets`: ``target_masses``
        (…, arms) in kg, ``target_inertias`` (…, arms) in kg m², ``contacts`` (…, arms, 2) from COM to contact point in
        m, and ``target_twists`` (…, arms, 3) [ω, vx, vy] of the COM in rad/s, m/s; inertial axes.

        G (…, joints, joints) in kg m², H (…, joints) in N m s, and the joint rates after the impact (…, joints) in
        rad/s.
        """
        inputs = [base_pose, joint_angles, joint_rates, target_masses, target_inertias, contacts, target_twists]
        return ReducedImpact(*self._values("reduced_impact", inputs, **options))

    def full_impact(
        self,
        base_pose: ArrayLike,
        joint_angles: ArrayLike,
        base_twist: ArrayLike,
        joint_rates: ArrayLike,
        target_masses: ArrayLike,
        target_inertias: ArrayLike,
        contacts: ArrayLike,
        target_twists: ArrayLike,
        **options: Unpack[Options],
    ) -> FullImpact:
        """The exact impact in full coordinates, (10) and (11): G v_f = H.

        ``base_pose`` (…, 3) [yaw, x, y] in rad, m; ``joint_angles`` (…, joints) in rad; before the impact
        ``base_twist`` (…, 3) [ω, vx, vy] in rad/s, m/s and ``joint_rates`` (…, joints) in rad/s. The targets, one for
        each arm, are those of :class:`Targets`: ``target_masses`` (…, arms) in kg, ``target_inertias`` (…, arms) in
        kg m², ``contacts`` (…, arms, 2) from COM to contact point in m, and ``target_twists`` (…, arms, 3) [ω, vx, vy]
        of the COM in rad/s, m/s; inertial axes.

        G (…, 3 + joints, 3 + joints), base then joints, in kg m², kg m, kg; H (…, 3 + joints) in N m s, N s, N s, then
        N m s; after the impact the base twist (…, 3) in rad/s, m/s and the joint rates (…, joints) in rad/s.

        In the vectors of the processor; :meth:`capture` has twists of the targets and impulses too, and loses no digits
        where a target is much lighter or heavier than a link.
        """
        inputs = [base_pose, joint_angles, base_twist, joint_rates]
        inputs += [target_masses, target_inertias, contacts, target_twists]
        return FullImpact(*self._values("full_impact", inputs, **options))

    def capture(
        self,
        base_pose: ArrayLike,
        joint_angles: ArrayLike,
        base_twist: ArrayLike,
        joint_rates: ArrayLike,
        target_masses: ArrayLike,
        target_inertias: ArrayLike,
        contacts: ArrayLike,
        target_twists: ArrayLike,
        *,
        parameters: Parameters = None,
        on_singular: OnSingular = "raise",
        threads: int | None = None,
    ) -> Capture:
        """The exact impact by the balance of momentum, as ``planar-capture eval`` and ``run`` compute it.

        ``base_pose`` (…, 3) [yaw, x, y] in rad, m; ``joint_angles`` (…, joints) in rad; before the impact
        ``base_twist`` (…, 3) [ω, vx, vy] in rad/s, m/s and ``joint_rates`` (…, joints) in rad/s. The targets, one for
        each arm, are those of :class:`Targets`: ``target_masses`` (…, arms) in kg, 0 where the arm captures nothing,
        ``target_inertias`` (…, arms) in kg m², ``contacts`` (…, arms, 2) from COM to contact point in m, and
        ``target_twists`` (…, arms, 3) [ω, vx, vy] of the COM in rad/s, m/s; inertial axes.

        After the impact the base twist (…, 3) in rad/s, m/s, the joint rates (…, joints) in rad/s and the twists of the
        targets (…, arms, 3) in rad/s, m/s; and the impulses (…, arms, 3) [n, fx, fy] on the robot at the end effectors
        in N m s, N s; inertial axes. State by state.
        """
        inputs = [base_pose, joint_angles, base_twist, joint_rates]
        inputs += [target_masses, target_inertias, contacts, target_twists]
        known = self._function("full_impact")
        function = Function("capture", known.inputs, ())
        arms, joints = len(self.arms), len(self.joints)

        def compute(arrays: list[Array], count: int, numbers: Array | None) -> tuple[list[Any], Any]:
            return self._native.capture(arrays, count, numbers, threads)

        shapes = [(3,), (joints,), (arms, 3), (arms, 3)]
        return Capture(*self._batches.run(function, inputs, shapes, parameters, on_singular, compute))

    def evaluate(
        self,
        base_pose: ArrayLike,
        joint_angles: ArrayLike,
        base_twist: ArrayLike,
        joint_rates: ArrayLike,
        joint_torques: ArrayLike | None = None,
        base_wrench: ArrayLike | None = None,
        end_effector_wrenches: ArrayLike | None = None,
        targets: tuple[ArrayLike, ArrayLike, ArrayLike, ArrayLike] | None = None,
        **options: Unpack[Options],
    ) -> dict[str, Any]:
        """All of a state under the keys of ``planar-capture eval``, each as the function of its name gives it.

        ``base_pose`` (…, 3) [yaw, x, y] in rad, m; ``joint_angles`` (…, joints) in rad; ``base_twist`` (…, 3)
        [ω, vx, vy] in rad/s, m/s; ``joint_rates`` (…, joints) in rad/s; the forces of :meth:`forward_dynamics`:
        ``joint_torques`` (…, joints) in N m, ``base_wrench`` (…, 3) and ``end_effector_wrenches`` (…, arms, 3)
        [n, fx, fy] in N m, N; inertial axes. Shapes and units of the results are those of :meth:`mass_matrix`,
        :meth:`bias`, :meth:`reduced_dynamics`, :meth:`end_effector_poses`, :meth:`end_effector_jacobian`,
        :meth:`forward_dynamics` and :meth:`momentum`.

        ``targets`` are those of :class:`Targets`: masses (…, arms) in kg, inertias (…, arms) in kg m², contacts
        (…, arms, 2) in m, twists (…, arms, 3) in rad/s, m/s. With them there are the blocks ``impact`` (``G``, ``H``,
        ``joint_rates_after`` of :meth:`reduced_impact`) and ``capture`` (:meth:`capture`), too.
        """
        state = State(base_pose, joint_angles, base_twist, joint_rates)  # type: ignore[arg-type]
        forces = (joint_torques, base_wrench, end_effector_wrenches)
        reduced = self.reduced_dynamics(*state, **options)
        result: dict[str, Any] = {
            "mass_matrix": self.mass_matrix(base_pose, joint_angles, **options),
            "bias": self.bias(*state, **options),
            "generalized_inertia": reduced.generalized_inertia,
            "generalized_bias": reduced.generalized_bias,
            "end_effector_poses": self.end_effector_poses(base_pose, joint_angles, **options),
            "end_effector_jacobian": self.end_effector_jacobian(base_pose, joint_angles, **options),
            "generalized_jacobian": reduced.generalized_jacobian,
            **self.forward_dynamics(*state, *forces, **options)._asdict(),
            **self.momentum(*state, **options)._asdict(),
        }
        if targets is not None:
            matrix, momentum, rates = self.reduced_impact(base_pose, joint_angles, joint_rates, *targets, **options)
            result["impact"] = {"G": matrix, "H": momentum, "joint_rates_after": rates}
            result["capture"] = self.capture(*state, *targets, **options)._asdict()
        return result

    def casadi_function(self, name: str, *, symbolic_parameters: bool = False) -> Any:
        """A function of the graph as a ``casadi.Function``, to optimise with: inputs and outputs have the names and
        (for matrices) the shapes of :attr:`functions`.

        With ``symbolic_parameters`` it has another input, ``parameters``, in the order of :attr:`parameters`; else the
        layout's are in it. Needs CasADi, the extra ``derive``.
        """
        return casadi_function(self.graph, self._function(name), self._batches.values, symbolic_parameters)

    def _function(self, name: str) -> Function:
        if name not in self._batches.functions:
            known = ", ".join(self._batches.functions)
            raise InputError(f"the graph has no function `{name}`: it has {known}")
        return self._batches.functions[name]

    def _value(self, name: str, inputs: list[ArrayLike], **options: Unpack[Options]) -> Array:
        """The output of a function of one output."""
        value: Array = self._values(name, inputs, **options)[0]
        return value

    def _values(
        self,
        name: str,
        inputs: list[ArrayLike],
        parameters: Parameters = None,
        on_singular: OnSingular = "raise",
        threads: int | None = None,
    ) -> list[Any]:
        """The outputs of a function, but for the pivot, which is told by the statuses."""
        function = self._function(name)
        wanted = [output.name != "smallest_pivot" for output in function.outputs]
        return self._batches.call(function, inputs, wanted, parameters, on_singular, threads)


def native_robot(source: str | os.PathLike[str]) -> _native.Robot:
    """From a path, the name of a shipped layout, or TOML text."""
    text, file = layout_source(source)
    return _native.Robot.named(file) if text is None else _native.Robot.parse(text, file)


def layout_source(source: str | os.PathLike[str]) -> tuple[str | None, str]:
    """Text and its name in messages; of a path or a name no text yet."""
    if isinstance(source, str):
        return (source, "<layout>") if "\n" in source else (None, source)
    path = os.fspath(source)
    # a path, whatever it is called
    is_path = path.endswith(".toml") or os.sep in path or "/" in path
    return None, path if is_path else os.path.join(".", path)
