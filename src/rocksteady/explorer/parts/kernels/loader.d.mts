// Made by `python -m tools.aot.web` from the annotations of the kernels.

/** An array in the module's memory, row after row; free it when it is not needed any more. */
interface KernelArray<Kind, Values> {
  readonly kind: Kind;
  readonly shape: readonly number[];
  /** Its elements: take them anew after each call, since the memory may have moved. */
  readonly values: Values;
  free(): void;
}
export type Floats = KernelArray<'f', Float64Array>;
export type Integers = KernelArray<'i', BigInt64Array>;
export type Booleans = KernelArray<'b', Uint8Array>;

/** A motion and a block, with the columns of `rocksteady.kernels.core.tables`. */
export interface Tables {
  segments: Floats;
  sides: Floats;
}

/** What a flight needs to know of one segment, from one side, in that side's own units. */
export interface Forcing {
  kind: number;
  constant: number;
  slope: number;
  amplitude: number;
  frequency: number;
  beta: number;
  swing: number;
  rising: number;
  node_sine: number;
  node_cosine: number;
}

/** Harmonic shaking seen from both sides of a block. */
export interface System {
  positive: Forcing;
  negative: Forcing;
  frequency: number;
  restitution: [number, number];
  free: number;
  lean: [number, number];
  rate: [number, number];
  alpha: [number, number];
  amplitude: number;
  left_out: number;
}

/** A pulse in numbers. */
export interface PulseNumbers {
  form: number;
  pieces: Floats;
  amplitude: number;
  frequency_ratio: number;
  tolerance: number;
  reach: number;
  oscillations: number;
  phase: number;
  peak: number;
}

/** Where steady states are wanted; arrays of shape (points,). */
export interface Points {
  amplitude: Floats;
  frequency_ratio: Floats;
  restitution: Floats;
  order: Integers;
}

/** Receives both branches at every point; where there is no orbit the numbers are nan. */
export interface Steady {
  region: Integers;
  boundaries: Floats;
  phase: Floats;
  velocity: Floats;
  trace: Floats;
  peak: Floats;
  extrema: Integers;
  admissible: Booleans;
}

/** One symmetric orbit of the algebra, whether or not the floor allows it. */
export interface Symmetric {
  phase: number;
  sine: number;
  cosine: number;
  velocity: number;
  trace: number;
}

/** A state just after an impact, or (with speed 0) at an uplift. */
export interface Section {
  side: number;
  half_cycles: number;
  phase: number;
  speed: number;
}

/** Derivative of (phase, speed) after a passage by (phase, speed) before it. */
export interface Jacobian {
  phase_by_phase: number;
  phase_by_speed: number;
  speed_by_phase: number;
  speed_by_speed: number;
}

/** One step of the return map. */
export interface Passage {
  kind: number;
  state: Section;
  time: number;
  landing: number;
  jacobian: Jacobian;
}

/** Symmetric blocks of the linear model under harmonic shaking; arrays of shape (cells,). */
export interface SymmetricCells {
  amplitude: Floats;
  frequency_ratio: Floats;
  restitution: Floats;
}

/** Where motions start, as `rocksteady.kernels.core.tables.March` has it, of shape (cells,). */
export interface States {
  side: Integers;
  angle: Floats;
  velocity: Floats;
  half_cycles: Integers;
  phase: Floats;
}

/** Receives what motions settle to, in the columns of `rocksteady.kernels.batch.attractors`. */
export interface Outcomes {
  whole: Integers;
  real: Floats;
}

/** State of a march between two flights. */
export interface March {
  side: number;
  angle: number;
  velocity: number;
  segment: number;
  half_cycles: number;
  phase: number;
  impacts: number;
  flights: number;
}

/** Where a march ends at the latest, and when it may come to rest. */
export interface Until {
  half_cycles: number;
  phase: number;
  rest_velocity: number;
  limit: number;
}

/** What a march keeps of its flights. */
export interface Kept {
  rows: Floats;
  peaks: Floats;
}

/** An attempt to find an orbit. */
export interface Fixed {
  found: boolean;
  residual: number;
  jacobian: Jacobian;
  rests: number;
  grazes: number;
}

