"""Derives the closed-form planar dynamics of a free-floating multi-arm robot from its layout, with CasADi.

From a layout to its graph, module by module:

    layout                                   numbers and content hash of a layout file
    symbols, inputs                          CasADi symbols of parameters and inputs
    kinematics                               poses, twists and Jacobians: J_be and J_me of eq. (1)
    composite_inertia, equations_of_motion   M, c_b and c_m of eq. (1)
    reduced_dynamics                         I, c and J of eq. (2)
    articulated_*, forward_dynamics          accelerations of eq. (1)
    momentum                                 p and l of eq. (17)
    impact                                   the impact from eqs. (10), (11), (13) and (14): G and H of eqs. (15), (16)
    signatures, functions                    all functions of a layout, in families
    casadi_import, value_numbering           expressions to nodes, each value once
    statements, graph, json_text, derive     nodes to single assignments, to a graph and to a file

Equations are those of Raina & Shah (2017). Those that need no derivation are in Rust (planar-dynamics): (6) and (7),
the trajectory; (12), the impulse; (17), the base twist after the impact; (18), the control law.
"""
