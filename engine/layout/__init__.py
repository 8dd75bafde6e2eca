"""Where things lie in the engine's flat arrays.

Kernels address rows and worlds with these constants, which Numba freezes; Python reads the same rows by
name, through `STATE_DTYPE`, `QUERY_DTYPE` and `RESULT_DTYPE`. Integers (flags, cell ids, indices) are
stored as float64, which holds them exactly.

The constants of all modules of this package are imported from here.
"""

from engine.layout.messages import *
from engine.layout.rows import *
from engine.layout.state import *
from engine.layout.world import *
