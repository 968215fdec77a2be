"""Computes the outputs of all functions of a layout, by families, from the symbols of its parameters and inputs.

The functions of a family share what depends on the configuration (base pose and joint angles) alone, and add
velocities and forces.
"""

from collections.abc import Callable

from .acceleration_derivatives import acceleration_derivatives_family
from .derivatives import NO_DERIVATIVES, Derivatives
from .directional_derivative import Direction, DirectionalDerivatives
from .equations_of_motion import EquationsOfMotion, equations_of_motion_family
from .forward_dynamics import ForwardDynamics, forward_dynamics_family
from .impact import impact_family
from .impact_derivatives import impact_derivatives_family
from .inputs import Inputs
from .kinematics import Kinematics, bodies_family, end_effectors_family
from .layout import Layout
from .momentum import momentum_family
from .reduced_dynamics import ReducedDynamics, reduced_dynamics_family
from .symbols import Symbols


class Functions:
    """The families of one layout, with the derivatives that are asked for; `progress` is called with the name of each
    before it is derived."""

    def __init__(
        self,
        layout: Layout,
        progress: Callable[[str], None] = lambda family: None,
        derivatives: Derivatives = NO_DERIVATIVES,
    ) -> None:
        self.derivatives = derivatives
        self.layout, self.symbols = layout, Symbols(layout)
        self.inputs = Inputs.create(len(layout.arms), self.symbols.joints)
        progress("forward dynamics")
        dynamics = ForwardDynamics(self.symbols, self.inputs)
        self.needs_distinct_mounts = dynamics.needs_distinct_mounts
        self.families = [forward_dynamics_family(dynamics)]
        progress("equations of motion")
        kinematics = Kinematics(self.symbols, self.inputs)
        equations = EquationsOfMotion(self.symbols, kinematics)
        self.families.append(equations_of_motion_family(equations))
        progress("reduced dynamics")
        reduced = ReducedDynamics(self.symbols, equations)
        self.families.append(reduced_dynamics_family(reduced))
        progress("end effectors")
        self.families.append(end_effectors_family(kinematics))
        progress("bodies")
        self.families.append(bodies_family(kinematics))
        progress("momentum")
        self.families.append(momentum_family(kinematics))
        progress("impact")
        self.families.append(impact_family(reduced, self.inputs))
        self.directions: dict[str, Direction] = {}
        if "forward_dynamics" in derivatives.matrices:
            progress("derivatives of forward dynamics")
            self.families.append(acceleration_derivatives_family(self.symbols, self.inputs))
        if "impact" in derivatives.matrices:
            progress("derivatives of the impact")
            self.families.append(impact_derivatives_family(reduced, self.inputs))
        if derivatives.directional:
            directional = DirectionalDerivatives(self.symbols, self.inputs)
            functions = {function.name: function for family in self.families for function in family.functions}
            for name in derivatives.directional:
                progress(f"directional derivative of {name}")
                self.families.append(directional.family(name, functions))
            self.directions = directional.directions
        progress("single assignments")
