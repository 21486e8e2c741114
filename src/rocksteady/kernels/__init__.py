"""Compiled scalar functions: flight, first zero, impact, rest, overturning, march.

Everything here is dimensionless and works in the *side frame* of ``docs/theory/march.md``: the
angle ``y = |theta|/alpha`` seen from the pivot on which the block stands, the pivot time
``s = p t`` and the base acceleration in units of ``alpha g``.  From the rest of the package these
modules import integer status codes only.
"""
