"""MuJoCo: a real rectangular block on a plane, held in its plane by three joints.

A physics engine takes no restitution of the angular velocity: what an impact leaves comes out of
its contacts. With contacts that do not rebound (critical damping) a rectangle should keep Housner's
share, 1 - 1.5 sin^2(alpha) of its angular velocity: 0.8 belongs to alpha = 0.374, and no slender
block can have it. So MuJoCo runs the rectangle of that alpha, and what decides whether a class is
right is the nonlinear equation of motion with the restitution 0.8. The restitution that it has in
free rocking is measured. The base stands still and the block feels the inertia force at its centre.
"""

import math
import time
from functools import partial
from importlib.metadata import version
from itertools import pairwise
from typing import Any

import numpy as np

from bench.peers import runge_kutta
from bench.peers.work import (
    CYCLES,
    OVERTURNED,
    RESTITUTION,
    ROCKING,
    START_VELOCITY,
    TURN,
    Cells,
    Outcome,
    Peer,
)

GRAVITY = 9.81
ALPHA = math.asin(math.sqrt((1.0 - RESTITUTION) / 1.5))
RADIUS = 0.75 * GRAVITY  # half-diagonal: p = sqrt(3 g / (4 R)) is 1 rad/s
STEPS = 500  # a forcing period
SOFTNESS = 2.0  # time constant of a contact in steps, the least that MuJoCo allows
LYING = 1.5  # rotation [rad] of a block that has fallen
TRUTH_STEPS = 2000
FREE_STEP = 1e-3  # s
FREE_TIME = 12.0  # s

MODEL = """
<mujoco>
  <option timestep="{step}" gravity="0 0 -{gravity}" cone="elliptic" impratio="10"
    tolerance="1e-12" iterations="50"/>
  <default>
    <geom condim="3" friction="10 0 0" solref="{softness} 1" solimp="0.99 0.9999 0.0001"/>
  </default>
  <worldbody>
    <geom type="plane" size="0 0 1"/>
    <body pos="0 0 {height}">
      <joint name="x" type="slide" axis="1 0 0"/>
      <joint name="z" type="slide" axis="0 0 1"/>
      <joint name="rotation" type="hinge" axis="0 1 0"/>
      <geom type="box" size="{width} {depth} {height}" mass="1"/>
    </body>
  </worldbody>
  <actuator><motor joint="x"/></actuator>
</mujoco>
"""


def peers() -> list[Peer]:
    """Return the block on the plane."""
    kept = free_restitution()
    return [
        Peer(
            name="MuJoCo",
            version=version("mujoco"),
            settings=f"rectangle of alpha {ALPHA:.3f}, {STEPS} steps a period, plastic contacts: "
            f"restitution {min(kept):.3f} to {max(kept):.3f} measured",
            thinned=12,
            run=run,
            truth=partial(runge_kutta.run, steps=TRUTH_STEPS, alpha=ALPHA),
        )
    ]


def block(step: float) -> Any:
    """Return the model with a time step [s]."""
    import mujoco

    width, height = RADIUS * math.sin(ALPHA), RADIUS * math.cos(ALPHA)
    return mujoco.MjModel.from_xml_string(
        MODEL.format(
            step=float(step),
            gravity=GRAVITY,
            softness=float(SOFTNESS * step),
            width=width,
            depth=0.2 * width,
            height=height,
        )
    )


def free_restitution() -> list[float]:
    """Release the block at half its critical angle and return the share of each of five impacts."""
    import mujoco

    model = block(FREE_STEP)
    data = mujoco.MjData(model)
    width, height = RADIUS * math.sin(ALPHA), RADIUS * math.cos(ALPHA)
    angle = 0.5 * ALPHA
    sine, cosine = math.sin(angle), math.cos(angle)
    data.qpos[:] = (
        width - width * cosine + height * sine,
        width * sine + height * cosine - height,
        angle,
    )
    angles = []
    for _ in range(round(FREE_TIME / FREE_STEP)):
        mujoco.mj_step(model, data)
        angles.append(float(data.qpos[2]))
    path = np.array(angles)
    swings = np.split(np.abs(path), np.flatnonzero(np.diff(np.sign(path))) + 1)[:6]
    heights = [math.cos(ALPHA - swing.max()) - math.cos(ALPHA) for swing in swings]
    return [math.sqrt(b / a) for a, b in pairwise(heights)]


def run(cells: Cells) -> Outcome:
    """Roll the block out, period by period until it has fallen."""
    count = len(cells.amplitude)
    status, impacts = np.zeros(count, np.int64), np.zeros(count, np.int64)
    periods = 0
    began = time.process_time()
    for i in range(count):
        status[i], impacts[i], lasted = fate(cells.amplitude[i], cells.frequency_ratio[i])
        periods += lasted
    seconds = time.process_time() - began
    return Outcome(
        status=status,
        impacts=impacts,
        last_phase=None,
        seconds=seconds,
        remark=f"MuJoCo takes {1e6 * seconds / periods:.0f} µs a simulated period.",
    )


def fate(amplitude: float, frequency: float) -> tuple[int, int, int]:
    """Return status, changes of side and simulated periods of one cell."""
    import mujoco
    from mujoco import rollout

    model = block(TURN / (frequency * STEPS))
    data = mujoco.MjData(model)
    velocity = START_VELOCITY * ALPHA
    # Its centre moves about the corner at its right.
    data.qvel[:] = (
        velocity * RADIUS * math.cos(ALPHA),
        velocity * RADIUS * math.sin(ALPHA),
        velocity,
    )
    middles = TURN * (np.arange(STEPS) + 0.5) / STEPS
    force = (amplitude * ALPHA * GRAVITY * np.sin(middles))[None, :, None]
    kind = mujoco.mjtState.mjSTATE_FULLPHYSICS
    state = np.empty(mujoco.mj_stateSize(model, kind))
    mujoco.mj_getState(model, data, state, kind)
    states = np.empty((1, STEPS, len(state)))
    rotation = 3  # its place in a state: time, x, z, rotation, velocities
    side, impacts = 1.0, 0
    for period in range(CYCLES):
        rollout.rollout(model, data, state[None], force, state=states)
        state = states[0, -1].copy()
        path = states[0, :, rotation]
        signs = np.sign(np.concatenate(([side], path)))
        impacts += int(np.count_nonzero(np.diff(signs)))
        side = signs[-1]
        if np.abs(path).max() > LYING:
            return OVERTURNED, impacts, period + 1
    return ROCKING, impacts, CYCLES
