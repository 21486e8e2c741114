// 3. Two ways to fall: at once, or after an impact; between them stronger is safer.

/** @import { App } from '../../shell/app.mjs' */
/** @import { Area } from '../draw.mjs' */
/** @import { Reel } from '../../physics/push/falling.mjs' */
/** @import { PulseFates } from '../../physics/demand/pulse.mjs' */
/** @import { Cell } from '../strips.mjs' */
import { evaluate } from '../../physics/case.mjs';
import { FATE } from '../../physics/demand/pulse.mjs';
import { fatesAsked, pulseReel, pulseShape, rectangle } from '../../physics/story/pulses.mjs';
import { element } from '../../shell/app.mjs';
import { drawGround, inArea, write } from '../draw.mjs';
import { NARROW, drawHistory, drawReel, makePlayer, reelShape, sceneOf, tieSlider } from '../scene.mjs';
import { drawHandle, drawStrip } from '../strips.mjs';
import { NEVER_LIFTS, STANDS, fallName } from '../../words.mjs';
import { dragOn, makeView } from '../view.mjs';
import { gText, impactText } from '../words.mjs';

export const WAYS = { width: 0.25, height: 1, restitution: 0.8, frequency: 2.16 }; // [m], [Hz]
const SECONDS = 3, WEAKEST = 0.1, STRONGEST = 1.4; // [g]
const CELLS = 260;

/**
 * Return the answer of a run.
 * @param {{ falls: boolean, peak: number, impacts: number }} run  impacts: until it falls
 * @param {number} weaker  strength [g] of a weaker push that fells it; nan where none is known
 */
export function waysAnswer({ falls, peak, impacts }, weaker) {
  if (peak === 0) return `It ${NEVER_LIFTS}.`;
  if (falls) return impacts > 1 ? `It falls after ${impactText(impacts)}.` : `It ${fallName(impacts)}.`;
  if (weaker > 0) return `It stands, though a weaker push of ${gText(weaker)} fells it.`;
  return 'It rocks and stands.';
}

/** Return how many impacts come before a fall, or in all. @param {Reel} reel */
export function impactsBefore({ impacts, overturns }) {
  return impacts.time.filter((time) => overturns === null || time < overturns).length;
}

/** Make the scene. @param {App} app */
export function makeWays(app) {
  const { canvas, answer } = sceneOf('fall'), { kernels } = app;
  const block = rectangle(kernels, WAYS.width, WAYS.height, WAYS.restitution);
  const lift = evaluate(kernels, 'tan', block.alpha);
  const strengths = Array.from({ length: CELLS }, (_, k) =>
    WEAKEST + ((k + 0.5) / CELLS) * (STRONGEST - WEAKEST));
  /** @type {Reel} */
  let reel;
  /** @type {Cell[]} */
  let cells = [];
  /** @type {PulseFates | undefined} */
  let fates;
  /** @type {Area | null} */
  let strip = null;
  /** @type {Area | null} */
  let history = null;

  const speak = () => {
    let weaker = NaN;
    fates?.status.forEach((code, k) => {
      if (code === FATE.overturned && strengths[k] < app.state.strength) weaker = strengths[k];
    });
    answer(waysAnswer({ ...reel, impacts: impactsBefore(reel) }, weaker));
  };
  const go = () => {
    reel = pulseReel(kernels, block, app.state.strength, WAYS.frequency, SECONDS);
    speak();
  };
  const view = makeView(canvas, (pen, width, height) => {
    const { theme } = app, narrow = width < NARROW, high = (narrow ? 0.36 : 0.66) * height;
    const wide = (narrow ? 1 : 0.42) * width, y = Math.round(0.84 * high);
    const unit = Math.min(0.8 * high, 0.44 * wide, 300), x = 0.5 * wide;
    drawGround(pen, theme, { width: wide, height: Math.min(26, high - y), y, x, unit });
    drawReel(pen, theme, reel, player.time, { x, y, unit, shape: reelShape(reel) });
    history = drawHistory(pen, theme, reel, player.time, {
      seconds: SECONDS,
      area: narrow ? [14, high + 10, width - 28, 0.28 * height] : [wide + 24, 16, width - wide - 38, high - 40],
      base: (time) => pulseShape(time * WAYS.frequency),
    });
    const area = /** @type {Area} */ ([14, 0.8 * height, width - 28, 0.11 * height]);
    const [left, top, length, tall] = strip = area;
    const across = (/** @type {number} */ g) => left + ((g - WEAKEST) / (STRONGEST - WEAKEST)) * length;
    write(pen, theme, 'what it does, over the strength of the push', left, top - 26);
    const handle = across(app.state.strength);
    if (cells.length) drawStrip(pen, theme, cells, area, handle);
    for (const g of [0.2, 0.4, 0.6, 0.8, 1, ...(narrow ? [] : [1.2]), STRONGEST]) {
      const last = g === STRONGEST, text = `${g.toFixed(1)}${last ? ' g' : ''}`;
      write(pen, theme, text, across(g), top + tall + 16, { role: 'quiet', align: last ? 'right' : 'center' });
    }
    drawHandle(pen, theme, handle, area);
  });
  const player = makePlayer(app, view, SECONDS, () => [reel]);

  tieSlider(app, 'strength', {
    text: gText,
    change: () => {
      go();
      player.play();
    },
  });
  go();
  element('go-fall').addEventListener('click', player.play);
  dragOn(canvas,
    (x, y) => (inArea(strip, x, y, 18) ? 'strength' : inArea(history, x, y) ? 'time' : null),
    (what, x, _, done) => {
      const [left, , width] = /** @type {Area} */ (what === 'time' ? history : strip);
      const part = Math.max(0, Math.min(1, (x - left) / width));
      if (what === 'time') player.seek(part * SECONDS);
      else {
        const strength = Number((WEAKEST + part * (STRONGEST - WEAKEST)).toFixed(3));
        app.set({ strength }, { settled: done, push: false });
      }
    });
  const pulses = strengths.map((strength) => ({ strength, frequency: WAYS.frequency }));
  app.pool.ask('pulseFates', fatesAsked(block, pulses), { key: 'story:fall' }).then((found) => {
    fates = /** @type {PulseFates} */ (found);
    cells = strengths.map((strength, k) => {
      if (found.status[k] === FATE.overturned) {
        return { name: 'overturned', words: found.impacts[k]
          ? [fallName(1), 'after an impact', 'after'] : [fallName(0), 'at once'] };
      }
      return strength > lift ? { name: 'rocking', words: [STANDS] } : { name: 'rest', words: [NEVER_LIFTS] };
    });
    speak();
    view.ask();
  });
  return view;
}
