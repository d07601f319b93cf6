"""Robots in a world, a control tick at a time."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from ._core import INPUTS, OUTPUTS, pointer
from ._lib import VerpError, calls, dtype_of, ffi, fill, layout_dtype, lib, memory, reals, whole
from ._sight import Sight

TICK = dtype_of(ffi.typeof("verp_tick"))
RELAX, STAND, WALK, GET_UP = 0, 1, 2, 3


@dataclass(frozen=True)
class Result:
    """How a walk went; see verp_result."""

    fallen: bool
    ticks: int
    digest: int
    simulated_s: float
    walk_s: float
    distance_m: float
    ahead_m: float
    aside_m: float
    turned_rad: float
    speed_m_s: float
    zmp_bias_mm: float
    faults: int
    failure: str
    remark: str


@dataclass(frozen=True)
class Quantity:
    """A number of the physics."""

    name: str
    unit: str
    what: str
    low: float
    high: float
    settable: bool


class Moment:
    """One tick in a controller's hands. `inputs` and `outputs` are numpy records; what stands in `outputs` is sent."""

    def __init__(self) -> None:
        self.robot = 0
        self._in, self._inputs = memory("verp_inputs", INPUTS)
        self._out, self._outputs = memory("verp_outputs", OUTPUTS)
        self._token = 0
        self._sent: object = ffi.NULL

    @property
    def inputs(self) -> np.ndarray:
        """What the robot's sensors told."""
        return self._inputs

    @property
    def outputs(self) -> np.ndarray:
        """Those of the tick before; write into them: outputs["goal_count"][0, 3] = ..."""
        return self._outputs

    def decide(self) -> None:
        """Has the robot's own controller decide; `outputs` may then be changed."""
        calls.decide(self._token)
        ffi.memmove(self._out, self._sent, OUTPUTS.itemsize)


Controller = Callable[[Moment], None]


