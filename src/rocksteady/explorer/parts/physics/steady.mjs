// Symmetric steady states in closed form at a point, with their Floquet multipliers.

import { impactOf, steadySolutions } from './start.mjs';

/** @import { Kernels } from '../kernels/loader.mjs' */
/** @import { Case } from './case.mjs' */
/** @import { Impact, Solution } from './start.mjs' */

/**
 * @typedef {object} SteadyFacts
 * @property {number} order  half periods of the shaking in a half cycle: 1 harmonic, 3 the 1/3
 * @property {number} branch  1 or 2
 * @property {'stable'|'neutral'|'unstable'|'inadmissible'} worth
 * @property {number} peak  theta/alpha
 * @property {Impact} state  at which its positive half begins
 * @property {[number, number][]} half  multipliers of the half cycle, the larger first
 * @property {[number, number][]} multipliers  of the whole orbit: their squares
 */

/**
 * Return all symmetric steady states of the linear model at a point, of some orders.
 * @param {Kernels} kernels
 * @param {Case} given
 * @param {number[]} [orders]
 * @returns {SteadyFacts[]}
 */
export function steadyStatesAt(kernels, given, orders = [1, 3]) {
  /** @type {SteadyFacts[]} */
  const found = [];
  for (const order of orders) {
    const { region, branches } = steadySolutions(kernels, given, order);
    if (region === 4) continue;
    branches.forEach((solution, k) => {
      const half = halfMultipliers(solution.trace, given.restitution);
      const [half_cycles, phase] = kernels.clock(solution.phase);
      const side = solution.velocity < 0 ? -1 : 1;
      found.push({
        order,
        branch: k + 1,
        worth: worthOf(solution),
        peak: solution.peak,
        state: impactOf({ side, half_cycles, phase, speed: Math.abs(solution.velocity) }),
        half,
        multipliers: half.map(squaredPair),
      });
    });
  }
  return found;
}

/**
 * @param {Solution} solution
 * @returns {SteadyFacts['worth']}
 */
function worthOf({ admissible, stable, neutral }) {
  if (!admissible) return 'inadmissible';
  return neutral ? 'neutral' : stable ? 'stable' : 'unstable';
}

/**
 * Return the roots of m^2 - trace m + restitution^2, as `SteadyStates.multipliers` has them.
 * @param {number} trace
 * @param {number} restitution
 * @returns {[number, number][]}
 */
export function halfMultipliers(trace, restitution) {
  const half = 0.5 * trace, product = restitution * restitution, size = Math.abs(half);
  if (size >= restitution) {
    const ratio = restitution / size, root = size * Math.sqrt((1 - ratio) * (1 + ratio));
    const large = half + (half < 0 ? -root : root);
    return [[large, 0], [product / large, 0]];
  }
  const turn = Math.sqrt(Math.max(product - half * half, 0));
  return [[half, turn], [half, -turn]];
}

/**
 * @param {[number, number]} value
 * @returns {[number, number]}
 */
function squaredPair([real, imaginary]) {
  return [real * real - imaginary * imaginary, 2 * real * imaginary];
}
