"""Made-up walls and short motions for tests of facades."""

import numpy as np

from rocksteady import Record
from rocksteady.codes import Facade, Load, PushingMass, Tie

BARE = Facade(name="bare", thickness_m=0.4, height_m=3.0, confidence_factor=1.0)
LOADED = Facade(
    name="loaded",
    thickness_m=0.4,
    height_m=3.0,
    loads=(Load(name="floor", weight_kn=8.0, x_m=0.3, z_m=2.9),),
    ties=(Tie(name="rod", force_kn=2.0, z_m=2.8, until_collapse=True),),
    masses=(PushingMass(name="vault", weight_kn=4.0, z_m=2.5),),
)


def motion(seed: int, peak_m_s2: float) -> Record:
    """Return four seconds of a few sines, with a given largest acceleration."""
    draw = np.random.default_rng(seed)
    t = 0.02 * np.arange(200)
    sines = [
        draw.normal() * np.sin(2.0 * np.pi * f * t + draw.uniform(0.0, 6.0))
        for f in (0.5, 0.8, 1.3, 2.1, 3.4)
    ]
    samples = np.sum(sines, axis=0) * np.sin(np.pi * t / 4.0)
    samples *= peak_m_s2 / np.abs(samples).max()
    return Record(acceleration_m_s2=samples, dt_s=0.02, name=f"motion {seed}")


def motions(count: int, peak_m_s2: float) -> list[Record]:
    """Return several, seeds 0 on."""
    return [motion(seed, peak_m_s2) for seed in range(count)]
