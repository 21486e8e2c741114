// The picture of the basins: fills of the attractors, their marks, and one orbit.

/** @import { App } from '../../shell/app.mjs' */
/** @import { Pen } from '../../draw/svg.mjs' */
/** @import { Frame } from '../../draw/frame.mjs' */
/** @import { Theme } from '../../draw/theme.mjs' */
/** @import { MarkKind } from '../../draw/marks.mjs' */
/** @import { Look } from '../../draw/classes.mjs' */
/** @import { Case, Start } from '../../physics/case.mjs' */
/** @import { BasinAttractor } from '../../physics/basins.mjs' */
/** @import { BasinLabels, makeBasinPlane } from './cells.mjs' */
/** @import { PlaneAxes } from '../plane/axis.mjs' */
/** @import { Followed } from '../point/followed.mjs' */
/** @import { panelUnits } from '../point/units.mjs' */
import { classLook, fillClass, lookSwatch } from '../../draw/classes.mjs';
import { frame, outline } from '../../draw/frame.mjs';
import { clipped, curve, drawHandle, drawMark, points } from '../../draw/marks.mjs';
import { numeral } from '../../draw/scale.mjs';
import { historyOf, motionAt } from '../../physics/history.mjs';
import { FULL_TURN } from '../../physics/start.mjs';
import { MOTION_NAMES, STANDS, motionName } from '../../words.mjs';
import { shownAxes } from '../plane/axis.mjs';
import { attractorLooks } from './looks.mjs';

/**
 * @typedef {object} BasinView
 * @property {ReturnType<typeof makeBasinPlane>['plane']} plane
 * @property {BasinLabels | null} drawn
 * @property {ReturnType<typeof panelUnits>} units
 * @property {PlaneAxes} axes
 * @property {boolean} safe
 * @property {Start} start
 * @property {Followed | null} followed
 */

const BASIN_KEY_WIDTH = 168, BASIN_KEY_NARROW = 152, BASIN_KEY_LINE = 50; // [px]
const BASIN_PERIODS = 10; // of the way to the attractor
const NARROW_PLANE = 620; // [px] below, the key stands under the plane

/**
 * Return what draws the basins; it keeps what takes long.
 * @param {App} app
 */
export function makeBasinPicture(app) {
  /** @type {WeakMap<BasinAttractor, { angle: Float64Array, velocity: Float64Array }>} */
  const atPhase = new WeakMap();

  return {
    /**
     * @param {Pen} pen
     * @param {{ width: number, height: number }} size
     * @param {BasinView} view
     */
    draw(pen, size, view) {
      const { theme } = app, { drawn } = view, faded = view.plane.isOther();
      const entries = keyEntries(theme, view, drawn);
      const beside = size.width >= NARROW_PLANE;
      const columns = Math.max(1, Math.floor(size.width / BASIN_KEY_NARROW));
      const below = beside ? 0 : Math.ceil(entries.length / columns) * BASIN_KEY_LINE + 4;
      const width = size.width - (beside ? BASIN_KEY_WIDTH : 0);
      const plane = { width, height: size.height - below };
      pen.fillStyle = theme.paper;
      pen.fillRect(0, 0, size.width, size.height);
      const onto = drawPlane(pen, plane, view, faded);
      pen.globalAlpha = faded ? 0.35 : 1;
      drawBasinKey(pen, theme, entries, beside ? { left: width + 10, top: onto.box.top, columns: 1 }
        : { left: 6, top: plane.height + 4, columns });
      pen.globalAlpha = 1;
    },
  };

  /**
   * @param {Pen} pen
   * @param {{ width: number, height: number }} size
   * @param {BasinView} view
   * @param {boolean} faded
   */
  function drawPlane(pen, size, view, faded) {
    const { theme } = app, { plane, drawn } = view;
    const onto = frame(pen, size, { theme, grid: false, ...shownAxes(view.axes) });
    clipped(pen, onto, () => fillClass(pen, theme, 'not-computed', onto.box));
    plane.drawCells(pen, onto, String(view.safe));
    outline(pen, onto);
    if (drawn && !faded && !view.safe) drawAttractors(pen, onto, view, drawn);
    drawOrbit(pen, onto, view);
    plane.drawTouched(pen, onto);
    return onto;
  }

  /** @param {Pen} pen @param {Frame} onto @param {BasinView} view @param {BasinLabels} drawn */
  function drawAttractors(pen, onto, { units }, { attractors, given }) {
    const { theme } = app;
    attractorLooks(theme, attractors, false).forEach(({ look, mark }, k) => {
      if (!mark) return;
      const { angle, velocity } = stroboscopic(given, attractors[k]);
      const xs = angle.map((u) => u * units.angle.factor);
      const ys = velocity.map((v) => v * units.velocity.factor);
      // A rim of paper around one of ink is seen on every fill.
      points(pen, onto, xs, ys, { mark, colour: theme.ink, radius: 5.5, casing: theme.paper });
      points(pen, onto, xs, ys, { mark, colour: look.fill, radius: 4 });
    });
  }

  /**
   * Return where an attractor is at phase 0.
   * @param {Case} given
   * @param {BasinAttractor} attractor
   */
  function stroboscopic(given, attractor) {
    const known = atPhase.get(attractor);
    if (known) return known;
    const { orbit } = attractor;
    let found = { angle: new Float64Array(attractor.kind === 'rest' ? 1 : 0),
      velocity: new Float64Array(attractor.kind === 'rest' ? 1 : 0) };
    if (orbit) {
      const [first] = orbit.states, start = { kind: /** @type {const} */ ('impact'), ...first };
      const run = historyOf(app.kernels, given, start, orbit.period);
      const times = Array.from({ length: orbit.period }, (_, k) => Math.min(run.endTime,
        (FULL_TURN - first.phase + FULL_TURN * k) / given.frequencyRatio));
      const { angle, velocity } = motionAt(app.kernels, given, run, times);
      found = { angle: angle.slice(), velocity: velocity.slice() };
    }
    atPhase.set(attractor, found);
    return found;
  }

  /** @param {Pen} pen @param {Frame} onto @param {BasinView} view */
  function drawOrbit(pen, onto, { start, followed, units }) {
    const { theme } = app;
    if (start.kind !== 'state' && start.kind !== 'rest') return;
    const { angle, velocity } = units;
    if (followed && start.kind === 'state') {
      const { course, orbit, strobe } = followed;
      const late = course.periods.findIndex((/** @type {number} */ time) => time > BASIN_PERIODS);
      const end = late < 0 ? course.periods.length : late;
      const scaled = (/** @type {Float64Array} */ values, /** @type {number} */ factor) =>
        values.map((value) => value * factor);
      curve(pen, onto, scaled(course.angle.subarray(0, end), angle.factor),
        scaled(course.velocity.subarray(0, end), velocity.factor),
        { colour: theme.motion, width: 1.4, casing: theme.paper });
      if (orbit) {
        curve(pen, onto, scaled(orbit.angle, angle.factor), scaled(orbit.velocity, velocity.factor),
          { colour: theme.motion, width: 2.4, casing: theme.paper });
      }
      points(pen, onto, scaled(strobe.angle, angle.factor),
        scaled(strobe.velocity, velocity.factor),
        { colour: theme.motion, radius: 2.6, casing: theme.paper });
    }
    const at = start.kind === 'state' ? start : { angle: 0, velocity: 0 };
    const [x, y] = [onto.x.at(at.angle * angle.factor), onto.y.at(at.velocity * velocity.factor)];
    clipped(pen, onto, () => drawHandle(pen, theme, x, y));
  }
}

