// 4. One shaking, two fates: the basins under the finger, and the block dropped into one.

/** @import { App } from '../../shell/app.mjs' */
/** @import { Area, Role } from '../draw.mjs' */
/** @import { Fate } from '../../physics/story/fates.mjs' */
/** @import { Reel } from '../../physics/push/falling.mjs' */
import { GRAVITY } from '../../physics/case.mjs';
import { FATE_SHAKING, stateFates, stateReel } from '../../physics/story/fates.mjs';
import { rectangle } from '../../physics/story/pulses.mjs';
import { START_WINDOW } from '../../kernels/window.mjs';
import { cellMiddles } from '../../physics/basins.mjs';
import { fillClass } from '../../draw/classes.mjs';
import { element } from '../../shell/app.mjs';
import { drawCurve, drawGround, drawLine, drawRing, inArea, write } from '../draw.mjs';
import { NARROW, drawReel, makePlayer, reelShape, sceneOf, tieSlider } from '../scene.mjs';
import { MOTION_NAMES, motionWords, shareWords } from '../../words.mjs';
import { dragOn, makeView } from '../view.mjs';

const { angle: WIDE, velocity: FAST, columns: COLUMNS, rows: ROWS } = START_WINDOW;
const TILTS = cellMiddles(-WIDE, WIDE, COLUMNS), SPEEDS = cellMiddles(-FAST, FAST, ROWS);
const SECONDS = 12, BATCH = 12; // rows of one job
const FARTHEST = 1.1; // of the start
/** @type {Record<Fate, string>} */
const ANSWERS = {
  rest: `${MOTION_NAMES.rest}, though the ground goes on`,
  rocking: motionWords({ kind: 'symmetric', period: 1 }),
  overturned: MOTION_NAMES.overturned,
  undecided: motionWords({ kind: 'undecided', period: null }),
};

/** @type {readonly Fate[]} */
const FATES = ['rest', 'rocking', 'overturned', 'undecided'];
/** Word of a region, its colour and that below it. @type {Record<Fate, [string, Role, Role]>} */
const WORDS = {
  rest: [MOTION_NAMES.rest, 'ink', 'rest'], rocking: [MOTION_NAMES.symmetric, 'onRocks', 'rocks'],
  overturned: [MOTION_NAMES.overturned, 'onFalls', 'falls'], undecided: ['', 'ink', 'paper'],
};
const WORD = 48; // [px] half of the widest word
const LEAST_ROOM = 10; // [px] of a region on each side of its word's middle
const CLEAR = [28, 30]; // [px] from the middle of a word to the curve and the ring: across, up

/**
 * Return where the regions have most room for a word off a curve.
 * @param {Fate[]} fates
 * @param {Reel} reel  the curve
 * @param {number[]} reach  how far a word keeps off it: across, up
 */
function regionWords(fates, { angle, velocity }, [far, high]) {
  // What words keep off: the curve and, at 1.5 times the distance, each other.
  const taken = Array.from(angle, (u, k) => [u, velocity[k], 1]);
  const clear = (/** @type {number} */ row, /** @type {number} */ column) => taken.every(([u, v, times]) =>
    Math.abs(u - TILTS[column]) > times * far || Math.abs(v - SPEEDS[row]) > times * high);
  return FATES.filter((fate) => fates.includes(fate)).map((fate) => {
    const at = (/** @type {number} */ row, /** @type {number} */ column) => row >= 0 && row < ROWS
      && column >= 0 && column < COLUMNS && fates[row * COLUMNS + column] === fate;
    let best = { room: 0, row: 0, column: 0 };
    for (let row = 0; row < ROWS; row++) {
      for (let column = 0; column < COLUMNS; column++) {
        let half = 0;
        while (at(row, column - half) && at(row, column + half) && at(row - half, column) && at(row + half, column)) half++;
        if (half > best.room && clear(row, column)) best = { room: half, row, column };
      }
    }
    taken.push([TILTS[best.column], SPEEDS[best.row], 1.5]);
    return { fate, ...best };
  });
}

