// The names of motions, as the package's outcomes give them (`outcomes.py`): the page's only ones.

/** Verb of each kind of attractor. @type {Readonly<Record<string, string>>} */
export const MOTION_NAMES = {
  symmetric: 'rocks', unsymmetric: 'rocks, further to one side', rest: 'comes to rest',
  overturned: 'falls', aperiodic: 'never repeats', undecided: 'undecided',
};
export const NEVER_LIFTS = 'never lifts', STANDS = 'stands';

/** @type {Readonly<Record<number, string>>} */
const ORDINALS = { 2: 'second', 3: 'third', 4: 'fourth', 5: 'fifth', 6: 'sixth', 8: 'eighth',
  16: 'sixteenth' };

/** @typedef {{ kind: string, period: number | null }} NamedMotion */

/** Return the name of a motion: of an orbit by its period in shakes. @param {NamedMotion} motion */
export function motionName({ kind, period }) {
  if (!period || period < 2) return MOTION_NAMES[kind];
  return `rocks, alike every ${ORDINALS[period] ?? `${period}th`} shake`;
}

/** Return what a motion is in a sentence that begins with "it". @param {NamedMotion} motion */
export function motionWords(motion) {
  if (motion.kind === 'aperiodic') return 'rocks and never repeats';
  if (motion.kind === 'undecided') return 'is not decided';
  return motion.period === 1 ? motionName(motion).replace('rocks', 'rocks with the shaking') : motionName(motion);
}

/** Return the name of a fall. @param {number} impacts  before it */
export function fallName(impacts) {
  return `falls ${impacts ? 'after an impact' : 'at once'}`;
}
