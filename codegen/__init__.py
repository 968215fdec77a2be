"""Derives the closed-form planar dynamics of a free-floating multi-arm robot from its layout, with CasADi.

From a layout to its graph, module by module:

    layout                  numbers and content hash of a layout file
    symbols, inputs         CasADi symbols of parameters and inputs
    kinematics, momentum    poses, twists, Jacobians; p and l of eq. (17)
    composite_inertia, equations_of_motion     M, c_b and c_m of eq. (1)
    reduced_dynamics        I, c and J of eq. (2)
    articulated_body, forward_dynamics         accelerations of eq. (1)
    impact                  G and H of eq. (16), solved as eq. (15); J_t of eq. (5), K of eqs. (13), (14)
    functions               all functions of a layout, in families
    casadi_import, value_numbering             expressions to nodes, each value once
    statements, graph, json_text               nodes to single assignments, and to JSON

Equations are those of Raina & Shah (2017). Those that need no derivation are in Rust (planar-dynamics): (6) and (7),
the trajectory; (12), the impulse; (17), the base twist after the impact; (18), the control law.
"""
