// What the panels of the tab Earthquake share: the motions, the block on the chosen one, its fates.

/** @import { App, Panel } from '../../shell/app.mjs' */
/** @import { State } from '../../shell/state.mjs' */
/** @import { GroundMotion } from '../../physics/motions.mjs' */
/** @import { RecordBlock } from '../../physics/quake/record.mjs' */
import { GRAVITY } from '../../physics/case.mjs';
import { peakOf, refusedMotion } from '../../physics/quake/record.mjs';
import { syntheticMotion } from '../../physics/quake/synthetic.mjs';
import { blockNumbers, equationsOf } from '../../shell/state.mjs';

/** @typedef {GroundMotion & { name: string, note: string }} NamedMotion */

/**
 * A block on a motion at a scale.
 * @typedef {object} Shaken
 * @property {NamedMotion} motion  at scale 1
 * @property {number} scale
 * @property {RecordBlock} block
 * @property {number} degrees  alpha in degrees
 * @property {number} pga  [g] at this scale
 * @property {string} refused  why there is no response, or nothing
 */

export const NOT_COMPUTED = 255;
const FALLEN = 2; // code of an overturned block
const CHUNK_SAMPLES = 120_000; // of all runs of one job
const COARSE_TO_FINE = [8, 4, 2, 1];

/** @type {NamedMotion | undefined} */
let syntheticOnce;
/** @type {{ state: State, count: number, found: Shaken } | undefined} */
let lastShaken; // panels ask for it many times in a frame
/** @type {WeakMap<Float64Array, number>} */
const peaksOfMotions = new WeakMap();

/**
 * Return the motions that can be chosen: those put in, those opened, and the synthetic one.
 * @param {App} app
 * @returns {NamedMotion[]}
 */
export function motionChoices(app) {
  syntheticOnce ??= syntheticMotion();
  const given = app.motions.map(({ name, dt, acceleration, note }) =>
    ({ name, dt, samples: acceleration, note }));
  return [...given, syntheticOnce];
}

/**
 * Return the block on the chosen motion.
 * @param {App} app
 * @param {State} state
 * @returns {Shaken}
 */
export function shakenBy(app, state) {
  if (lastShaken?.state === state && lastShaken.count === app.motions.length) return lastShaken.found;
  const found = shakenAnew(app, state);
  lastShaken = { state, count: app.motions.length, found };
  return found;
}

/** @param {App} app @param {State} state @returns {Shaken} */
function shakenAnew(app, state) {
  const choices = motionChoices(app);
  const motion = choices[Math.min(Math.round(state.record), choices.length - 1)];
  const { alpha, p, radius, restitution } = blockNumbers(app.kernels, state);
  const block = { alpha, p, radius, restitution, nonlinear: equationsOf(state) === 'nonlinear' };
  let peak = peaksOfMotions.get(motion.samples);
  if (peak === undefined) {
    peak = peakOf(motion);
    peaksOfMotions.set(motion.samples, peak);
  }
  return {
    motion, block, scale: state.scale, degrees: (alpha * 180) / Math.PI,
    pga: (state.scale * peak) / GRAVITY, refused: refusedMotion(motion, block),
  };
}

/**
 * Fates over values, as far as they are computed.
 * @typedef {object} FateSeries
 * @property {Float64Array} values
 * @property {Uint8Array} status  codes, or NOT_COMPUTED
 * @property {Float64Array} peak  theta/alpha, nan where not computed
 * @property {Float64Array} impacts
 * @property {number} done
 */

/**
 * Ask the pool for fates over values, coarse ones first.
 * @param {App} app
 * @param {Panel} panel
 * @param {string} job
 * @param {{ motion: GroundMotion, block: RecordBlock, scale?: number }} args
 * @param {Float64Array} values
 * @param {boolean} all  or the coarsest ones alone, as while something is dragged
 * @param {() => void} came  called when some have come
 * @returns {FateSeries}
 */
export function askFates(app, panel, job, { motion, block, scale }, values, all, came) {
  const count = values.length, { samples, dt } = motion;
  const found = {
    values, status: new Uint8Array(count).fill(NOT_COMPUTED), done: 0,
    peak: new Float64Array(count).fill(NaN), impacts: new Float64Array(count).fill(NaN),
  };
  app.pool.drop(`${panel.name}:`);
  const chunk = Math.max(4, Math.min(32, Math.round(CHUNK_SAMPLES / samples.length)));
  COARSE_TO_FINE.slice(0, all ? COARSE_TO_FINE.length : 1).forEach((stride, round) => {
    const wanted = Array.from(values.keys()).filter((k) =>
      k % stride === 0 && (round === 0 || k % (2 * stride) !== 0));
    for (let first = 0; first < wanted.length; first += chunk) {
      const places = wanted.slice(first, first + chunk);
      const args = {
        motion: { samples, dt }, block, scale, values: Float64Array.from(places, (k) => values[k]),
      };
      const how = { key: `${panel.name}:${stride}:${first}`, priority: 3 + round };
      app.pool.ask(job, args, how).then((fates) => {
        if (!fates) return;
        places.forEach((k, n) => {
          found.status[k] = fates.status[n];
          found.peak[k] = fates.peak[n];
          found.impacts[k] = fates.impacts[n];
        });
        found.done += places.length;
        came();
      }, (error) => app.fail(panel, `The response stopped: ${error.message}`, 'Choose another motion'));
    }
  });
  return found;
}

/**
 * Return how many fates overturned, of those that are computed.
 * @param {FateSeries} series
 */
export function fallenOf({ status }) {
  return status.filter((code) => code === FALLEN).length;
}

/**
 * Return a number for words: three digits, a plain minus.
 * @param {number} value
 * @param {number} [digits]
 */
export function few(value, digits = 3) {
  const shown = Number(value.toPrecision(digits));
  return Object.is(shown, -0) ? '0' : String(shown);
}
