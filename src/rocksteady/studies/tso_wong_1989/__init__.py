"""W. K. Tso and C. M. Wong, *Steady state rocking response of rigid blocks part 1: Analysis*,
Earthquake Engineering and Structural Dynamics 18, 89-106 (1989): every figure, every statement.

`reproduce` computes them and `Study.save` writes them into a folder.
"""  # noqa: D205 -- one sentence

from rocksteady.studies.tso_wong_1989.study import Study, reproduce

__all__ = ["Study", "reproduce"]
