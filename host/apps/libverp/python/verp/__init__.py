"""VERP: humanoid robots in a world, the controller that drives them, and its algorithms, with the controller's own bits.

Session: robots in a world, a control tick at a time. Core: the controller alone. Env and VectorEnv (verp.env): for
learning. SI units; frames and meanings stand in verp.h.
"""

from . import _needs  # noqa: F401  isort: skip
from ._core import Core
from ._lib import VerpError, ffi, lib
from ._session import GET_UP, RELAX, STAND, WALK, Moment, Quantity, Result, Session, replay
from ._sight import Camera, Picture

__all__ = [
    "Camera",
    "Core",
    "GET_UP",
    "Moment",
    "Picture",
    "Quantity",
    "RELAX",
    "Result",
    "STAND",
    "Session",
    "VerpError",
    "WALK",
    "replay",
    "version",
]


def version() -> str:
    """The revision of the library's sources."""
    return ffi.string(lib.verp_version()).decode()
