// 6. An earthquake: a verdict with its 26 neighbours, and why engineers give probabilities.

/** @import { App } from '../../shell/app.mjs' */
/** @import { Area } from '../draw.mjs' */
/** @import { Reel } from '../../physics/push/falling.mjs' */
import { GRAVITY } from '../../physics/case.mjs';
import { peakOf } from '../../physics/quake/record.mjs';
import { syntheticMotion } from '../../physics/quake/synthetic.mjs';
import { rectangle } from '../../physics/story/pulses.mjs';
import { element } from '../../shell/app.mjs';
import { drawCurve, drawLine, inArea, write } from '../draw.mjs';
import { drawReel, makePlayer, reelShape, sceneOf, tieSlider } from '../scene.mjs';
import { dragOn, makeView } from '../view.mjs';
import { gText } from '../words.mjs';

export const CABINET = { width: 0.6, height: 2 }; // [m]
const SECONDS = 10, ACROSS = 9, MIDDLE = 13; // cabinets in a row, place of the reader's own

/**
 * Return the answer of some fates.
 * @param {boolean} own  whether the cabinet itself falls
 * @param {number} others  of its neighbours that do
 * @param {number} all  of its neighbours
 */
export function crowdAnswer(own, others, all) {
  const alike = own ? others : all - others, fate = own ? 'falls' : 'stands';
  if (alike === all) return `It ${fate}, and so do all its neighbours.`;
  const rest = own ? `${all - others} of its ${all} neighbours stand` : `${others} of its ${all} neighbours fall`;
  return `Yours ${fate}, but ${rest}. That is why engineers give probabilities.`;
}

/** Make the scene. @param {App} app */
export function makeCrowd(app) {
  const { canvas, answer } = sceneOf('quake'), { kernels } = app;
  const block = rectangle(kernels, CABINET.width, CABINET.height);
  const motion = syntheticMotion(), peak = peakOf(motion);
  /** @type {Reel[]} */
  let reels = [];
  /** @type {Area | null} */
  let course = null;

  let shaken = false;
  const speak = () => {
    const [own, ...others] = reels;
    answer(shaken && own ? crowdAnswer(own.falls, others.filter(({ falls }) => falls).length, others.length)
      : 'All stand. Shake the ground.');
  };
  const go = async () => {
    const scale = (app.state.pga * GRAVITY) / peak, { samples, dt } = motion;
    const asked = { motion: { samples, dt }, block, scale, seconds: SECONDS };
    const found = await app.pool.ask('crowdReels', asked, { key: 'story:crowd' });
    if (!found) return;
    reels = /** @type {Reel[]} */ (found);
    speak();
    view.ask();
  };
  const view = makeView(canvas, (pen, width, height) => {
    const { theme } = app, left = 14, wide = width - 28, { samples, dt } = motion;
    const across = (/** @type {number} */ time) => left + (time / SECONDS) * wide;
    write(pen, theme, 'ground acceleration, made by a formula', left, 14, { role: 'base', bold: true });
    write(pen, theme, gText(app.state.pga), left + wide, 14, { role: 'base', align: 'right' });
    drawCurve(pen, theme, samples.length, (k) => [across(k * dt), 54 - (28 * samples[k]) / peak],
      { role: 'base', width: 1.25 });
    drawLine(pen, theme, [across(player.time), 20, across(player.time), 88], 'ink', 2);
    course = [left, 20, wide, 68];
    if (!reels.length) return;
    const top = 100, row = (height - 76 - top) / 3, column = wide / ACROSS;
    const unit = Math.min((0.8 * row) / 2.1, (0.72 * column) / 2.1);
    for (let k = 1; k <= 3; k++) {
      drawLine(pen, theme, [left, top + k * row - 6, left + wide, top + k * row - 6], 'edge', 1.5);
    }
    const [own, ...others] = reels, order = [...others.slice(0, MIDDLE), own, ...others.slice(MIDDLE)];
    order.forEach((reel, k) => {
      const x = left + ((k % ACROSS) + 0.5) * column, y = top + (Math.floor(k / ACROSS) + 1) * row - 7;
      drawReel(pen, theme, reel, player.time, { x, y, unit, shape: reelShape(reel), width: 1.5, flashes: false });
      if (reel !== own) return;
      drawLine(pen, theme, [x - 0.3 * column, y + 3, x + 0.3 * column, y + 3], 'ink', 5);
      write(pen, theme, 'yours', x, y + 19, { size: 13, bold: true, align: 'center' });
    });
    drawShare(pen, order, [left, height - 44, wide, 16]);
  });

  /** @param {CanvasRenderingContext2D} pen @param {Reel[]} all @param {Area} area */
  const drawShare = (pen, all, [left, top, width, height]) => {
    const { theme } = app, { time } = player;
    theme.riskRamp.forEach((colour, k) => {
      pen.fillStyle = colour;
      pen.fillRect(left + (k * width) / 5, top, width / 5, height);
    });
    pen.strokeStyle = theme.edge;
    pen.lineWidth = 1;
    pen.strokeRect(left, top, width, height);
    const fell = all.filter(({ falls, overturns }) => falls && (overturns ?? 0) <= time).length;
    const x = left + (fell / all.length) * width;
    drawLine(pen, theme, [x, top - 5, x, top + height + 5], 'paper', 7);
    drawLine(pen, theme, [x, top - 5, x, top + height + 5], 'ink', 3);
    write(pen, theme, 'share that fell', left, top - 8, { role: 'risk', bold: true });
    write(pen, theme, `${fell} of ${all.length} fell`, left + width, top - 8, { align: 'right' });
    for (const part of [0, 20, 40, 60, 80, 100]) {
      const align = part === 0 ? 'left' : part === 100 ? 'right' : 'center';
      write(pen, theme, `${part} %`, left + (part / 100) * width, top + height + 17, { role: 'quiet', align });
    }
  };
  const player = makePlayer(app, view, SECONDS, () => []);
  tieSlider(app, 'pga', {
    text: gText,
    change: () => {
      shaken = true;
      player.seek(SECONDS);
      go();
    },
  });
  element('go-quake').addEventListener('click', () => {
    shaken = true;
    player.play();
    speak();
  });
  dragOn(canvas, (x, y) => (inArea(course, x, y, 6) ? 'time' : null), (_, x) => {
    const [left, , width] = /** @type {Area} */ (course);
    shaken = true;
    player.seek(((x - left) / width) * SECONDS);
    speak();
  });
  player.time = 0;
  speak();
  go();
  return view;
}
