// Where the script begins, in the page and in its workers.

/** @import { App } from './app.mjs' */
import { makeBench } from '../bench/bench.mjs';
import { jobs } from '../work/jobs.mjs';
import { makePool } from '../work/pool.mjs';
import { serve } from '../work/worker.mjs';
import { warmUp } from '../panels/point/followed.mjs';
import { makeStory } from '../story/story.mjs';
import { element, makeApp } from './app.mjs';
import { makeControls } from './controls.mjs';
import { addExamples, addHelp } from './help.mjs';
import { KEY_WORDS, listenToKeys } from './keys.mjs';
import { applyTheme, darkSystem, makeTabs, onBench, printInLight, showTab } from './layout.mjs';
import { addMenus } from './menus.mjs';
import { motionsPutIn } from './motions.mjs';
import { blockText, openKernels, refusal } from './opening.mjs';
import { placePanels } from './places.mjs';
import { openPlaces } from './rooms.mjs';
import { ROOMS } from './state.mjs';
import { describePanels } from './tables.mjs';

/** Begin. */
export function start() {
  if (typeof document === 'undefined') serve(jobs);
  else {
    element('story').hidden = true; // until it is known that it can compute
    turn().then(openPage).catch(refusal);
  }
}

async function openPage() {
  const { module, found } = await openKernels();
  const pool = makePool(module, blockText('program'), (job, args) => jobs[job](found, args));
  await turn();
  const app = makeApp(found, pool, JSON.parse(blockText('first-view')));
  app.motions = motionsPutIn(blockText('motions'));
  applyTheme(app);
  await turn();
  await openPlaces(app, { story: () => makeStory(app, turn), lab: () => openLab(app) });
  darkSystem().addEventListener('change', () => applyTheme(app));
  let { look } = app.state;
  document.addEventListener('state', () => {
    if (app.state.look !== look) applyTheme(app);
    ({ look } = app.state);
  });
  printInLight(app);
  app.set({}, { push: false });
  document.documentElement.dataset.ready = 'true';
}

/** Make the laboratory. @param {App} app */
async function openLab(app) {
  makeTabs(app);
  showTab(app);
  await turn();
  makeBench(app);
  listenToKeys(app);
  element('back').addEventListener('click', () => app.set({ tab: ROOMS[app.state.tab] }));
  /** @type {Promise<void> | undefined} */
  let panels;
  let { tab } = app.state;
  const show = () => (onBench(tab) ? undefined : (panels ??= openPanels(app)));
  document.addEventListener('state', () => {
    if (app.state.tab === tab) return;
    ({ tab } = app.state);
    showTab(app);
    show();
  });
  await show();
}

/** Make the panels of the other questions and of researchers. @param {App} app */
async function openPanels(app) {
  makeControls(app);
  await turn();
  await warmUp(app, turn);
  await placePanels(app, turn);
  addExamples(app);
  addMenus(app);
  addHelp(app, KEY_WORDS);
  describePanels(app);
  await turn();
  showTab(app);
  app.touch('history', ...Object.keys(app.state)); // no panel knows the state yet
  app.set({}, { push: false });
}

/** Let the browser do what waits: no task of the opening takes long. @returns {Promise<void>} */
function turn() {
  return new Promise((done) => {
    setTimeout(done);
  });
}
