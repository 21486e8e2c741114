// All windows of amplitude in which a pulse of one frequency overturns a block: the search of
// `rocksteady.dynamics.overturning.scan`, amplitude for amplitude.
import { evaluate, evaluateEach } from '../case.mjs';
import { pulseTable, PULSE_TOLERANCE } from '../motions.mjs';
import { pulseFates, FATE } from './pulse.mjs';

/** @import { Kernels } from '../../kernels/loader.mjs' */
/** @import { Struck } from './pulse.mjs' */

/**
 * An amplitude that was tried, and the fate there.
 * @typedef {{ at: number, falls: boolean, decided: boolean, impacts: number, side: number,
 *   during: number, margin: number }} Tried
 */

/**
 * A range of amplitudes over which the block overturns in one way.
 * @typedef {{ low: number, high: number, impacts: number, side: number }} PulseWindow
 */

const SCAN = {
  finest: 1e-7, fine: 1e-5, coarse: 2e-4, many: 10, higher: 8, muchHigher: 1000, most: 10000,
  steeper: 2, nearest: 1e-6, decade: 16, kept: 32, closest: 1e-12, top: 20, uplifts: 2,
  resolution: 2e-3, lines: 1000, rough: 1e-4, roughLeftOut: 1e-9,
};
const BORDER = { straight: 0.06, room: 4, nearest: 32, wide: 1e-9, least: 1e-4, around: 0.25 };

/**
 * Return the amplitude at which the block lifts.
 * @param {Kernels} kernels
 * @param {Struck} block
 * @returns {number}
 */
export function upliftOf(kernels, { nonlinear, alpha }) {
  return nonlinear ? evaluate(kernels, 'tan', alpha) / alpha : 1;
}

/**
 * Return all windows at one frequency, as `find_overturning_windows` finds them.
 * @param {Kernels} kernels
 * @param {Struck & { ratio: number, low?: number, high?: number, resolution?: number }} given
 * @returns {{ windows: PulseWindow[], leftOut: number, unsettled: number, undecided: number,
 *   low: number, high: number }}
 */
export function pulseWindows(kernels, given) {
  const { nonlinear, shape, ratio, resolution = SCAN.resolution } = given;
  const uplift = upliftOf(kernels, given);
  const low = given.low ?? Math.min(uplift, 1);
  const high = given.high ?? Math.max(SCAN.top, SCAN.uplifts * uplift);
  /** @param {object} more */
  const followed = (more) => /** @param {number[]} at */ (at) => {
    const ratios = new Float64Array(at.length).fill(ratio);
    const found = pulseFates(kernels, { ...given, ...more, amplitudes: at, ratios });
    return at.map((amplitude, k) => triedOf(found, amplitude, k));
  };
  const table = pulseTable(kernels, shape, 1, 1, { nonlinear, still: false });
  table.free();
  const quick = nonlinear && table.shape[0] > SCAN.lines
    ? { tolerance: Math.max(SCAN.rough, PULSE_TOLERANCE), leftOut: SCAN.roughLeftOut } : null;
  const follow = followed({});
  const look = quick ? followed(quick) : follow;
  let tried = look(firstGrid(kernels, low, high, resolution, uplift));
  let left = SCAN.most, doubtful = doubtfulOf(tried);
  while (doubtful.length && left) {
    const widths = doubtful.map((k) => (tried[k + 1].at - tried[k].at) / tried[k + 1].at);
    const chosen = doubtful.map((_, k) => k).sort((a, b) => widths[b] - widths[a] || a - b);
    const where = chosen.slice(0, left).map((k) => doubtful[k]).sort((a, b) => a - b);
    tried = withMore(tried, look(where.map((k) => 0.5 * (tried[k].at + tried[k + 1].at))));
    left -= where.length;
    doubtful = doubtfulOf(tried);
  }
  if (quick) tried = follow(keptPlaces(tried).map((k) => tried[k].at));
  const found = windowsOf(kernels, follow, tried, nonlinear ? SCAN.closest : 0);
  return { ...found, unsettled: doubtful.length, low, high };
}

/**
 * @param {import('./pulse.mjs').PulseFates} found
 * @param {number} at
 * @param {number} k
 * @returns {Tried}
 */
function triedOf(found, at, k) {
  const status = found.status[k], margin = Math.min(found.margin[k], 1e200);
  return {
    at, falls: status === FATE.overturned, impacts: found.impacts[k], side: found.side[k],
    decided: status === FATE.overturned || status === FATE.rest || status === FATE.rocking,
    // Differences and slopes stay finite.
    during: found.during[k], margin: Number.isNaN(margin) ? -1 : Math.max(margin, -Number.MAX_VALUE),
  };
}

/**
 * Return numbers in equal ratios, both ends as they are given.
 * @param {Kernels} kernels
 * @param {number} start
 * @param {number} stop
 * @param {number} count
 * @returns {number[]}
 */
export function inEqualRatios(kernels, start, stop, count) {
  const last = count - 1, whole = evaluate(kernels, 'log', stop / start);
  const inner = Array.from({ length: Math.max(0, last - 1) }, (_, k) => (whole * (k + 1)) / last);
  return [start, ...Array.from(evaluateEach(kernels, 'exp', inner), (x) => start * x), stop];
}

