// The attractor of a motion under harmonic shaking: dynamics/orbits/attractor.py and orbit.py.

import { evaluate, systemOf } from './case.mjs';
import { beginOf, generalFormat, impactOf } from './start.mjs';

/** @import { Floats, Kernels, Settled, System } from '../kernels/loader.mjs' */
/** @import { Case, Start } from './case.mjs' */
/** @import { Impact } from './start.mjs' */

/** @typedef {'symmetric'|'unsymmetric'|'rest'|'overturned'|'aperiodic'|'undecided'} Kind */

/**
 * A stable periodic motion.
 * @typedef {object} Orbit
 * @property {number} period  in forcing periods
 * @property {Impact[]} states  after each impact and at each uplift from rest
 * @property {Float64Array} table  one row of `ORBIT_COLUMNS` a state (kernels/orbits/periodic.py)
 * @property {number} rests  times it comes to rest within a period of its own
 * @property {boolean} symmetric
 * @property {number} highest  theta/alpha
 * @property {number} lowest
 * @property {[number, number][]} multipliers  real and imaginary part, the larger first
 * @property {number} largest  modulus of the larger
 * @property {number} residual
 */

/**
 * What a motion settles to.
 * @typedef {object} Attractor
 * @property {Kind} kind
 * @property {Orbit|null} orbit
 * @property {number|null} period  forcing periods of the orbit
 * @property {number|null} highest  theta/alpha; 0 at rest, null without an orbit
 * @property {number|null} lowest
 * @property {number|null} impacts  in a period; null for infinitely many, or without an orbit
 * @property {number} lyapunov  largest exponent per forcing period
 * @property {number} after  forcing periods until it was known
 * @property {number} growth  of a small difference on the way
 * @property {string} reason  why it is undecided
 * @property {Impact|null} state  the last state after an impact
 * @property {Start|null} start  a start on the attractor
 * @property {number} phase  of the shaking at the start [rad]
 */

export const ATTRACTOR_KINDS = /** @type {Kind[]} */ ([
  'symmetric', 'unsymmetric', 'rest', 'overturned', 'aperiodic', 'undecided',
]);
export const ORBIT_COLUMNS = 14;
const SETTLED_PERIODIC = 0;
const SETTLED_STAYS = 1;
const SETTLED_FALLS = 2;
const MEMORY_ROWS = 256;
const LONGEST_ORBIT = 2 ** 17;
const CHAOTIC_EXPONENT = 0.01; // Lyapunov exponent per forcing period of an aperiodic motion
const ORBIT_PEAK = 12;
const ORBIT_OTHER_PEAK = 13;

/** Room that `settle` works in, made once. @type {WeakMap<Kernels, [Floats, Floats]>} */
const settlingRooms = new WeakMap();

/**
 * Return room for the last states, and for an orbit.
 * @param {Kernels} kernels
 * @returns {[Floats, Floats]}
 */
function settlingRoom(kernels) {
  let room = settlingRooms.get(kernels);
  if (!room) {
    const shapes = [[MEMORY_ROWS, ORBIT_COLUMNS], [LONGEST_ORBIT, ORBIT_COLUMNS]];
    const [memory, table] = shapes.map((shape) => kernels.array('f', shape));
    room = [memory, table];
    settlingRooms.set(kernels, room);
  }
  return room;
}

/**
 * Return the kind of an attractor from what a kernel says of it, as `kind_codes`.
 * @param {number} outcome
 * @param {boolean} symmetric
 * @param {number} least  the smaller Lyapunov exponent of the two last quarters
 * @param {number} restitution
 * @returns {Kind}
 */
export function attractorKind(outcome, symmetric, least, restitution) {
  if (outcome === SETTLED_PERIODIC) return symmetric ? 'symmetric' : 'unsymmetric';
  if (outcome === SETTLED_STAYS) return 'rest';
  if (outcome === SETTLED_FALLS) return 'overturned';
  return restitution < 1 && least > CHAOTIC_EXPONENT ? 'aperiodic' : 'undecided';
}

/**
 * Follow a motion until its attractor is known, as `rocksteady.find_attractor`.
 * @param {Kernels} kernels
 * @param {Case} given
 * @param {Start} start
 * @param {number} [cycles]  forcing periods after which it counts as aperiodic or undecided
 * @returns {Attractor}
 */
