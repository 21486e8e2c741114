"""Elementary functions that give the same bits on every machine.

They are plain float64 arithmetic: ``+ - * /``, square roots, comparisons and bits.  Each operation
is rounded once, as IEEE 754 says, and none is fused with another; no library of the system is
called.  So machine code, WebAssembly and plain Python give one result.

Special values follow C99, Annex F: infinities, NaN, signed zeros and subnormal numbers.  A pole or
an invalid argument gives an infinity or NaN and raises nothing.

Largest errors, in units in the last place (ulp) of the exact result:

=============  =====  =============================================================
function       ulp    arguments
=============  =====  =============================================================
exp            0.57   all; 1.0 where the result is subnormal
expm1          1.3    all
log, log1p     0.9    all
sin, cos       0.9    all
tan            1.0    all
asin, acos     1.0    all
atan, atan2    0.75   all
sinh           2.0    all
cosh           1.2    all
tanh           2.2    all
asinh          1.9    all
hypot          0.55   all; 1.0 where the result is subnormal
=============  =====  =============================================================

Modules: `bits` the numbers behind a float, `exponential`, `logarithm`, `circular`, `inverse`,
`hyperbolic`, `lengths`, `loops` the functions over arrays, `arrays` the functions for callers in
Python.
"""