class Session(Sight):
    """A world and the robots in it.

    >>> with Session() as session:
    ...     robot = session.add(walk_s=10)
    ...     while session.tick():
    ...         height_m = session.seen(robot)["truth"]["body_m"][2]
    ...     print(session.result(robot).distance_m)
    """

    def __init__(self, world: str | None = None, physics_step_us: int = 0) -> None:
        what, where = ffi.new("verp_world *", {"size": ffi.sizeof("verp_world")}), ffi.new("verp_session *")
        kept = fill(what, "verp_session_open", {"physics_step_us": physics_step_us, "file": world})
        calls.session_open(what, where)
        del kept  # keeps the texts alive
        super().__init__(where[0], lib.verp_session_close)
        self._ticks: dict[int, np.ndarray] = {}
        self._kept: dict[int, tuple[object, ...]] = {}  # callbacks in use
        self._setting = threading.RLock()  # keeps self._kept equal to them
        self._thrown: BaseException | None = None

    def add(
        self,
        model: str = "generic21",
        *,
        bus: str | None = None,
        name: str | None = None,
        tuning: str | None = None,
        record: str | None = None,
        open_end: bool = False,
        **numbers: float,
    ) -> int:
        """One more robot, before the first tick: its number. `numbers`: seed, walk_s, vx_m_s, vy_m_s, wz_rad_s, x_m,
        y_m, yaw_rad. With walk_s = 0 it obeys command() alone."""
        what = ffi.new("verp_robot *")
        calls.robot_defaults(what)
        for field in numbers:
            if field not in ("seed", "walk_s", "vx_m_s", "vy_m_s", "wz_rad_s", "x_m", "y_m", "yaw_rad"):
                raise TypeError(f"Session.add() has no argument '{field}'")
        texts = {"model": model, "bus": bus, "name": name, "tuning": tuning, "record": record}
        kept = fill(what, "verp_session_add", texts | numbers)
        what.flags = lib.VERP_OPEN_END if open_end else 0
        robot = ffi.new("uint32_t *")
        calls.session_add(self._session, what, robot)
        del kept  # keeps the texts alive
        tick, seen = memory("verp_tick", TICK)
        tick.size = TICK.itemsize
        self._ticks[robot[0]] = seen  # before the library writes there, even if interrupted
        calls.session_view(self._session, robot[0], tick)
        return robot[0]

    def tick(self, count: int = 1) -> bool:
        """At most so many ticks, each of one robot. False: the run is over."""
        try:
            return calls.session_tick(self._session, count, ffi.NULL, ffi.NULL) == lib.VERP_OK
        except VerpError as error:
            if error.status != lib.VERP_CALLBACK_FAILED or self._thrown is None:
                raise
        thrown, self._thrown = self._thrown, None
        raise thrown

    def __iter__(self) -> Iterator[np.void]:
        """Tick by tick, of robot 0: what seen() gives."""
        while self.tick():
            yield self.seen()

    def seen(self, robot: int = 0) -> np.void:
        """The robot's last tick: a record that the session writes into, without a copy (see verp_tick). It outlives the session."""
        self._need_open("Session.seen")
        if robot.__class__ is not int or robot not in self._ticks:
            if not self._ticks:
                raise ValueError("Session.seen: nobody is in the world; call add() before")
            robot = whole(robot, "Session.seen: robot", 0, len(self._ticks) - 1)
        return self._ticks[robot][0]

    def state(self, robot: int = 0) -> np.ndarray:
        """The controller's State after the last tick, a copy; fields as in C++."""
        array = np.zeros(1, layout_dtype("state"))
        calls.session_state(self._session, robot, pointer(array, "void *"), array.nbytes)
        return array

    def digest(self, robot: int = 0) -> int:
        """Of all its ticks so far."""
        value = ffi.new("uint64_t *")
        calls.session_digest(self._session, robot, value)
        return value[0]

    def result(self, robot: int = 0) -> Result:
        """Ends the run of all robots; traces become whole."""
        result = ffi.new("verp_result *")
        result.size = ffi.sizeof(result[0])
        calls.session_result(self._session, robot, result)
        values: dict[str, Any] = {name: getattr(result, name) for name in Result.__dataclass_fields__}
        for name in ("failure", "remark"):
            values[name] = ffi.string(values[name]).decode()
        return Result(**{**values, "fallen": bool(values["fallen"])})

    def command(
        self,
        request: int,
        vx_m_s: float = 0,
        vy_m_s: float = 0,
        wz_rad_s: float = 0,
        *,
        pan_rad: float = 0,
        tilt_rad: float = 0,
        robot: int = 0,
    ) -> None:
        """From now on the caller has the robot: RELAX, STAND, GET_UP or WALK with that velocity."""
        calls.session_command(self._session, robot, request, vx_m_s, vy_m_s, wz_rad_s, pan_rad, tilt_rad)

    def give_back(self, robot: int = 0) -> None:
        """The walk that was asked for goes on."""
        calls.session_give_back(self._session, robot)

    def emergency_stop(self, pressed: bool = True, robot: int = 0) -> None:
        """While it is pressed the robot is limp."""
        calls.session_emergency_stop(self._session, robot, pressed)

    def tune(self, name: str, value: float, robot: int = 0) -> None:
        """A number of the tuning, in force in one of the next ticks."""
        calls.session_tune(self._session, robot, name, value)

    def tuning(self, name: str, robot: int = 0) -> float:
        """A number of the tuning as it is in force."""
        value = ffi.new("double *")
        calls.session_tuning(self._session, robot, name, value)
        return value[0]

    def quantities(self) -> list[Quantity]:
        """The numbers of the physics, once all robots were added."""
        count, what = ffi.new("uint32_t *"), ffi.new("verp_quantity *")
        what.size = ffi.sizeof(what[0])
        calls.session_quantities(self._session, count)
        found = []
        for index in range(count[0]):
            calls.session_quantity(self._session, index, what)
            words = [ffi.string(field).decode() for field in (what.name, what.unit, what.what)]
            found.append(Quantity(*words, what.low, what.high, bool(what.settable)))
        return found

    def read(self, quantity: str) -> float:
        """A number of the physics."""
        value = ffi.new("double *")
        calls.session_read(self._session, quantity, value)
        return value[0]

    def set(self, quantity: str, value: float) -> None:
        """A number of the physics, from the next step on."""
        calls.session_set(self._session, quantity, value)

    def push(self, thing: str, force_n: tuple[float, float, float], for_s: float) -> None:
        """Pushes a link or an object at its centre of mass, N in the world's axes."""
        force = reals(force_n, "verp_session_push: force_n", (3,))
        calls.session_push(self._session, thing, *force, for_s)

    def radio(self, **numbers: float) -> None:
        """Each robot has a radio, before the first tick: range_m, loss, fade, fade_s, delay_s, jitter_s, bytes_s, most_bytes,
        most_waiting, overhead_bytes, seed (verp_radio); what is left out is as of a modem of IEEE 802.15.4 in a hall."""
        what = ffi.new("verp_radio *")
        calls.radio_defaults(what)
        known = [name for name, _ in ffi.typeof("verp_radio").fields if name != "size"]
        for field in numbers:
            if field not in known:
                raise TypeError(f"Session.radio() has no argument '{field}': {', '.join(known)}")
        fill(what, "verp_session_radio", numbers)
        calls.session_radio(self._session, what)

    def send(self, data: bytes, to: int | None = None, *, robot: int = 0) -> bool:
        """A message of the robot's to another one, or to everybody. False: too many wait for the air already. Nothing
        acknowledges it; it stands in the traces of who says and who hears it."""
        try:
            given = bytes(memoryview(data))  # refuses text
        except TypeError:
            raise TypeError(f"verp_session_send: data is bytes, not {data!r}") from None
        whom = lib.VERP_EVERYBODY if to is None else to
        return calls.session_send(self._session, robot, whom, given, len(given)) == lib.VERP_OK

    def take(self, robot: int = 0) -> list[tuple[int, bytes]]:
        """What it heard up to its last tick and nobody took yet: from whom, and what."""
        room, size, sender = ffi.new("char[65536]"), ffi.new("uint64_t *"), ffi.new("uint32_t *")
        heard = []
        while calls.session_take(self._session, robot, room, 65536, size, sender) == lib.VERP_OK:
            heard.append((sender[0], ffi.buffer(room, size[0])[:]))
        return heard

    def control(self, controller: Controller | None, robot: int = 0) -> None:
        """In place of the robot's own controller, from the next tick on; None: its own again. It writes into `moment.outputs`
        and returns None: anything else ends the run, as an exception does, which tick() raises."""
        robot = whole(robot, "verp_session_control: robot", 0, 2**32 - 1)
        if controller is None:
            callback = ffi.NULL
        elif not callable(controller):
            raise TypeError(f"verp_session_control: controller is a function of a Moment, or None, not {controller!r}")
        else:
            callback = ffi.callback("verp_controller", self._callback(controller), error=1)
        with self._setting:
            self._kept[robot] = (*self._kept.get(robot, ()), callback)
            calls.session_control(self._session, robot, callback, ffi.NULL)
            self._kept[robot] = (callback,)

    def _callback(self, controller: Controller) -> Callable[[object, object], int]:
        moment = Moment()

        def run(seen: object, _: object) -> int:
            try:
                ffi.memmove(moment._in, seen.inputs, INPUTS.itemsize)
                ffi.memmove(moment._out, seen.outputs, OUTPUTS.itemsize)
                moment.robot, moment._token, moment._sent = seen.robot, seen.token, seen.outputs
                given = controller(moment)
                if given is not None:
                    raise TypeError(f"Session.tick: the controller of robot {seen.robot} returned {given!r}: "
                                    "it writes into moment.outputs and returns None")
                ffi.memmove(seen.outputs, moment._out, OUTPUTS.itemsize)
                return 0
            except BaseException as thrown:  # tick() raises it
                self._thrown = thrown
                return 1

        return run


def replay(trace: str) -> tuple[int, int]:
    """Ticks and digest of a trace that replays bit for bit; raises VerpError that says where it does not."""
    ticks, digest = ffi.new("uint64_t *"), ffi.new("uint64_t *")
    status = calls.replay(trace, ticks, digest)
    if status != lib.VERP_OK:
        raise VerpError(status, ffi.string(lib.verp_last_error()).decode())
    return ticks[0], digest[0]
