"""How the command line ends; the numbers agree with pytest's where it has them."""

from __future__ import annotations

from typing import Final

OK: Final = 0
FAILURES: Final = 1
"""Something was compared and differs, or could not be read."""
USAGE: Final = 2
NOTHING_RAN: Final = 4
"""Nothing was compared, so nothing was shown to be right."""
