"""``python -m pbfluids`` is the command ``pbfluids``."""

from __future__ import annotations

import sys

from pbfluids.cli import main

sys.exit(main())
