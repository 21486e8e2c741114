// The kernels in a page or in node, without a server: load the module and call them by name.
// Named tuples are objects, other tuples are arrays; the types are in loader.d.mts.
import { signatures } from './signatures.mjs';

const CELL = 8;
const VIEWS = { f: Float64Array, i: BigInt64Array, b: Uint8Array };
const isArray = type => typeof type === 'string' && type.length === 2; // as 'f2': kind, dimensions

export async function load(source, types = signatures) {
  const made = await WebAssembly.instantiate(source, {});
  return kernels(made.instance ?? made, types);
}

export function kernels(instance, types = signatures) {
  const { memory, malloc, free, ...entries } = instance.exports;
  entries._initialize?.();

  const room = bytes => {
    const address = malloc(Math.max(CELL, bytes)) >>> 0;
    if (!address) throw new Error(`no memory for ${bytes} bytes`);
    return address;
  };
  // What is written and read is laid out once an entry.
  const count = type => isArray(type) ? 1 + Number(type[1]) : type === 'c' ? 2
    : typeof type === 'string' ? 1 : Object.values(type).reduce((sum, part) => sum + count(part), 0);

  const placed = type => {
    let at = 0;
    return Object.entries(type).map(([name, part]) => {
      const place = { name, part, at };
      at += count(part) * CELL;
      return place;
    });
  };
  const whole = (data, value, at) => {
    if (typeof value === 'number' && (value | 0) === value) {
      data.setInt32(at, value, true);
      data.setInt32(at + 4, value >> 31, true);
    } else data.setBigInt64(at, BigInt(value), true);
  };
  const writer = type => {
    if (isArray(type)) {
      const kind = type[0], rank = Number(type[1]);
      return (data, value, at) => {
        if (value.kind !== kind || value.shape.length !== rank) throw new TypeError(`no array of type ${type}`);
        whole(data, value.address, at);
        for (let k = 0; k < rank; k++) whole(data, value.shape[k], at + (k + 1) * CELL);
      };
    }
    if (type === 'f') return (data, value, at) => data.setFloat64(at, value, true);
    if (typeof type === 'string') return whole;
    const parts = placed(type).map(({ name, part, at }) => ({ name, at, write: writer(part) }));
    return (data, value, from) => {
      for (const { name, at, write } of parts) write(data, value[name], from + at);
    };
  };
  const reader = type => {
    if (type === 'f') return (data, at) => data.getFloat64(at, true);
    if (type === 'c') return (data, at) => [data.getFloat64(at, true), data.getFloat64(at + CELL, true)];
    if (type === 'b') return (data, at) => data.getUint8(at) !== 0;
    if (typeof type === 'string') return (data, at) => Number(data.getBigInt64(at, true));
    const parts = placed(type).map(({ name, part, at }) => ({ name, at, read: reader(part) }));
    return (data, from) => {
      const found = Array.isArray(type) ? [] : {};
      for (const { name, at, read } of parts) found[name] = read(data, from + at);
      return found;
    };
  };

  const array = (kind, shape, values) => {
    const length = shape.reduce((product, size) => product * size, 1);
    const address = room(length * VIEWS[kind].BYTES_PER_ELEMENT);
    let view;
    const made = {
      kind, shape, address, free: () => free(address),
      get values() {
        // A new view when the memory has grown, and moved.
        if (view?.buffer !== memory.buffer) view = new VIEWS[kind](memory.buffer, address, length);
        return view;
      },
    };
    if (values) made.values.set(values); else made.values.fill(kind === 'i' ? 0n : 0);
    return made;
  };
  let memoryView = new DataView(memory.buffer);
  const data = () => memoryView.buffer === memory.buffer ? memoryView : memoryView = new DataView(memory.buffer);
  const call = (name, { takes, gives }) => {
    const first = count(takes) * CELL, entry = entries[`rs_${name}`];
    const write = writer(takes), read = gives && reader(gives);
    let cells = 0;
    return (...values) => {
      cells ||= room(first + count(gives ?? []) * CELL);
      write(data(), values, cells);
      if (entry(cells)) throw new Error(`kernel ${name}: no memory`);
      return read ? read(data(), cells + first) : undefined;
    };
  };
  return { array, ...Object.fromEntries(Object.entries(types).map(([name, each]) => [name, call(name, each)])) };
}
