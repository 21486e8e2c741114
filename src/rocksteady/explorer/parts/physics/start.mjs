// Initial states as the kernels see them: dynamics/history/start.py and departure.py, step by step.

import { evaluate, sidesOf } from './case.mjs';

/** @import { Kernels, March, Section } from '../kernels/loader.mjs' */
/** @import { Case, Start } from './case.mjs' */

/**
 * A state after an impact, or with speed 0 at an uplift from rest, as `ImpactState`.
 * @typedef {object} Impact
 * @property {number} side
 * @property {number} phase  of the shaking, from 0 to 2 pi [rad]
 * @property {number} speed  |d(theta/alpha)/d(p t)|
 */

/**
 * @typedef {object} Begin
 * @property {number} phase  of the shaking at the start [rad]
 * @property {March} march
 */

export const FULL_TURN = 2 * Math.PI;
const START_KICK = 1e-6; // distance from an unstable orbit at which a block is set off

/** That a start cannot be: why, and what to do. */
export class NoStart extends Error {
  /**
   * @param {string} cause
   * @param {string} fix
   */
  constructor(cause, fix) {
    super(`${cause}; ${fix}`);
    this.cause = cause;
    this.fix = fix;
  }
}

/**
 * Return a number in so many significant digits, as Python's `g` writes it.
 * @param {number} value
 * @param {number} digits
 * @returns {string}
 */
export function generalFormat(value, digits) {
  if (!Number.isFinite(value)) {
    return Number.isNaN(value) ? 'nan' : value > 0 ? 'inf' : '-inf';
  }
  const [mantissa, power] = value.toExponential(digits - 1).split('e');
  const exponent = Number(power);
  const short = (/** @type {string} */ text) => text.replace(/\.?0+$/, '');
  if (exponent < -4 || exponent >= digits) {
    const size = String(Math.abs(exponent)).padStart(2, '0');
    const plain = mantissa.includes('.') ? short(mantissa) : mantissa;
    return `${plain}e${exponent < 0 ? '-' : '+'}${size}`;
  }
  const text = value.toFixed(digits - 1 - exponent);
  return text.includes('.') ? short(text) : text;
}

/**
 * Return a phase from 0 to 2 pi.
 * @param {number} phase
 * @returns {number}
 */
export function turnedPhase(phase) {
  let turned = phase % FULL_TURN;
  if (turned < 0) turned += FULL_TURN;
  return turned > 0 && turned < FULL_TURN ? turned : 0;
}

/**
 * Return a state of the kernels as users see it.
 * @param {Section} here
 * @returns {Impact}
 */
export function impactOf(here) {
  const odd = here.half_cycles % 2 !== 0 ? 1 : 0;
  return { side: here.side, phase: turnedPhase(odd * Math.PI + here.phase), speed: here.speed };
}

/**
 * Return the mirror image of a state: the other side, half a period of the shaking later.
 * @param {Impact} state
 * @returns {Impact}
 */
export function mirroredImpact(state) {
  return { side: -state.side, phase: turnedPhase(state.phase + Math.PI), speed: state.speed };
}

/**
 * Return the phase of the shaking at a start, and the state of the block.
 * @param {Kernels} kernels
 * @param {Case} given
 * @param {Start} start
 * @returns {Begin}
 */
export function beginOf(kernels, given, start) {
  let phase = 0, angle = 0, velocity = 0;
  if (start.kind === 'steady') ({ phase, velocity } = steadyStart(kernels, given));
  else if (start.kind === 'state') ({ angle, velocity } = start);
  else if (start.kind === 'impact') {
    phase = turnedPhase(start.phase);
    velocity = start.side * start.speed;
  }
  const [half, rest] = kernels.clock(phase);
  velocity += 0; // -0 is 0
  const leans = Math.sign(angle || velocity);
  return {
    phase,
    march: {
      side: leans, angle, velocity, segment: 0, half_cycles: half, phase: rest,
      impacts: 0, flights: 0,
    },
  };
}

/**
 * Return phase and velocity on the first symmetric steady state, beside it where it is unstable.
 * @param {Kernels} kernels
 * @param {Case} given
 * @param {number} [branch]
 * @param {Solutions} [solutions]  of order 1, where they are known
 * @returns {{ phase: number, velocity: number }}
 */
