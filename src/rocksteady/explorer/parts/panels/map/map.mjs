// The map: what the block settles to over frequency and amplitude, with the regions of the paper.

/** @import { App, Panel } from '../../shell/app.mjs' */
/** @import { State } from '../../shell/state.mjs' */
/** @import { Frame } from '../../draw/frame.mjs' */
/** @import { Pen } from '../../draw/svg.mjs' */
/** @import { Boundaries } from '../../physics/boundaries.mjs' */
/** @import { Case } from '../../physics/case.mjs' */
/** @import { Tile } from '../../physics/tiles.mjs' */
/** @import { PlanePlace } from '../plane/axis.mjs' */
/** @import { PlaneCell } from '../plane/plane.mjs' */
/** @import { RegionPlace } from './regions.mjs' */
/** @import { MapColouring } from './words.mjs' */
import { MOTION_CLASSES, fillClass, lookTiles } from '../../draw/classes.mjs';
import { frame, outline } from '../../draw/frame.mjs';
import { numeral } from '../../draw/scale.mjs';
import { regionAt, regionBoundaries } from '../../physics/boundaries.mjs';
import { MAP_KIND, axisValues, emptyTile, mapCycles } from '../../physics/tiles.mjs';
import { caseOf, startOf } from '../../shell/state.mjs';
import { pageUnits, shakingWords } from '../../shell/units.mjs';
import { axisOf, partOf, placeIn, roundPlace, shownAxes } from '../plane/axis.mjs';
import { makePlane, wholeNumber } from '../plane/plane.mjs';
import { makeMapBar } from './bar.mjs';
import { drawRegions, regionPlaces } from './regions.mjs';
import { REGION_WORDS, cellClass, cellWords, drawColourBar, drawMapLegend, legendEntries, legendShape,
  mapLooks, peakEnd, peakLook, peakOf, periodLook } from './words.mjs';

const CURVE_POINTS = 320;
const MAP_MARGIN = { left: 44, right: 36 }; // [px] whatever the numbers are
const UNDER_AXIS = 40; // [px] of tick labels and the label of the axis
const COLOUR_BAR = 17; // [px]
const NARROW_MAP = 420; // [px]
const MAP_KEYS = /** @type {const} */ ({ x: ['w0', 'w1'], y: ['a0', 'a1'] });
const CELL_MS = { linear: 0.02, nonlinear: 0.6 }; // until it is measured
const HELD_MS = 120; // for which the picture of another block may stay
const FIRST_END = 0.2; // of the colours of the peak, until peaks are known
const MAP_TABLE = [1, 3, 5, 7, 9, 11, 13, 15].map((k) => k / 16); // parts of an axis

/**
 * Make the panel.
 * @param {App} app
 * @returns {Panel}
 */
