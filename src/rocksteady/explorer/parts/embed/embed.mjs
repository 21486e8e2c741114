// One scene of the story as a page of its own: its entries, its jobs, and nothing else.

/** @import { Kernels } from '../kernels/loader.mjs' */
/** @import { App } from '../shell/app.mjs' */
import { element, makeApp } from '../shell/app.mjs';
import { applyTheme, darkSystem, setOn } from '../shell/layout.mjs';
import { blockText, openKernels, refusal } from '../shell/opening.mjs';
import { turnSound } from '../story/sound.mjs';
import { makePool } from '../work/pool.mjs';
import { serve } from '../work/worker.mjs';

/** @typedef {Record<string, (kernels: Kernels, args: any) => unknown>} Jobs */

/**
 * Open a scene, or serve its jobs in a worker.
 * @param {string} scene
 * @param {(app: App) => unknown} make
 * @param {Jobs} [jobs]
 */
export function embed(scene, make, jobs = {}) {
  if (typeof document === 'undefined') serve(jobs);
  else open(scene, make, jobs).catch(refusal);
}

/** @param {string} scene @param {(app: App) => unknown} make @param {Jobs} jobs */
async function open(scene, make, jobs) {
  const { module, found } = await openKernels();
  const run = (/** @type {string} */ job, /** @type {unknown} */ args) => jobs[job](found, args);
  const app = makeApp(found, makePool(module, blockText('program'), run), JSON.parse(blockText('first-view')));
  setOn(document.documentElement, 'data-at', scene);
  applyTheme(app);
  darkSystem().addEventListener('change', () => applyTheme(app));
  element('sound').addEventListener('click', ({ currentTarget }) => {
    setOn(/** @type {Element} */ (currentTarget), 'aria-pressed', String(turnSound()));
  });
  make(app);
  document.documentElement.dataset.ready = 'true';
}
