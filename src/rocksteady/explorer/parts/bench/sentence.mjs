// What the laboratory says of a block: one sentence with one number, and a fact or two.

/** @import { ShakenRun, WidthTurn } from '../physics/shake.mjs' */
/** @import { PulseWindow } from '../physics/demand/windows.mjs' */
/** @import { ReleasedRun } from '../physics/released.mjs' */
/** @import { Share } from './cells.mjs' */
import { SHAKEN } from '../physics/shake.mjs';
import { degreeText, gText, impactText } from '../story/words.mjs';
import { NEVER_LIFTS, STANDS, fallName, motionWords, shareWords } from '../words.mjs';

/** @typedef {{ words: readonly [string, string, string], facts: string }} Sentence  the second is the number */

const CENTIG = 100; // advice is in hundredths of g
const UNDECIDED = 'What becomes of it is not decided.';

/** Return a sentence without a number. @param {string} words @returns {readonly [string, string, string]} */
export function plain(words) {
  return [words, '', ''];
}

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
  if (fate === SHAKEN.undecided) return { words: plain(UNDECIDED), facts: '' };
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

/**
 * Return the sentence on a block that was let go.
 * @param {ReleasedRun} run
 * @param {{ alpha: number, shaken: boolean }} asked
 * @param {Share | null} share  of the starts on the map that fall
 * @returns {Sentence}
 */
export function releasedSentence(run, { alpha, shaken }, share) {
  const facts = `it tips past ${degreeText(alpha)}`;
  if (!shaken) {
    if (run.fate === SHAKEN.once) return { words: plain('It falls: that is past its tipping angle.'), facts };
    if (Number.isNaN(run.rock)) return { words: plain('It does not rock.'), facts };
    return { words: ['The first rock takes ', `${run.rock.toFixed(2)} s`, '.'], facts };
  }
  const here = run.fate === SHAKEN.undecided ? UNDECIDED.slice(0, -1)
    : `From here it ${run.fate === SHAKEN.once ? 'falls' : motionWords(run)}`;
  if (!share) return { words: plain(`${here}.`), facts };
  const [part, rest] = shareWords(share.falls, share.cells).split(/ (?=of the)/);
  return { words: [`${here}; `, part, ` ${rest}.`], facts };
}

/**
 * Return the sentence on a size.
 * @param {ShakenRun} run
 * @param {WidthTurn | null} turn  null: not known yet
 * @param {{ push: boolean, lift: number, alpha: number, width: number }} asked
 * @returns {Sentence}
 */
export function sizeSentence(run, turn, { push, lift, alpha, width }) {
  const falls = run.fate === SHAKEN.once || run.fate === SHAKEN.after;
  const facts = `it lifts at ${gText(lift)} and tips past ${degreeText(alpha)}`;
  if (run.fate === SHAKEN.undecided) return { words: plain(UNDECIDED), facts };
  const now = falls ? 'falls' : run.fate === SHAKEN.still ? NEVER_LIFTS : push ? STANDS : 'rocks';
  if (!turn || turn.falls !== falls) return { words: plain(`It ${now}.`), facts };
  if (turn.turns === null) {
    if (turn.last === null) return { words: plain(`It ${now}.`), facts };
    return { words: [`It ${now}, ${falls ? 'wider too, up to' : 'narrower too, down to'} `, `${turn.last.toFixed(2)} m`, '.'], facts };
  }
  const by = `${Math.round(100 * Math.abs(turn.turns - width))} cm`;
  return { words: [`It ${now}; `, by, falls ? ' wider it stands.' : ' narrower it falls.'], facts };
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
