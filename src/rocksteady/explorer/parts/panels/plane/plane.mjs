// A plane of cells in a panel, and a point on it that is dragged: pointer, keys, window, picture.

/** @import { App, Panel } from '../../shell/app.mjs' */
/** @import { State } from '../../shell/state.mjs' */
/** @import { Frame } from '../../draw/frame.mjs' */
/** @import { Pen } from '../../draw/svg.mjs' */
/** @import { PlaneAxes, PlanePlace } from './axis.mjs' */
/** @import { PlaneBox, PlaneHandle } from './pointer.mjs' */
/** @import { RasterOptions, RasterTask } from './raster.mjs' */
import { clipped } from '../../draw/marks.mjs';
import { FIELDS } from '../../shell/state.mjs';
import { buttonEntry } from '../entries.mjs';
import { axesPatch, placeIn } from './axis.mjs';
import { drawMarkedBox, drawPlaneLines, drawPlanePoint, drawTip, inPlaneBox } from './overlay.mjs';
import { ZOOM_STEP, listenToPointers, planeKey, zoomAbout } from './pointer.mjs';
import { makeRaster } from './raster.mjs';

/** @typedef {Pick<RasterTask, 'job' | 'args' | 'cost' | 'ms' | 'motion'>} PlaneWork */
/** @typedef {NonNullable<ReturnType<ReturnType<typeof makeRaster>['cellAt']>>} PlaneCell */

/**
 * @typedef {object} PlanePart
 * @property {(state: State) => PlaneAxes} axes
 * @property {(state: State) => PlanePlace} point
 * @property {(place: PlanePlace) => Record<string, unknown>} moved  the patch of a point
 * @property {(state: State) => PlaneWork} work
 * @property {(place: PlanePlace, cell: PlaneCell | null) => string[]} words  beside the pointer
 * @property {string} [hint]  at a point that has not been dragged
 * @property {() => void} tell  writes how far the picture is
 * @property {{ columns: number, rows: number }} [grid]  cells; as many as pixels without it
 * @property {boolean} [late]  whether cells are computed only in a view that is settled
 * @property {number} [arrow]  part of an axis that an arrow key goes; a pixel where it is missing
 */

/** @typedef {RasterOptions & PlanePart} PlaneOptions */
/** @typedef {ReturnType<typeof makePlane>} Plane */

const LEAST_SIDE = 8; // [px] of a plane that is computed
const DIMMED = 0.35;

/**
 * Return a plane for a panel: the panel calls its methods from its own.
 * @param {App} app
 * @param {() => Panel} panelOf
 * @param {PlaneOptions} options
 */