/**
 * @param {number[]} values
 * @returns {number[]}
 */
function uniqueOf(values) {
  const sorted = Float64Array.from(values).sort();
  return Array.from(sorted.filter((value, k) => k === 0 || value !== sorted[k - 1]));
}

/**
 * @param {Kernels} kernels
 * @param {number} low
 * @param {number} high
 * @param {number} step
 * @param {number} uplift
 * @returns {number[]}
 */
function firstGrid(kernels, low, high, step, uplift) {
  const floor = Math.max(low, uplift);
  if (high <= floor) return uniqueOf([low, high]);
  const steps = evaluate(kernels, 'log', high / floor) / evaluateEach(kernels, 'log1p', [step])[0];
  const parts = [low, ...inEqualRatios(kernels, floor, high, Math.max(Math.ceil(steps) + 1, 2))];
  const nearest = Math.max(floor - uplift, SCAN.nearest * uplift), furthest = high - uplift;
  if (furthest > nearest) {
    const decades = evaluate(kernels, 'log', furthest / nearest) / evaluate(kernels, 'log', 10);
    const count = Math.ceil(SCAN.decade * decades) + 1;
    for (const beyond of inEqualRatios(kernels, nearest, furthest, count)) parts.push(uplift + beyond);
  }
  return uniqueOf(parts.map((at) => Math.min(Math.max(at, low), high)));
}

/**
 * Return which intervals are to be halved, by the places of their lower ends.
 * @param {Tried[]} tried
 * @returns {number[]}
 */
function doubtfulOf(tried) {
  const count = tried.length - 1;
  const margin = tried.map((each) => each.falls ? -each.margin : each.margin); // below 0
  const drop = new Float64Array(count), slope = new Float64Array(count);
  for (let k = 0; k < count; k += 1) {
    drop[k] = Math.abs(margin[k + 1] - margin[k]);
    slope[k] = drop[k] / (tried[k + 1].at - tried[k].at);
  }
  const hump = new Uint8Array(count + 1), high = new Uint8Array(count + 1);
  for (let k = 1; k < count; k += 1) {
    const here = tried[k];
    if (!(here.falls || margin[k] > -1) || !(margin[k] > margin[k - 1])
      || !(margin[k] >= margin[k + 1]) || here.falls !== tried[k - 1].falls
      || here.falls !== tried[k + 1].falls) continue;
    const standsOut = Math.max(drop[k], drop[k - 1]);
    high[k] = Number(margin[k] + SCAN.higher * standsOut > 0);
    hump[k] = Number(margin[k] + SCAN.muchHigher * standsOut > 0);
  }
  /** @type {number[]} */
  const doubtful = [];
  for (let k = 0; k < count; k += 1) {
    const a = tried[k], b = tried[k + 1], width = b.at - a.at;
    const around = Math.max(slope[k], k + 1 < count ? slope[k + 1] : 0, k > 0 ? slope[k - 1] : 0);
    const steep = Math.max(margin[k + 1], margin[k]) + SCAN.steeper * around * width > 0;
    const many = a.falls && b.falls && a.impacts >= SCAN.many && b.impacts >= SCAN.many;
    if (((high[k] || high[k + 1]) && width > SCAN.finest * b.at)
      || ((differ(a, b, true) || steep || hump[k] || hump[k + 1]) && width > SCAN.fine * b.at)
      || ((a.during !== b.during || many) && width > SCAN.coarse * b.at)) doubtful.push(k);
  }
  return doubtful;
}

/**
 * Return whether the way of overturning changes between neighbours, or what leads to it.
 * @param {Tried} a
 * @param {Tried} b
 * @param {boolean} during
 * @returns {boolean}
 */
function differ(a, b, during) {
  /** @param {Tried} each */
  const ways = (each) => each.falls ? Math.min(each.impacts, SCAN.many) : 0;
  const most = 3 * SCAN.many + 3;
  return a.falls !== b.falls || ways(a) !== ways(b) || a.side !== b.side
    || (during && Math.min(a.during, most) !== Math.min(b.during, most));
}

/** @param {Tried[]} tried @param {Tried[]} more @returns {Tried[]} */
function withMore(tried, more) {
  return [...tried, ...more].sort((a, b) => a.at - b.at);
}

/**
 * Return the places after which neighbours differ, and where the stretches between begin and end.
 * @param {Tried[]} tried
 * @returns {{ where: number[], starts: number[], stops: number[] }}
 */
function stretchesOf(tried) {
  /** @type {number[]} */
  const where = [];
  for (let k = 0; k + 1 < tried.length; k += 1) if (differ(tried[k], tried[k + 1], false)) where.push(k);
  return { where, starts: [0, ...where.map((k) => k + 1)], stops: [...where, tried.length - 1] };
}

/**
 * Return the places of the ends, of both sides of every border, and of a middle between.
 * @param {Tried[]} tried
 * @returns {number[]}
 */