/** Make the scene. @param {App} app */
export function makeFates(app) {
  const { canvas, answer } = sceneOf('fates'), { kernels } = app;
  const block = rectangle(kernels, 0.3, 1, FATE_SHAKING.restitution);
  const hertz = (FATE_SHAKING.frequencyRatio * block.p) / (2 * Math.PI);
  const travel = (FATE_SHAKING.amplitude * block.alpha * GRAVITY) / (2 * Math.PI * hertz) ** 2; // [m]
  /** @type {Reel} */
  let reel;
  /** @type {(Fate | undefined)[]} */
  const fates = new Array(COLUMNS * ROWS);
  /** @type {ReturnType<typeof regionWords>} */
  let words = [];
  let placed = ''; // for which start and size they are
  /** @type {Area | null} */
  let plane = null;

  /** @type {Fate} */
  let fate;
  const tell = () => {
    const falls = fates.filter((each) => each === 'overturned').length;
    const share = fates.includes(undefined) ? '' : `; ${shareWords(falls, fates.length)}`;
    answer(`From here it ${ANSWERS[fate]}${share}.`);
  };
  const go = () => {
    const { su: u, sv: v } = app.state;
    [fate] = stateFates(kernels, { alpha: block.alpha, angles: [u], velocities: [v] });
    reel = stateReel(kernels, block, u, v, SECONDS);
    tell();
  };
  const view = makeView(canvas, (pen, width, height) => {
    const { theme, state } = app, narrow = width < NARROW;
    const wide = (narrow ? 0.24 : 0.3) * width, y = Math.round((narrow ? 0.8 : 0.72) * height);
    const unit = Math.min((narrow ? 1.1 : 0.62) * wide, 0.5 * height, 260), turn = 2 * Math.PI * hertz * player.time;
    const x = 0.5 * wide - travel * Math.sin(turn) * unit;
    drawGround(pen, theme, { width: wide, height: 30, y, x, unit });
    drawReel(pen, theme, reel, player.time, { x, y, unit, shape: reelShape(reel) });
    const left = wide + 44, high = height - 62, top = 26;
    const side = narrow ? high : Math.min(width - left - 10, high);
    plane = [left, top, width - left - 10, side];
    const area = plane, across = (/** @type {number} */ u) => left + ((u / WIDE + 1) / 2) * area[2];
    const up = (/** @type {number} */ v) => top + ((1 - v / FAST) / 2) * side;
    drawFates(pen, area);
    pen.save();
    pen.beginPath();
    pen.rect(...area);
    pen.clip();
    const { angle, velocity, step } = reel, count = Math.floor(player.time / step);
    const place = (/** @type {number} */ k) => /** @type {const} */ ([across(angle[k]),
      up(velocity[k])]);
    drawCurve(pen, theme, count, place, { role: 'paper', width: 4 });
    drawCurve(pen, theme, count, place, { role: 'motion', width: 1.75 });
    pen.restore();
    drawWords(pen, area);
    for (const mark of [-1, 0, 1]) {
      const tilt = ((180 / Math.PI) * mark * block.alpha).toFixed(0);
      write(pen, theme, `${tilt}°`, across(mark), top + side + 16, { role: 'quiet', align: 'center' });
      const rate = (180 / Math.PI) * mark * block.alpha * block.p;
      write(pen, theme, `${rate.toFixed(0)}`, left - 6, up(mark) + 4, { role: 'quiet', align: 'right' });
    }
    write(pen, theme, 'tilt at the start', left + area[2], top + side + 32, { align: 'right' });
    write(pen, theme, 'speed at the start [°/s]', left - 34, top - 10);
    drawRing(pen, theme, across(state.su), up(state.sv));
  });

  /** @param {CanvasRenderingContext2D} pen @param {Area} area */
  const drawFates = (pen, [left, top, width, height]) => {
    const { theme } = app, step = width / COLUMNS, tall = height / ROWS;
    for (const fate of FATES) {
      pen.beginPath();
      for (let row = 0; row < ROWS; row++) {
        for (let from = 0; from < COLUMNS; from++) {
          if (fates[row * COLUMNS + from] !== fate) continue;
          let to = from;
          while (to < COLUMNS && fates[row * COLUMNS + to] === fate) to++;
          pen.rect(left + from * step, top + height - (row + 1) * tall, (to - from) * step + 0.4, tall + 0.4);
          from = to;
        }
      }
      pen.save();
      pen.clip();
      fillClass(pen, theme, fate, { left, top, width, height });
      pen.restore();
    }
    drawLine(pen, theme, [left, top + height, left + width, top + height], 'ink');
    drawLine(pen, theme, [left, top, left, top + height], 'ink');
  };
  /** @param {CanvasRenderingContext2D} pen @param {Area} area */
  const drawWords = (pen, [left, top, width, height]) => {
    if (fates.includes(undefined)) return;
    const { su, sv } = app.state, now = [su, sv, width, height].join();
    if (now !== placed) {
      const clear = [(2 * WIDE * CLEAR[0]) / width, (2 * FAST * CLEAR[1]) / height];
      words = regionWords(/** @type {Fate[]} */ (fates), reel, clear);
      placed = now;
    }
    for (const { fate: each, column, row, room } of words) {
      if ((room * width) / COLUMNS < LEAST_ROOM) continue;
      const x = Math.min(left + width - WORD, Math.max(left + WORD, left + ((column + 0.5) / COLUMNS) * width)), y = top + (1 - (row + 0.5) / ROWS) * height;
      const [word, role, over] = WORDS[each], how = { bold: true, align: /** @type {const} */ ('center'), role, over };
      write(pen, app.theme, word, x, y + 4, how);
    }
  };
  const player = makePlayer(app, view, SECONDS, () => [reel]);
  const change = () => {
    go();
    player.play();
  };
  const degrees = (180 / Math.PI) * block.alpha;
  tieSlider(app, 'su', { text: (u) => `${(degrees * u).toFixed(1)}°`, change });
  tieSlider(app, 'sv', { text: (v) => `${(degrees * block.p * v).toFixed(0)} °/s`, change });
  go();
  element('go-fates').addEventListener('click', player.play);
  dragOn(canvas, (x, y) => (inArea(plane, x, y, 4) ? 'start' : null), (_, x, y, done) => {
    const [left, top, width, height] = /** @type {Area} */ (plane);
    const within = (/** @type {number} */ part, /** @type {number} */ reach) =>
      Number(Math.max(-FARTHEST, Math.min(FARTHEST, (2 * part - 1) * reach)).toFixed(3));
    app.set({ su: within((x - left) / width, WIDE), sv: within(1 - (y - top) / height, FAST) },
      { settled: done, push: false });
  });
  for (let row = 0; row < ROWS; row += BATCH) {
    const places = Array.from({ length: BATCH * COLUMNS }, (_, k) => k);
    const asked = {
      alpha: block.alpha, angles: places.map((k) => TILTS[k % COLUMNS]),
      velocities: places.map((k) => SPEEDS[row + Math.floor(k / COLUMNS)]),
    };
    app.pool.ask('stateFates', asked, { key: `story:fates${row}`, priority: 2 }).then((found) => {
      found.forEach((/** @type {Fate} */ each, /** @type {number} */ k) => { fates[row * COLUMNS + k] = each; });
      if (!fates.includes(undefined)) tell();
      view.ask();
    });
  }
  return view;
}
