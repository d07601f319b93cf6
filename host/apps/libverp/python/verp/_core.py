"""The controller's own algorithms, with its bits."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._lib import Handle, calls, dtype_of, ffi, layout_dtype, lib, memory, reals, whole

INPUTS = dtype_of(ffi.typeof("verp_inputs"))
OUTPUTS = dtype_of(ffi.typeof("verp_outputs"))
PLAN = dtype_of(ffi.typeof("verp_plan"))


def pointer(array: np.ndarray, ctype: str) -> object:
    """To an array's own memory."""
    return ffi.cast(ctype, array.ctypes.data)


def _angles(angle_rad: Any, call: str) -> NDArray[np.float32]:
    """As the library reads them. How many there have to be it knows itself, but not what lies beyond an array of another shape."""
    angles = reals(angle_rad, f"{call}: angle_rad")
    if angles.ndim != 1:
        raise ValueError(f"{call}: angle_rad: one row of angles is needed, not an array of shape {angles.shape}")
    return _single(angles)


def _single(array: NDArray[np.float64]) -> NDArray[np.float32]:
    with np.errstate(over="ignore"):  # the library refuses the infinite
        return np.ascontiguousarray(array, np.float32)


class Core(Handle):
    """One robot's controller without a world.

    >>> core = Core("generic21")
    >>> core.com(core.zeros())          # m, body frame
    """

    def __init__(self, model: str = "generic21", bus: str | None = None, tuning: str | None = None) -> None:
        where = ffi.new("verp_core *")
        calls.core_open(model, bus, tuning, where)
        self._core = where[0]
        super().__init__(self._core, lib.verp_core_close)
        self.joint_names: list[str] = [self._name(j) for j in range(self._get("joints", "uint32_t *"))]
        self.period_s: float = self._get("period", "double *")
        self._in, self._inputs = memory("verp_inputs", INPUTS)
        self._out, self._outputs = memory("verp_outputs", OUTPUTS)

    @property
    def inputs(self) -> np.ndarray:
        """What the next step() reads: numpy records, memory that stays where it is; write into it: inputs[0] = ..."""
        self._need_open("Core.inputs")
        return self._inputs

    @property
    def outputs(self) -> np.ndarray:
        """What the last step() wrote; memory that stays where it is."""
        self._need_open("Core.outputs")
        return self._outputs

    def _get(self, what: str, ctype: str) -> int | float:
        value = ffi.new(ctype)
        getattr(calls, f"core_{what}")(self._core, value)
        return value[0]

    def _name(self, joint: int) -> str:
        name = ffi.new(f"char[{lib.VERP_NAME}]")
        calls.core_joint_name(self._core, joint, name, lib.VERP_NAME)
        return ffi.string(name).decode()

    def reset(self) -> None:
        """As it is when power comes on."""
        calls.core_reset(self._core)

    def step(self) -> None:
        """One control tick, from self.inputs to self.outputs."""
        calls.core_step(self._core, self._in, self._out)

    @property
    def digest(self) -> int:
        """Of all ticks so far."""
        return self._get("digest", "uint64_t *")

    def state(self) -> np.ndarray:
        """All that the last tick leaves for the next: one record, fields as in C++."""
        return self._bytes("state")

    def params(self) -> np.ndarray:
        """The robot as constants: one record, fields as in C++."""
        return self._bytes("params")

    def _bytes(self, what: str) -> np.ndarray:
        array = np.zeros(1, layout_dtype(what))
        getattr(calls, f"core_{what}")(self._core, pointer(array, "void *"), array.nbytes)
        return array

    def zeros(self) -> NDArray[np.float32]:
        """All joints at zero, rad."""
        return np.zeros(len(self.joint_names), np.float32)

    def count(self, joint: int, angle_rad: float) -> int:
        """A joint's angle in its servo's counts."""
        value = ffi.new("int32_t *")
        calls.core_count(self._core, joint, angle_rad, value)
        return value[0]

    def angle(self, joint: int, count: int) -> float:
        """The angle, rad, of a joint whose servo is at these counts."""
        value = ffi.new("float *")
        calls.core_angle(self._core, joint, count, value)
        return value[0]

    def forward(self, angle_rad: NDArray[np.float32]) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
        """Rotations (n + 1, 3, 3) and positions (n + 1, 3) of all links, body frame; the first is the body's."""
        angles = _angles(angle_rad, "verp_core_forward")
        poses = np.zeros((len(angles) + 1, lib.VERP_POSE), np.float32)
        calls.core_forward(self._core, pointer(angles, "float *"), len(angles), pointer(poses, "float *"))
        return poses[:, :9].reshape(-1, 3, 3), poses[:, 9:]

    def com(self, angle_rad: NDArray[np.float32]) -> NDArray[np.float32]:
        """Centre of mass, m, body frame."""
        angles, com_m = _angles(angle_rad, "verp_core_com"), np.zeros(3, np.float32)
        calls.core_com(self._core, pointer(angles, "float *"), len(angles), pointer(com_m, "float *"))
        return com_m

    def leg_joints(self, side: int) -> list[int]:
        """The joints of a leg, hip to ankle, as they count in joint_names; 255: it has no such joint."""
        joint = ffi.new(f"uint32_t[{lib.VERP_LEG_JOINTS}]")
        calls.core_leg_joints(self._core, side, joint)
        return list(joint)

    def leg_ik(self, side: int, rotation: np.ndarray, position_m: np.ndarray) -> tuple[NDArray[np.float32], int]:
        """Six angles, hip to ankle, that put the sole there (body frame), and flags: 0 if it stands exactly so, else 1 out of
        reach, 2 a joint at its limit, 4 not converged. A rotation is 3 x 3, or its nine numbers row by row."""
        turned = reals(rotation, "verp_core_leg_ik: rotation")
        if turned.shape != (9,):
            turned = reals(rotation, "verp_core_leg_ik: rotation", (3, 3))
        at_m = reals(position_m, "verp_core_leg_ik: position_m", (3,))
        pose = _single(np.concatenate([np.ravel(turned), at_m]))
        angle, flags = np.zeros(lib.VERP_LEG_JOINTS, np.float32), ffi.new("uint32_t *")
        calls.core_leg_ik(self._core, side, pointer(pose, "float *"), ffi.NULL, pointer(angle, "float *"), flags)
        return angle, flags[0]

    def plan(self, vx_m_s: float, vy_m_s: float, wz_rad_s: float, ticks: int, stop: int = 0) -> np.ndarray:
        """What the gait plans, tick by tick: records with body, sole, zmp_m, carry, leg_rad, phase, state, swing. The last
        `stop` ticks are after it was asked to stop."""
        ticks = whole(ticks, "verp_core_plan: ticks", 0, lib.VERP_MOST_PLANNED)  # before memory is allocated
        plan = np.zeros(ticks, PLAN)
        calls.core_plan(self._core, vx_m_s, vy_m_s, wz_rad_s, pointer(plan, "verp_plan *"), ticks, stop)
        return plan