function keptPlaces(tried) {
  const { starts, stops } = stretchesOf(tried);
  const middles = starts.map((start, k) => {
    const middle = 0.5 * (tried[start].at + tried[stops[k]].at);
    return tried.findIndex((each) => each.at >= middle);
  });
  return uniqueOf([...starts, ...stops, ...middles]);
}

/**
 * Return the windows that amplitudes close enough show, the borders of the widest to rounding.
 * @param {Kernels} kernels
 * @param {(at: number[]) => Tried[]} follow
 * @param {Tried[]} tried
 * @param {number} closest
 * @returns {{ windows: PulseWindow[], leftOut: number, undecided: number }}
 */
function windowsOf(kernels, follow, tried, closest) {
  const undecided = tried.filter((each) => !each.decided).length;
  let all = tried, found = stretchesOf(all);
  for (;;) {
    const { where, starts, stops } = found;
    const wide = mayBeWidest(all, starts, stops);
    const ends = where.map((k) => all[k + 1].at);
    const highs = Array.from(evaluateEach(kernels, 'next_up', ends), (next, i) => next - ends[i]);
    const apart = where.map((k, i) => ({ k, i })).filter(({ k, i }) => (wide[i] || wide[i + 1])
      && all[k + 1].at - all[k].at > Math.max(4 * highs[i], closest * all[k + 1].at));
    if (!apart.length) break;
    const more = nextAmplitudes(all, apart.map(({ k }) => k), apart.map(({ i }) => highs[i]), closest);
    all = withMore(all, follow(more));
    found = stretchesOf(all);
  }
  const { starts, stops } = found;
  const falls = starts.map((_, k) => k).filter((k) => all[starts[k]].falls);
  const windows = falls.map((k, i) => {
    const { at: low, impacts, side } = all[starts[k]];
    // Two that touch share the border.
    const touching = i + 1 < falls.length && starts[falls[i + 1]] === stops[k] + 1;
    return { low, high: all[touching ? stops[k] + 1 : stops[k]].at, impacts, side };
  });
  const widest = windows.map((_, k) => k)
    .sort((a, b) => (windows[b].high - windows[b].low) - (windows[a].high - windows[a].low) || a - b)
    .slice(0, SCAN.kept).sort((a, b) => a - b);
  return {
    windows: widest.map((k) => windows[k]), leftOut: windows.length - widest.length, undecided,
  };
}

/**
 * @param {Tried[]} tried
 * @param {number[]} starts
 * @param {number[]} stops
 * @returns {boolean[]}
 */
function mayBeWidest(tried, starts, stops) {
  const falls = starts.map((k) => tried[k].falls);
  if (falls.filter(Boolean).length <= SCAN.kept) return falls;
  const widths = starts.map((k, i) => tried[stops[i]].at - tried[k].at).filter((_, i) => falls[i])
    .sort((a, b) => a - b);
  const least = widths[widths.length - SCAN.kept];
  return falls.map((fell, i) => fell && tried[Math.min(stops[i] + 1, tried.length - 1)].at
    - tried[Math.max(starts[i] - 1, 0)].at >= least);
}

/**
 * Return amplitudes to be tried in some intervals, so that few bring a border to rounding.
 * @param {Tried[]} tried
 * @param {number[]} where  places of their lower ends
 * @param {number[]} spacing  of their upper ends
 * @param {number} closest
 * @returns {number[]}
 */
function nextAmplitudes(tried, where, spacing, closest) {
  /** @type {number[]} */
  const chosen = [];
  where.forEach((place, i) => {
    const [a, m] = ['at', 'margin'].map((name) => [-1, 0, 1, 2].map((k) =>
      /** @type {any} */ (tried[place + k])?.[name] ?? NaN));
    const [, low, high] = a, width = high - low;
    const [before, chord, after] = [0, 1, 2].map((k) => (m[k + 1] - m[k]) / (a[k + 1] - a[k]));
    const q = Math.max(Math.abs(before - chord), Math.abs(after - chord)) / Math.abs(chord);
    const crosses = tried[place].falls !== tried[place + 1].falls;
    const straight = crosses && q < BORDER.straight;
    const zero = low - m[1] / chord;
    const least = Math.max(0.25 * closest * high, BORDER.nearest * spacing[i]);
    const away = Math.max(Math.max(BORDER.room * q, BORDER.least) * width, least);
    const rising = -m[1] / before, sinking = m[2] / after, half = 0.5 * width;
    const bent = crosses && !straight && width > BORDER.wide * high;
    const tries = [];
    if (straight) tries.push(zero - away, zero + away);
    if (bent && rising > 0 && rising < half) {
      tries.push(low + (1 - BORDER.around) * rising, low + (1 + BORDER.around) * rising);
    }
    if (bent && sinking > 0 && sinking < half) {
      tries.push(high - (1 - BORDER.around) * sinking, high - (1 + BORDER.around) * sinking);
    }
    const inside = tries.filter((value) => value > low && value < high);
    chosen.push(...inside);
    if (!(straight && inside.length)) chosen.push(0.5 * (low + high)); // rounding left no other
  });
  return uniqueOf(chosen);
}
