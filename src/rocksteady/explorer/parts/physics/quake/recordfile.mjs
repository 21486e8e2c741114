// A ground motion from a file: two columns of time and acceleration, or PEER's AT2.
// What is read here has the bits of rocksteady.read_record; anything else is refused in one line,
// and much of it `rocksteady explore --record FILE` reads.

import { spacingOf } from './recordtimes.mjs';
/** @import { Kernels } from '../../kernels/loader.mjs' */

export const LARGEST_RECORD_FILE = 20e6; // bytes
export const ELSEWHERE = 'rocksteady explore --record FILE reads other formats';
const RECORD_VALID = 'valid: two columns, time and acceleration, or PEER AT2';
const STANDARD_G = 9.80665;

/** Units of acceleration that a page asks for, each with its size in m/s2. */
export const RECORD_UNITS = { g: STANDARD_G, 'm/s2': 1, 'cm/s2': 0.01 };
const UNIT_SPELLINGS = {
  g: STANDARD_G, gal: 0.01, 'm/s2': 1, 'm/s^2': 1, 'm/s/s': 1, 'm/sec2': 1, 'm/sec^2': 1,
  'cm/s2': 0.01, 'cm/s^2': 0.01, 'cm/s/s': 0.01, 'cm/sec2': 0.01, 'cm/sec^2': 0.01,
};
const TIME_UNITS = { s: 1, sec: 1, secs: 1, second: 1, seconds: 1, ms: 0.001 };

const NUMBER_PATTERN = String.raw`[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[EeDd][+-]?[0-9]+)?`;
const WHOLE_NUMBER = new RegExp(`^${NUMBER_PATTERN}$`);
const LONGEST_NUMBER = 60;
const LONGEST_SHOWN = 40;
const LONGEST_LINE = 2000; // characters; what reads a line may take as long as the square of it
const NAMES_FIRST = new RegExp(
  String.raw`NPTS\s*[=:]?\s*(${NUMBER_PATTERN})[\s,;]*DT\s*[=:]?\s*(${NUMBER_PATTERN})(.*)$`, 'i',
);
const NUMBERS_FIRST = new RegExp(
  String.raw`^\s*(${NUMBER_PATTERN})[\s,;]+(${NUMBER_PATTERN})[\s,;]*NPTS\W*DT\s*()$`, 'i',
);
const SECONDS_AFTER = /^\s*(?:s|secs?|seconds?)?[\s.,;]*$/i;
const IN_UNITS_OF_G = /^\s*ACC\w*(?: TIME (?:HISTORY|SERIES))? IN UNITS OF G\s*$/i;
const FILTER_POINTS = /\.\s*FILTER POINTS: HP=[\d.]+ Hz LP=[\d.]+ Hz\s*$/i;
const OTHER_QUANTITY = /^\s*(?:VELOCITY|DISPLACEMENT|(?:PSEUDO[\s-]*)?(?:SPECTRAL|RESPONSE)\b)/i;
const ODD_HEADER = new RegExp([
  /\bunits?\b|[*^×·²³]|\bx\s*\d|\d\s*x\b|\bscal(?:e|ed|ing)\b|factor|multipl|divid|\bgain\b|\blsb\b/,
  /doubled|halved|negated|conver[st]|calibrat|accelerogram|format v|\bcounts\b|\bNPTS\b|\bDT\b/,
].map((part) => part.source).join('|'), 'i');
const DOWNWARDS = /^(?:d|dn|dwn|down|downwards?)$/i;
const PERHAPS_DOWNWARDS = /(?:^|[^a-z])(?:d|dn|dwn|down|downwards?|neg|negative|minus|du)(?![a-z])/i;
const NAME_DOWNWARDS = /(?:^|[-_. ])(?:dwn|down|dn|d-?u)$|[a-z0-9][-_.]?dwn$|[A-Z0-9]DOWN$/i;

/**
 * A motion, or one line why there is none; `asks` where only the unit is missing.
 * @typedef {object} ReadMotion
 * @property {string} name
 * @property {number} dt  [s]
 * @property {Float64Array} samples  [m/s2]
 * @property {string} note  where it comes from
 * @property {string[]} doubts  sentences
 */
