"""Compiled scalar functions: flight, first zero, impact, rest, overturning, march.

Everything here is dimensionless and works in the *side frame* of ``docs/theory/march.md``: the
angle ``y = |theta|/alpha`` seen from the pivot on which the block stands, the pivot time
``s = p t`` and the base acceleration in units of ``alpha g``.  From the rest of the package these
modules import integer status codes only.

==================  ==============================================================================
`compilation`       the one decorator, and the cache folder that is keyed on these sources
`circular`          sine and cosine of a phase together
`forcing`           base acceleration of one segment seen from one side; where it changes sign
`flight`            the closed-form motion between impacts (eqs 7, 8, 14, 15)
`zeros`             the first zero of a flight, which cannot be missed; the proof of no return
`extrema`           peaks and level crossings, by the same isolation argument
`saltation`         exact derivatives of a flight through its impact
`tables`            columns of segments, sides and recorded flights, and the state between two
`clock`             time on a segment: whole half cycles and the phase within one
`rest`              uplift from rest, and the bound that ends chatter
`samples`           runs of samples at a few products each
`march`             flights strung together by impacts, uplifts and segment ends
`nonlinear`         flights, proofs and derivatives of the full equations
`history`           what a recorded march tells
`symmetric`         Tso and Wong's closed forms for one symmetric steady state (eqs 12 to 25)
`arcs`              flights between two impacts whose phases are known
`chains`            periodic orbits as closed chains of arcs: what continuation solves
`section`           the return map of harmonic shaking, from impact to impact
`periodic`          its periodic orbits, by Newton's method
`attractors`        what a motion settles to
`lanes`             harmonic sweeps of symmetric blocks, trajectories side by side in vectors
`cells`, `settling` plain loops of `march` and of `settle` over many cases
==================  ==============================================================================
"""
