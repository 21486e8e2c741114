// 5. Order ends: the cascade, and two blocks a hair apart.

/** @import { App } from '../../shell/app.mjs' */
/** @import { Area } from '../draw.mjs' */
/** @import { Cascade, Order } from '../../physics/story/order.mjs' */
import { ORDER_PERIODS, ORDER_RATIO, ORDER_RESTITUTION } from '../../physics/story/order.mjs';
import { rectangle } from '../../physics/story/pulses.mjs';
import { drawCurve, drawLine, drawRing, inArea, write } from '../draw.mjs';
import { sceneOf, tieSlider } from '../scene.mjs';
import { motionWords } from '../../words.mjs';
import { dragOn, makeView } from '../view.mjs';

const FIRST = 2, LAST = 2.75, COUNT = 301; // amplitudes over alpha g
const LOWEST = -8; // power of ten of a distance
const TOP = 1.5; // |theta|/alpha

/**
 * Return the answer at an amplitude.
 * @param {Order} order
 * @param {number} period  of the shaking [s]
 */
export function orderAnswer({ kind, period: repeats, parted }, period) {
  if (kind !== 'aperiodic') return `It ${motionWords({ kind, period: repeats })}.`;
  if (parted === null) return `It never repeats; two blocks part slowly, over more than ${ORDER_PERIODS} periods.`;
  return 'It never repeats: two blocks a millionth apart differ by a tenth of the tipping angle after '
    + `${parted} periods, ${(parted * period).toFixed(0)} s.`;
}

/** Make the scene. @param {App} app */
export function makeOrder(app) {
  const { canvas, answer } = sceneOf('order');
  const block = rectangle(app.kernels, 0.5, 2, ORDER_RESTITUTION);
  const period = (2 * Math.PI) / (ORDER_RATIO * block.p); // [s]
  /** @type {Cascade | null} */
  let cascade = null;
  /** @type {Order | null} */
  let order = null;
  /** @type {Area | null} */
  let strip = null;

  const go = async () => {
    if (!cascade) return;
    const { shake } = app.state, { amplitudes, starts, falls } = cascade;
    const place = amplitudes.filter((amplitude) => amplitude <= shake).length - 1;
    if (falls !== null && shake >= falls) {
      order = { kind: 'overturned', period: 0, lyapunov: NaN, apart: [], parted: null };
    } else {
      const asked = { amplitude: shake, start: starts[Math.max(0, place)] };
      const found = await app.pool.ask('orderAt', asked, { key: 'story:order' });
      if (!found) return;
      order = found;
    }
    answer(orderAnswer(/** @type {Order} */ (order), period));
    view.ask();
  };
  const view = makeView(canvas, (pen, width, height) => {
    const { theme, state } = app, left = 40, wide = width - left - 14, middle = 0.56 * height;
    const across = (/** @type {number} */ a) => left + ((a - FIRST) / (LAST - FIRST)) * wide;
    const up = (/** @type {number} */ angle) => middle - (angle / TOP) * (middle - 30);
    write(pen, theme, 'largest tilt over the tipping angle', 4, 14);
    for (const angle of [0, 0.5, 1]) {
      drawLine(pen, theme, [left, up(angle), left + wide, up(angle)], angle === 1 ? 'ink' : 'hair', 1, angle === 1 ? [5, 4] : []);
      write(pen, theme, String(angle), left - 6, up(angle) + 4, { role: 'quiet', align: 'right' });
    }
    write(pen, theme, 'tipping angle', left + 6, up(1) - 5);
    pen.fillStyle = theme.motion;
    cascade?.peaks.forEach((peaks, k) => {
      const x = across(/** @type {Cascade} */ (cascade).amplitudes[k]);
      for (const peak of peaks) pen.fillRect(x - 0.6, up(peak) - 0.6, 1.6, 1.6);
    });
    if (cascade?.falls) {
      const x = across(cascade.falls);
      write(pen, theme, 'falls', Math.min(x + 4, left + wide - 18), 40, { bold: true });
      drawLine(pen, theme, [x, 30, x, middle], 'ink', 1, [5, 4]);
    }
    strip = [left, 20, wide, middle - 10];
    const g = (/** @type {number} */ a) => (a * block.alpha).toFixed(2);
    for (const a of [2, 2.25, 2.5, 2.75]) {
      write(pen, theme, `${g(a)}${a === 2.75 ? ' g' : ''}`, across(a), middle + 18, { role: 'quiet', align: a === 2 ? 'left' : a === 2.75 ? 'right' : 'center' });
    }
    const x = across(state.shake);
    drawLine(pen, theme, [x, 24, x, middle], 'ink', 1, [1, 4]);
    drawRing(pen, theme, x, middle);
    if (order) drawApart(pen, order, [left, middle + 64, wide, height - middle - 92]);
  });

  /** @param {CanvasRenderingContext2D} pen @param {Order} order @param {Area} area */
  const drawApart = (pen, { apart, kind }, [left, top, width, height]) => {
    const { theme } = app, across = (/** @type {number} */ k) => left + (k / ORDER_PERIODS) * width;
    const up = (/** @type {number} */ power) => top + (Math.max(LOWEST, power) / LOWEST) * height;
    write(pen, theme, 'how far two blocks are apart that began a millionth apart', 4, top - 14);
    for (const power of [0, -2, -4, -6, LOWEST]) {
      drawLine(pen, theme, [left, up(power), left + width, up(power)], 'hair');
      const text = power ? `10${[...String(-power)].map((digit) => '⁰¹²³⁴⁵⁶⁷⁸⁹'[Number(digit)]).join('').replace(/^/, '⁻')}` : '1';
      write(pen, theme, text, left - 6, up(power) + 4, { role: 'quiet', align: 'right' });
    }
    drawCurve(pen, theme, apart.length, (k) => [across(k), up(Math.log10(Math.max(apart[k], 1e-12)))],
      { role: 'motion', width: 2.2 });
    write(pen, theme, '0', left, top + height + 16, { role: 'quiet' });
    write(pen, theme, `${ORDER_PERIODS} periods of the shaking`, left + width, top + height + 16, { role: 'quiet', align: 'right' });
    if (kind === 'overturned') write(pen, theme, 'it falls before', left + 8, top + height / 2);
  };

  tieSlider(app, 'shake', { text: (a) => `${(a * block.alpha).toFixed(4)} g`, change: go });
  dragOn(canvas, (x, y) => (inArea(strip, x, y, 8) ? 'shake' : null), (_, x, __, done) => {
    const [left, , width] = /** @type {Area} */ (strip);
    const part = Math.max(0, Math.min(1, (x - left) / width));
    app.set({ shake: Number((FIRST + part * (LAST - FIRST)).toFixed(4)) }, { settled: done, push: false });
  });
  const amplitudes = Array.from({ length: COUNT }, (_, k) => FIRST + (k * (LAST - FIRST)) / (COUNT - 1));
  app.pool.ask('cascadeOf', { amplitudes }, { key: 'story:cascade', priority: 1 }).then((found) => {
    cascade = found;
    go();
  });
  return view;
}