/** @typedef {{ motion: ReadMotion } | { refused: string, asks?: 'unit' }} ReadResult */

/** Why a file is no record, with what was found. */
class RefusedRecord extends Error {}

/**
 * Return the name of a file as it is shown: without signs that steer the text, and not too long.
 * @param {string} name
 */
export function plainName(name) {
  const plain = name.replace(/[\p{Cc}\p{Cf}\p{Cs}\p{Zl}\p{Zp}]/gu, '\ufffd').trim();
  const signs = [...plain];
  const cut = LONGEST_SHOWN - 16;
  const short = [...signs.slice(0, cut), '…', ...signs.slice(-12)].join('');
  return (signs.length > LONGEST_SHOWN ? short : plain) || 'unnamed file';
}

/**
 * Return why a file is not even opened, or nothing.
 * @param {string} name
 * @param {number} bytes
 */
export function refusedUnread(name, bytes) {
  if (bytes === 0) return `${plainName(name)}: the file is empty. ${RECORD_VALID}.`;
  if (bytes <= LARGEST_RECORD_FILE) return '';
  return `${plainName(name)}: ${Math.round(bytes / 1e6)} MB, and ${LARGEST_RECORD_FILE / 1e6} MB`
    + ` are the most that a page reads. ${ELSEWHERE}.`;
}

/**
 * Return the motion of a file, or the line that refuses it.
 * @param {Kernels} kernels
 * @param {{ name: string, bytes: Uint8Array, unit?: string }} file  the unit where it was asked for
 * @returns {ReadResult}
 */
export function readMotion(kernels, { name, bytes, unit = '' }) {
  try {
    const text = textOf(bytes);
    const isPeer = text.lines.slice(0, 40).some((line) => /\bNPTS\b/i.test(line));
    const found = isPeer ? peerOf(text, name) : columnsOf(kernels, text);
    const size = found.size || /** @type {Record<string, number>} */ (RECORD_UNITS)[unit];
    if (!size) {
      return { refused: `${plainName(name)}: the file does not state the unit of its`
        + ' accelerations. Choose g, m/s2 or cm/s2.', asks: 'unit' };
    }
    const samples = found.values.map((value) => value * size * found.sign);
    return { motion: checkedMotion(name, samples, found) };
  } catch (error) {
    if (!(error instanceof RefusedRecord)) throw error;
    return { refused: `${plainName(name)}: ${error.message}. ${RECORD_VALID}; ${ELSEWHERE}.` };
  }
}

/** @typedef {{ values: Float64Array, dt: number, size: number, sign: number, doubts: string[] }} Found */

/**
 * @param {string} name
 * @param {Float64Array} samples
 * @param {Found} found
 * @returns {ReadMotion}
 */
function checkedMotion(name, samples, { dt, sign, doubts }) {
  if (samples.length < 2) refuse('it holds one sample');
  if (!(dt >= 1e-15)) refuse(`${dt} s between samples, which is not above 0`);
  if (dt > 1e6) refuse(`${dt} s between samples`);
  const peak = samples.reduce((most, value) => Math.max(most, Math.abs(value)), 0) / STANDARD_G;
  if (!(peak > 0)) refuse('all accelerations are zero');
  if (!(peak <= 1000)) refuse(`a peak of ${peak.toPrecision(3)} g, which no record has`);
  if (peak > 10) {
    doubts.push(`its peak is ${peak.toPrecision(3)} g, more than any earthquake has caused:`
      + ' see whether the unit is right');
  }
  if (dt < 1e-4 || dt > 0.1) doubts.push(`samples ${dt} s apart are unusual`);
  if (sign < 0) doubts.push('its sign is changed: the component is positive downwards');
  const shown = plainName(name);
  return { name: shown, dt, samples, note: `file ${shown}`, doubts };
}

/**
 * @param {string} found
 * @param {number} [line]  from 0
 * @returns {never}
 */
