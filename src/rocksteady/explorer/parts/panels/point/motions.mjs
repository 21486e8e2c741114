// Which motions coexist at the point: asked of the workers, named, and told in a sentence.

import { coexistingOf, sameEnding, startOn } from '../../physics/coexisting.mjs';
import { caseOf, equationsOf } from '../../shell/state.mjs';
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
 * @property {number} starts
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
    return { key, given, found: coexistingOf(endings), starts: 2 * endings.length };
  } catch (error) {
    const fault = error instanceof Error ? error.message : String(error);
    return { key, given, found: [], starts: 0, fault };
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
 * What names a motion.
 * @typedef {{ kind: string, period: number | null, highest: number | null,
 *   lowest: number | null, rests?: number }} Named
 */

/**
 * Return the name of a motion in a few words: `harmonic` where it has the period of the shaking.
 * @param {Named} motion
 */
export function motionName({ kind, period, highest, lowest, rests }) {
  if (kind !== 'symmetric' && kind !== 'unsymmetric') {
    return { rest: 'rest', aperiodic: 'aperiodic rocking', overturned: 'falling' }[kind]
      ?? 'undecided';
  }
  const count = period ?? 1;
  const rocking = count === 1 ? 'harmonic rocking' : `1/${count} subharmonic rocking`;
  // Positive rotation is about the left corner.
  const left = (highest ?? 0) >= -(lowest ?? 0);
  const lean = kind === 'symmetric' ? '' : `, leaning ${left ? 'left' : 'right'}`;
  return `${rocking}${lean}${rests ? ', with rests' : ''}`;
}

/**
 * Return the same in a sentence.
 * @param {Named} motion
 */
export function motionWords(motion) {
  const long = 'rocking with the period of the shaking';
  return motionName(motion).replace(/^harmonic rocking/, long);
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
 * Return the sentence on what coexists.
 * @param {App} app
 * @param {Measures} block
 * @param {Motions} motions
 */
export function motionsSentence(app, block, { fault, found, given }) {
  if (fault) return `Which motions coexist here is not known: ${fault}.`;
  const staying = found.filter(({ kind }) => kind !== 'overturned' && kind !== 'undecided');
  const falling = found.find(({ kind }) => kind === 'overturned')?.share ?? 0;
  const doubt = found.find(({ kind }) => kind === 'undecided')?.share ?? 0;
  const words = staying.map((motion, k) => {
    const peak = motionPeak(motion), { twin } = motion;
    if (twin >= 0 && found[twin] === staying[k - 1]) return 'the mirror image of that';
    const size = motion.kind === 'rest' || peak === null ? ''
      : `, peak ${angleWords(app, block, peak)}`;
    return `${motionWords(motion)}${size}`;
  });
  const counts = ['No', 'One', 'Two', 'Three', 'Four', 'Five', 'Six'];
  const many = counts[words.length] ?? String(words.length);
  const list = words.length < 2 ? words.join('')
    : `${words.slice(0, -1).join(', ')}, and ${words[words.length - 1]}`;
  let text = `${many} motions coexist here: ${list}.`;
  if (words.length === 1) text = `One motion is found here: ${list}.`;
  if (words.length === 0) {
    text = falling === 1 ? 'The block falls here, from every start tried.' : '';
  }
  if (falling > 0 && falling < 1) text += ` ${percentText(falling)} of the starts fall.`;
  if (doubt > 0) {
    text += given.restitution < 1 ? ` ${percentText(doubt)} of the starts stay undecided.`
      : ' Without loss (restitution 1) motions do not settle.';
  }
  return text.trim();
}

/** Return a share in percent. @param {number} share */
export function percentText(share) {
  return share > 0 && share < 0.01 ? 'under 1 %' : `${Math.round(100 * share)} %`;
}