export function attractorOf(kernels, given, start, cycles = 2000) {
  const { phase, march } = beginOf(kernels, given, start);
  const [memory, table] = settlingRoom(kernels);
  const system = systemOf(kernels, given);
  const found = kernels.settle(system, march, cycles, memory, table);
  const repeats = found.outcome === SETTLED_PERIODIC;
  const orbit = repeats ? orbitFrom(kernels, system, found, table) : null;
  const kind = attractorKind(
    found.outcome, orbit !== null && orbit.symmetric, found.least, given.restitution,
  );
  const still = kind === 'rest' ? 0 : null;
  const state = found.state.side !== 0 ? impactOf(found.state) : null;
  return {
    kind,
    orbit,
    period: orbit && orbit.period,
    highest: orbit ? orbit.highest : still,
    lowest: orbit ? orbit.lowest : still,
    impacts: orbit && !orbit.rests ? orbit.states.length : null,
    lyapunov: found.lyapunov,
    after: found.after,
    growth: growthOf(kernels, found),
    reason: kind === 'undecided' ? reasonOf(kernels, found, given) : '',
    state,
    start: kind === 'rest' ? { kind: 'rest' } : startAt(orbit ? orbit.states[0] : state),
    phase,
  };
}

/**
 * Return a state after an impact as a start.
 * @param {Impact|null} state
 * @returns {Start|null}
 */
export function startAt(state) {
  return state && { kind: 'impact', ...state };
}

/**
 * Return the orbit of a table that `settle` or `polish` has filled.
 * @param {Kernels} kernels
 * @param {System} system
 * @param {{ passages: number, periods: number, residual: number }} found
 * @param {Floats} table
 * @returns {Orbit}
 */
export function orbitFrom(kernels, system, found, table) {
  const { passages, periods, residual } = found;
  const fixed = kernels.measured(system, passages, periods, table);
  kernels.fill_peaks(system, passages, table);
  const rows = table.values.slice(0, passages * ORBIT_COLUMNS), states = [];
  let highest = -Infinity, lowest = -Infinity;
  for (let at = 0; at < rows.length; at += ORBIT_COLUMNS) {
    const [side, half_cycles, phase, speed] = rows.subarray(at, at + 4);
    states.push(impactOf({ side, half_cycles, phase, speed }));
    const here = rows[at + ORBIT_PEAK], there = rows[at + ORBIT_OTHER_PEAK];
    highest = Math.max(highest, side > 0 ? here : there);
    lowest = Math.max(lowest, side > 0 ? there : here);
  }
  const determinant = kernels.loss(system, states[0].side, passages, fixed.rests);
  const multipliers = orderedPair(...kernels.multipliers(fixed.jacobian, determinant));
  return {
    period: periods,
    states,
    table: rows,
    rests: fixed.rests,
    symmetric: Boolean(kernels.is_symmetric(system, table, passages, periods)),
    highest,
    lowest: 0 - lowest,
    multipliers,
    largest: evaluate(kernels, 'hypot', ...multipliers[0]),
    residual,
  };
}

/**
 * Return two multipliers, the larger first, of a conjugate pair the one above the real axis.
 * @param {[number, number]} first
 * @param {[number, number]} second
 * @returns {[number, number][]}
 */
function orderedPair(first, second) {
  if (first[1] !== 0) {
    const [real, up] = [first[0], Math.abs(first[1])];
    return [[real, up], [real, -up]];
  }
  const swapped = Math.abs(second[0]) > Math.abs(first[0]);
  const pair = swapped ? [second[0], first[0]] : [first[0], second[0]];
  return pair.map((real) => [real, 0]);
}

/**
 * @param {Kernels} kernels
 * @param {Settled} found
 */
function growthOf(kernels, found) {
  return evaluate(kernels, 'exp', Math.min(found.growth, 700));
}

/**
 * Return why a motion is undecided, and what to do.
 * @param {Kernels} kernels
 * @param {Settled} found
 * @param {Case} given
 * @returns {string}
 */
function reasonOf(kernels, found, given) {
  const { passages, periods, after } = found;
  if (given.restitution === 1) return 'without loss (restitution 1) motions do not settle';
  if (after === 0) return 'the block balances upright, and nothing brings it down';
  if (passages > 0 && passages <= LONGEST_ORBIT) {
    return `it rests again and again, the last time after ${passages} impacts in ${periods} `
      + 'forcing periods, on which a small difference may grow '
      + `${generalFormat(growthOf(kernels, found), 1)}-fold: rounding decides how it goes on`;
  }
  if (passages > 0) {
    return `from one rest to the same again it has ${passages} impacts in ${periods} forcing `
      + `periods, more than an orbit may have, ${LONGEST_ORBIT}: it repeats itself, and no more `
      + 'cycles help';
  }
  const start = `no repetition within ${after} forcing periods`;
  if (Number.isNaN(found.lyapunov)) {
    return `${start}, too few, or with rests too near the end, for a Lyapunov exponent: follow `
      + 'more cycles';
  }
  return `${start}, and a Lyapunov exponent of ${generalFormat(found.lyapunov, 2)} a period, too `
    + 'small or too unsteady for chaos: follow more cycles';
}
