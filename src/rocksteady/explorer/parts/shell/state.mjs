// The state of the page: flat, frozen, each key with its default, its text and its limits.

/** @import { Kernels } from '../kernels/loader.mjs' */
/** @import { Case, Measures, Start } from '../physics/case.mjs' */
import { PULSES } from '../kernels/pulses.mjs';
import { START_WINDOW } from '../kernels/window.mjs';
import { measuresOf } from '../physics/case.mjs';

/** Places of the story, in their order. */
export const STORY = ['push', 'swing', 'size', 'fall', 'fates', 'order', 'quake'];
/** Questions of the laboratory, and of the rooms for researchers the questions that they are behind. */
export const TABS = ['shake', 'start', 'quake', 'size'];
/** @type {Readonly<Record<string, string>>} */
export const ROOMS = { explore: 'shake', basins: 'start', pulse: 'shake', design: 'size' };

const FULL = ['shake', 'size']; // questions of blocks with a size, by the full equations whatever the model
const DECIMAL = /^\s*[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?\s*$/i; // no 0x10

/**
 * @typedef {object} Field
 * @property {string | number} value  the default
 * @property {(text: string) => string | number | undefined} parse  undefined where it is refused
 * @property {number} [least]  of a number
 * @property {number} [most]
 */

/**
 * @param {number} value
 * @param {number} least
 * @param {number} most
 * @returns {Field}
 */
function numberField(value, least, most) {
  return {
    value,
    least,
    most,
    parse(text) {
      const found = DECIMAL.test(text) ? Number(text) : NaN;
      return found >= least && found <= most ? found : undefined;
    },
  };
}

/**
 * @param {...string} names  the first is the default
 * @returns {Field}
 */
function choiceField(...names) {
  return { value: names[0], parse: (text) => (names.includes(text) ? text : undefined) };
}

/**
 * @param {...number} numbers  the first is the default
 * @returns {Field}
 */
function optionField(...numbers) {
  return {
    value: numbers[0],
    parse: (text) => numbers.find((number) => String(number) === text),
  };
}

/** @returns {Field} */
function startField() {
  return { value: 'rest', parse: (text) => (parsedStart(text) ? text : undefined) };
}

/** @type {Readonly<Record<string, Field>>} */
export const FIELDS = {
  at: choiceField('lab', ...STORY), // where in the page
  tilt: numberField(0.8, 0.05, 0.98), // values of the scenes: theta/alpha at the start
  length: numberField(0.35, 0.12, 2.4), // of a pulse [s]
  strength: numberField(0.7, 0.1, 1.4), // of a pulse [g]
  su: numberField(0.3, -1.1, 1.1), // theta/alpha, du/d(pt) at the start
  sv: numberField(0.35, -1.1, 1.1),
  shake: numberField(2.699, 2, 2.75), // amplitude over alpha g
  pga: numberField(0.5, 0.2, 1.1), // [g]
  tab: choiceField(...TABS, ...Object.keys(ROOMS)),
  kind: choiceField('on', 'push'), // whether the shaking goes on
  ground: choiceField('still', 'shaken'), // on which a block is let go
  model: choiceField('auto', 'linear', 'nonlinear'), // auto: as `equationsOf` says
  units: choiceField('si', 'none'), // of a block with a size, or dimensionless
  look: choiceField('auto', 'light', 'dark'),
  A: numberField(2, 0, 1000),
  W: numberField(3, 0.01, 1000),
  r: numberField(0.8, 0.01, 1),
  rh: optionField(0, 1), // whether the restitution is Housner's
  b: numberField(0.5, 0.001, 1000), // width [m]
  h: numberField(2, 0.001, 1000), // height [m]
  start: startField(),
  cycles: numberField(60, 1, 1000),
  w0: numberField(0.5, 0.01, 1000),
  w1: numberField(8, 0.01, 1000),
  a0: numberField(0, 0, 1000),
  a1: numberField(6, 0, 1000),
  log: optionField(0, 1),
  hue: choiceField('kind', 'period', 'peak'), // what the colours of the map mean
  by: choiceField('w', 'a'),
  record: numberField(0, 0, 9999), // number of the ground motion, from 0
  scale: numberField(1, 0.01, 100), // of its accelerations
  u0: numberField(-START_WINDOW.angle, -100, 100), // window of the basins
  u1: numberField(START_WINDOW.angle, -100, 100),
  v0: numberField(-START_WINDOW.velocity, -100, 100),
  v1: numberField(START_WINDOW.velocity, -100, 100),
  safe: optionField(0, 1), // whether the basins show the safe basin alone
  pulse: choiceField('one-sine', ...Object.keys(PULSES)),
  pA: numberField(2.5, 0, 1000),
  pW: numberField(3.6, 0.01, 1000),
  pw0: numberField(1, 0.01, 1000),
  pw1: numberField(12, 0.01, 1000),
  pa0: numberField(0.8, 0.001, 1000),
  pa1: numberField(20, 0.001, 1000),
  plog: optionField(1, 0),
  demand: choiceField('pulse', 'harmonic', 'record'),
  dg: numberField(0.4, 0.001, 100), // largest base acceleration [g]
  df: numberField(1.5, 0.01, 100), // frequency [Hz]
  dn: numberField(20, 1, 1000), // cycles of harmonic shaking
  limit: numberField(0.5, 0.01, 1), // theta/alpha that is allowed
  plane: choiceField('size', 'alpha'), // width and height, or slenderness and half-diagonal
  dpeak: optionField(0, 1), // whether cells show their peaks
  db0: numberField(0.1, 0.001, 1000), // window of widths, heights [m], alpha [rad] and R [m]
  db1: numberField(1, 0.001, 1000),
  dh0: numberField(0.5, 0.001, 1000),
  dh1: numberField(3, 0.001, 1000),
  ds0: numberField(0.05, 0.001, 1.5),
  ds1: numberField(0.5, 0.001, 1.5),
  dr0: numberField(0.25, 0.001, 1000),
  dr1: numberField(2.5, 0.001, 1000),
};

/**
 * @typedef {object} State
 * @property {string} at  push, a scene or lab
 * @property {number} tilt
 * @property {number} length
 * @property {number} strength
 * @property {number} su
 * @property {number} sv
 * @property {number} shake
 * @property {number} pga
 * @property {string} tab
 * @property {string} kind  on or push
 * @property {string} ground  still or shaken
 * @property {'auto' | 'linear' | 'nonlinear'} model
 * @property {'none' | 'si'} units
 * @property {'auto' | 'light' | 'dark'} look
 * @property {number} A  amplitude
 * @property {number} W  frequency ratio
 * @property {number} r  restitution, where it is not Housner's
 * @property {number} rh  1 where it is Housner's
 * @property {number} b  full width [m]
 * @property {number} h  full height [m]
 * @property {string} start  rest, steady, u,v or side:phase:speed
 * @property {number} cycles  periods of a time history
 * @property {number} w0
 * @property {number} w1
 * @property {number} a0
 * @property {number} a1
 * @property {number} log
 * @property {'kind' | 'period' | 'peak'} hue  what the colours of the map mean
 * @property {'w' | 'a'} by  what the strip runs over
 * @property {number} record  number of the ground motion, from 0
 * @property {number} scale  factor of its accelerations
 * @property {number} u0  window of the basins, theta/alpha
 * @property {number} u1
 * @property {number} v0  du/d(pt)
 * @property {number} v1
 * @property {number} safe  1 where the basins show the safe basin alone
 * @property {string} pulse  shape of the pulse
 * @property {number} pA  its amplitude
 * @property {number} pW  its frequency ratio
 * @property {number} pw0
 * @property {number} pw1
 * @property {number} pa0
 * @property {number} pa1
 * @property {number} plog
 * @property {'pulse' | 'harmonic' | 'record'} demand  of a design
 * @property {number} dg  its largest base acceleration [g]
 * @property {number} df  its frequency [Hz]
 * @property {number} dn  its cycles
 * @property {number} limit  theta/alpha that is allowed
 * @property {'size' | 'alpha'} plane  what the axes of the design are
 * @property {number} dpeak  1 where cells show their peaks
 * @property {number} db0
 * @property {number} db1
 * @property {number} dh0
 * @property {number} dh1
 * @property {number} ds0
 * @property {number} ds1
 * @property {number} dr0
 * @property {number} dr1
 */

/** Return the state whose keys all have their defaults. @returns {State} */
export function defaultState() {
  const pairs = Object.entries(FIELDS).map(([name, field]) => [name, field.value]);
  return Object.freeze(/** @type {State} */ (Object.fromEntries(pairs)));
}

/**
 * Return a state with some keys at other values, and what was refused of them.
 * @param {State} state
 * @param {Record<string, unknown>} patch  values, or their texts
 * @returns {{ state: State, refused: string[] }}
 */
export function patched(state, patch) {
  /** @type {Record<string, string | number>} */
  const next = { ...state };
  const refused = [];
  for (const [name, given] of Object.entries(patch)) {
    const value = Object.hasOwn(FIELDS, name) ? FIELDS[name].parse(String(given)) : undefined;
    if (value === undefined) refused.push(name);
    else next[name] = value;
  }
  const found = /** @type {State} */ (/** @type {unknown} */ (next));
  for (const [low, high] of WINDOWS) {
    if (!(found[low] < found[high])) {
      if (low in patch || high in patch) refused.push(low);
      next[low] = state[low];
      next[high] = state[high];
    }
  }
  if (found.rh === 1 && !(3 * found.b * found.b < 2 * (found.b * found.b + found.h * found.h))) {
    // Housner's restitution, 1 - 1.5 sin^2 alpha, is not above 0: so stocky a block does not rock.
    refused.push('rh');
    Object.assign(next, { rh: state.rh, b: state.b, h: state.h });
  }
  return { state: Object.freeze(found), refused };
}

/**
 * Pairs of keys that are the ends of an axis.
 * @type {readonly (readonly [keyof State, keyof State])[]}
 */
const WINDOWS = [
  ['w0', 'w1'], ['a0', 'a1'], ['u0', 'u1'], ['v0', 'v1'], ['pw0', 'pw1'], ['pa0', 'pa1'],
  ['db0', 'db1'], ['dh0', 'dh1'], ['ds0', 'ds1'], ['dr0', 'dr1'],
];

/**
 * Return the start that a text means; null where it means none.
 * @param {string} text
 * @returns {Start | null}
 */
function parsedStart(text) {
  if (text === 'rest' || text === 'steady') return { kind: text };
  const pair = text.split(',');
  const three = text.split(':');
  const parts = (pair.length === 2 ? pair : three).map((part) => (part.trim() ? Number(part) : NaN));
  if (!parts.every((part) => Math.abs(part) <= 1e6)) return null;
  if (pair.length === 2) return { kind: 'state', angle: parts[0], velocity: parts[1] };
  const [side, phase, speed] = parts;
  if (three.length !== 3 || Math.abs(side) !== 1 || speed < 0) return null;
  return { kind: 'impact', side, phase, speed };
}

/**
 * Return where the motion starts.
 * @param {State} state
 * @returns {Start}
 */
export function startOf(state) {
  return parsedStart(state.start) ?? { kind: 'rest' };
}

/**
 * Return the text of a start, from which `startOf` makes the same again.
 * @param {Start} start
 */
export function startText(start) {
  if (start.kind === 'state') return `${start.angle},${start.velocity}`;
  if (start.kind === 'impact') return `${start.side}:${start.phase}:${start.speed}`;
  return start.kind;
}

/**
 * Return the measures of the block, and the restitution that counts.
 * @param {Kernels} kernels
 * @param {State} state
 * @returns {Measures & { restitution: number }}
 */
export function blockNumbers(kernels, state) {
  const measures = measuresOf(kernels, state.b, state.h);
  return { ...measures, restitution: state.rh === 1 ? measures.housner : state.r };
}

/** Return whether the window of the basins is the default one. @param {State} state */
export function isWhole(state) {
  const keys = /** @type {const} */ (['u0', 'u1', 'v0', 'v1']);
  return keys.every((key) => state[key] === FIELDS[key].value);
}

/**
 * Return the equations of motion; by default the full ones of a block with a size, maps excepted.
 * @param {State} state
 * @returns {'linear' | 'nonlinear'}
 */
export function equationsOf(state) {
  if (FULL.includes(state.tab)) return 'nonlinear';
  if (state.model !== 'auto') return state.model;
  const sized = ['start', 'quake', 'design', ...(state.units === 'si' ? ['pulse'] : [])];
  return sized.includes(state.tab) ? 'nonlinear' : 'linear';
}

/**
 * Return the block and its shaking as the kernels see them.
 * @param {Kernels} kernels
 * @param {State} state
 * @returns {Case}
 */
export function caseOf(kernels, state) {
  const { alpha, restitution } = blockNumbers(kernels, state);
  return {
    amplitude: state.A,
    frequencyRatio: state.W,
    restitution,
    nonlinear: equationsOf(state) === 'nonlinear',
    alpha,
  };
}
