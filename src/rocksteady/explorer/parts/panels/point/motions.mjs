// What the block can do at the point: asked of the workers, named, and told in a sentence.

import { coexistingOf, sameEnding, startOn } from '../../physics/coexisting.mjs';
import { caseOf, equationsOf } from '../../shell/state.mjs';
import { motionWords } from '../../words.mjs';
import { orbitCourse } from './followed.mjs';
import { angleWords } from './units.mjs';

/** @import { App } from '../../shell/app.mjs' */
/** @import { Attractor } from '../../physics/attractor.mjs' */
/** @import { Case, Measures } from '../../physics/case.mjs' */
/** @import { Coexisting, Ending } from '../../physics/coexisting.mjs' */
/** @import { Course } from '../../physics/history.mjs' */
/** @import { Impact } from '../../physics/start.mjs' */
/** @import { Followed } from './followed.mjs' */
/** @import { MotionClass } from '../../draw/classes.mjs' */

/**
 * The motions of a point: `shared.motions`.
 * @typedef {object} Motions
 * @property {string} key  of the case
 * @property {Case} given
 * @property {Coexisting[]} found
 * @property {string} [fault]  why they are not known
 * @property {OtherMotion[]} [curves]  made when they are first drawn
 */

const PATIENCE_MS = 400; // after which the motions of an earlier point are given up for a later one
const CHUNK = { linear: 16, nonlinear: 8 };

/**
 * Look for the motions of the present case, unless that is under way: then when it is done.
 * @param {App} app
 */
export function askMotions(app) {
  const { shared } = app, key = caseKey(app);
  if (shared.motions?.key === key || shared.asking === key) return;
  if (shared.asking) {
    if (performance.now() - shared.askedAt > PATIENCE_MS) app.pool.drop('motions:');
    return;
  }
  shared.asking = key;
  shared.askedAt = performance.now();
  motionsOf(app, key).then((motions) => {
    shared.asking = null;
    if (motions) {
      shared.motions = motions;
      app.touch('motions');
    }
    if (caseKey(app) !== key) askMotions(app);
  });
}

/** @param {App} app */
function caseKey(app) {
  return keyOfCase(caseOf(app.kernels, app.state));
}

/** @param {Case} given */
function keyOfCase(given) {
  return Object.values(given).join(' ');
}

/**
 * Return the motions that coexist at the point that is followed, null until they are known.
 * @param {App} app
 * @param {Followed | null} followed
 * @returns {Motions | null}
 */
export function motionsHere({ shared }, followed) {
  const { motions } = shared;
  return followed && motions?.key === keyOfCase(followed.given) ? motions : null;
}

/**
 * Return the motions that coexist at the present state, null until they are known.
 * @param {App} app
 * @returns {Motions | null}
 */
export function presentMotions(app) {
  const { motions } = app.shared;
  return motions?.key === caseKey(app) ? motions : null;
}

/**
 * The course of a motion and its states after impacts.
 * @typedef {{ motion: Coexisting, course: Course, states: Impact[] }} OtherMotion
 */

/**
 * Return the motions that coexist with the one that is followed, as curves.
 * @param {App} app
 * @param {Followed | null} followed
 * @returns {OtherMotion[]}
 */
export function otherMotions(app, followed) {
  const motions = motionsHere(app, followed);
  if (!motions || !followed) return [];
  if (!motions.curves) {
    const { given } = motions;
    motions.curves = [];
    for (const motion of motions.found) {
      const start = motion.kind === 'rest' || motion.state ? startOn(motion) : null;
      const orbit = orbitCourse(app.kernels, given, start, motion.period || 1);
      if (orbit) motions.curves.push({ motion, ...orbit });
    }
  }
  return motions.curves.filter(({ motion }) => !isPresent(motion, followed.attractor));
}

/**
 * @param {App} app
 * @param {string} key
 * @returns {Promise<Motions | null>}
 */
async function motionsOf({ kernels, pool, state }, key) {
  const given = caseOf(kernels, state), size = CHUNK[equationsOf(state)];
  const ask = (/** @type {number} */ from) => pool.ask(
    'endings', { given, from, to: from + size }, { key: `motions:${from}`, priority: -1 },
  );
  try {
    const first = await ask(0);
    if (!first) return null;
    const rest = [];
    for (let from = size; from < first.starts; from += size) rest.push(ask(from));
    const parts = [first, ...await Promise.all(rest)];
    if (parts.some((part) => !part)) return null;
    const endings = parts.flatMap((part) => part.endings);
    return { key, given, found: coexistingOf(endings) };
  } catch (error) {
    const fault = error instanceof Error ? error.message : String(error);
    return { key, given, found: [], fault };
  }
}

/**
 * Return whether a coexisting motion is what the block has settled to.
 * @param {Coexisting} motion
 * @param {Attractor} attractor
 */
export function isPresent(motion, attractor) {
  const { kind, orbit } = attractor;
  return sameEnding(motion, /** @type {Ending} */ ({
    ...motion,
    kind,
    period: orbit ? orbit.period : 0,
    passages: orbit ? orbit.states.length : 0,
    rests: orbit ? orbit.rests : 0,
    highest: attractor.highest ?? NaN,
    lowest: attractor.lowest ?? NaN,
  }));
}

/**
 * Return whether a motion of a point beside this one is of the kind that the block settles to.
 * @param {Coexisting} motion
 * @param {Attractor} attractor
 */
export function isAlike(motion, attractor) {
  const { kind, period, highest, lowest } = attractor;
  if (motion.kind !== kind || motion.period !== (period ?? 0)) return false;
  const right = motion.highest > -motion.lowest;
  return kind !== 'unsymmetric' || right === (highest ?? 0) > -(lowest ?? 0);
}

/**
 * Return the class of a motion, as maps colour it.
 * @param {{ kind: MotionClass | string, period: number | null }} motion
 * @returns {MotionClass}
 */
export function motionClass({ kind, period }) {
  return /** @type {MotionClass} */ ((period ?? 0) > 1 ? 'subharmonic' : kind);
}

/**
 * Return the largest |theta|/alpha of a motion; null without an orbit.
 * @param {{ highest: number | null, lowest: number | null }} motion
 */
export function motionPeak({ highest, lowest }) {
  if (highest === null || lowest === null || Number.isNaN(highest)) return null;
  return Math.max(highest, -lowest);
}

/**
 * Return the sentence on what the block does, depending on how it begins.
 * @param {App} app
 * @param {Measures} block
 * @param {Motions} motions
 */
export function motionsSentence(app, block, { fault, found, given }) {
  if (fault) return `What it can do here is not known: ${fault}.`;
  const words = found.map((motion, k) => {
    const peak = motionPeak(motion), { kind, twin } = motion;
    if (kind === 'undecided') {
      return given.restitution < 1 ? 'stays undecided' : 'never settles without loss (restitution 1)';
    }
    if (twin >= 0 && found[twin] === found[k - 1]) return 'does the mirror image of that';
    const size = kind === 'rest' || peak === null ? '' : ` (peak ${angleWords(app, block, peak)})`;
    return `${motionWords(motion)}${size}`;
  });
  const last = words.pop();
  if (!words.length) return `From every start tried, it ${last}.`;
  return `It ${words.join(', ')} or ${last}: how it begins decides.`;
}