function refuse(found, line) {
  throw new RefusedRecord(line === undefined ? found : `line ${line + 1}: ${found}`);
}

/**
 * @param {string} text
 */
function shownPart(text) {
  const plain = plainName(text.slice(0, 200));
  return `‘${plain}’`;
}

/** @typedef {{ lines: string[], ended: boolean }} RecordText */

/**
 * Return the lines of a file: UTF-8, UTF-16 with its mark, else Latin-1.
 * @param {Uint8Array} bytes
 * @returns {RecordText}
 */
function textOf(bytes) {
  const marked = bytes[0] === 0xff && bytes[1] === 0xfe ? 'utf-16le'
    : bytes[0] === 0xfe && bytes[1] === 0xff ? 'utf-16be' : '';
  let content = '';
  try {
    content = new TextDecoder(marked || 'utf-8', { fatal: !marked }).decode(bytes);
  } catch {
    content = new TextDecoder('latin1').decode(bytes);
  }
  const filled = withoutEnd(content, '\0\x1a \t\r\n');
  if (!filled) refuse('the file is empty');
  // eslint-disable-next-line no-control-regex
  if (/[\0-\x08\x0b\x0c\x0e-\x1f\x7f]/.test(filled)) refuse('it is binary, not text');
  const lines = filled.split('\n').flatMap((line) => withoutEnd(line, '\r').split('\r'));
  const long = lines.findIndex((line) => line.length > LONGEST_LINE);
  if (long >= 0) refuse(`${lines[long].length} characters in a line`, long);
  return { lines, ended: filled.length < content.length
    && /[\r\n]/.test(content.slice(filled.length)) };
}

/**
 * Return a text without some signs at its end.
 * @param {string} text
 * @param {string} signs
 */
function withoutEnd(text, signs) {
  let end = text.length;
  while (end > 0 && signs.includes(text[end - 1])) end -= 1;
  return text.slice(0, end);
}

/**
 * Return a number as it is written, or nothing where it is none.
 * @param {string} written
 */
function numberOf(written) {
  if (written.length > LONGEST_NUMBER || !WHOLE_NUMBER.test(written)) return undefined;
  const value = Number(written.replace(/d/i, 'e'));
  return Number.isFinite(value) ? value : undefined;
}

/**
 * Return the numbers of a line that stand apart, or run together at a sign; null for anything else.
 * @param {string} line
 */
function numbersOf(line) {
  const plain = line.split(/[ \t]+/).filter(Boolean).map(numberOf);
  if (!plain.includes(undefined)) return /** @type {number[]} */ (plain);
  // Where an exponent has three digits, Fortran leaves out its letter: 0.1234-105.
  const lettered = line.replace(/((?:\d\.|\.\d)\d*)([+-]\d{3})(?![\d.])/g, '$1E$2');
  const apart = lettered.replace(/([\d.])(?=[+-])/g, '$1 ');
  const values = apart.split(/[ \t]+/).filter(Boolean).map(numberOf);
  return values.includes(undefined) ? null : /** @type {number[]} */ (values);
}

// PEER's files of acceleration -------------------------------------------------------------------

/**
 * @param {RecordText} text
 * @param {string} name
 * @returns {Found}
 */
function peerOf(text, name) {
  const at = text.lines.findIndex((line) => /\bNPTS\b/i.test(line));
  const line = text.lines[at];
  const counts = NAMES_FIRST.exec(line) ?? NUMBERS_FIRST.exec(line);
  if (!counts || !SECONDS_AFTER.test(counts[3])) {
    refuse(`${shownPart(line)} does not read as NPTS= 5372, DT= .0100 SEC`, at);
  }
  const count = Number(numberOf(counts[1])), dt = Number(numberOf(counts[2]));
  if (!(count >= 2 && Number.isInteger(count))) refuse(`NPTS is ${counts[1]}`, at);
  const head = text.lines.slice(0, at);
  const inG = peerHeader(head);
  const sign = peerSign(head, name);
  /** @type {number[]} */
  const values = [];
  for (let row = at + 1; row < text.lines.length; row++) {
    const found = numbersOf(text.lines[row]);
    if (!found) refuse(`${shownPart(text.lines[row])} is no row of numbers`, row);
    for (const value of found) values.push(value);
  }
  if (values.length < count) {
    refuse(`the file ends with ${values.length} samples, and line ${at + 1} states ${count}`);
  }
  refuseTimes(values, dt, at + 1);
  refuseCut(text, text.lines.map((_, row) => row).slice(at + 1), true, false);
  const doubts = values.length > count
    ? [`the file holds ${values.length} samples, and its header states ${count}: the rest is left out`]
    : [];
  return { values: Float64Array.from(values.slice(0, count)), dt, size: inG, sign, doubts };
}

