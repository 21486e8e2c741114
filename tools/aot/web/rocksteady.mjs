// The kernels in a page or in node, without a server: load the module and call them by name.
// Named tuples are objects, other tuples are arrays; the types are in rocksteady.d.mts.
import { signatures } from './signatures.mjs';

const CELL = 8;
const VIEWS = { f: Float64Array, i: BigInt64Array, b: Uint8Array };
const isArray = type => typeof type === 'string' && type.length === 2; // as 'f2': kind, dimensions

export async function load(source) {
  const made = await WebAssembly.instantiate(source, {});
  return kernels(made.instance ?? made);
}

export function kernels(instance) {
  const { memory, malloc, free, ...entries } = instance.exports;
  entries._initialize?.();

  const room = bytes => {
    const address = malloc(Math.max(CELL, bytes)) >>> 0;
    if (!address) throw new Error(`no memory for ${bytes} bytes`);
    return address;
  };
  const count = type => isArray(type) ? 1 + Number(type[1]) : type === 'c' ? 2
    : typeof type === 'string' ? 1 : Object.values(type).reduce((sum, part) => sum + count(part), 0);

  const write = (data, type, value, at) => {
    if (isArray(type)) {
      if (value.kind !== type[0] || value.shape.length !== Number(type[1])) throw new TypeError(`no array of type ${type}`);
      [value.address, ...value.shape].forEach((cell, k) => data.setBigInt64(at + k * CELL, BigInt(cell), true));
    } else if (type === 'f') data.setFloat64(at, value, true);
    else if (typeof type === 'string') data.setBigInt64(at, BigInt(value), true);
    else for (const [name, part] of Object.entries(type)) {
      write(data, part, value[name], at);
      at += count(part) * CELL;
    }
  };
  const read = (data, type, at) => {
    if (type === 'f') return data.getFloat64(at, true);
    if (type === 'c') return [data.getFloat64(at, true), data.getFloat64(at + CELL, true)];
    if (typeof type === 'string') return type === 'b' ? data.getUint8(at) !== 0 : Number(data.getBigInt64(at, true));
    const parts = Object.entries(type).map(([name, part]) => {
      const value = read(data, part, at);
      at += count(part) * CELL;
      return [name, value];
    });
    return Array.isArray(type) ? parts.map(([, value]) => value) : Object.fromEntries(parts);
  };

  const array = (kind, shape, values) => {
    const length = shape.reduce((product, size) => product * size, 1);
    const address = room(length * VIEWS[kind].BYTES_PER_ELEMENT);
    // A new view each time: the memory moves when it grows.
    const made = { kind, shape, address, get values() { return new VIEWS[kind](memory.buffer, address, length); }, free: () => free(address) };
    if (values) made.values.set(values); else made.values.fill(kind === 'i' ? 0n : 0);
    return made;
  };
  const call = (name, { takes, gives }) => {
    const first = count(takes) * CELL, cells = room(first + count(gives ?? []) * CELL);
    return (...values) => {
      write(new DataView(memory.buffer), takes, values, cells);
      if (entries[`rs_${name}`](cells)) throw new Error(`kernel ${name}: no memory`);
      return gives === null ? undefined : read(new DataView(memory.buffer), gives, cells + first);
    };
  };
  return { array, ...Object.fromEntries(Object.entries(signatures).map(([name, types]) => [name, call(name, types)])) };
}
