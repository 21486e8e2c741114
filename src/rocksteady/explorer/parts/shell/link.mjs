// The link: the state in the fragment of the address, short and flat.

/** @import { State } from './state.mjs' */
import { FIELDS, defaultState, patched } from './state.mjs';

const LINK_VERSION = '2';
/** What links of an older version mean that name no tab. */
const OLDER = { version: '1', tab: 'explore' };
const LANDING = 'push'; // what a place that is not known leads to
const LONGEST_LINK = 4000; // characters

/**
 * Return the fragment of a state; keys at their defaults are left out, where not all are wanted.
 * @param {State} state
 * @param {boolean} [all]
 */
export function linkOf(state, all = false) {
  const given = Object.entries(state).filter(([name, value]) => all || value !== FIELDS[name].value);
  const parts = [['v', LINK_VERSION], ...given];
  return `#${parts.map(([name, value]) => `${name}=${encodeURIComponent(value)}`).join('&')}`;
}

/**
 * Return the state of a fragment, and what of it was ignored; null where it holds no state.
 * @param {string} fragment
 * @returns {{ state: State, ignored: string[] } | null}
 */
export function stateOfLink(fragment) {
  const text = fragment.replace(/^#/, '').slice(0, LONGEST_LINK);
  if (!text.includes('=')) return null;
  /** @type {Record<string, string>} */
  const patch = {};
  /** @type {string[]} */
  const ignored = [];
  let older = false;
  for (const part of text.split('&')) {
    const [name, value = ''] = part.split('=', 2);
    if (name === 'v') {
      if (value === OLDER.version) older = true;
      else if (value !== LINK_VERSION) ignored.push(`v=${value}`);
      continue;
    }
    try {
      if (Object.hasOwn(FIELDS, name)) patch[name] = decodeURIComponent(value);
      else ignored.push(name);
    } catch {
      ignored.push(name);
    }
  }
  const { state, refused } = patched(defaultState(), older ? { tab: OLDER.tab, ...patch } : patch);
  const { state: found } = refused.includes('at') ? patched(state, { at: LANDING }) : { state };
  return { state: found, ignored: [...ignored, ...refused] };
}