/**
 * Return the size of the unit that the header states, 0 where it states none.
 * @param {string[]} head
 */
function peerHeader(head) {
  let size = 0;
  head.forEach((written, row) => {
    const line = written.replace(FILTER_POINTS, '');
    if (row > 0 && OTHER_QUANTITY.test(line)) refuse(`${shownPart(line)}, no acceleration`, row);
    if (IN_UNITS_OF_G.test(line)) size = STANDARD_G;
    else if (ODD_HEADER.test(line)) refuse(`${shownPart(line)} is not understood as a whole`, row);
  });
  return size;
}

/**
 * Return -1 of a vertical component whose positive values point downwards, else 1.
 * @param {string[]} head
 * @param {string} name
 */
function peerSign(head, name) {
  const title = head.filter((line) => line.trim())[1] ?? '';
  const component = (title.replace(/\s*\([^()]*\)\s*$/, '').split(',').pop() ?? '').trim();
  if (title.split(',').length > 2 && DOWNWARDS.test(component)) return -1;
  const stem = name.replace(/\.[^.]*$/, '');
  if (PERHAPS_DOWNWARDS.test(title) || NAME_DOWNWARDS.test(stem)) {
    refuse('it may be a vertical component that is positive downwards');
  }
  return 1;
}

/**
 * Refuse times beside the samples: taken for samples they would be a ramp.
 * @param {number[]} values
 * @param {number} dt
 * @param {number} row
 */
function refuseTimes(values, dt, row) {
  const first = values.slice(0, 40).filter((_, k) => k % 2 === 0);
  const steps = first.slice(1).map((value, k) => value - first[k]);
  if (dt && steps.length > 3 && steps.every((step) => Math.abs(step - dt) <= 1e-3 * Math.abs(dt))) {
    refuse('times stand beside the samples, and AT2 holds samples alone', row);
  }
}

// Two columns ------------------------------------------------------------------------------------

/**
 * @param {Kernels} kernels
 * @param {RecordText} text
 * @returns {Found}
 */
function columnsOf(kernels, text) {
  const filled = text.lines.map((_, row) => row).filter((row) => /[^ \t,;]/.test(text.lines[row]));
  const { separator, comma } = dialectOf(filled.map((row) => text.lines[row]));
  /** @param {string} line */
  const fieldsOf = (line) => {
    const plain = comma ? line.replaceAll(',', '.') : line;
    if (!separator) return plain.split(/[ \t]+/).filter(Boolean);
    const fields = plain.split(separator).map((field) => field.trim().replace(/^"+|"+$/g, ''));
    while (fields.length && !fields[fields.length - 1]) fields.pop();
    return fields;
  };
  const first = fieldsOf(text.lines[filled[0]]);
  const named = first.some((field) => numberOf(field) === undefined);
  const names = named ? columnNames(text.lines[filled[0]], separator, filled[0]) : null;
  const rows = named ? filled.slice(1) : filled;
  const columns = [/** @type {string[]} */ ([]), /** @type {string[]} */ ([])];
  for (const row of rows) {
    const fields = fieldsOf(text.lines[row]);
    const odd = fields.find((field) => numberOf(field) === undefined);
    if (odd !== undefined) refuse(`${shownPart(odd)} is no number`, row);
    if (fields.length !== 2) {
      refuse(`${fields.length} ${fields.length === 1 ? 'number' : 'numbers'} in a row, not 2`, row);
    }
    columns[0].push(fields[0]);
    columns[1].push(fields[1]);
  }
  if (rows.length < 2) refuse('it holds no two rows of numbers');
  const [times, values] = (names?.timeLast ? [...columns].reverse() : columns)
    .map((column) => Float64Array.from(column, (field) => Number(numberOf(field))));
  if (!names && !growsEvenly(times)) refuse('its first column holds no times');
  if (/^\d+$/.test(columns[0][0]) && Number(columns[0][0]) === rows.length - 1) {
    refuse('its first row looks like a number of samples', rows[0]);
  }
  const written = names?.timeLast ? columns[1] : columns[0];
  const spacing = spacingOf(kernels, written, times, names?.seconds ?? 1);
  if ('row' in spacing) refuse(spacing.found, rows[spacing.row]);
  if (!separator) refuseCut(text, rows, false, comma);
  const doubts = spacing.doubt ? [spacing.doubt] : [];
  return { values, dt: spacing.interval, size: names?.size ?? 0, sign: 1, doubts };
}

