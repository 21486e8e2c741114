// The story: the landing, and six scenes of one idea each.

/** @import { App } from '../shell/app.mjs' */
import { element } from '../shell/app.mjs';
import { STORY } from '../shell/state.mjs';
import { makeLanding } from './landing.mjs';
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
const SEEN = 0.55; // part of a scene in the window from which the address names it

/**
 * Make the landing at once, and each scene in a turn of its own.
 * @param {App} app
 * @param {() => Promise<void>} turn
 */
export async function makeStory(app, turn) {
  makeLanding(app);
  for (const make of Object.values(SCENES)) {
    await turn();
    make(app);
  }
  const watch = new IntersectionObserver((all) => {
    if (app.state.at === 'lab') return;
    for (const { target, isIntersecting } of all) {
      const at = target instanceof HTMLElement ? target.dataset.at : undefined;
      if (isIntersecting && at && at !== app.state.at) app.set({ at }, { push: false });
    }
  }, { rootMargin: `-${100 * SEEN}% 0px -${100 * (1 - SEEN) - 1}% 0px` });
  for (const name of STORY) watch.observe(element(name === 'push' ? name : `scene-${name}`));
}

/** Bring a part of the story into the window. @param {string} at */
export function scrollTo(at) {
  const target = element(at === 'push' ? at : `scene-${at}`);
  target.scrollIntoView({ behavior: 'auto', block: 'start' });
}
