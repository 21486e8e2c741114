// Repeat recorded calls (rocksteady/installation/_recorded.py says what such a file holds) and
// compare all bits.   node replay.mjs rocksteady.wasm CALLS
import { load } from '../../../src/rocksteady/explorer/parts/kernels/loader.mjs';
import { signatures } from './signatures.mjs';

const KINDS = { 2: 'f', 3: 'i', 4: 'b' }, BYTES = { f: 8, i: 8, b: 1 };

function* calls(buffer) {
  const data = new DataView(buffer), text = new TextDecoder();
  let at = 8;
  const whole = () => Number(data.getBigInt64((at += 8) - 8, true));
  const bytes = length => { const start = at; at += Math.ceil(length / 8) * 8; return buffer.slice(start, start + length); };
  const number = kind => kind === 1 ? data.getFloat64((at += 8) - 8, true) : whole();
  const argument = () => {
    const code = whole(), kind = KINDS[code];
    if (!kind) return { value: number(code) };
    const shape = Array.from({ length: whole() }, whole), size = BYTES[kind] * shape.reduce((a, b) => a * b, 1);
    const before = bytes(size);
    return { kind, shape, before, after: whole() ? bytes(size) : before };
  };
  if (text.decode(buffer.slice(0, 8)) !== 'RSCALLS1') throw new Error('this is no file of recorded calls');
  for (let left = whole(); left > 0; left--) {
    const name = text.decode(bytes(whole()));
    yield { name, leaves: Array.from({ length: whole() }, argument), results: Array.from({ length: whole() }, () => number(whole())) };
  }
}

const view = { f: Float64Array, i: BigInt64Array, b: Uint8Array };
const same = (a, b) => Object.is(a, b);            // 0 and -0 differ, NaN and NaN do not
const built = (type, leaves) => typeof type === 'string' ? leaves.shift()
  : Array.isArray(type) ? type.map(part => built(part, leaves))
  : Object.fromEntries(Object.entries(type).map(([name, part]) => [name, built(part, leaves)]));
const flat = value => value === undefined ? [] : typeof value === 'object' ? Object.values(value).flatMap(flat) : [Number(value)];

export function replay(kernels, recorded) {
  const found = [];
  for (const { name, leaves, results } of calls(recorded)) {
    const given = leaves.map(leaf => leaf.kind ? kernels.array(leaf.kind, leaf.shape, new view[leaf.kind](leaf.before)) : leaf.value);
    const returned = flat(kernels[name](...built(signatures[name].takes, [...given])));
    let values = 0, differing = 0;
    const compare = (a, b) => { values++; if (!same(a, b)) differing++; };
    leaves.forEach((leaf, k) => {
      if (!leaf.kind) return values++;
      const expected = new view[leaf.kind](leaf.after);
      given[k].values.forEach((value, index) => compare(value, expected[index]));
      given[k].free();
    });
    if (returned.length !== results.length) throw new Error(`${name} returns ${returned.length} numbers, recorded were ${results.length}`);
    results.forEach((value, k) => compare(returned[k], value));
    found.push({ name, values, differing });
  }
  return found;
}

if (typeof process !== 'undefined' && process.argv[1] === new URL(import.meta.url).pathname) {
  const { readFileSync } = await import('node:fs'), { gunzipSync } = await import('node:zlib');
  const file = readFileSync(process.argv[3]), plain = file[0] === 0x1f ? gunzipSync(file) : file;
  const recorded = plain.buffer.slice(plain.byteOffset, plain.byteOffset + plain.length);
  for (const { name, values, differing } of replay(await load(readFileSync(process.argv[2]), signatures), recorded)) console.log(name, values, differing);
}
