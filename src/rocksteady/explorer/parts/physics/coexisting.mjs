// What the block can do at a point from other starts: a list of motions, without shares.

import { attractorKind, startAt } from './attractor.mjs';
import { settledRows } from './settled.mjs';
import { FULL_TURN, NoStart, mirroredImpact, steadyStart } from './start.mjs';

/** @import { Kernels } from '../kernels/loader.mjs' */
/** @import { Case, Start } from './case.mjs' */
/** @import { Kind } from './attractor.mjs' */
/** @import { SettledRow } from './settled.mjs' */
/** @import { Impact } from './start.mjs' */

/**
 * What one start leads to.
 * @typedef {object} Ending
 * @property {Kind} kind
 * @property {number} period  forcing periods; 0 without an orbit
 * @property {number} passages  impacts and uplifts in it
 * @property {number} rests
 * @property {number} highest  theta/alpha; nan without an orbit
 * @property {number} lowest
 * @property {Impact|null} state  on the orbit
 * @property {Start|null} start  the start itself, where there is a name for it
 * @property {number} from  number of the start
 * @property {boolean} mirrored  whether it is the mirror image of what that start leads to
 * @property {number} after  forcing periods until it was known
 */

/**
 * A motion that coexists with others, from the first start that leads to it.
 * @typedef {Ending & { twin: number }} Coexisting
 * `twin` is the place of its mirror image in the list, or -1.
 */

const IMPACT_PHASES = 12;
// No round numbers: from some of those a block balances upright at round A and Omega.
const IMPACT_SPEEDS = [0.047, 0.193, 0.457, 0.811];
const TILTS = [0.31, 0.59, 0.87];
const TILT_PHASES = 4;
const SAME_PEAK = 1e-6; // relative difference of the peaks of one motion
const COEXISTING_CYCLES = 600;
const LOSSLESS_CYCLES = 6; // motions without loss do not settle however long they are followed

/**
 * Return the states from which the motions at a point are looked for, rest first: states after an
 * impact at evenly spaced phases and speeds that do not overturn a free block, the two symmetric
 * steady states, and tilted blocks.  Mirror images need no computation.
 * @param {Kernels} kernels
 * @param {Case} given
 * @returns {{ angle: number, velocity: number, phase: number }[]}
 */
export function fixedStarts(kernels, given) {
  const starts = [{ angle: 0, velocity: 0, phase: 0 }];
  for (const branch of [1, 2]) {
    try {
      starts.push({ angle: 0, ...steadyStart(kernels, given, branch) });
    } catch (error) {
      if (!(error instanceof NoStart)) throw error;
    }
  }
  for (const velocity of IMPACT_SPEEDS) {
    for (let k = 0; k < IMPACT_PHASES; k++) {
      starts.push({ angle: 0, velocity, phase: (k * FULL_TURN) / IMPACT_PHASES });
    }
  }
  for (const angle of TILTS) {
    for (let k = 0; k < TILT_PHASES; k++) {
      starts.push({ angle, velocity: 0, phase: ((k + 0.5) * FULL_TURN) / TILT_PHASES });
    }
  }
  return starts;
}

/**
 * Return a fixed start for `attractorOf`: with the phase of the shaking that it has.
 * @param {{ angle: number, velocity: number, phase: number }} state
 * @returns {Start|null}  null of a tilted block at another phase than 0
 */
export function startOfFixed({ angle, velocity, phase }) {
  if (angle !== 0) return phase === 0 ? { kind: 'state', angle, velocity } : null;
  if (velocity === 0) return { kind: 'rest' };
  return { kind: 'impact', side: velocity < 0 ? -1 : 1, phase, speed: Math.abs(velocity) };
}

/**
 * Return what some of the fixed starts lead to.
 * @param {Kernels} kernels
 * @param {{ given: Case, from?: number, to?: number, cycles?: number }} asked
 * @returns {{ endings: Ending[], starts: number }}  with the number of all starts
 */
