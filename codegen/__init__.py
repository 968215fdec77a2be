"""Derives the closed-form planar dynamics of a free-floating multi-arm robot with CasADi."""
