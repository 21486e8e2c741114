// Blocks of many sizes against one demand in engineering units: does each stand, and how far does
// it rock; each the same bits as `simulate` in Python.
import { evaluate, GRAVITY, rectangleOf, sidesOf } from '../case.mjs';
import { harmonicTable, pulseTable, recordTable, scaledMotion } from '../motions.mjs';
import { fateOf } from '../run.mjs';
import { runFromRest } from './run.mjs';

/** @import { Floats, Kernels } from '../../kernels/loader.mjs' */
/** @import { SampledRun } from './run.mjs' */
/** @import { Measures, Sizes } from '../case.mjs' */

/**
 * What shakes the base.  Accelerations in g of 9.80665 m/s2, frequencies in Hz.
 * @typedef {{ kind: 'pulse', shape: string, level: number, hertz: number }
 *   | { kind: 'harmonic', level: number, hertz: number, cycles: number }
 *   | { kind: 'record', dt: number, acceleration: ArrayLike<number>, scale: number }} Demand
 *   acceleration [m/s2] at steps of dt [s]
 */

/**
 * How blocks rock: restitution null stands for Housner's of each slenderness.
 * @typedef {{ demand: Demand, restitution: number | null, nonlinear: boolean }} Design
 */

export const DESIGN_FATE = { stands: 0, overturns: 1, undecided: 2, impossible: 3 };
const DESIGN_FLIGHTS = 100000;

/**
 * Return a demand as a block feels it, A and Omega; nothing of a record.
 * @param {Demand} demand
 * @param {Measures} block
 * @returns {{ amplitude: number, frequencyRatio: number }}
 */
export function feltBy(demand, block) {
  if (demand.kind === 'record') return { amplitude: NaN, frequencyRatio: NaN };
  const amplitude = (demand.level * GRAVITY) / (block.alpha * GRAVITY);
  return { amplitude, frequencyRatio: (2 * Math.PI * demand.hertz) / block.p };
}

/**
 * Return the table of a demand in the units of a block; free it.
 * @param {Kernels} kernels
 * @param {Demand} demand
 * @param {Measures} block
 * @param {boolean} nonlinear
 * @returns {Floats}
 */
function demandTable(kernels, demand, block, nonlinear) {
  const { amplitude, frequencyRatio } = feltBy(demand, block);
  if (demand.kind === 'pulse') {
    return pulseTable(kernels, demand.shape, amplitude, frequencyRatio, { nonlinear });
  }
  if (demand.kind === 'harmonic') {
    return harmonicTable(kernels, { amplitude, frequencyRatio, nonlinear });
  }
  const motion = { samples: Float64Array.from(demand.acceleration), dt: demand.dt };
  const scaled = scaledMotion(motion, demand.scale);
  return recordTable(kernels, scaled, nonlinear, block.p, block.alpha * GRAVITY);
}

/**
 * Return the tables with which a block marches; free both.
 * @param {Kernels} kernels
 * @param {Design} design
 * @param {Measures} block
 * @param {number} restitution
 */
function tablesOf(kernels, { demand, nonlinear }, block, restitution) {
  const given = { amplitude: 1, frequencyRatio: 1, restitution, nonlinear, alpha: block.alpha };
  return { segments: demandTable(kernels, demand, block, nonlinear), sides: sidesOf(kernels, given) };
}

/** @param {Demand} demand */
function marchLimits(demand) {
  return { cycles: demand.kind === 'harmonic' ? demand.cycles : undefined, most: DESIGN_FLIGHTS };
}

/** @param {string} status */
function designFate(status) {
  if (status === 'overturned') return DESIGN_FATE.overturns;
  return status === 'undecided' || status.startsWith('lost') ? DESIGN_FATE.undecided
    : DESIGN_FATE.stands;
}

/**
 * Return how blocks fare.
 * @param {Kernels} kernels
 * @param {Design & { sizes: Sizes[] }} given
 * @returns {{ fates: Uint8Array, peaks: Float64Array }}  codes of DESIGN_FATE, and the largest
 *   |theta|/alpha of what stands (of the rest: nan)
 */
export function designCells(kernels, { sizes, ...design }) {
  const fates = new Uint8Array(sizes.length).fill(DESIGN_FATE.impossible);
  const peaks = new Float64Array(sizes.length).fill(NaN);
  sizes.forEach((each, k) => {
    const block = rectangleOf(kernels, each), restitution = design.restitution ?? block.housner;
    if (!(restitution > 0)) return;
    const tables = tablesOf(kernels, design, block, restitution);
    const { status, peak } = fateOf(kernels, tables, marchLimits(design.demand));
    tables.segments.free();
    tables.sides.free();
    fates[k] = designFate(status);
    if (fates[k] === DESIGN_FATE.stands) peaks[k] = peak;
  });
  return { fates, peaks };
}

/**
 * Return the run of one block, and its numbers.
 * @param {Kernels} kernels
 * @param {Design & { sizes: Sizes, samples?: number, until?: number }} given
 * @returns {{ block: Measures & { restitution: number, uplift: number }, fate: number,
 *   run: SampledRun | null }}  uplift [g]: tan(alpha); alpha if linear
 */
export function designRun(kernels, { sizes, samples, until, ...design }) {
  const block = rectangleOf(kernels, sizes), restitution = design.restitution ?? block.housner;
  const uplift = design.nonlinear ? evaluate(kernels, 'tan', block.alpha) : block.alpha;
  const known = { ...block, restitution, uplift };
  if (!(restitution > 0)) return { block: known, fate: DESIGN_FATE.impossible, run: null };
  const tables = tablesOf(kernels, design, block, restitution);
  const run = runFromRest(kernels, tables, { ...marchLimits(design.demand), samples, until });
  tables.segments.free();
  tables.sides.free();
  return { block: known, fate: designFate(run.status), run };
}

/**
 * Return what becomes of a block under slightly other demands, and of slightly other blocks.
 * @param {Kernels} kernels
 * @param {Design & { width: number, height: number }} given
 * @returns {{ change: string, fate: number, peak: number }[]}
 */
export function designNeighbours(kernels, { width, height, ...given }) {
  const { demand, restitution } = given;
  const scaled = /** @param {number} by @returns {Demand} */ (by) => demand.kind === 'record'
    ? { ...demand, scale: by * demand.scale } : { ...demand, level: by * demand.level };
  const own = restitution ?? rectangleOf(kernels, { width, height }).housner;
  /** @type {[string, Partial<Design & { width: number, height: number }>][]} */
  const changes = [
    ['demand +10 %', { demand: scaled(1.1) }], ['demand −10 %', { demand: scaled(0.9) }],
    ['width −10 %', { width: 0.9 * width }], ['width +10 %', { width: 1.1 * width }],
    ['height −10 %', { height: 0.9 * height }], ['height +10 %', { height: 1.1 * height }],
    ['restitution −0.03', { restitution: own - 0.03 }],
    ['restitution +0.03', { restitution: Math.min(own + 0.03, 1) }],
  ];
  if (demand.kind !== 'record') {
    changes.push(['frequency −10 %', { demand: { ...demand, hertz: 0.9 * demand.hertz } }],
      ['frequency +10 %', { demand: { ...demand, hertz: 1.1 * demand.hertz } }]);
  }
  return changes.map(([change, other]) => {
    const { width: b, height: h, ...design } = { width, height, ...given, ...other };
    const { fate, run } = designRun(kernels, { ...design, sizes: { width: b, height: h } });
    return { change, fate, peak: run ? run.peak : NaN };
  });
}
