// A motion made by a formula, for a page without a record; products and sums alone, so that NumPy
// gives the same bits.

const HUMPS = [ // peak [g], middle [s], half width [s]
  [0.12, 1.2, 0.4], [-0.24, 1.95, 0.4], [0.36, 2.55, 0.25], [-0.52, 2.9, 0.15], [0.52, 3.3, 0.25],
  [-0.54, 3.65, 0.15], [0.24, 4.1, 0.3], [-0.3, 4.75, 0.4], [0.18, 5.3, 0.2], [-0.08, 5.95, 0.45],
];
const SYNTHETIC_COUNT = 1000;
const SYNTHETIC_STEP = 0.01;

/** The same samples in Python, with `numpy` as np. */
export const SYNTHETIC_IN_PYTHON = `9.80665 * sum(c * np.maximum(0.0, 1.0 - ((${SYNTHETIC_STEP}`
  + ` * np.arange(${SYNTHETIC_COUNT}.0) - m) / w)**2)**2 for c, m, w in`
  + ` [${HUMPS.map((hump) => `(${hump.join(', ')})`).join(', ')}])`;

/**
 * Return the motion.
 * @returns {{ name: string, dt: number, samples: Float64Array, note: string }}
 */
export function syntheticMotion() {
  const samples = Float64Array.from({ length: SYNTHETIC_COUNT }, (_, k) => {
    let total = 0;
    for (const [size, middle, width] of HUMPS) {
      const x = (SYNTHETIC_STEP * k - middle) / width, y = Math.max(0, 1 - x * x);
      total += size * (y * y);
    }
    return 9.80665 * total;
  });
  const note = `Synthetic example, not a record: acceleration_m_s2 = ${SYNTHETIC_IN_PYTHON},`
    + ` dt_s = ${SYNTHETIC_STEP}`;
  return { name: 'synthetic example, not a record', dt: SYNTHETIC_STEP, samples, note };
}
