// An axis of a plane: what zooming, moving and a box make of its ends, and round numbers on it.

/** @import { State } from '../../shell/state.mjs' */
/** @import { Shown } from '../../shell/units.mjs' */
import { FIELDS } from '../../shell/state.mjs';

/**
 * Ends of an axis and how it runs; its values are those of the state, and `unit` times as much is
 * shown.
 * @typedef {object} PlaneAxis
 * @property {readonly [string, string]} keys  of the state that are its ends
 * @property {number} from
 * @property {number} to
 * @property {boolean} log
 * @property {number} unit
 * @property {string} label
 * @property {Shown['far']} [far]  the dimensionless scale
 * @property {readonly [number, number]} within  what the ends keep to
 */

/** @typedef {{ x: PlaneAxis, y: PlaneAxis }} PlaneAxes */
/** @typedef {{ x: number, y: number }} PlanePlace */

const NARROWEST = 1e-4; // part of its centre that an axis keeps
const SHORTEST = 1e-6;
const LOG_PART = 1e-2; // of its end, where a logarithmic axis begins that would begin at 0
const END_STEPS = 5000; // along an axis, of which its ends are whole numbers

/**
 * Return an axis of the state; one from 0 begins above it where it is logarithmic.
 * @param {State} state
 * @param {readonly [string, string]} keys
 * @param {{ label: string, factor?: number, far?: Shown['far'] }} shown
 * @param {boolean} [log]
 * @returns {PlaneAxis}
 */
export function axisOf(state, keys, { label, factor = 1, far }, log = false) {
  const [from, to] = keys.map((key) => Number(state[/** @type {keyof State} */ (key)]));
  const { least = -Infinity, most = Infinity } = FIELDS[keys[0]];
  return { keys, from: log && !(from > 0) ? LOG_PART * to : from, to, log, unit: factor, label, far,
    within: [log ? Math.max(SHORTEST, least) : least, most] };
}

/** @param {PlaneAxis} axis @param {number} value */
const forth = ({ log }, value) => (log ? Math.log(value) : value);
/** @param {PlaneAxis} axis @param {number} value */
const back = ({ log }, value) => (log ? Math.exp(value) : value);

/**
 * Return the value at a part of an axis, 0 to 1.
 * @param {PlaneAxis} axis
 * @param {number} part
 */
export function valueOn(axis, part) {
  const [low, high] = [forth(axis, axis.from), forth(axis, axis.to)];
  return back(axis, low + (high - low) * part);
}

/**
 * Return the part of an axis where a value is.
 * @param {PlaneAxis} axis
 * @param {number} value
 */
export function partOn(axis, value) {
  const [low, high] = [forth(axis, axis.from), forth(axis, axis.to)];
  return (forth(axis, value) - low) / (high - low);
}

/** @param {PlaneAxes} axes @param {PlanePlace} part  from the lower left corner */
export function placeIn({ x, y }, part) {
  return { x: valueOn(x, part.x), y: valueOn(y, part.y) };
}

/** @param {PlaneAxes} axes @param {PlanePlace} place */
export function partOf({ x, y }, place) {
  return { x: partOn(x, place.x), y: partOn(y, place.y) };
}

/**
 * Return an axis with other ends, which keep within what there is.
 * @param {PlaneAxis} axis
 * @param {number} low
 * @param {number} high
 */
export function endedAxis(axis, low, high) {
  const [least, most] = axis.within;
  let [from, to] = [Math.max(least, low), Math.min(most, high)];
  const middle = (from + to) / 2, narrow = Math.max(NARROWEST * Math.abs(middle), SHORTEST);
  if (to - from < narrow) [from, to] = [Math.max(least, middle - narrow / 2), middle + narrow / 2];
  return { ...axis, from, to };
}

/**
 * Return axes seen from nearer or further.
 * @param {PlaneAxes} axes
 * @param {number} factor  below 1 nearer
 * @param {PlanePlace} about  what keeps its place
 * @returns {PlaneAxes}
 */
