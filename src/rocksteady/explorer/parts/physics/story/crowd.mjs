// A cabinet in an earthquake, and its 26 neighbours, as `rocksteady.check_neighbours` has them.

/** @import { Kernels } from '../../kernels/loader.mjs' */
/** @import { GroundMotion } from '../motions.mjs' */
/** @import { RecordBlock } from '../quake/record.mjs' */
/** @import { Reel } from '../push/falling.mjs' */
import { GRAVITY } from '../case.mjs';
import { recordTable, scaledMotion } from '../motions.mjs';
import { reelOf } from '../push/falling.mjs';
import { neighbourCases } from '../quake/record.mjs';

/**
 * Film a block and its neighbours in a motion, the block itself first: a job of the pool.
 * @param {Kernels} kernels
 * @param {{ motion: GroundMotion, block: RecordBlock, scale: number, seconds: number }} asked
 * @returns {Reel[]}
 */
export function crowdReels(kernels, { motion, block, scale, seconds }) {
  const cases = [{ scale: 1, block }, ...neighbourCases(kernels, block)];
  return cases.map(({ scale: factor, block: body }) => {
    const shaken = scaledMotion(motion, scale * factor);
    const table = recordTable(kernels, shaken, body.nonlinear, body.p, body.alpha * GRAVITY);
    return reelOf(kernels, body, table, seconds);
  });
}
