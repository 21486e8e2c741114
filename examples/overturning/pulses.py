"""
Which pulses are there?
=======================

The base acceleration of every named pulse, at one amplitude and one frequency, and of motions made
of others: a sum of two pulses, blows that change the velocity at once, and noise that swells and
dies away. Dashed lines are what lifts a block from rest. See :doc:`/guides/pulses`.
"""

import matplotlib.pyplot as plt

import rocksteady as rs

names = ["rectangle", "half-sine", "versed-sine", "triangle", "decaying-ramp", "one-sine"]
names += ["one-cosine", "type-c1", "type-c2", "type-c3", "ricker", "ricker-antisymmetric"]
names += ["mavroeidis-papageorgiou"]
like = {"amplitude": 1.5, "frequency_ratio": 4.0}
motions = {name: rs.Pulse(shape=name, tolerance=1e-4, **like) for name in names}
later = rs.motions.delay(rs.Pulse(shape="one-sine", amplitude=0.5, frequency_ratio=12.0), 0.6)
motions["one-sine and a faster one"] = rs.motions.add(motions["one-sine"], later, tolerance=1e-4)
motions["impulses"] = rs.motions.Impulses(velocities=(0.5, -0.8, 0.3), times=(0.0, 0.8, 1.6))
motions["synthetic"] = rs.SyntheticMotion(rms=0.6, frequency_ratio=8.0, duration=4.0, seed=2)
block = rs.DimensionlessBlock(restitution=0.9)
fig, axes = plt.subplots(4, 4, figsize=(7.36, 6.6), layout="constrained")
for ax, (name, motion) in zip(axes.flat, motions.items(), strict=True):
    rs.plots.base(rs.simulate(block, motion), ax, legend="none").set_title(name, fontsize=7.5)
    ax.set(xlabel="", ylabel="", xlim=(-0.3, 5.5))
fig.supxlabel("pivot time  pt", fontsize=9)
fig.supylabel("base acceleration  a/(αg)", fontsize=9)
