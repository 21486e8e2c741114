// 1. It does not swing: the period depends on the tilt, the energy goes at impacts alone.

/** @import { App } from '../../shell/app.mjs' */
/** @import { Area } from '../draw.mjs' */
/** @import { Swing } from '../../physics/story/swing.mjs' */
import { letGo, restitutionHeard, rockTimes } from '../../physics/story/swing.mjs';
import { element } from '../../shell/app.mjs';
import { say } from '../../shell/layout.mjs';
import { shapeOf } from '../../panels/scene.mjs';
import { drawBlock, drawCurve, drawGround, drawLine, drawRing, inArea, write } from '../draw.mjs';
import { landingBlock } from '../landing.mjs';
import { NARROW, drawHistory, drawReel, makePlayer, sceneOf, tieSlider } from '../scene.mjs';
import { heard } from '../sound.mjs';
import { dragOn, makeView } from '../view.mjs';
import { degreeText } from '../words.mjs';

const SECONDS = 5, LONGEST_ROCK = 1.8, PENDULUM = 1.1; // [s]
const FIFTH = 4;

/** Make the scene. @param {App} app */
export function makeSwing(app) {
  const { canvas, answer } = sceneOf('swing'), block = landingBlock(app.kernels);
  const shape = shapeOf(0.3, 1), times = rockTimes(app.kernels, block);
  /** @type {Swing} */
  let swing;
  let holding = false, taps = /** @type {number[]} */ ([]);
  let pivot = [0, 0];
  /** @type {Area | null} */
  let handle = null;
  /** @type {Area | null} */
  let history = null;

  const go = () => {
    swing = letGo(app.kernels, block, app.state.tilt, SECONDS);
    const { rocks } = swing;
    answer(`From impact to impact the first rock takes ${rocks[0].toFixed(2)}\u00a0s, `
      + `the fifth ${rocks[FIFTH].toFixed(2)}\u00a0s.`);
  };
  const view = makeView(canvas, (pen, width, height) => {
    const { theme } = app, narrow = width < NARROW;
    const wide = narrow ? width : 0.42 * width, high = narrow ? 0.52 * height : height;
    const unit = Math.min(0.66 * high, 0.8 * wide, 340), x = 0.5 * wide, y = Math.round(0.88 * high);
    const still = !player.playing && player.time >= SECONDS;
    drawGround(pen, theme, { width: wide, height: Math.min(40, high - y), y, x, unit });
    const at = { x, y, unit, shape };
    const angle = app.state.tilt * block.alpha;
    if (still || holding) drawBlock(pen, theme, shape, { ...at, angle });
    else drawReel(pen, theme, swing.reel, player.time, at);
    if (still || holding) {
      pivot = [x - shape.halfWidth * unit, y];
      const [cos, sin] = [Math.cos(angle), Math.sin(angle)], b = 2 * shape.halfWidth;
      const corner = [pivot[0] + (b * cos - sin) * unit, y - (b * sin + cos) * unit];
      drawRing(pen, theme, corner[0], corner[1]);
      handle = [corner[0] - 26, corner[1] - 26, 52, 52];
    } else handle = null;
    history = drawHistory(pen, theme, swing.reel, player.time, {
      seconds: SECONDS,
      area: narrow ? [14, high + 22, width - 28, height - high - 48]
        : [wide + 40, 10, width - wide - 60, 0.42 * height],
    });
    if (!narrow) drawTimes(pen, [wide + 40, 0.6 * height, width - wide - 60, 0.3 * height]);
  });
  const player = makePlayer(app, view, SECONDS, () => [swing.reel]);

  /** @param {CanvasRenderingContext2D} pen @param {Area} area */
  const drawTimes = (pen, [left, top, width, height]) => {
    const { theme } = app, low = top + height;
    const across = (/** @type {number} */ tilt) => left + tilt * width;
    const up = (/** @type {number} */ time) => low - (time / LONGEST_ROCK) * height;
    drawLine(pen, theme, [left, top, left, low], 'ink');
    drawLine(pen, theme, [left, low, left + width, low], 'ink');
    for (const time of [0.5, 1, 1.5]) {
      drawLine(pen, theme, [left, up(time), left + width, up(time)], 'hair');
      write(pen, theme, String(time), left - 8, up(time) + 4, { role: 'quiet', align: 'right' });
    }
    for (const tilt of [0, 0.25, 0.5, 0.75, 1]) {
      write(pen, theme, degreeText(tilt * block.alpha), across(tilt), low + 17, { role: 'quiet', align: 'center' });
    }
    write(pen, theme, 'time from impact to impact [s]', left - 14, top - 12);
    write(pen, theme, 'tilt it reaches', left + width, low + 34, { align: 'right' });
    pen.save();
    pen.beginPath();
    pen.rect(left, top - 4, width, height + 4);
    pen.clip();
    drawCurve(pen, theme, times.length, (k) => [across(times[k].tilt), up(times[k].time)], { role: 'ink', width: 1.25 });
    pen.restore();
    drawLine(pen, theme, [left, up(PENDULUM), left + width, up(PENDULUM)], 'quiet', 1, [2, 3]);
    write(pen, theme, 'a pendulum: always the same', across(0.04), up(PENDULUM) - 6, { role: 'quiet' });
    const { time } = swing.reel.impacts, { angle, step } = swing.reel;
    for (let k = 1; k < time.length && time[k] <= player.time; k++) {
      let top = 0;
      for (let j = Math.ceil(time[k - 1] / step); j * step < time[k]; j++) top = Math.max(top, Math.abs(angle[j]));
      pen.beginPath();
      pen.arc(across(top), up(time[k] - time[k - 1]), 4.5, 0, 2 * Math.PI);
      pen.fillStyle = theme.motion;
      pen.fill();
    }
    drawRing(pen, theme, across(app.state.tilt), up(Math.min(LONGEST_ROCK, 2 * swing.quarter)), 7);
  };

  tieSlider(app, 'tilt', {
    text: (tilt) => degreeText(tilt * block.alpha),
    change: () => {
      go();
      player.seek(SECONDS);
    },
  });
  go();
  element('go-swing').addEventListener('click', () => {
    taps = [];
    player.play();
  });
  dragOn(canvas,
    (x, y) => (inArea(handle, x, y) ? 'tilt' : inArea(history, x, y) ? 'time' : null),
    (what, x, y, done) => {
      if (what === 'time') {
        const [left, , width] = /** @type {Area} */ (history);
        player.seek(((x - left) / width) * SECONDS);
        return;
      }
      // The upper right corner is as far from the pivot as the diagonal is long.
      const turned = Math.atan2(pivot[1] - y, x - pivot[0]) - (0.5 * Math.PI - block.alpha);
      holding = !done;
      app.set({ tilt: Math.round(1000 * Math.max(0.05, Math.min(0.98, turned / block.alpha))) / 1000 },
        { settled: done, push: false });
      if (done) player.play();
    });
  element('hear').addEventListener('click', () => {
    taps.push(performance.now() / 1000);
    const found = restitutionHeard(app.kernels, block, taps);
    const text = found === null ? `${taps.length} heard${heard() ? '' : '; the sound is off'}`
      : `by your ear ${found.toFixed(2)}; Housner ${block.restitution.toFixed(2)}`;
    say(element('ear'), text);
  });
  return view;
}
