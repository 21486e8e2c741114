// Where the script begins, in the page and in its workers.

/** @import { App } from './app.mjs' */
import { kernels } from '../kernels/loader.mjs';
import { jobs } from '../work/jobs.mjs';
import { makePool } from '../work/pool.mjs';
import { serve } from '../work/worker.mjs';
import { makeStory } from '../story/story.mjs';
import { element, makeApp } from './app.mjs';
import { makeControls } from './controls.mjs';
import { addExamples, addHelp } from './help.mjs';
import { KEY_WORDS, listenToKeys } from './keys.mjs';
import { applyTheme, darkSystem, makeTabs, printInLight, showTab } from './layout.mjs';
import { addMenus } from './menus.mjs';
import { motionsPutIn } from './motions.mjs';
import { placePanels } from './places.mjs';
import { openPlaces } from './rooms.mjs';
import { describePanels } from './tables.mjs';

/** Begin. */
export function start() {
  if (typeof document === 'undefined') serve();
  else openPage().catch(refusal);
}

async function openPage() {
  element('story').hidden = true; // until it is known that it can compute
  if (typeof WebAssembly === 'undefined') throw new Error('this browser has no WebAssembly');
  if (typeof DecompressionStream === 'undefined') throw new Error('this browser is too old');
  const module = await WebAssembly.compile(await unpacked(blockText('kernels')));
  const found = kernels(await WebAssembly.instantiate(module, {}));
  const pool = makePool(module, blockText('program'), (job, args) => jobs[job](found, args));
  const app = makeApp(found, pool, JSON.parse(blockText('first-view')));
  app.motions = motionsPutIn(blockText('motions'));
  applyTheme(app);
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
  makeControls(app);
  await turn();
  await placePanels(app, turn);
  addExamples(app);
  addMenus(app);
  addHelp(app, KEY_WORDS);
  listenToKeys(app);
  describePanels(app);
  await turn();
  let { tab } = app.state;
  document.addEventListener('state', () => {
    if (app.state.tab !== tab) showTab(app);
    ({ tab } = app.state);
  });
  showTab(app);
  app.touch(...Object.keys(app.state)); // no panel knows the state yet
  app.set({}, { push: false });
}

/** Let the browser do what waits: no task of the opening takes long. @returns {Promise<void>} */
function turn() {
  return new Promise((done) => {
    setTimeout(done);
  });
}

/** @param {string} id @returns {string} */
function blockText(id) {
  return element(id).textContent ?? '';
}

/**
 * Return the bytes of a compressed block.
 * @param {string} text  base64 of gzip
 */
async function unpacked(text) {
  const bytes = Uint8Array.from(atob(text.trim()), (letter) => letter.charCodeAt(0));
  const plain = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Response(plain).arrayBuffer();
}

/** Say why the page cannot compute; a still picture stays. @param {unknown} error */
function refusal(error) {
  console.error(error);
  document.documentElement.dataset.ready = 'false';
  element('story').hidden = element('refusal').hidden = false;
  element('cause').textContent = error instanceof Error ? error.message : String(error);
}
