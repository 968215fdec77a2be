"""Computes the outputs of all functions of a layout, by families, from the symbols of its parameters and inputs.

The functions of a family share what depends on the configuration (base pose and joint angles) alone, and add
velocities and forces.
"""

from collections.abc import Callable

from .equations_of_motion import EquationsOfMotion, equations_of_motion_family
from .forward_dynamics import ForwardDynamics, forward_dynamics_family
from .impact import impact_family
from .inputs import Inputs
from .kinematics import Kinematics, bodies_family, end_effectors_family
from .layout import Layout
from .momentum import momentum_family
from .reduced_dynamics import ReducedDynamics, reduced_dynamics_family
from .symbols import Symbols


class Functions:
    """The families of one layout; `progress` is called with the name of each before it is derived."""

    def __init__(self, layout: Layout, progress: Callable[[str], None] = lambda family: None) -> None:
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
        progress("single assignments")
