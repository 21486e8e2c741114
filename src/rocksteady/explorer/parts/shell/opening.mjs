// What a page begins with: its kernels, or why it has none.

/** @import { Kernels } from '../kernels/loader.mjs' */
import { kernels } from '../kernels/loader.mjs';
import { element } from './app.mjs';

/**
 * Return the page's module and its kernels.
 * @returns {Promise<{ module: WebAssembly.Module, found: Kernels }>}
 */
export async function openKernels() {
  if (typeof WebAssembly === 'undefined') throw new Error('this browser has no WebAssembly');
  if (typeof DecompressionStream === 'undefined') throw new Error('this browser is too old');
  const module = await WebAssembly.compile(await unpacked(blockText('kernels')));
  return { module, found: kernels(await WebAssembly.instantiate(module, {})) };
}

/** Return the text of a block of the page. @param {string} id */
export function blockText(id) {
  return element(id).textContent ?? '';
}

/**
 * Return the bytes of a compressed block.
 * @param {string} text  base64 of gzip
 */
async function unpacked(text) {
  /** @type {any} */
  const { fromBase64 } = Uint8Array; // of browsers since 2025
  const bytes = fromBase64?.call(Uint8Array, text)
    ?? Uint8Array.from(atob(text.trim()), (letter) => letter.charCodeAt(0));
  const plain = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Response(plain).arrayBuffer();
}

/** Say why the page cannot compute; its words stay. @param {unknown} error */
export function refusal(error) {
  console.error(error);
  document.documentElement.dataset.ready = 'false';
  element('story').hidden = element('refusal').hidden = false;
  element('refusal').append(element('still'));
  element('cause').textContent = error instanceof Error ? error.message : String(error);
}