export function zoomed({ x, y }, factor, about) {
  const one = (/** @type {PlaneAxis} */ axis, /** @type {number} */ value) => {
    const centre = forth(axis, value);
    const end = (/** @type {number} */ at) =>
      back(axis, centre + (forth(axis, at) - centre) * factor);
    return endedAxis(axis, end(axis.from), end(axis.to));
  };
  return { x: one(x, about.x), y: one(y, about.y) };
}

/**
 * Return axes moved so that one place comes to where another was; an end that they have stops the
 * move, so that they keep their lengths.
 * @param {PlaneAxes} axes
 * @param {PlanePlace} from
 * @param {PlanePlace} to
 * @returns {PlaneAxes}
 */
export function panned({ x, y }, from, to) {
  const one = (/** @type {PlaneAxis} */ axis, /** @type {number} */ by) => {
    const [least, low, high, most] =
      [axis.within[0], axis.from, axis.to, axis.within[1]].map((end) => forth(axis, end));
    const shift = Math.min(most - high, Math.max(least - low, by));
    return { ...axis, from: back(axis, low + shift), to: back(axis, high + shift) };
  };
  return { x: one(x, forth(x, from.x) - forth(x, to.x)),
    y: one(y, forth(y, from.y) - forth(y, to.y)) };
}

/**
 * Return what the state takes over: ends that are round numbers, far finer than a pixel.
 * @param {PlaneAxes} axes
 */
export function axesPatch({ x, y }) {
  return Object.fromEntries([x, y].flatMap(({ keys: [low, high], from, to }) => {
    const step = roundStep((to - from) / END_STEPS);
    return [[low, inSteps(from, step)], [high, inSteps(to, step)]];
  }));
}

/**
 * Return the largest of 1, 2 and 5 times a power of ten that is no larger.
 * @param {number} size
 */
function roundStep(size) {
  const power = 10 ** Math.floor(Math.log10(size));
  const lead = size / power >= 5 ? 5 : size / power >= 2 ? 2 : 1;
  return Number(`${lead}e${Math.round(Math.log10(power))}`);
}

/**
 * Return the nearest whole number of steps, without the digits of a product.
 * @param {number} value
 * @param {number} step
 */
function inSteps(value, step) {
  const digits = Math.max(0, -Math.floor(Math.log10(step)));
  return Number((Math.round(value / step) * step).toFixed(Math.min(15, digits))) + 0;
}

/**
 * Return the round step at a value, as large as a pixel at most.
 * @param {PlaneAxis} axis
 * @param {number} value
 * @param {number} pixels  along the axis
 */
export function stepOn({ from, to, log }, value, pixels) {
  const pixel = log ? (Math.max(value, from) * Math.log(to / from)) / pixels : (to - from) / pixels;
  return roundStep(pixel);
}

/**
 * Return a place in round numbers, no coarser than a pixel, within what there is.
 * @param {PlaneAxes} axes
 * @param {PlanePlace} place
 * @param {{ width: number, height: number }} size  of the plane [px]
 */
export function roundPlace({ x, y }, place, { width, height }) {
  const round = (/** @type {PlaneAxis} */ axis, /** @type {number} */ value,
    /** @type {number} */ pixels) => {
    const { least = -Infinity, most = Infinity } = FIELDS[axis.keys[0]];
    return Math.min(most, Math.max(least, inSteps(value, stepOn(axis, value, pixels))));
  };
  return { x: round(x, place.x, width), y: round(y, place.y, height) };
}

/** Return axes as they are shown. @param {PlaneAxes} axes */
export function shownAxes({ x, y }) {
  const shown = (/** @type {PlaneAxis} */ { from, to, log, label, unit, far }) =>
    ({ from: from * unit, to: to * unit, log, label, far });
  return { x: shown(x), y: shown(y) };
}