export function steadyStart(
  kernels, given, branch = 1, solutions = steadySolutions(kernels, given, 1),
) {
  const { amplitude, frequencyRatio, restitution } = given;
  if (solutions.region === 4) {
    const [a, w, r] = [amplitude, frequencyRatio, restitution].map((x) => generalFormat(x, 6));
    throw new NoStart(
      `at A = ${a}, Omega = ${w}, restitution ${r} there is none of order 1`,
      `raise the amplitude to ${generalFormat(solutions.existence, 6)} or above (eq 23)`,
    );
  }
  const solution = solutions.branches[branch - 1];
  if (!solution.admissible) {
    throw new NoStart(
      'that solution of the algebra passes through the floor and is no motion',
      'take the other branch or another order',
    );
  }
  let { phase, velocity } = solution, turn = 0, rate = 0;
  if (given.nonlinear) {
    const half = nonlinearHalf(kernels, given, branch, phase, velocity);
    // As Python keeps them: the phase in (-pi, pi], the velocity by the phase of the shaking.
    phase = half.state.half_cycles * Math.PI + half.state.phase;
    phase -= 2 * Math.PI * (Number(phase > Math.PI) - Number(phase <= -Math.PI));
    velocity = frequencyRatio * (half.state.speed / frequencyRatio);
    const trace = half.jacobian.phase_by_phase + half.jacobian.speed_by_speed;
    if (!(Math.abs(trace) < 1 + restitution * restitution)) {
      const { phase_by_phase, phase_by_speed, speed_by_phase, speed_by_speed } = half.jacobian;
      const rows = [phase_by_phase, phase_by_speed, speed_by_phase, speed_by_speed];
      [turn, rate] = growingDirection(kernels, rows, velocity, frequencyRatio, branch);
    }
  } else if (!solution.stable && !solution.neutral) {
    const orbit = kernels.symmetric_orbit(amplitude, frequencyRatio, restitution, 1, branch);
    const rows = kernels.half_cycle_jacobian(amplitude, frequencyRatio, restitution, 1, orbit);
    const speed = frequencyRatio * orbit.velocity;
    [turn, rate] = growingDirection(kernels, rows, speed, frequencyRatio, branch);
  }
  return { phase: phase + START_KICK * turn, velocity: velocity + START_KICK * rate };
}

/**
 * @param {Kernels} kernels
 * @param {Case} given
 * @param {number} branch
 * @param {number} phase  in the linear model
 * @param {number} velocity
 */
function nonlinearHalf(kernels, given, branch, phase, velocity) {
  const [half_cycles, turn] = kernels.clock(phase);
  const begin = { side: 1, half_cycles, phase: turn, speed: velocity };
  const sides = sidesOf(kernels, given);
  const { amplitude, frequencyRatio } = given;
  const half = kernels.symmetric_from(amplitude, frequencyRatio, sides, 1, branch, begin);
  sides.free();
  if (!half.found) {
    throw new NoStart(
      "the linear model's steady state leads to none of the nonlinear model at "
        + `alpha = ${generalFormat(given.alpha, 6)}`,
      'take the other branch, another amplitude, or a State to start from',
    );
  }
  return half;
}

/**
 * Return the unit eigenvector of a half cycle's larger multiplier, velocity part positive.
 * @param {Kernels} kernels
 * @param {number[]} rows  of the derivative by (phase, velocity)
 * @param {number} velocity  of the orbit
 * @param {number} frequencyRatio
 * @param {number} branch
 * @returns {[number, number]}
 */
function growingDirection(kernels, rows, velocity, frequencyRatio, branch) {
  const entries = [rows[0], rows[1] * velocity, rows[2] / velocity, rows[3]];
  const largest = Math.max(...entries.map(Math.abs));
  if (!(largest > 0 && largest < Infinity)) {
    throw new NoStart(
      `branch ${branch}: at Omega = ${generalFormat(frequencyRatio, 6)} its half cycle is so long `
        + 'that no number determines how it is left',
      'take a State to start from',
    );
  }
  const [a, b, c, d] = entries.map((entry) => entry / largest);
  const half = 0.5 * (a + d), apart = 0.5 * (a - d);
  const root = Math.sqrt(Math.max(apart * apart + b * c, 0));
  const multiplier = half + (half < 0 || Object.is(half, -0) ? -root : root);
  const length = (/** @type {number} */ x, /** @type {number} */ y) =>
    evaluate(kernels, 'hypot', x, y);
  const longer = length(a - multiplier, b) > length(c, d - multiplier);
  const [x, y] = longer ? [-b, a - multiplier] : [multiplier - d, c];
  const size = (y < 0 || Object.is(y, -0) ? -1 : 1) * length(x, y);
  return [x / size, (y / size) * velocity];
}

