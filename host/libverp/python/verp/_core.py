"""The controller's own algorithms, with its bits."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ._lib import Handle, check, dtype_of, ffi, layout_dtype, lib, text

INPUTS = dtype_of(ffi.typeof("verp_inputs"))
OUTPUTS = dtype_of(ffi.typeof("verp_outputs"))
PLAN = dtype_of(ffi.typeof("verp_plan"))


def pointer(array: np.ndarray, ctype: str) -> object:
    """To an array's own memory."""
    return ffi.cast(ctype, array.ctypes.data)


def _angles(angle_rad: NDArray[np.float32]) -> NDArray[np.float32]:
    """As the library reads them. How many there have to be it knows itself, but not what lies beyond an array of another shape."""
    angles = np.ascontiguousarray(angle_rad, np.float32)
    if angles.ndim != 1 or np.ndim(angle_rad) != 1:
        raise ValueError(f"angle_rad: one row of angles is needed, not an array of shape {np.shape(angle_rad)}")
    return angles


class Core(Handle):
    """One robot's controller without a world.

    >>> core = Core("generic21")
    >>> core.com(core.zeros())          # m, body frame
    """

    def __init__(self, model: str = "generic21", bus: str | None = None, tuning: str | None = None) -> None:
        where = ffi.new("verp_core *")
        check(lib.verp_core_open(text(model), text(bus), text(tuning), where))
        self._core = where[0]
        super().__init__(self._core, lib.verp_core_close)
        self.joint_names: list[str] = [self._name(j) for j in range(self._get("joints", "uint32_t *"))]
        self.period_s: float = self._get("period", "double *")
        self._inputs = np.zeros(1, INPUTS)
        self._outputs = np.zeros(1, OUTPUTS)
        self._in = pointer(self._inputs, "verp_inputs *")
        self._out = pointer(self._outputs, "verp_outputs *")

    @property
    def inputs(self) -> np.ndarray:
        """What the next step() reads: numpy records, memory that stays where it is; write into it: inputs[0] = ..."""
        return self._inputs

    @property
    def outputs(self) -> np.ndarray:
        """What the last step() wrote; memory that stays where it is."""
        return self._outputs

    def _get(self, what: str, ctype: str) -> int | float:
        value = ffi.new(ctype)
        check(getattr(lib, f"verp_core_{what}")(self._core, value))
        return value[0]

    def _name(self, joint: int) -> str:
        name = ffi.new(f"char[{lib.VERP_NAME}]")
        check(lib.verp_core_joint_name(self._core, joint, name, lib.VERP_NAME))
        return ffi.string(name).decode()

    def reset(self) -> None:
        """As it is when power comes on."""
        check(lib.verp_core_reset(self._core))

    def step(self) -> None:
        """One control tick, from self.inputs to self.outputs."""
        check(lib.verp_core_step(self._core, self._in, self._out))

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
        check(getattr(lib, f"verp_core_{what}")(self._core, pointer(array, "void *"), array.nbytes))
        return array

    def zeros(self) -> NDArray[np.float32]:
        """All joints at zero, rad."""
        return np.zeros(len(self.joint_names), np.float32)

    def count(self, joint: int, angle_rad: float) -> int:
        """A joint's angle in its servo's counts."""
        value = ffi.new("int32_t *")
        check(lib.verp_core_count(self._core, joint, angle_rad, value))
        return value[0]

    def forward(self, angle_rad: NDArray[np.float32]) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
        """Rotations (n + 1, 3, 3) and positions (n + 1, 3) of all links, body frame; the first is the body's."""
        angles = _angles(angle_rad)
        poses = np.zeros((len(angles) + 1, lib.VERP_POSE), np.float32)
        check(lib.verp_core_forward(self._core, pointer(angles, "float *"), len(angles), pointer(poses, "float *")))
        return poses[:, :9].reshape(-1, 3, 3), poses[:, 9:]

    def com(self, angle_rad: NDArray[np.float32]) -> NDArray[np.float32]:
        """Centre of mass, m, body frame."""
        angles, com_m = _angles(angle_rad), np.zeros(3, np.float32)
        check(lib.verp_core_com(self._core, pointer(angles, "float *"), len(angles), pointer(com_m, "float *")))
        return com_m

    def leg_joints(self, side: int) -> list[int]:
        """Hip to ankle."""
        joint = ffi.new(f"uint32_t[{lib.VERP_LEG_JOINTS}]")
        check(lib.verp_core_leg_joints(self._core, side, joint))
        return list(joint)

    def leg_ik(self, side: int, rotation: np.ndarray, position_m: np.ndarray) -> tuple[NDArray[np.float32], int]:
        """Six angles, hip to ankle, that put the sole there (body frame), and flags: 0 if it stands exactly so."""
        pose = np.concatenate([np.ravel(rotation), np.ravel(position_m)]).astype(np.float32)
        if pose.shape != (lib.VERP_POSE,):
            raise ValueError("leg_ik: a rotation has 9 numbers, a position 3")
        angle, flags = np.zeros(lib.VERP_LEG_JOINTS, np.float32), ffi.new("uint32_t *")
        check(
            lib.verp_core_leg_ik(
                self._core, side, pointer(pose, "float *"), ffi.NULL, pointer(angle, "float *"), flags
            )
        )
        return angle, flags[0]

    def plan(self, vx_m_s: float, vy_m_s: float, wz_rad_s: float, ticks: int, stop: int = 0) -> np.ndarray:
        """What the gait plans, tick by tick: records with body, sole, zmp_m, carry, leg_rad, phase, state, swing."""
        plan = np.zeros(ticks, PLAN)
        check(lib.verp_core_plan(self._core, vx_m_s, vy_m_s, wz_rad_s, pointer(plan, "verp_plan *"), ticks, stop))
        return plan