export function makeMapPanel(app) {
  /** @type {Boundaries | undefined} */
  let curves;
  /** @type {RegionPlace[]} */
  let places = [];
  /** @type {Frame | undefined} */
  let onto;
  /** @type {Case} */
  let given;
  let units = pageUnits(app), by = { w: 1, a: 1 }; // factors from Omega and A to what the axes show
  let degrees = 0; // of alpha; 0 where angles are shown in parts of it
  let layerKey = '';
  /** @type {(state: State) => void} */
  let showChoices = () => {};
  let end = FIRST_END; // of the colours of the peak
  const below = document.createElement('canvas'), above = document.createElement('canvas');
  const found = () => /** @type {Tile} */ (/** @type {unknown} */ (plane.cells()));
  const plane = makePlane(app, () => panel, {
    name: 'map',
    empty: (count) => ({ ...emptyTile(count) }),
    rectangles: true,
    held: HELD_MS,
    tiles: (theme, ratio) => lookTiles(mapLooks(theme), ratio),
    look: (k) => mapLook(found(), k, colouring(), end),
    undecided: (k) => found().kind[k] === MAP_KIND.undecided,
    begun: () => {
      end = FIRST_END;
    },
    levelled() {
      const last = end;
      end = peakEnd(found());
      // The peaks of a finer level may need another scale of colours.
      return end !== last && colouring() === 'peak';
    },
    axes(state) {
      const log = state.log === 1;
      return {
        x: axisOf(state, MAP_KEYS.x, units.frequency, log),
        y: axisOf(state, MAP_KEYS.y, units.amplitude, log),
      };
    },
    point: ({ W, A }) => ({ x: W, y: A }),
    moved: ({ x, y }) => ({ W: x, A: y }),
    work(state) {
      const { restitution, nonlinear, alpha } = given, start = startOf(state), block = given;
      const cost = nonlinear ? 'nonlinear' : 'linear';
      return {
        job: 'mapTile', cost, ms: CELL_MS[cost],
        motion: JSON.stringify([restitution, nonlinear && alpha, state.start]),
        args: (ratios, amplitudes, nested) =>
          ({ given: block, start, ratios, amplitudes, nested }),
      };
    },
    words: (place, cell) => [placeWords(place), cell ? wordsOf(cell) : 'not computed yet',
      `${given.nonlinear ? 'linear model: ' : ''}region ${regionOf(place)}, `
        + REGION_WORDS[regionOf(place)]],
    tell: () => tell(),
  });

  const axes = () => plane.handle.axes(), point = () => plane.handle.point();
  const si = () => app.state.units === 'si';
  const colouring = () => /** @type {MapColouring} */ (app.state.hue);
  const angle = (/** @type {number} */ peak) =>
    (degrees ? `${numeral(peak * degrees, 3)}°` : `${numeral(peak, 3)} α`);
  const placeWords = (/** @type {PlanePlace} */ { x, y }) => shakingWords(units, { A: y, W: x });
  const regionOf = (/** @type {PlanePlace} */ { x, y }) => {
    const at = regionBoundaries(app.kernels, [x], given.restitution);
    return regionAt(y, at.existence[0], at.sign[0], at.kind[0]);
  };
  const wordsOf = (/** @type {PlaneCell} */ { at }) => {
    const { kind, period, impacts, highest, lowest } = found();
    return cellWords({ kind: kind[at], period: period[at], impacts: impacts[at],
      highest: highest[at], lowest: lowest[at] }, angle, app.theme.words);
  };

  /** @param {State} state @param {boolean} settled */
  const compute = (state, settled) => {
    given = caseOf(app.kernels, state);
    units = pageUnits(app, state);
    by = { w: units.frequency.factor, a: units.amplitude.factor };
    degrees = si() ? units.angle.factor : 0;
    plane.update(state, settled);
    const { restitution } = given, seen = axes();
    const ratios = axisValues(app.kernels, { ...seen.x, count: CURVE_POINTS });
    curves = regionBoundaries(app.kernels, ratios, restitution);
    const { width, height } = plane.handle.box();
    // In a moving window the numbers stay where they are.
    if (settled) places = regionPlaces(curves, seen, width > 1 ? height / width : 0.75);
    layerKey = '';
  };

  /** Say how far the map is. */
  const tell = () => {
    const far = plane.words(), { complete, undecided, done } = plane.progress();
    if (far === null) return;
    const words = [complete ? `${wholeNumber(done)} cells${far && ', '}${far}` : far];
    const cycles = mapCycles(given);
    if (given.restitution === 1) {
      words.push(`without loss motions do not settle, followed for ${cycles} periods`);
    } else if (undecided) words.push(`undecided: no repetition in ${cycles} periods, nor chaos`);
    if (given.nonlinear) words.splice(1, 0, 'edges: linear model, the nonlinear one has none');
    app.note(panel, words.join('; '));
    if (panel.note) panel.note.title = panel.note.textContent ?? '';
  };

  /**
   * Draw what is beneath the cells: paper, axes, legend.
   * @param {Pen} pen
   * @param {{ width: number, height: number }} size
   */
  const drawBelow = (pen, size) => {
    const { theme, state } = app;
    const entries = legendEntries(theme, colouring(), startOf(state).kind === 'steady');
    pen.font = theme.small;
    // On a phone the legend has the whole width.
    const left = size.width < NARROW_MAP ? 6 : MAP_MARGIN.left;
    const width = size.width - left - MAP_MARGIN.right, shape = legendShape(pen, entries, width);
    const bar = state.hue === 'peak' ? COLOUR_BAR : 0;
    const made = frame(pen, size, {
      theme,
      grid: false,
      margin: { ...MAP_MARGIN, bottom: UNDER_AXIS + shape.height + bar },
      ...shownAxes(axes()),
    });
    const { box } = made;
    fillClass(pen, theme, 'not-computed', box);
    const at = { left, top: box.top + box.height + UNDER_AXIS, width };
    if (bar) {
      const [words, most] = si() ? ['peak |θ|', angle(end)] : ['peak |θ|/α', numeral(end)];
      drawColourBar(pen, theme, at, words, ['0', `≥ ${most}`]);
    }
    drawMapLegend(pen, theme, entries, { ...at, top: at.top + bar });
    return made;
  };

  /** Draw what is above the cells. @param {Pen} pen @param {Frame} made */
  const drawAbove = (pen, made) => {
    if (curves) drawRegions(pen, made, curves, places, { ...by, other: given.nonlinear });
    outline(pen, made);
  };

  /** @param {PlaneCell | null} cell */
  const tableWords = (cell) => {
    if (!cell) return 'not computed';
    const { kind, period, highest, lowest } = found(), { at } = cell;
    const name = app.theme.words[MOTION_CLASSES[cellClass(kind[at], period[at])]];
    const peak = peakOf(highest[at], lowest[at]);
    return peak > 0 ? `${name}${period[at] > 1 ? ` ${period[at]}` : ''}, ${angle(peak)}` : name;
  };

  /** Move the point to the next region that is seen. @param {number} step */
  const toRegion = (step) => {
    const here = regionOf(point()), at = places.findIndex(({ region }) => region === here);
    const next = places[(Math.max(at, 0) + step + places.length) % places.length];
    const { handle } = plane;
    if (next) handle.movePoint(roundPlace(axes(), next, handle.box()), true, false);
    return next !== undefined;
  };

  /** @type {Panel} */
  const panel = {
    name: 'map',
    title: 'Map',
    uses: ['A', 'W', 'model', 'units', 'r', 'rh', 'b', 'h', 'start', 'w0', 'w1', 'a0', 'a1', 'log',
      'hue', 'by'],
    placed() {
      const { bar } = panel;
      if (!bar) return;
      showChoices = makeMapBar(app, bar);
      bar.append(...plane.buttons());
      plane.listen();
    },
    update(state, { changed, settled }) {
      if (curves && [...changed].every((key) => ['A', 'W', 'by'].includes(key))) return;
      compute(state, settled || !curves);
      showChoices(state);
    },
    draw(pen, size) {
      if (!curves) return;
      if (pen.canvas !== panel.canvas) {
        const made = drawBelow(pen, size);
        plane.drawCells(pen, made);
        drawAbove(pen, made);
        plane.drawLines(pen, made, along());
        plane.drawPoint(pen, made);
        return;
      }
      const ratio = pen.getTransform().a;
      const { width, height } = size;
      if (!onto) { // the rest of the first picture in the next frame: its code is still compiled
        onto = drawBelow(pen, size);
        plane.drawCells(pen, onto, colouring());
        app.redraw(panel);
        return;
      }
      const key = [width, height, ratio, app.theme.dark, end].join();
      if (key !== layerKey) {
        onto = drawBelow(blank(below, size, ratio), size);
        drawAbove(blank(above, size, ratio), onto);
        layerKey = key;
      }
      pen.drawImage(below, 0, 0, width, height);
      plane.drawCells(pen, onto, colouring());
      pen.drawImage(above, 0, 0, width, height);
      plane.drawLines(pen, onto, along());
      plane.drawPoint(pen, onto);
      plane.drawTouched(pen, onto);
    },
    keys(event) {
      if (event.key === '[' || event.key === ']') return toRegion(event.key === ']' ? 1 : -1);
      return plane.keys(event);
    },
    sentence() {
      const cell = plane.cellAt(partOf(axes(), point()));
      const { kind } = startOf(app.state), region = regionOf(point());
      const from = kind === 'rest' ? 'rest' : kind === 'steady' ? 'the steady state' : 'a state';
      return `The point is at ${placeWords(point())}, in region ${region} of the linear model: `
        + `${REGION_WORDS[region]}.`
        + (cell ? ` What the block does there from ${from}: ${wordsOf(cell)}.` : '');
    },
    table() {
      const there = (/** @type {number} */ x, /** @type {number} */ y) => placeIn(axes(), { x, y });
      const up = [...MAP_TABLE].reverse();
      return {
        columns: [units.amplitude.label, ...MAP_TABLE.map((x) => (si()
          ? `${numeral(there(x, 0).x * by.w)} Hz` : `Ω = ${numeral(there(x, 0).x)}`))],
        rows: up.map((y) => [numeral(there(0, y).y * by.a),
          ...MAP_TABLE.map((x) => tableWords(plane.cellAt({ x, y })))]),
      };
    },
  };

  const along = () => (app.state.by === 'a' ? 'up' : 'across');
  return panel;
}

/**
 * Return the number of the look of a cell.
 * @param {Tile} cells
 * @param {number} k
 * @param {MapColouring} by
 * @param {number} end  of the peaks
 */
function mapLook({ kind, period, highest, lowest }, k, by, end) {
  if (by === 'kind' || kind[k] < 0 || kind[k] > MAP_KIND.unsymmetric) {
    return cellClass(kind[k], period[k]);
  }
  return by === 'period' ? periodLook(period[k]) : peakLook(peakOf(highest[k], lowest[k]) / end);
}

/**
 * Return the pen of a canvas that is made empty.
 * @param {HTMLCanvasElement} canvas
 * @param {{ width: number, height: number }} size
 * @param {number} ratio
 */
function blank(canvas, { width, height }, ratio) {
  [canvas.width, canvas.height] = [Math.round(width * ratio), Math.round(height * ratio)];
  const pen = /** @type {CanvasRenderingContext2D} */ (canvas.getContext('2d'));
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  return pen;
}
