// What a worker does: it takes the module once, then runs one job after the other.

/** @import { Kernels } from '../kernels/loader.mjs' */
import { kernels } from '../kernels/loader.mjs';

/**
 * Run jobs that the page asks for.
 * @param {Record<string, (kernels: Kernels, args: any) => unknown>} jobs  by their names
 */
export function serve(jobs) {
  /** @type {Promise<Kernels> | undefined} */
  let ready;
  onmessage = async ({ data }) => {
    if (data.module) {
      const module = /** @type {WebAssembly.Module} */ (data.module);
      ready = WebAssembly.instantiate(module, {}).then(kernels);
      return;
    }
    /** @type {(message: unknown, move?: Transferable[]) => void} */
    const post = /** @type {any} */ (postMessage);
    try {
      const found = await ready;
      if (!found) throw new Error('the module has not been given');
      const result = jobs[data.job](found, data.args);
      post({ id: data.id, result }, buffersIn(result));
    } catch (error) {
      post({ id: data.id, fault: error instanceof Error ? error.message : String(error) });
    }
  };
}

/**
 * Return the memory of all typed arrays in a result, so that none is copied.
 * @param {unknown} value
 * @returns {ArrayBuffer[]}
 */
function buffersIn(value) {
  if (ArrayBuffer.isView(value)) return [/** @type {ArrayBuffer} */ (value.buffer)];
  if (value === null || typeof value !== 'object') return [];
  return [...new Set(Object.values(value).flatMap(buffersIn))];
}
