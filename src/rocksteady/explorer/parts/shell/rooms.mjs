// The two rooms of the page, the story and the laboratory: one is seen, and made when it is first.

/** @import { App } from './app.mjs' */
import { turnSound } from '../story/sound.mjs';
import { scrollTo } from '../story/story.mjs';
import { labState } from '../story/tolab.mjs';
import { element } from './app.mjs';
import { say, setOn } from './layout.mjs';

/** @typedef {'story' | 'lab'} Room */

/**
 * Show the room of the state, now and whenever it changes.
 * @param {App} app
 * @param {Record<Room, () => Promise<void>>} make
 */
export async function openPlaces(app, make) {
  /** @type {Partial<Record<Room, Promise<void>>>} */
  const made = {};
  let jumps = app.state.at !== 'push'; // whether the next place is to be scrolled to
  const show = async () => {
    const { at } = app.state, room = at === 'lab' ? 'lab' : 'story';
    const other = room === 'lab' ? 'story' : 'lab', changed = element(room).hidden;
    element(room).hidden = false;
    element(other).hidden = true;
    setOn(document.documentElement, 'data-at', at);
    setOn(element('skip'), 'href', room === 'lab' ? '#lab' : '#scene-swing');
    say(element('skip'), room === 'lab' ? 'Skip to the laboratory' : 'Skip to the six ideas');
    for (const link of document.querySelectorAll('#places nav a')) {
      const here = (link.getAttribute('data-to') === 'lab') === (room === 'lab') && at !== 'push';
      if (here) link.setAttribute('aria-current', 'true');
      else link.removeAttribute('aria-current');
    }
    await (made[room] ??= make[room]());
    if (room === 'lab' && changed) scrollToTop();
    if (room === 'story' && (changed || jumps) && (jumps || at !== 'push')) scrollTo(at);
    jumps = false;
  };
  document.addEventListener('click', (event) => {
    const link = event.target instanceof Element ? event.target.closest('[data-to], [data-lab]') : null;
    if (!link || event.ctrlKey || event.metaKey || event.shiftKey) return;
    event.preventDefault();
    const scene = link.getAttribute('data-lab'), at = link.getAttribute('data-to');
    jumps = true;
    if (scene) app.set({ ...labState(app, scene), at: 'lab' });
    else if (at === app.state.at) show();
    else app.set({ at });
  });
  addEventListener('popstate', () => { jumps = true; });
  document.addEventListener('state', (event) => {
    if (/** @type {CustomEvent} */ (event).detail.changed.includes('at')) show();
  });
  element('sound').addEventListener('click', ({ currentTarget }) => {
    setOn(/** @type {Element} */ (currentTarget), 'aria-pressed', String(turnSound()));
  });
  const dark = () => document.documentElement.dataset.look === 'dark';
  const name = () => say(element('shade'), dark() ? 'Light' : 'Dark');
  element('shade').addEventListener('click', () => app.set({ look: dark() ? 'light' : 'dark' }, { push: false }));
  document.addEventListener('theme', name);
  name();
  await show();
}

function scrollToTop() {
  scroll({ top: 0, behavior: 'auto' });
}
