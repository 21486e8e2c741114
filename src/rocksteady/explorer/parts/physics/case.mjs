// The block and its shaking as the kernels see them: tables of sides, starts, measures.

/** @import { Floats, Kernels, System } from '../kernels/loader.mjs' */

/**
 * A block under harmonic shaking.
 * @typedef {object} Case
 * @property {number} amplitude  A = a_max / (alpha g)
 * @property {number} frequencyRatio  Omega = omega / p
 * @property {number} restitution  velocity after an impact over that before it
 * @property {boolean} nonlinear  whether the full equation of motion holds
 * @property {number} alpha  slenderness [rad], of which the nonlinear model takes notice
 */

/**
 * Where a motion starts; the phase of the shaking is 0 at rest and in a state.
 * @typedef {{ kind: 'rest' } | { kind: 'steady' }
 *   | { kind: 'state', angle: number, velocity: number }
 *   | { kind: 'impact', side: number, phase: number, speed: number }} Start
 */

/**
 * A homogeneous rectangle.
 * @typedef {object} Measures
 * @property {number} alpha  slenderness [rad]
 * @property {number} radius  half-diagonal [m]
 * @property {number} p  frequency parameter [rad/s]
 * @property {number} housner  restitution that conserves angular momentum
 */

/**
 * A rectangle by width and height, or by slenderness [rad] and half-diagonal; lengths in m.
 * @typedef {{ width: number, height: number } | { alpha: number, radius: number }} Sizes
 */

export const GRAVITY = 9.80665; // [m/s2]
export const COUNTED = 1e-6; // least |du/d(pt)| after an impact that counts (kernels/core/tables.py)

/** Room for single numbers. @type {WeakMap<Kernels, Floats[]>} */
const numberRooms = new WeakMap();
/** The block measured last. @type {WeakMap<Kernels, { width: number, height: number, found: Measures }>} */
const measured = new WeakMap();

// What a step of the nonlinear model may leave out: 1e-5 of the default tolerance (nonlinear_tables.py).
const LEFT_OUT = 1e-5 * 1e-10;

/**
 * Return the side table of a case, shape (2, 3), or (2, 5) in the nonlinear model; free it.
 * @param {Kernels} kernels
 * @param {Case} given
 * @returns {Floats}
 */
export function sidesOf(kernels, given) {
  const side = [given.restitution, 1, 1];
  if (given.nonlinear) side.push(given.alpha, LEFT_OUT);
  return kernels.array('f', [2, side.length], [...side, ...side]);
}

/**
 * Return the shaking of a case seen from both sides of its block.
 * @param {Kernels} kernels
 * @param {Case} given
 * @returns {System}
 */
export function systemOf(kernels, given) {
  const sides = sidesOf(kernels, given);
  const system = kernels.make_system(given.amplitude, given.frequencyRatio, sides);
  sides.free();
  return system;
}

/**
 * Return the value of an elementary function of the kernels, as `evaluate(kernels, 'sin', x)`.
 * @param {Kernels} kernels
 * @param {'exp'|'log'|'sin'|'cos'|'tan'|'atan2'|'hypot'} name
 * @param {...number} values
 * @returns {number}
 */
export function evaluate(kernels, name, ...values) {
  let room = numberRooms.get(kernels);
  if (!room) {
    room = [1, 2, 3].map(() => kernels.array('f', [1]));
    numberRooms.set(kernels, room);
  }
  const [out, first, second] = room, call = /** @type {any} */ (kernels)[`fill_${name}`];
  [first.values[0], second.values[0]] = [values[0], values[1] ?? 0];
  if (values.length === 1) call(first, out);
  else call(first, second, out);
  return out.values[0];
}

/**
 * Return the values of an elementary function of the kernels, in one call.
 * @param {Kernels} kernels
 * @param {'exp'|'log'|'log1p'|'next_up'|'sin'} name
 * @param {ArrayLike<number>} values
 * @returns {Float64Array}
 */
export function evaluateEach(kernels, name, values) {
  const given = kernels.array('f', [values.length], values);
  const out = kernels.array('f', [values.length]);
  kernels[/** @type {'fill_exp'} */ (`fill_${name}`)](given, out);
  const found = out.values.slice();
  given.free();
  out.free();
  return found;
}

/**
 * Return the measures of a rectangle, as `Block.rectangle` and `Block.from_radius` have them.
 * @param {Kernels} kernels
 * @param {Sizes} sizes
 * @returns {Measures}
 */
export function rectangleOf(kernels, sizes) {
  const given = 'width' in sizes;
  const alpha = given ? evaluate(kernels, 'atan2', sizes.width, sizes.height) : sizes.alpha;
  const radius = given ? 0.5 * evaluate(kernels, 'hypot', sizes.width, sizes.height) : sizes.radius;
  const p = Math.sqrt((0.75 * GRAVITY) / radius), sine = evaluate(kernels, 'sin', alpha);
  return { alpha, radius, p, housner: 1 - 2 * ((p * p * radius) / GRAVITY) * (sine * sine) };
}

/**
 * Return the measures of a rectangle, those of the last one without computing them again.
 * @param {Kernels} kernels
 * @param {number} width  full width [m]
 * @param {number} height  full height [m]
 * @returns {Measures}
 */
export function measuresOf(kernels, width, height) {
  const known = measured.get(kernels);
  if (known?.width === width && known.height === height) return known.found;
  const found = Object.freeze(rectangleOf(kernels, { width, height }));
  measured.set(kernels, { width, height, found });
  return found;
}
