// The scene order, alone.

import { cascadeOf, orderAt } from '../physics/story/order.mjs';
import { makeOrder } from '../story/scenes/order.mjs';
import { embed } from './embed.mjs';

/** Begin. */
export function start() {
  embed('order', makeOrder, { cascadeOf, orderAt });
}