/**
 * Return what stands between numbers ('' for blanks), and whether a comma is the decimal point.
 * @param {string[]} lines
 */
function dialectOf(lines) {
  const sample = lines.slice(lines.length >> 1).slice(0, 200).map((line) => line.trim());
  const most = (/** @type {string} */ sign) =>
    2 * sample.filter((line) => line.includes(sign)).length > sample.length;
  const body = sample.join('');
  for (const separator of [';', '\t']) {
    if (most(separator)) return { separator, comma: body.includes(',') && !body.includes('.') };
  }
  if (!most(',')) return { separator: '', comma: false };
  const tokens = sample.map((line) => line.split(/[ \t]+/));
  const decimal = /^(?:[+-]?\d*,\d+(?:[eEdD][+-]?\d+)?|[+-]?\d+(?:[eEdD][+-]?\d+)?)$/;
  if (!tokens.every((line) => line.every((token) => decimal.test(token)))) {
    return { separator: ',', comma: false };
  }
  if (tokens.some((line) => line.length > 1)) return { separator: '', comma: true };
  // 0,5: two columns, or one number? The names of two columns decide.
  const named = lines.slice(0, 3).some((line) => line.includes(',') && /[A-Za-z]/.test(line));
  return named ? { separator: ',', comma: false } : { separator: '', comma: true };
}

/**
 * Return what the names of two columns state, or refuse them.
 * @param {string} line
 * @param {string} separator
 * @param {number} row
 */