/** Receives how a block fares under pulses; arrays of shape (cells,). */
export interface PulseFates {
  status: Integers;
  impacts: Integers;
  side: Integers;
  during: Integers;
  margin: Floats;
}

/** Blocks under one motion. */
export interface Blocks {
  sides: Floats;
  afterwards: Floats;
}

/** Receives how blocks under one motion fare. */
export interface PeakFates {
  status: Integers;
  impacts: Integers;
  peaks: Floats;
}

/** What a recorded march amounts to, in pivot time; nan where it does not apply. */
export interface RunFacts {
  last: number;
  end: number;
  passing: number;
  since: number;
  overturned: number;
  rested: number;
  peaks: [number, number, number];
}

/** Any state of a block, as `rocksteady.kernels.core.tables.March` has it. */
export interface AnyState {
  side: number;
  half_cycles: number;
  phase: number;
  angle: number;
  velocity: number;
}

/** What a motion settles to. */
export interface Settled {
  outcome: number;
  state: Section;
  passages: number;
  periods: number;
  residual: number;
  rests: number;
  lyapunov: number;
  least: number;
  after: number;
  growth: number;
}

/** Blocks under harmonic shaking, one a cell. */
export interface Cells {
  amplitude: Floats;
  frequency_ratio: Floats;
  sides: Floats;
}

/** An attempt to find a symmetric orbit. */
export interface Half {
  found: boolean;
  state: Section;
  jacobian: Jacobian;
}

