// Sentences of the landing, from what has happened.

/**
 * What has happened since the block last stood still.
 * @typedef {object} Story
 * @property {number} alpha  tipping angle [rad]
 * @property {number} lift  acceleration that lifts it [g]
 * @property {number} reach  how far the ground went [m]
 * @property {number} top  its largest acceleration [g]
 * @property {number} impacts
 * @property {number} peak  largest |theta|/alpha
 * @property {number} angle  |theta|/alpha now
 * @property {boolean} rocks
 * @property {boolean} lies
 * @property {boolean} quiet  the ground has stood still for a while
 */

const FEW_IMPACTS = 20;
const MOVED = 0.02; // acceleration [g] from which a push is spoken of
const SETTLES = 0.02; // |theta|/alpha below which it only settles

/**
 * Return the sentence and the facts below it.
 * @param {Story} story
 * @returns {{ sentence: string, facts: string }}
 */
export function storyWords(story) {
  const { alpha, lift, reach, top, impacts, peak, angle, rocks, lies, quiet } = story;
  const moved = top < MOVED ? '' : ` You moved the ground ${Math.round(100 * reach)} cm at ${gText(top)}.`;
  const limit = degreeText(alpha);
  if (lies) {
    const after = impacts ? `after ${impactText(impacts)}` : 'at once, without an impact';
    return { sentence: `It fell.${moved}`, facts: after };
  }
  if (rocks && angle > 1) return { sentence: 'Past its tipping angle.', facts: '' };
  if (rocks) {
    const settles = quiet && impacts > 3 && angle < SETTLES;
    const now = `${degreeText(angle * alpha)} of ${limit} · ${impactText(impacts)}`;
    return { sentence: settles ? 'It settles.' : 'It rocks.', facts: now };
  }
  if (peak > 0) {
    const leaned = `it leaned ${degreeText(peak * alpha)}; past ${limit} it tips`;
    return { sentence: `It stood.${moved}`, facts: leaned };
  }
  if (top < MOVED) return { sentence: '', facts: '' };
  return {
    sentence: `It did not lift: that needs ${gText(lift)}.`,
    facts: `your hardest push ${gText(top)}`,
  };
}

/** @param {number} count */
export function impactText(count) {
  if (count > FEW_IMPACTS) return `more than ${FEW_IMPACTS} impacts`;
  return `${count} impact${count === 1 ? '' : 's'}`;
}

/** @param {number} value  [g] */
export function gText(value) {
  return `${value.toFixed(2)} g`;
}

/** @param {number} angle  [rad] */
export function degreeText(angle) {
  return `${((180 / Math.PI) * angle).toFixed(1)}°`;
}
