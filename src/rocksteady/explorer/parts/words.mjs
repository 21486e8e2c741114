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

/**
 * Return what a map says of its share: of the cells that it shows, in per cent as the package
 * writes them (`results/numbers.py`).
 * @param {number} falls
 * @param {number} cells  shown
 */
export function shareWords(falls, cells) {
  const percents = 100 * (falls / cells), scale = percents < 9.95 ? 10 : 1;
  const below = Math.floor(scale * percents), half = scale * percents - below === 0.5;
  const rounded = half && below % 2 === 0 ? below / scale : percents; // halves go to even digits
  const part = falls === cells ? 'all' : falls === 0 ? 'none' : percents < 0.1 ? '< 0.1 %'
    : percents >= 99.5 ? '> 99 %' : `${rounded.toFixed(scale === 10 ? 1 : 0)} %`;
  return `${part} of the starts on this map fall`;
}

/** Return the name of a fall. @param {number} impacts  before it */
export function fallName(impacts) {
  return `falls ${impacts ? 'after an impact' : 'at once'}`;
}