function columnNames(line, separator, row) {
  const plain = line.trim().replace(/^[#%!*/ ]+/, '');
  const parts = separator
    ? plain.split(separator).map((name) => name.trim().replace(/^"+|"+$/g, '').trim())
    : plain.replace(/\s+(?=[([])/g, '').replaceAll(',', ' ').split(/\s+/);
  while (parts.length && !parts[parts.length - 1]) parts.pop();
  const pattern = /^([a-z][a-z ]*?)(?:\s*[([]\s*([a-z0-9/^]+)\s*[)\]]|[ _]([a-z0-9/^]+))?$/i;
  const found = parts.map((name) => {
    const [, label = '', inBrackets = '', behind = ''] = pattern.exec(name) ?? [];
    const unit = (inBrackets || behind).toLowerCase();
    if (/^(?:t|times?)$/i.test(label)) {
      const seconds = unit ? Object.entries(TIME_UNITS).find(([each]) => each === unit)?.[1] : 1;
      return { seconds, size: undefined };
    }
    const isOne = /^(?:a|acc|accel|acceleration|ground acceleration)$/i.test(label);
    const size = unit ? Object.entries(UNIT_SPELLINGS).find(([each]) => each === unit)?.[1] : 0;
    return { seconds: undefined, size: isOne ? size : undefined };
  });
  const time = found.findIndex((one) => one.seconds !== undefined);
  const other = found[1 - time];
  if (found.length !== 2 || time < 0 || other.size === undefined) {
    refuse(`${shownPart(line.trim())} does not name two columns as time (s), acceleration (g)`, row);
  }
  return { timeLast: time === 1, seconds: Number(found[time].seconds), size: other.size };
}

/**
 * Return whether numbers grow, nearly all by the same, as times do.
 * @param {Float64Array} values
 */
function growsEvenly(values) {
  const times = values.subarray(0, 2000);
  if (times.length < 3) return false;
  const steps = times.slice(1).map((time, k) => time - times[k]).sort();
  const usual = steps[steps.length >> 1];
  const near = steps.filter((step) => Math.abs(step - usual) <= 0.5 * usual).length;
  return usual > 0 && (steps[0] >= 0 || near >= 0.9 * steps.length);
}

// Cut files --------------------------------------------------------------------------------------

/**
 * Refuse a file whose last number ends otherwise than all others: it is cut.
 * @param {RecordText} text
 * @param {number[]} among  its lines of numbers
 * @param {boolean} strict  whether the form of the last number counts where it has no line end
 * @param {boolean} comma  whether a comma is the decimal point
 */
function refuseCut(text, among, strict, comma) {
  const rows = among.filter((row) => text.lines[row].trim()).map((row) => {
    const line = comma ? text.lines[row].replaceAll(',', '.') : text.lines[row];
    return [...line.matchAll(new RegExp(NUMBER_PATTERN, 'g'))]
      .map((found) => ({ written: found[0], end: found.index + found[0].length }));
  });
  const last = rows[rows.length - 1], before = rows.slice(0, -1);
  if (!last?.length || rows.length < 2) return;
  const misplaced = lastIsMisplaced(rows, last, before);
  const late = last[last.length - 1].end > rows[0][rows[0].length - 1].end;
  const odd = misplaced ?? lastIsMisshapen(rows, last);
  if (odd && ((misplaced !== null && !late) || (strict && !text.ended))) {
    refuse(`the file ends inside its last number, ${last[last.length - 1].written}`);
  }
}

/** @typedef {{ written: string, end: number }} Token */

/**
 * Return whether the last row ends its numbers elsewhere than the others; null without a layout.
 * @param {Token[][]} rows
 * @param {Token[]} last
 * @param {Token[][]} before
 */
function lastIsMisplaced(rows, last, before) {
  if (rows.length <= 8) return null;
  const ends = before.map((row) => row.map((token) => token.end).join());
  const [usual, share] = mostCommon(ends);
  const lengths = new Set(rows.flatMap((row) => row.map((token) => token.written.length)));
  const columns = usual.split(',').map(Number);
  if (share < 0.9 * ends.length || (lengths.size === 1 && columns.length === 1)) return null;
  return last.length > columns.length || last.some((token, k) => token.end !== columns[k]);
}

/**
 * Return whether a number of the last row has other decimals than those above it.
 * @param {Token[][]} rows
 * @param {Token[]} last
 */
function lastIsMisshapen(rows, last) {
  return last.some((token, column) => {
    const shapes = rows.filter((row) => row.length > column)
      .map((row) => shapeOf(row[column].written));
    const [shape, share] = mostCommon(shapes);
    const regular = shapes.length > 8
      && shapes.length - share <= Math.max(1, 0.005 * shapes.length);
    return regular && shape !== shapeOf(token.written);
  });
}

/**
 * Return the decimals of a number and the digits of its exponent, as one text.
 * @param {string} written
 */
function shapeOf(written) {
  const [mantissa, exponent = ''] = written.split(/[EeDd]/);
  const decimals = mantissa.includes('.') ? mantissa.length - mantissa.indexOf('.') - 1 : -1;
  return `${decimals} ${exponent.replace(/^[+-]/, '').length}`;
}

/**
 * @param {string[]} values
 * @returns {[string, number]}
 */
function mostCommon(values) {
  /** @type {Map<string, number>} */
  const counts = new Map();
  for (const value of values) counts.set(value, (counts.get(value) ?? 0) + 1);
  return [...counts].reduce((most, one) => (one[1] > most[1] ? one : most));
}