/**
 * One symmetric steady state in closed form.
 * @typedef {object} Solution
 * @property {number} phase  of the shaking at the impact that begins a positive half cycle [rad]
 * @property {number} velocity  du/d(pt) just after that impact
 * @property {number} trace  of the half-cycle map
 * @property {number} peak  largest theta/alpha
 * @property {boolean} admissible  whether it stays above the floor
 * @property {boolean} stable
 * @property {boolean} neutral
 */

/**
 * @typedef {object} Solutions
 * @property {number} region  1 to 5; no solution in 4
 * @property {number} existence  amplitude below which there is none (eq 23)
 * @property {number} sign  amplitude above which the phase of branch 2 is negative (eq 24)
 * @property {number} kind  amplitude above which branch 1 is out of phase (eq 25)
 * @property {Solution[]} branches  two, of nan where there is none
 */

/**
 * Solutions at many points, as `fill_steady` has them; those of branch 2 after all of branch 1.
 * @typedef {object} SteadyTable
 * @property {number} count
 * @property {BigInt64Array} region
 * @property {Float64Array} boundaries
 * @property {Float64Array} phase
 * @property {Float64Array} velocity
 * @property {Float64Array} trace
 * @property {Float64Array} peak
 * @property {Uint8Array} admissible
 */

/**
 * Return the symmetric steady states of the linear model at many points.
 * @param {Kernels} kernels
 * @param {ArrayLike<number>} amplitudes
 * @param {ArrayLike<number>} ratios
 * @param {number} restitution
 * @param {number} order  1, 3, 5, ...: half periods of the shaking in a half cycle
 * @returns {SteadyTable}
 */
export function steadyTable(kernels, amplitudes, ratios, restitution, order) {
  const count = ratios.length, restitutions = new Float64Array(count).fill(restitution);
  const given = [amplitudes, ratios, restitutions]
    .map((values) => kernels.array('f', [count], values));
  const orders = kernels.array('i', [count], new BigInt64Array(count).fill(BigInt(order)));
  const region = kernels.array('i', [count]), extrema = kernels.array('i', [2, count]);
  const boundaries = kernels.array('f', [3, count]), admissible = kernels.array('b', [2, count]);
  const filled = Array.from({ length: 4 }, () => kernels.array('f', [2, count]));
  const [a, w, r] = given, [phase, velocity, trace, peak] = filled;
  kernels.fill_steady(
    { amplitude: a, frequency_ratio: w, restitution: r, order: orders }, true,
    { region, boundaries, phase, velocity, trace, peak, extrema, admissible },
  );
  const found = {
    count,
    region: region.values.slice(),
    boundaries: boundaries.values.slice(),
    phase: phase.values.slice(),
    velocity: velocity.values.slice(),
    trace: trace.values.slice(),
    peak: peak.values.slice(),
    admissible: admissible.values.slice(),
  };
  const made = [...given, orders, region, boundaries, extrema, ...filled, admissible];
  for (const array of made) array.free();
  return found;
}

/**
 * Return both steady states at one point of a table, as `steady_states` has them.
 * @param {SteadyTable} table
 * @param {number} place
 * @param {Case} given  at that point
 * @returns {Solutions}
 */
export function solutionsIn(table, place, { frequencyRatio, restitution }) {
  const { count, region, boundaries, phase, velocity, trace, peak, admissible } = table;
  const branches = [place, count + place].map((at) => {
    const allowed = admissible[at] !== 0, size = Math.abs(trace[at]);
    return {
      phase: phase[at],
      velocity: frequencyRatio * velocity[at],
      trace: trace[at],
      peak: peak[at],
      admissible: allowed,
      stable: allowed && size < 1 + restitution * restitution && restitution < 1,
      neutral: allowed && size < 2 && restitution === 1,
    };
  });
  const [existence, sign, kind] = [0, 1, 2].map((row) => boundaries[row * count + place]);
  return { region: Number(region[place]), existence, sign, kind, branches };
}

/**
 * Return both symmetric steady states of the linear model, as `steady_states` has them.
 * @param {Kernels} kernels
 * @param {Case} given
 * @param {number} order  1, 3, 5, ...: half periods of the shaking in a half cycle
 * @returns {Solutions}
 */
export function steadySolutions(kernels, given, order) {
  const { amplitude, frequencyRatio, restitution } = given;
  const table = steadyTable(kernels, [amplitude], [frequencyRatio], restitution, order);
  return solutionsIn(table, 0, given);
}