export function makePlane(app, panelOf, options) {
  /** @type {Frame | undefined} */
  let onto;
  /** @type {PlaneWork | undefined} */
  let work;
  let known = '', touched = false, settled = true;
  /** @type {PlanePlace | null} */
  let pointer = null;
  /** @type {PlaneBox | null} */
  let marked = null;
  const changed = () => {
    options.tell();
    app.redraw(panelOf());
  };
  const raster = makeRaster(app, options, { changed, seen: () => !!panelOf().root?.offsetParent });
  const axes = () => options.axes(app.state);

  /** @type {PlaneHandle} */
  const handle = {
    axes,
    arrow: options.arrow,
    box: () => onto?.box ?? { left: 0, top: 0, width: 1, height: 1 },
    point: () => options.point(app.state),
    movePoint(place, settled, push = settled) {
      touched = true;
      app.set(options.moved(place), { settled, push });
    },
    show(to, settled) {
      app.set(axesPatch(to), { settled });
      if (settled) app.bring(panelOf()); // its cells are asked for before other panels are updated
    },
    reset() {
      const { x, y } = axes();
      app.set(Object.fromEntries([...x.keys, ...y.keys].map((key) => [key, FIELDS[key].value])));
    },
    hover(at) {
      if (!at && !pointer) return;
      pointer = at;
      if (at) raster.lookAt(partAt(at));
      app.redraw(panelOf());
    },
    mark(box) {
      marked = box;
      app.redraw(panelOf());
    },
  };
  const partAt = (/** @type {PlanePlace} */ { x, y }) => {
    const { left, top, width, height } = handle.box();
    return { x: (x - left) / width, y: 1 - (y - top) / height };
  };

  /** Have the cells computed, if that is not under way. */
  const compute = () => {
    const { width, height } = handle.box(), [across, up] = [width, height].map(Math.round);
    if (!work || across < LEAST_SIDE || up < LEAST_SIDE) return;
    const { columns, rows } = options.grid ?? { columns: across, rows: up };
    const { x, y } = axes();
    const key = JSON.stringify([work.motion, x.from, x.to, y.from, y.to, x.log, x.keys, columns,
      rows]);
    if (key === known || (options.late && !settled)) return raster.resume();
    known = key;
    raster.begin({ ...work, axes: { x, y }, columns, rows, width: across, height: up });
    options.tell();
  };

  /** @param {Frame} made @param {PlanePlace} place */
  const shown = (made, { x, y }) => {
    const { x: along, y: up } = axes();
    return { x: made.x.at(x * along.unit), y: made.y.at(y * up.unit) };
  };

  const pointShown = () => {
    const { x, y } = axes(), at = handle.point();
    return { x: at.x * x.unit, y: at.y * y.unit };
  };

  return {
    handle,
    repaint: raster.repaint,
    cells: raster.cells,
    progress: raster.progress,
    nearestCells: raster.nearestCells,
    task: raster.task,
    /** @param {PlanePlace} part  of the window */
    cellAt: (part) => raster.cellAt(part.x, part.y),
    /** Take over what is to be computed. @param {State} state @param {boolean} now  settled */
    update(state, now) {
      work = options.work(state);
      settled = now;
      if (onto) compute(); // before the picture is drawn, in the box that it had
    },
    /** Whether the cells are of another motion than the present one. */
    isOther: () => !work || raster.task()?.motion !== work.motion,
    listen() {
      const { canvas } = panelOf();
      if (!canvas) return;
      canvas.style.touchAction = 'none';
      canvas.style.cursor = 'crosshair';
      listenToPointers(canvas, handle);
    },
    /** @param {KeyboardEvent} event */
    keys: (event) => planeKey(event, handle),
    /** Return buttons that do what keys do. */
    buttons: () => [
      buttonEntry('+', 'Zoom in (key +)', () => zoomAbout(handle, 1 / ZOOM_STEP)),
      buttonEntry('−', 'Zoom out (key −)', () => zoomAbout(handle, ZOOM_STEP)),
      buttonEntry('reset', 'Whole window (key 0, or double-click)', handle.reset),
    ],
    /** Return how far the picture is, in words; those of a fault are shown. */
    words() {
      const { part, fault, undecided, complete } = raster.progress();
      if (fault) {
        app.fail(panelOf(), `The cells could not be computed: ${fault}`, 'Move the point or the window');
        return null;
      }
      const far = complete ? '' : `refining ${Math.min(99, Math.floor(100 * part))} %`;
      return [far, undecided ? `${wholeNumber(undecided)} undecided` : ''].filter(Boolean).join(', ');
    },
    /**
     * Draw the cells; on the panel's canvas they are computed for the place where they stand.
     * @param {any} pen
     * @param {Frame} made
     * @param {string} [colours]  what is drawn in other ones has another name
     */
    drawCells(pen, made, colours = '') {
      if (pen.canvas === panelOf().canvas) {
        onto = made;
        raster.recolour(colours);
        compute();
      }
      clipped(pen, made, () => {
        pen.imageSmoothingEnabled = false;
        const other = raster.task()?.motion !== work?.motion;
        for (const picture of raster.pictures()) {
          const { x, y } = picture.axes;
          const [low, high] = [{ x: x.from, y: y.from }, { x: x.to, y: y.to }].map((place) =>
            shown(made, place));
          const [width, height] = [high.x - low.x, low.y - high.y];
          if (!picture.canvas.width || !(width < 1e5) || !(height < 1e5)) continue;
          pen.globalAlpha = options.late && (other || picture.other) ? DIMMED : 1;
          pen.drawImage(picture.canvas, low.x, high.y, width, height);
        }
        pen.globalAlpha = 1;
      });
    },
    /** @param {Pen} pen @param {Frame} made @param {'across' | 'up' | 'both'} lines */
    drawLines: (pen, made, lines) => drawPlaneLines(pen, made, pointShown(), lines),
    /** @param {Pen} pen @param {Frame} made */
    drawPoint: (pen, made) => drawPlanePoint(pen, made, pointShown()),
    /**
     * Draw a box that is being marked, or what is at the pointer.
     * @param {any} pen
     * @param {Frame} made
     */
    drawTouched(pen, made) {
      if (pen.canvas !== panelOf().canvas) return;
      const at = shown(made, handle.point());
      if (marked) drawMarkedBox(pen, made, marked);
      else if (pointer) {
        const part = partAt(pointer), cell = raster.cellAt(part.x, part.y);
        drawTip(pen, made, pointer, options.words(cell ?? placeIn(axes(), part), cell));
      } else if (!touched && inPlaneBox(made.box, at.x, at.y)) {
        drawTip(pen, made, at, [options.hint ?? 'drag the point']);
      }
    },
  };
}

/** @param {number} count */
export function wholeNumber(count) {
  return String(count).replace(/\B(?=(\d{3})+$)/g, ',');
}
