// Boundaries of the regions of symmetric steady states, as `compute_region_map` has them.
// They are closed forms of the linear model; the nonlinear model has none.

/** @import { Kernels } from '../kernels/loader.mjs' */

/**
 * Amplitudes that bound the regions, one a frequency ratio.
 * @typedef {object} Boundaries
 * @property {Float64Array} frequencyRatio
 * @property {Float64Array} existence  eq 23: the least amplitude with a symmetric solution
 * @property {Float64Array} sign  eq 24: above it the phase of branch 2 is negative
 * @property {Float64Array} kind  eq 25: above it branch 1 is out of phase
 * @property {Float64Array} symmetryBreaking  where the harmonic motion loses its stability
 * @property {Float64Array} heteroclinic  where the manifolds of the upright saddles touch
 */

/**
 * Return the boundary curves at some frequency ratios.
 * @param {Kernels} kernels
 * @param {ArrayLike<number>} ratios
 * @param {number} restitution
 * @param {number} [order]  1, 3, 5, ...
 * @returns {Boundaries}
 */
export function regionBoundaries(kernels, ratios, restitution, order = 1) {
  const count = ratios.length;
  const w = kernels.array('f', [count], ratios);
  const r = kernels.array('f', [count], new Float64Array(count).fill(restitution));
  const n = kernels.array('i', [count], new BigInt64Array(count).fill(BigInt(order)));
  const curves = kernels.array('f', [5, count]);
  kernels.fill_curves(w, r, n, curves);
  const values = curves.values;
  const [existence, sign, kind, symmetryBreaking, heteroclinic] = [0, 1, 2, 3, 4].map(
    (row) => values.slice(row * count, (row + 1) * count),
  );
  for (const array of [w, r, n, curves]) array.free();
  const frequencyRatio = Float64Array.from(ratios);
  return { frequencyRatio, existence, sign, kind, symmetryBreaking, heteroclinic };
}

/**
 * Return Tso and Wong's region 1 to 5 of an amplitude among three boundaries at its frequency.
 * @param {number} amplitude
 * @param {number} existence
 * @param {number} sign
 * @param {number} kind
 */
export function regionAt(amplitude, existence, sign, kind) {
  if (amplitude < existence || amplitude === 0) return 4;
  if (amplitude > kind) return amplitude < sign ? 1 : 2;
  return amplitude < sign ? 3 : 5;
}
