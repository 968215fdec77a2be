"""Computes what the rest of a robot sees of one body whose angular acceleration is eliminated, in inertial axes.

The equations are those of `articulated_body.py`, for one child at d from the own joint P and in inertial axes, so that
derivatives by the angle of a body are derivatives of its own vectors alone. With the first moment sigma = m c of the
body, its inertia I_P about the joint, and F' = A' (a + alpha z x d - omega^2 d) + b' the force on the child,

    F = m a + alpha z x sigma - omega^2 sigma + F' = m a + A' a + alpha r - omega^2 p + b',
    n = D alpha + r . a - omega^2 h + (z x d) . b',

    r = z x sigma + A' (z x d),  p = sigma + A' d,  D = I_P + (z x d) . A' (z x d),  h = (z x d) . A' d.
"""

from dataclasses import replace

from .articulated_body import Child, LeafBody, TipBody
from .articulated_inertia import ArticulatedInertia
from .plane_vectors import ZERO, ZERO_VECTOR, Rotation, add, dot, perpendicular, rotate, scale
from .rigid_body_inertia import RigidBodyInertia
from .symbols import Symbols


class EliminatedBody:
    """One body: ``coupling`` r, ``centripetal`` p, ``centripetal_moment`` h, ``pivot`` D, ``inverse`` 1 / D,
    ``response`` r / D and ``inertia``, its articulated inertia m + A' - r r^T / D."""

    def __init__(self, symbols: Symbols, own: RigidBodyInertia, rotation: Rotation, child: Child | None) -> None:
        if child is None:
            rotation = rotate(rotation, own.com)  # as that of a `TipBody`
            self.first_moment = scale(own.mass, rotation)
        else:
            self.first_moment = rotate(rotation, own.first_moment(symbols))
        self.joint_inertia = own.about_joint(symbols)
        self.child = None if child is None else child.inertia
        self.to_child = self.lever = ZERO_VECTOR  # d, z x d
        if child is None or child.at_joint:
            # with constants of its own: forward dynamics may have added a part of the base's mass to those of its body
            alone = replace(own, label=f"{own.label}_alone")
            leaf = TipBody(symbols, alone, ZERO) if child is None else LeafBody(symbols, alone, [], ZERO)
            self.pivot, self.inverse = self.joint_inertia, leaf.inverse
            self.coupling = perpendicular(self.first_moment)
            self.centripetal, self.centripetal_moment = self.first_moment, ZERO
            self.response = scale(self.inverse, self.coupling)
            inertia = leaf.inertia.rotate(rotation)
            self.inertia = inertia if child is None else inertia.plus(child.inertia)
            return
        self.to_child, self.lever = child.position, perpendicular(child.position)
        along, across = child.inertia.times(self.to_child), child.inertia.times(self.lever)
        self.coupling = r = add(perpendicular(self.first_moment), across)
        self.centripetal = add(self.first_moment, along)
        self.centripetal_moment = dot(self.lever, along)
        self.pivot = self.joint_inertia + child.inertia.square(self.lever)
        self.inverse = symbols.reciprocal(self.pivot)
        self.response = scale(self.inverse, r)
        total = ArticulatedInertia(own.mass, ZERO, own.mass).plus(child.inertia)
        # a body outboard of it decides for the whole chain
        inverse = None if child.inertia.remains_of is None else self.inverse
        self.inertia = total.without(r, self.response, inverse)

    @property
    def configuration_values(self) -> list:
        """All that the passes use of the configuration."""
        return [*self.coupling, *self.centripetal, self.centripetal_moment, *self.response, *self.inertia.elements]
