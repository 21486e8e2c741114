// A time history with its base motion above it, on one axis of time.

/** @import { Frame } from '../../draw/frame.mjs' */
/** @import { Theme } from '../../draw/theme.mjs' */
/** @import { ShownUnits } from './words.mjs' */
/** @import { SampledRun } from '../../physics/demand/run.mjs' */
import { frame, hasFarRoom } from '../../draw/frame.mjs';
import { curve, note, points, rule } from '../../draw/marks.mjs';
import { numeral } from '../../draw/scale.mjs';

const COURSE_SMALL = 0.12; // theta/alpha
const COURSE_BASE = 0.34; // part of the height that the base motion takes

/**
 * Return the height of words above a level, or below it where the box ends [px].
 * @param {Frame} onto
 * @param {number} level
 */
function beside(onto, level) {
  const y = onto.y.at(level);
  return y - 17 < onto.box.top ? y + 9 : y - 9;
}

/**
 * Draw the base acceleration and the angle of a run, +-alpha as lines, impacts as dots.
 * @param {any} pen
 * @param {{ width: number, height: number }} size
 * @param {Theme} theme
 * @param {SampledRun} run
 * @param {ShownUnits} units
 */
export function drawCourse(pen, size, theme, run, units) {
  const count = run.times.length;
  if (!count) return;
  const times = Array.from(run.times, (t) => t * units.time), to = times[count - 1];
  const base = Array.from(run.base, (a) => a * units.amplitude);
  const angles = Array.from(run.states.subarray(0, count), (u) => u * units.angle);
  const strongest = Math.max(1e-6, ...base.map(Math.abs)) * 1.1;
  const largest = Math.max(...angles.map((u) => Math.min(Math.abs(u), 2 * units.angle)));
  // A small motion is enlarged; where alpha is outside the axes it is named.
  const small = largest > 0 && largest < COURSE_SMALL * units.angle;
  const widest = small ? 1.6 * largest : Math.max(1.15 * units.angle, 1.06 * largest);
  const above = Math.round(size.height * COURSE_BASE), lower = { ...size, height: size.height - above };
  const margin = { left: 44, right: units.si && hasFarRoom(lower) ? 44 : 12 };
  const { time, angle, base: push } = units.axes, x = { from: 0, to, label: time.label };
  const top = frame(pen, { width: size.width, height: above }, {
    theme, x: { ...x, label: '', bare: true }, margin,
    y: { from: -strongest, to: strongest, label: `${push.label}; dashed: lifts the block`, far: push.far },
  });
  rule(pen, top, { y: 0 }, { colour: theme.edge });
  for (const side of [-1, 1]) {
    rule(pen, top, { y: side * units.amplitude }, { colour: theme.limit, dash: [6, 4] });
  }
  curve(pen, top, [0, ...times], [0, ...base], { colour: theme.base, width: 1.8 });
  pen.save();
  pen.translate(0, above);
  const low = frame(pen, lower, {
    theme, x, margin,
    y: { from: -widest, to: widest, label: angle.label, far: angle.far },
  });
  rule(pen, low, { y: 0 }, { colour: theme.edge });
  for (const side of [-1, 1]) rule(pen, low, { y: side * units.angle }, { colour: theme.limit, dash: [6, 4], width: 1.2 });
  const level = small ? `±α = ±${numeral(units.angle, 3)}${units.si ? '°' : ''}, outside` : 'θ = α';
  const at = small ? low.box.top + 10 : beside(low, units.angle);
  note(pen, low, level, low.box.left + low.box.width - 4, at, { align: 'right' });
  curve(pen, low, times, angles, { colour: theme.motion, width: 2 });
  const struck = Array.from(run.impacts).filter((t) => t * units.time <= to).slice(0, 400);
  points(pen, low, struck.map((t) => t * units.time), struck.map(() => 0), { colour: theme.impact, radius: 3 });
  if (run.overturns !== null) {
    rule(pen, low, { x: run.overturns * units.time }, { colour: theme.limit, dash: [2, 3] });
    note(pen, low, theme.words.overturned, low.x.at(run.overturns * units.time) - 4, low.box.top + low.box.height - 10, { align: 'right' });
  }
  pen.restore();
}
