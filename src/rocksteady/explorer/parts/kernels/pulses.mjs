// Made by `python -m tools.aot.web` from the shapes of pulses in Python.

/**
 * Shapes by name; where a Ricker wavelet ends, by the tolerance of its lines.
 * @type {Record<string, { words: string, form: number, pieces: number[][],
 *   reach: Record<number, number>, oscillations: number, phase: number, peak: number }>}
 */
export const PULSES = {
  'rectangle': { words: 'constant for half a period', form: 0, pieces: [[3.141592653589793, 1.0, 0.0, 0.0, 0.0, 0.0]], reach: {}, oscillations: 1.0, phase: 0.0, peak: 1.0 },
  'half-sine': { words: 'sine for half a period', form: 0, pieces: [[3.141592653589793, 0.0, 0.0, 1.0, 1.0, 0.0]], reach: {}, oscillations: 1.0, phase: 0.0, peak: 1.0 },
  'versed-sine': { words: '(1 - cos)/2, one lobe in half a period', form: 0, pieces: [[3.141592653589793, 0.5, 0.0, 0.5, 2.0, -1.5707963267948966]], reach: {}, oscillations: 1.0, phase: 0.0, peak: 1.0 },
  'triangle': { words: 'up and down along lines in half a period', form: 0, pieces: [[1.5707963267948966, 0.0, 1.0, 0.0, 0.0, 0.0], [1.5707963267948966, 1.0, -1.0, 0.0, 0.0, 0.0]], reach: {}, oscillations: 1.0, phase: 0.0, peak: 1.0 },
  'decaying-ramp': { words: 'at once up, down along a line in half a period', form: 0, pieces: [[3.141592653589793, 1.0, -1.0, 0.0, 0.0, 0.0]], reach: {}, oscillations: 1.0, phase: 0.0, peak: 1.0 },
  'one-sine': { words: 'sine for a period (type A)', form: 0, pieces: [[6.283185307179586, 0.0, 0.0, 1.0, 1.0, 0.0]], reach: {}, oscillations: 1.0, phase: 0.0, peak: 1.0 },
  'one-cosine': { words: 'cosine for a period (type B)', form: 0, pieces: [[6.283185307179586, 0.0, 0.0, 1.0, 1.0, 1.5707963267948966]], reach: {}, oscillations: 1.0, phase: 0.0, peak: 1.0 },
  'type-c1': { words: 'cosine for 1.43 periods from a phase at which the ground comes back', form: 0, pieces: [[8.986818915818128, 0.0, 0.0, 1.0, 1.0, 1.7897758492705222]], reach: {}, oscillations: 1.0, phase: 0.0, peak: 1.0 },
  'type-c2': { words: 'the same for 2.46 periods', form: 0, pieces: [[15.450503673875414, 0.0, 0.0, 1.0, 1.0, 1.6995261238316726]], reach: {}, oscillations: 1.0, phase: 0.0, peak: 1.0 },
  'type-c3': { words: 'the same for 3.47 periods', form: 0, pieces: [[21.808243318857798, 0.0, 0.0, 1.0, 1.0, 1.662248954930273]], reach: {}, oscillations: 1.0, phase: 0.0, peak: 1.0 },
  'ricker': { words: 'second derivative of a Gaussian bell, one large lobe between two small ones', form: 1, pieces: [], reach: {1e-06: 5.887603206473685, 0.0001: 4.975578687080307}, oscillations: 1.0, phase: 0.0, peak: 1.0 },
  'ricker-antisymmetric': { words: 'third derivative, one lobe and its opposite between two small ones', form: 2, pieces: [], reach: {1e-06: 6.140905750239072, 0.0001: 5.242733127840895}, oscillations: 1.0, phase: 0.0, peak: 1.0 },
  'mavroeidis-papageorgiou': { words: 'a velocity cos(omega t + nu) under a bell of gamma periods', form: 3, pieces: [], reach: {}, oscillations: 2.0, phase: 0.0, peak: 0.9060248235438082 },
};
