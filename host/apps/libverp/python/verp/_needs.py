"""What this package needs, in one line where it is missing. Imported before all else, by any Python 3."""

import importlib.util
import sys

_lacks = [name for name in ("cffi", "numpy") if importlib.util.find_spec(name) is None]
if sys.version_info < (3, 11):
    _lacks.insert(0, "Python 3.11 or later")
if _lacks:
    raise ImportError(
        "verp: " + sys.executable + " lacks " + " and ".join(_lacks) + ": run `./verp python FILE`, "
        "or /usr/bin/python3 with Debian's python3-cffi and python3-numpy"
    )
