// Jobs on recorded motions.

/** @typedef {import('../kernels/loader.mjs').Kernels} Kernels */
import { scaledMotion } from '../physics/motions.mjs';
import { fatesOverScales, rockingSpectrum, runNeighbours, runRecord }
  from '../physics/quake/record.mjs';
import { readMotion } from '../physics/quake/recordfile.mjs';

/** @type {Record<string, (kernels: Kernels, args: any) => unknown>} */
export const recordJobs = {
  recordRead: (kernels, file) => readMotion(kernels, file),
  recordRun: (kernels, { motion, block, scale, points }) =>
    runRecord(kernels, scaledMotion(motion, scale), block, points),
  recordNeighbours: (kernels, { motion, scale, cases }) =>
    runNeighbours(kernels, scaledMotion(motion, scale), cases),
  recordScales: (kernels, { motion, block, values }) =>
    fatesOverScales(kernels, motion, block, values),
  recordSpectrum: (kernels, { motion, block, scale, values }) =>
    rockingSpectrum(kernels, motion, block, values, scale),
};
