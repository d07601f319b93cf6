"""What the robots of a session see, and pictures of their world, as numpy arrays."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._core import pointer
from ._lib import Handle, calls, ffi, fill, lib, reals, whole

_WHAT = {"colour": lib.VERP_COLOUR, "depth": lib.VERP_DEPTH, "labels": lib.VERP_LABELS}


def _pixels(shape: tuple[int, int], what: str, out: NDArray[Any] | None, call: str) -> NDArray[Any]:
    """Memory for a picture: the caller's, if it is as it has to be."""
    wanted, kind = ((*shape, 3), np.uint8) if what == "colour" else (shape, np.uint16)
    if out is None:
        return np.empty(wanted, kind)
    flags = out.flags if isinstance(out, np.ndarray) and out.shape == wanted and out.dtype == kind else None
    if not flags or not flags.c_contiguous or not flags.writeable:
        raise ValueError(f"{call}: out: a writeable array of {wanted}, {np.dtype(kind)}, in C order is needed")
    return out


@dataclass(frozen=True)
class Camera:
    """One that a robot has; see verp_camera."""

    name: str
    gives: tuple[str, ...]  #: of "colour", "depth", "labels"
    width: int
    height: int
    rate_hz: float
    matrix: NDArray[np.float64]  #: of the lens: fx, 0, cx; 0, fy, cy; 0, 0, 1, in pixels
    distortion: tuple[float, ...]  #: k1, k2, p1, p2, k3
    near_m: float
    far_m: float
    link: int  #: of Core.forward()
    rotation: NDArray[np.float64]  #: in its link: x ahead, y left, z up
    position_m: NDArray[np.float64]


@dataclass(frozen=True)
class Picture:
    """What a camera saw: rows from the top. colour: uint8 (height, width, 3), red first; depth: uint16 (height, width),
    mm along the camera's axis, 0 where nothing is; labels: uint16 (height, width)."""

    pixels: NDArray[np.uint8] | NDArray[np.uint16]
    time_s: float  #: when it looked, simulated


class Sight(Handle):
    """Of a Session. A program beside this one draws, which the first picture starts; a session without one pays nothing."""

    def __init__(self, session: object, close: Callable[[object], int]) -> None:
        super().__init__(session, close)
        self._session = session
        self._cameras: dict[int, list[Camera]] = {}

    def cameras(self, robot: int = 0) -> list[Camera]:
        """Those of the robot's file."""
        count, what = ffi.new("uint32_t *"), ffi.new("verp_camera *")
        calls.session_cameras(self._session, robot, count)
        found = []
        for index in range(count[0]):
            what.size = ffi.sizeof(what[0])
            calls.session_camera(self._session, robot, index, what)
            pose = np.array(list(what.pose))
            found.append(
                Camera(
                    name=ffi.string(what.name).decode(),
                    gives=tuple(name for name, bit in _WHAT.items() if what.gives & bit),
                    width=what.width,
                    height=what.height,
                    rate_hz=what.rate_hz,
                    matrix=np.array([[what.fx_px, 0, what.cx_px], [0, what.fy_px, what.cy_px], [0, 0, 1]]),
                    distortion=tuple(what.distortion),
                    near_m=what.near_m,
                    far_m=what.far_m,
                    link=what.link,
                    rotation=pose[:9].reshape(3, 3),
                    position_m=pose[9:],
                )
            )
        return found

    def picture(
        self, what: str = "colour", *, camera: int | str = 0, robot: int = 0, out: NDArray[Any] | None = None
    ) -> Picture | None:
        """What that camera (a number or a name) saw when it last looked, up to the robot's last tick; None: it has not
        looked yet. It is drawn now, into `out` if there is one, an array as Picture says. The run stays what it was."""
        call = "verp_session_picture"
        robot = whole(robot, f"{call}: robot", 0, 2**32 - 1)
        cameras = self._cameras.get(robot)
        if cameras is None:
            cameras = self._cameras[robot] = self.cameras(robot)
        names = [each.name for each in cameras]
        if isinstance(camera, str) and camera not in names:
            raise ValueError(f"{call}: robot {robot} has no camera '{camera}': it has {', '.join(names) or 'none'}")
        index = names.index(camera) if isinstance(camera, str) else whole(camera, f"{call}: camera", 0, 2**32 - 1)
        if not isinstance(what, str) or what not in _WHAT:
            raise ValueError(f"{call}: there is no {what!r}: a camera gives {', '.join(_WHAT)}")
        by = cameras[index] if index < len(cameras) else None  # the library raises the error
        shape = (by.height, by.width) if by else (1, 1)
        pixels = _pixels(shape, what, out, call)
        time_s = ffi.new("double *")
        status = calls.session_picture(
            self._session, robot, index, _WHAT[what], pointer(pixels, "void *"), pixels.nbytes, time_s
        )
        return None if status == lib.VERP_NO_PICTURE else Picture(pixels, time_s[0])

    def render(
        self,
        view: str | None = "follow",
        *,
        width: int = 640,
        height: int = 480,
        eye_m: Sequence[float] | None = None,
        target_m: Sequence[float] = (0, 0, 0.25),
        fov_rad: float = 0,
        robot: int = 0,
        plain: bool = False,
        out: NDArray[np.uint8] | None = None,
    ) -> NDArray[np.uint8]:
        """The world as it is now, (height, width, 3): front, side, three-quarter, back, top, follow or head of a robot, a
        camera that a file declares, or from eye_m to target_m, world frame. `plain`: without shadows, and sooner."""
        call, what = "verp_session_render", ffi.new("verp_view *", {"size": ffi.sizeof("verp_view")})
        numbers = {"width": width, "height": height, "robot": robot, "fov_rad": fov_rad}
        kept = fill(what, call, numbers | {"name": view if eye_m is None else None})
        what.flags = lib.VERP_PLAIN if plain else 0
        if eye_m is not None:
            what.eye_m = reals(eye_m, f"{call}: eye_m", (3,)).tolist()
            what.target_m = reals(target_m, f"{call}: target_m", (3,)).tolist()
        drawn = max(what.width, what.height) <= lib.VERP_MOST_PIXELS  # the library raises the error
        pixels = _pixels((what.height, what.width) if drawn else (1, 1), "colour", out, call)
        calls.session_render(self._session, what, pointer(pixels, "void *"), pixels.nbytes)
        del kept  # keeps the texts alive
        return pixels
