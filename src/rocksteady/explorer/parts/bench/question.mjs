// What a question of the laboratory is, and the block and the shaking that all of them share.

/** @import { App } from '../shell/app.mjs' */
/** @import { State } from '../shell/state.mjs' */
/** @import { RecordBlock } from '../physics/quake/record.mjs' */
/** @import { Kind } from './areas.mjs' */
/** @import { Asked, Share } from './cells.mjs' */
/** @import { Place, Plane } from './picture.mjs' */
/** @import { Sentence } from './sentence.mjs' */
import { classLook, fallLook } from '../draw/classes.mjs';
import { evaluate } from '../physics/case.mjs';
import { pulseNumbers } from '../physics/story/pulses.mjs';
import { blockNumbers, equationsOf } from '../shell/state.mjs';
import { MOTION_NAMES, NEVER_LIFTS, STANDS, fallName } from '../words.mjs';

/** @typedef {{ job: string, args: object, priority: number }} Wanted  a job of the pool */
/** @typedef {Record<string, any>} Answers  of the jobs that have come, by the names of `wants` */

/**
 * A question of the laboratory: its picture, its sentence and its film.
 * @typedef {object} Question
 * @property {string} title
 * @property {{ key: 'kind' | 'ground', words: string, options: readonly (readonly [string, string])[] }} choice
 * @property {readonly string[]} uses  keys of the state
 * @property {() => string} act  what its button says
 * @property {() => Sentence} invited  before the reader has done anything
 * @property {(sizing: boolean, answers: Answers) => Plane} plane  axes hold while a size is changed
 * @property {(place: Place) => Partial<State>} moved  what a place of the point sets
 * @property {() => readonly Kind[]} kinds  by the codes of the cells
 * @property {() => Asked | null} cells
 * @property {() => Record<string, Wanted>} wants
 * @property {(answers: Answers) => readonly Place[]} [curve]  in place of areas
 * @property {(answers: Answers, share: Share | null) => Sentence | null} says
 * @property {() => string} note
 * @property {() => Partial<State>} more  what leads to the researchers' room
 * @property {() => number} [leans]  theta/alpha at which the block is held
 * @property {(tilt: number) => Partial<State>} [tilted]  what letting it go from a tilt sets
 */

/**
 * Return the block of the state and its shaking.
 * @param {App} app
 * @returns {{ block: RecordBlock, push: boolean, amplitude: number, ratio: number, lift: number, g: number, hz: number }}
 */
export function shakingOf({ kernels, state }) {
  const { alpha, p, radius, restitution } = blockNumbers(kernels, state), push = state.kind === 'push' && state.tab !== 'start';
  const block = { alpha, p, radius, restitution, nonlinear: equationsOf(state) === 'nonlinear' };
  const [amplitude, ratio] = push ? [state.pA, state.pW] : [state.A, state.W];
  return {
    block, push, amplitude, ratio, lift: evaluate(kernels, 'tan', alpha),
    g: amplitude * alpha, hz: (ratio * p) / (2 * Math.PI),
  };
}

/** Return what sets a strength and a frequency, in thousandths. @param {App} app @param {number} g @param {number} hz
 * @returns {Partial<State>} */
export function shakingSet(app, g, hz) {
  const { block, push } = shakingOf(app), round = (/** @type {number} */ value) => Number(value.toFixed(3));
  const { amplitude, ratio } = pulseNumbers(block, round(g), round(hz));
  return push ? { pA: amplitude, pW: ratio } : { A: amplitude, W: ratio };
}

/** Return what sets a size, of which the full equations hold; the shakings stay as they are in g and Hz. @param {App} app
 * @param {{ b: number, h: number }} size @returns {Partial<State>} */
export function sizeSet({ kernels, state }, size) {
  const before = blockNumbers(kernels, state), after = blockNumbers(kernels, { ...state, ...size });
  const [lean, pace] = [before.alpha / after.alpha, before.p / after.p];
  return { ...size, model: 'auto', A: state.A * lean, W: state.W * pace, pA: state.pA * lean, pW: state.pW * pace };
}

/**
 * Return the kinds of areas by the codes of SHAKEN.
 * @param {App} app
 * @param {{ still?: string, goesOn?: string, falls?: boolean }} [names]  of what does not lift, and of what rocks; `falls`
 *   names both ways to fall as one
 * @returns {Kind[]}
 */
export function kindsOf({ theme }, { still = NEVER_LIFTS, goesOn = STANDS, falls = false } = {}) {
  const fell = (/** @type {number} */ impacts, /** @type {string} */ name) =>
    /** @type {const} */ ({ look: fallLook(theme, 1, impacts), name, ink: 'onFalls', over: 'falls' });
  const any = fell(1, MOTION_NAMES.overturned);
  return [
    { look: classLook(theme, 'rest'), name: still, ink: 'ink', over: 'rest' },
    { look: classLook(theme, 'rocking'), name: goesOn, ink: 'onRocks', over: 'rocks' },
    falls ? any : fell(0, fallName(0)), falls ? any : fell(1, fallName(1).replace('after ', 'after|')),
    { look: classLook(theme, 'undecided'), name: MOTION_NAMES.undecided, ink: 'ink', over: 'paper' },
  ];
}

/**
 * Return the ends of axes that follow the block, and hold while its size is changed.
 * @template Ends
 * @param {() => Ends} now
 * @returns {(sizing?: boolean) => Ends}  by default as when last asked
 */
export function heldEnds(now) {
  /** @type {Ends | null} */
  let kept = null;
  return (sizing = kept !== null) => {
    kept = sizing ? kept ?? now() : null;
    return kept ?? now();
  };
}

/** Return a value rounded up to a multiple. @param {number} value @param {number} step */
export function upTo(value, step) {
  return Math.ceil(value / step - 1e-9) * step;
}

