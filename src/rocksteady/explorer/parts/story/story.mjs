// The story: the landing, and six scenes of one idea each.

/** @import { App } from '../shell/app.mjs' */
import { STANDING, pushOn } from '../physics/push/pushed.mjs';
import { element, sizeOf } from '../shell/app.mjs';
import { STORY } from '../shell/state.mjs';
import { landingBlock, makeLanding } from './landing.mjs';
import { makeCrowd } from './scenes/crowd.mjs';
import { makeFates } from './scenes/fates.mjs';
import { makeOrder } from './scenes/order.mjs';
import { makeSizes } from './scenes/sizes.mjs';
import { makeSwing } from './scenes/swing.mjs';
import { makeWays } from './scenes/ways.mjs';

/** @type {Record<string, (app: App) => unknown>} */
const SCENES = {
  swing: makeSwing, size: makeSizes, fall: makeWays, fates: makeFates, order: makeOrder, quake: makeCrowd,
};
const NEAR = '60% 0px'; // of the window
const SEEN = 0.55; // part of a scene in the window from which the address names it

/**
 * Make the landing at once, and each scene when it comes near the window and there is time.
 * @param {App} app
 * @param {() => Promise<void>} turn  lets the browser do what waits
 */
export async function makeStory(app, turn) {
  // What the first frame needs, a part a turn: the page laid out, kernels compiled.
  sizeOf(/** @type {HTMLCanvasElement} */ (element('stage')));
  await turn();
  pushOn(app.kernels, landingBlock(app.kernels), STANDING, new Float64Array(3));
  await turn();
  makeLanding(app);
  const near = new IntersectionObserver((all) => {
    for (const { target, isIntersecting } of all) {
      const at = target instanceof HTMLElement ? target.dataset.at : undefined;
      if (!isIntersecting || !at) continue;
      near.unobserve(target);
      idle(() => SCENES[at](app));
    }
  }, { rootMargin: NEAR });
  for (const name of Object.keys(SCENES)) near.observe(element(`scene-${name}`));
  const watch = new IntersectionObserver((all) => {
    if (app.state.at === 'lab') return;
    for (const { target, isIntersecting } of all) {
      const at = target instanceof HTMLElement ? target.dataset.at : undefined;
      if (isIntersecting && at && at !== app.state.at) app.set({ at }, { push: false });
    }
  }, { rootMargin: `-${100 * SEEN}% 0px -${100 * (1 - SEEN) - 1}% 0px` });
  for (const name of STORY) watch.observe(element(name === 'push' ? name : `scene-${name}`));
}

/** Do something when the browser has time. @param {() => void} work */
function idle(work) {
  if (typeof requestIdleCallback === 'function') requestIdleCallback(work, { timeout: 400 });
  else setTimeout(work, 30);
}

/** Bring a part of the story into the window. @param {string} at */
export function scrollTo(at) {
  const target = element(at === 'push' ? at : `scene-${at}`);
  target.scrollIntoView({ behavior: 'auto', block: 'start' });
}