export interface Kernels {
  /** Make an array in the module's memory, of zeros where no values are given. */
  array(kind: 'f', shape: readonly number[], values?: ArrayLike<number>): Floats;
  array(kind: 'i', shape: readonly number[], values?: ArrayLike<bigint>): Integers;
  array(kind: 'b', shape: readonly number[], values?: ArrayLike<number>): Booleans;
  /** Split an unbounded phase into whole half cycles and a rest in [0, pi). */
  clock(phase: number): [number, number];
  /** Fill `out` with the angle of (x, y) of each pair. */
  fill_atan2(y: Floats, x: Floats, out: Floats): void;
  /** Fill an upper bound of |a| from each segment's start on, and how many alike follow at once. */
  fill_bounds(table: Floats): void;
  /** Split phases into whole half cycles and rests in [0, pi), all of shape (cells,). */
  fill_clocks(phase: Floats, half_cycles: Integers, rest: Floats): void;
  /** Fill `out` with the cosine of each x. */
  fill_cos(x: Floats, out: Floats): void;
  /** Fill the five curves of the plane, shape (5, points), at each frequency ratio. */
  fill_curves(frequency_ratio: Floats, restitution: Floats, order: Integers, curves: Floats): void;
  /** Fill `out` with e^x of each x. */
  fill_exp(x: Floats, out: Floats): void;
  /** Fill `out` with the length of (x, y) of each pair. */
  fill_hypot(x: Floats, y: Floats, out: Floats): void;
  /** Fill the impacts of a recorded march, however slow, and return how many there are. */
  fill_landings(tables: Tables, rows: Floats, starts: Floats, landings: Floats): number;
  /** Fill straight lines between evenly spaced samples, the still base after them, and bounds. */
  fill_lines(samples: Floats, step: number, table: Floats): void;
  /** Fill `out` with the natural logarithm of each x. */
  fill_log(x: Floats, out: Floats): void;
  /** Fill `out` with log(1 + x) of each x. */
  fill_log1p(x: Floats, out: Floats): void;
  /** Fill `out` with the next number above of each x. */
  fill_next_up(x: Floats, out: Floats): void;
  /** Fill the largest |theta|/alpha of each passage of an orbit that has been measured. */
  fill_peaks(system: System, passages: number, table: Floats): void;
  /** Fill the segments of a pulse; return how many there are, and how many lines it needs. */
  fill_pulse(pulse: PulseNumbers, table: Floats): [number, number];
  /** Fill `out` with the sine of each x. */
  fill_sin(x: Floats, out: Floats): void;
  /** Fill angle, velocity and acceleration, shape (3, times), in reference units. */
  fill_states(segments: Floats, sides: Floats, rows: Floats, index: Integers, since: Floats, states: Floats): void;
  /** Fill both branches at every point; without `shapes` the last three are left as they are. */
  fill_steady(points: Points, shapes: boolean, steady: Steady): void;
  /** Fill `out` with the tangent of each x. */
  fill_tan(x: Floats, out: Floats): void;
  /** Return the derivative of the half-cycle map in (phase, du/ds after impact), row by row. */
  half_cycle_jacobian(amplitude: number, frequency_ratio: number, restitution: number, order: number, orbit: Symmetric): [number, number, number, number];
  /** Fill row 0 with endless harmonic shaking; `amplitude` and `frequency` as for the model. */
  harmonic_segment(segments: Floats, amplitude: number, frequency: number, phase: number): void;
  /** Return the largest |theta|/alpha of the passage after a state, on its side and the other. */
  highest_after(system: System, state: Section, passage: Passage): [number, number];
  /** Return whether half of an orbit turns it into its mirror image. */
  is_symmetric(system: System, table: Floats, passages: number, periods: number): boolean;
  /** Follow motions of symmetric blocks until it is known what they settle to. */
  lane_attractors(cells: SymmetricCells, states: States, cycles: number, outcomes: Outcomes): void;
  /** Return the exact determinant of the Jacobian of an orbit that starts towards a side. */
  loss(system: System, side: number, passages: number, rests: number): number;
  /** Return the system of shaking ``A sin(Omega s + phi)`` and a table of sides. */
  make_system(amplitude: number, frequency: number, sides: Floats): System;
  /** March from `start` to the stop, to overturning, or to the limit. */
  march(tables: Tables, start: March, until: Until, kept: Kept): [number, March];
  /** Return by what the states of a table fail to be an orbit, and fill in its derivatives. */
  measured(system: System, passages: number, periods: number, table: Floats): Fixed;
  /** Return the eigenvalues of an orbit's Jacobian, the larger in modulus first. */
  multipliers(jacobian: Jacobian, determinant: number): [[number, number], [number, number]];
  /** Return the passage that follows a state; `guess` is a time near which the impact may be. */
  next_passage(system: System, state: Section, guess: number): Passage;
  /** Find the orbit of m passages and n periods near a state, and leave its states in a table. */
  polish(system: System, state: Section, passages: number, periods: number, table: Floats): Fixed;
  /** March a block from rest through a pulse of many sizes and write its fates. */
  pulse_fates(tables: Tables, amplitude: Floats, frequency_ratio: Floats, rest_velocity: number, limit: number, fates: PulseFates): void;
  /** March blocks from rest through one motion and note how each fares. */
  record_fates(segments: Floats, blocks: Blocks, limit: number, fates: PeakFates): void;
  /** Return half cycles and phase (or time) on the last segment at which a run ends. */
  run_end(tables: Tables, cycles: number): [number, number];
  /** Return times and peaks of a recorded march, and fill the time at which each row begins. */
  run_facts(tables: Tables, rows: Floats, status: number, starts: Floats): RunFacts;
  /** Return half cycles and phase (or time) at the start of a segment. */
  segment_start(segments: Floats, index: number): [number, number];
  /** Follow a motion from any state until it is known what it settles to. */
  settle(system: System, start: AnyState, most_periods: number, memory: Floats, table: Floats): Settled;
  /** Follow motions until it is known what they settle to. */
  settle_cells(cells: Cells, states: States, cycles: number, outcomes: Outcomes): void;
  /** Return the symmetric orbit of the nonlinear model to which one of the linear model leads. */
  symmetric_from(amplitude: number, frequency_ratio: number, sides: Floats, order: number, branch: number, state: Section): Half;
  /** Return branch 1 or 2 (upper or lower signs of eqs 21, 22); the amplitude must allow it. */
  symmetric_orbit(amplitude: number, frequency_ratio: number, restitution: number, order: number, branch: number): Symmetric;
}

/** Load the module from its bytes, or from what has been compiled of them. */
export function load(source: BufferSource | WebAssembly.Module): Promise<Kernels>;

/** Return the kernels of an instance of the module. */
export function kernels(instance: WebAssembly.Instance): Kernels;