export function endingsOf(kernels, { given, from = 0, to = Infinity, cycles }) {
  const all = fixedStarts(kernels, given), some = all.slice(from, to);
  const most = cycles ?? (given.restitution < 1 ? COEXISTING_CYCLES : LOSSLESS_CYCLES);
  const rows = settledRows(kernels, given, {
    amplitude: some.map(() => given.amplitude), ratio: some.map(() => given.frequencyRatio),
    angle: some.map((start) => start.angle), velocity: some.map((start) => start.velocity + 0),
    phase: some.map((start) => start.phase),
  }, most);
  const endings = rows.map((row, k) => ({
    ...endingAt(row, from + k, given), start: startOfFixed(some[k]),
  }));
  return { endings, starts: all.length };
}

/**
 * @param {SettledRow} row
 * @param {number} from
 * @param {Case} given
 * @returns {Omit<Ending, 'start'>}
 */
function endingAt({ whole, real }, from, given) {
  const [outcome, side, passages, period, rests, symmetric, after] = Array.from(whole, Number);
  const [phase, speed, highest, lowest, , least] = real;
  const kind = attractorKind(outcome, symmetric === 1, least, given.restitution);
  const still = kind === 'rest';
  return {
    kind,
    period,
    passages,
    rests,
    highest: still ? 0 : highest,
    lowest: still ? 0 : lowest,
    state: period > 0 ? { side, phase, speed } : null,
    from,
    mirrored: false,
    after,
  };
}

/**
 * Return whether two endings are one motion.
 * @param {Ending} one
 * @param {Ending} other
 */
export function sameEnding(one, other) {
  const close = (/** @type {number} */ x, /** @type {number} */ y) =>
    x === y || (Number.isNaN(x) && Number.isNaN(y))
    || Math.abs(x - y) <= SAME_PEAK * Math.max(Math.abs(x), Math.abs(y), 1e-3);
  return one.kind === other.kind && one.period === other.period
    && (one.rests > 0) === (other.rests > 0) && (one.rests > 0 || one.passages === other.passages)
    && close(one.highest, other.highest) && close(one.lowest, other.lowest);
}

/**
 * Return the distinct motions of endings and of their mirror images, the rest first, then orbits
 * by period.
 * @param {Ending[]} endings
 * @returns {Coexisting[]}
 */
export function coexistingOf(endings) {
  /** @type {Coexisting[]} */
  const motions = [];
  for (const ending of endings.flatMap((one) => [one, mirrorEnding(one)])) {
    if (!motions.some((motion) => sameEnding(motion, ending))) motions.push({ ...ending, twin: -1 });
  }
  const places = ['rest', 'symmetric', 'unsymmetric', 'aperiodic', 'undecided', 'overturned'];
  motions.sort((one, other) => places.indexOf(one.kind) - places.indexOf(other.kind)
    || one.period - other.period || one.from - other.from);
  motions.forEach((motion) => {
    if (motion.kind !== 'unsymmetric') return;
    const image = mirrorEnding(motion);
    motion.twin = motions.findIndex((other) => other !== motion && sameEnding(other, image));
  });
  return motions;
}

/**
 * Return the mirror image of an ending.
 * @param {Ending} ending
 * @returns {Ending}
 */
function mirrorEnding(ending) {
  const { kind, highest, lowest, state } = ending;
  if (kind !== 'unsymmetric') return ending;
  return {
    ...ending,
    highest: -lowest,
    lowest: -highest,
    state: state && mirroredImpact(state),
    start: null,
    mirrored: !ending.mirrored,
  };
}

/**
 * Return a start on a coexisting motion, or where there is no orbit the start that leads to it.
 * @param {Coexisting} motion
 * @returns {Start|null}
 */
export function startOn(motion) {
  return motion.kind === 'rest' ? { kind: 'rest' } : startAt(motion.state) ?? motion.start;
}
