// Steady shaking that is too weak to lift a block, and keeps it rocking all the same.

/** @import { Kernels } from '../../kernels/loader.mjs' */
/** @import { RecordBlock } from '../quake/record.mjs' */
/** @import { Reel } from '../push/falling.mjs' */
import { ATTRACTOR_KINDS } from '../attractor.mjs';
import { settleStates } from '../basins.mjs';
import { harmonicTable } from '../motions.mjs';
import { reelOf } from '../push/falling.mjs';
import { beginOf } from '../start.mjs';

/** @typedef {'rest' | 'rocking' | 'overturned' | 'undecided'} Fate */

export const FATE_SHAKING = { amplitude: 0.5, frequencyRatio: 2, restitution: 0.8 };

/**
 * Return what some states come to, the phase of the shaking being 0: a job of the pool.
 * @param {Kernels} kernels
 * @param {{ alpha: number, angles: ArrayLike<number>, velocities: ArrayLike<number> }} asked
 * @returns {Fate[]}
 */
export function stateFates(kernels, { alpha, angles, velocities }) {
  const given = { ...FATE_SHAKING, nonlinear: false, alpha };
  const { kind } = settleStates(kernels, { given, angles, velocities });
  return Array.from(kind, (code) => {
    const name = ATTRACTOR_KINDS[code];
    return name === 'rest' || name === 'overturned' || name === 'undecided' ? name : 'rocking';
  });
}

/**
 * Film a block under the shaking from a state.
 * @param {Kernels} kernels
 * @param {RecordBlock} block
 * @param {number} angle  theta/alpha
 * @param {number} velocity  du/d(pt)
 * @param {number} seconds
 * @returns {Reel}
 */
export function stateReel(kernels, block, angle, velocity, seconds) {
  const given = { ...FATE_SHAKING, nonlinear: false, alpha: block.alpha };
  const { march } = beginOf(kernels, given, { kind: 'state', angle, velocity });
  return reelOf(kernels, { ...block, ...given }, harmonicTable(kernels, given), seconds, { start: march });
}
