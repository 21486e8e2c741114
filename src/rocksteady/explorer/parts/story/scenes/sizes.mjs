// 2. Big ones stand: three blocks of one shape, one push.

/** @import { App } from '../../shell/app.mjs' */
/** @import { Area } from '../draw.mjs' */
/** @import { Reel } from '../../physics/push/falling.mjs' */
/** @import { Cell } from '../strips.mjs' */
import { GRAVITY } from '../../physics/case.mjs';
import { FATE } from '../../physics/demand/pulse.mjs';
import { fatesAsked, pulsePlace, pulseReel, rectangle } from '../../physics/story/pulses.mjs';
import { element } from '../../shell/app.mjs';
import { drawGround, inArea, write } from '../draw.mjs';
import { drawReel, makePlayer, reelShape, sceneOf, tieSlider } from '../scene.mjs';
import { drawHandle, drawStrip } from '../strips.mjs';
import { dragOn, makeView } from '../view.mjs';

export const HEIGHTS = [0.5, 1, 2], SLIM = 4; // [m]; height over width
export const SIZES_STRENGTH = 0.45; // [g]
const SECONDS = 5, SHORTEST = 0.12, LONGEST = 2.4; // [s]
const CELLS = 140;
const LOW = 480; // [px] below which the picture needs its height for captions

/** Return the answer of three fates, the smallest block first. @param {readonly boolean[]} falls */
export function sizesAnswer(falls) {
  const count = falls.filter(Boolean).length;
  if (count === 0) return 'All three stand.';
  if (count === 3) return 'Too long for all three: even the largest falls.';
  const first = falls[0] && (count === 1 || falls[1]);
  if (first && count === 1) return 'Only the smallest falls. The other two stand.';
  if (first) return 'The two small ones fall. The largest stands.';
  const names = HEIGHTS.filter((_, k) => falls[k]).map((height) => `${height} m`);
  return `Of the three falls: ${names.join(', ')}.`;
}

/** Make the scene. @param {App} app */
export function makeSizes(app) {
  const { canvas, answer } = sceneOf('size'), { kernels } = app;
  const blocks = HEIGHTS.map((height) => rectangle(kernels, height / SLIM, height));
  /** @type {Reel[]} */
  let reels = [];
  /** @type {Cell[][]} */
  const strips = [[], [], []];
  /** @type {Area | null} */
  let strip = null;
  const span = Math.log(LONGEST / SHORTEST);
  const lengthAt = (/** @type {number} */ part) => SHORTEST * Math.exp(span * Math.min(1, Math.max(0, part)));
  const partOf = (/** @type {number} */ length) => Math.log(length / SHORTEST) / span;

  const go = () => {
    const frequency = 1 / app.state.length;
    reels = blocks.map((block) => pulseReel(kernels, block, SIZES_STRENGTH, frequency, SECONDS));
    answer(sizesAnswer(reels.map(({ falls }) => falls)));
  };
  const view = makeView(canvas, (pen, width, height) => {
    const { theme } = app, { length } = app.state, y = Math.round((height < LOW ? 0.5 : 0.58) * height);
    const unit = Math.min((0.9 * y) / 2.1, width / 5.8), low = Math.max(34, Math.round(0.06 * height));
    const gone = SIZES_STRENGTH * GRAVITY * length * length * pulsePlace(player.time / length);
    const shift = Math.min(0.3, gone) * unit;
    drawGround(pen, theme, { width, height: low, y, x: shift, unit });
    [0.14, 0.36, 0.66].forEach((part, k) => {
      const x = part * width + shift, shape = reelShape(reels[k]);
      drawReel(pen, theme, reels[k], player.time, { x, y, unit, shape, width: 2.25 });
      write(pen, theme, `${HEIGHTS[k]} m`, x, y + low - 7, { size: 13, align: 'center', bold: true });
    });
    const area = /** @type {Area} */ ([46, 0.75 * height, width - 60, 0.17 * height]);
    const [left, top, wide, high] = strip = area;
    write(pen, theme, 'what each does, over the length of the push', left, top - 24);
    const handle = left + partOf(length) * wide;
    strips.forEach((cells, k) => {
      const row = top + (k * high) / 3;
      write(pen, theme, `${HEIGHTS[k]} m`, left - 8, row + high / 6 + 4, { align: 'right' });
      drawStrip(pen, theme, cells, [left, row, wide, high / 3 - 2], handle);
    });
    for (const length of [0.2, 0.5, 1, 2]) {
      write(pen, theme, `${length} s`, left + partOf(length) * wide, top + high + 16, { role: 'quiet', align: 'center' });
    }
    drawHandle(pen, theme, handle, area);
  });
  const player = makePlayer(app, view, SECONDS, () => reels);

  tieSlider(app, 'length', {
    text: (length) => `${length.toFixed(2)} s`,
    change: () => {
      go();
      player.play();
    },
  });
  go();
  element('go-size').addEventListener('click', player.play);
  dragOn(canvas, (x, y) => (inArea(strip, x, y, 16) ? 'length' : null), (_, x, __, done) => {
    const [left, , width] = /** @type {Area} */ (strip);
    app.set({ length: Number(lengthAt((x - left) / width).toFixed(3)) }, { settled: done, push: false });
  });
  blocks.forEach(async (block, row) => {
    const pulses = Array.from({ length: CELLS }, (_, k) =>
      ({ strength: SIZES_STRENGTH, frequency: 1 / lengthAt((k + 0.5) / CELLS) }));
    const found = await app.pool.ask('pulseFates', fatesAsked(block, pulses), { key: `story:size${row}` });
    strips[row] = Array.from(found.status, (code) => (code === FATE.overturned
      ? { name: 'overturned', words: ['falls'] } : { name: 'rocking', words: ['stands'] }));
    view.ask();
  });
  return view;
}