/**
 * @typedef {object} BasinEntry
 * @property {Look} [look]  of an area; without one a line, the orbit
 * @property {MarkKind | null} mark
 * @property {string[]} lines  name, peaks
 */

/**
 * @param {Theme} theme
 * @param {BasinView} view
 * @param {BasinLabels | null} drawn
 * @returns {BasinEntry[]}
 */
function keyEntries(theme, { safe, units, start, followed }, drawn) {
  if (!drawn) return [];
  const { attractors } = drawn, { angle } = units;
  const orbit = start.kind === 'state' && followed ? [orbitEntry()] : [];
  if (safe) {
    const unknown = attractors.find(({ kind }) => kind === 'undecided')?.states ?? 0;
    return [
      { look: classLook(theme, 'rocking'), mark: null,
        lines: [STANDS, ...(unknown ? [`${unknown} undecided`] : [])] },
      { look: classLook(theme, 'overturned'), mark: null, lines: [MOTION_NAMES.overturned] },
      ...orbit,
    ];
  }
  const looks = attractorLooks(theme, attractors, safe);
  return [...attractors.map((attractor, k) => ({ ...looks[k],
    lines: [...motionName(attractor).split(/(?<=,) /), ...peakLines(attractor, angle)] })), ...orbit];
}

/**
 * @param {BasinAttractor} attractor
 * @param {BasinView['units']['angle']} angle
 */
function peakLines({ orbit }, angle) {
  if (!orbit) return [];
  const [high, low] = [orbit.highest, orbit.lowest].map((u) => numeral(u * angle.factor, 3));
  const unit = angle.unit === '°' ? '°' : ` ${angle.unit}`;
  return [orbit.symmetric ? `peak ±${high}${unit}` : `peaks ${high}, ${low}${unit}`];
}

/** @returns {BasinEntry} */
function orbitEntry() {
  return { mark: null, lines: ['orbit of the state;', 'dots: once a period,', 'at phase 0'] };
}

/** @param {Pen} pen @param {Theme} theme @param {BasinEntry[]} entries
 * @param {{ left: number, top: number, columns: number }} at */
function drawBasinKey(pen, theme, entries, { left, top, columns }) {
  pen.save();
  pen.textAlign = 'left';
  pen.textBaseline = 'middle';
  entries.forEach(({ look, mark, lines }, k) => {
    const x = left + (k % columns) * BASIN_KEY_NARROW;
    const y = top + Math.floor(k / columns) * BASIN_KEY_LINE;
    const box = { left: x, top: y + 3, width: 22, height: 24 };
    if (!look) {
      const colour = theme.motion;
      pen.strokeStyle = colour;
      pen.lineWidth = 1.4;
      pen.beginPath();
      pen.moveTo(x, y + 15);
      pen.lineTo(x + 22, y + 15);
      pen.stroke();
      drawMark(pen, 'dot', x + 11, y + 15, { colour, radius: 2.6, casing: theme.paper });
    } else lookSwatch(pen, theme, look, box);
    if (mark && look) {
      drawMark(pen, mark, x + 11, y + 15, { colour: theme.ink, radius: 5.5, casing: theme.paper });
      drawMark(pen, mark, x + 11, y + 15, { colour: look.fill, radius: 4 });
    }
    lines.forEach((text, line) => {
      pen.font = theme.small;
      pen.fillStyle = line ? theme.quiet : theme.ink;
      pen.fillText(text, x + 28, y + 8 + 14 * line);
    });
  });
  pen.restore();
}
