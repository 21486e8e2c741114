// Every job that a worker runs, by its name.

/** @import { Kernels } from '../kernels/loader.mjs' */
import { attractorOf } from '../physics/attractor.mjs';
import { labelStates, settleStates } from '../physics/basins.mjs';
import { endingsOf } from '../physics/coexisting.mjs';
import { designCells, designNeighbours, designRun } from '../physics/demand/design.mjs';
import { pulseFates, pulseHistory } from '../physics/demand/pulse.mjs';
import { pulseWindows } from '../physics/demand/windows.mjs';
import { baseReel } from '../physics/push/falling.mjs';
import { historyOf, longSection } from '../physics/history.mjs';
import { releasedRun, rockCurve, startCells } from '../physics/released.mjs';
import { shakenCells, shakenRun, sizeCells, widthTurn } from '../physics/shake.mjs';
import { crowdReels } from '../physics/story/crowd.mjs';
import { stateFates } from '../physics/story/fates.mjs';
import { cascadeOf, orderAt } from '../physics/story/order.mjs';
import { steadyCurves, sweepSteps } from '../physics/sweep.mjs';
import { mapTile } from '../physics/tiles.mjs';
import { recordJobs } from './recordjobs.mjs';

const SETTLING_CYCLES = 2000; // as `rocksteady.find_attractor` follows by default
const SETTLED_FLIGHTS = 100_000;

/** @type {Record<string, (kernels: Kernels, args: any) => unknown>} */
export const jobs = {
  baseReel,
  cascadeOf,
  crowdReels,
  designCells: (kernels, asked) => timed(() => designCells(kernels, asked)),
  designNeighbours,
  designRun,
  endings: endingsOf,
  followMotion: (kernels, { given, start, cycles }) => ({
    attractor: attractorOf(kernels, given, start, SETTLING_CYCLES),
    history: historyOf(kernels, given, start, cycles, SETTLED_FLIGHTS),
  }),
  labelStates: (kernels, { given, cells }) => labelStates(kernels, given, cells),
  longSection,
  mapTile: (kernels, request) => timed(() => mapTile(kernels, request)),
  orderAt,
  pulseFates: (kernels, asked) => timed(() => pulseFates(kernels, asked)),
  pulseHistory,
  pulseWindows,
  ...recordJobs,
  releasedRun,
  rockCurve,
  shakenCells,
  shakenRun,
  sizeCells,
  startCells,
  widthTurn,
  settleStates: (kernels, asked) => timed(() => settleStates(kernels, asked)),
  stateFates,
  steadyCurves,
  sweepSteps,
};

/**
 * Return a result with the milliseconds that it took, by which further jobs are cut.
 * @template {object} Result
 * @param {() => Result} work
 */
function timed(work) {
  const began = performance.now();
  const result = work();
  return { ...result, ms: performance.now() - began };
}
