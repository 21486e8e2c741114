// What the laboratory says of a shaken block: one sentence with one number, and a fact or two.

/** @import { ShakenRun } from '../physics/shake.mjs' */
/** @import { PulseWindow } from '../physics/demand/windows.mjs' */
import { SHAKEN } from '../physics/shake.mjs';
import { degreeText, gText, impactText } from '../story/words.mjs';
import { fallName, motionWords } from '../words.mjs';

/** @typedef {{ words: readonly [string, string, string], facts: string }} Sentence  the second is the number */

const CENTIG = 100; // advice is in hundredths of g
const plain = (/** @type {string} */ words) => /** @type {const} */ ([words, '', '']);

/** Before the reader has done anything. @type {Sentence} */
export const INVITED = { words: plain('Push the ground, or drag the point on the map.'), facts: '' };

/**
 * Return the sentence on a run.
 * @param {ShakenRun} run
 * @param {{ push: boolean, g: number, lift: number, alpha: number }} asked  [g], [rad]
 * @param {readonly PulseWindow[]} windows  of a push at its frequency [g], in which it falls
 * @returns {Sentence}
 */
export function shakenSentence(run, { push, g, lift, alpha }, windows) {
  const { fate, lies, impacts } = run, limit = `it tips past ${degreeText(alpha)}`;
  if (fate === SHAKEN.still) return { words: ['It never lifts: to lift it takes ', gText(lift), '.'], facts: '' };
  if (fate === SHAKEN.undecided) return { words: plain('What becomes of it is not decided.'), facts: '' };
  if (fate !== SHAKEN.stands) {
    if (push) return { words: weaker(fate === SHAKEN.once ? 0 : 1, g, windows), facts: fallen(run) };
    if (lies === null) return { words: plain('It falls.'), facts: '' };
    return { words: ['It falls after ', `${lies.toFixed(1)} s`, '.'], facts: impacts ? `after ${impactText(impacts)}` : 'at once, without an impact' };
  }
  if (!push) {
    const how = run.kind === 'rocking' ? 'rocks' : motionWords({ kind: run.kind, period: run.period });
    return { words: [`It ${how}, and leans `, degreeText(run.lean), ' at most.'], facts: limit };
  }
  const worse = windows.filter(({ high }) => high < g).pop();
  const leans = `it leans ${degreeText(run.lean)} of ${degreeText(alpha)}`;
  if (worse) return { words: ['It stands: safer than a push of ', strengthIn(worse), '.'], facts: leans };
  return { words: ['It rocks, leans ', degreeText(run.lean), ', and stands.'], facts: limit };
}

/** Say at which weaker push it would stand: the nearest in hundredths of g. @param {number} impacts
 * @param {number} g @param {readonly PulseWindow[]} windows
 * @returns {readonly [string, string, string]} */
function weaker(impacts, g, windows) {
  const name = `It ${fallName(impacts)}`, falls = (/** @type {number} */ at) =>
    windows.some(({ low, high }) => low <= at && at <= high);
  if (!windows.length) return plain(`${name}.`);
  let steps = Math.floor(g * CENTIG);
  while (steps > 0 && (steps / CENTIG >= g || falls(steps / CENTIG))) steps--;
  return [`${name}; at `, gText(steps / CENTIG), ' it would stand.'];
}

/** Return a strength in a window, with as few decimals as it takes. @param {PulseWindow} window */
function strengthIn({ low, high }) {
  const digits = [2, 3, 4].find((places) => Math.floor(high * 10 ** places) >= low * 10 ** places) ?? 5;
  return `${(Math.floor(high * 10 ** digits) / 10 ** digits).toFixed(digits)} g`;
}

/** @param {ShakenRun} run */
function fallen({ lies }) {
  return lies === null ? '' : `it lies after ${lies.toFixed(1)} s`;
}
