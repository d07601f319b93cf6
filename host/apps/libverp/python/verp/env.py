"""A robot to learn policies on: Env has the shape of Gymnasium's environments, without needing it."""

from __future__ import annotations

import multiprocessing
import signal
from dataclasses import dataclass
from multiprocessing.connection import Connection
from types import TracebackType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._core import Core
from ._lib import real, reals, whole
from ._session import WALK, Moment, Session
from ._sight import Picture

Info = dict[str, Any]
_VELOCITY = ("vx_m_s", "vy_m_s", "wz_rad_s")
_NEXT_SEED = 1_000_003  #: from one episode's seed to the next one's: past those of any other environment of a VectorEnv
_PATIENCE_S = 30.0  #: simulated
Step = tuple[NDArray[np.float32], float, bool, bool, Info]


@dataclass(frozen=True)
class Box:
    """A space of arrays: between `low` and `high`, which have its shape."""

    low: NDArray[np.float32]
    high: NDArray[np.float32]

    @property
    def shape(self) -> tuple[int, ...]:
        """Of its arrays."""
        return self.low.shape

    def sample(self, generator: np.random.Generator) -> NDArray[np.float32]:
        """One of them, drawn at random."""
        return generator.uniform(self.low, self.high).astype(np.float32)

    def contains(self, array: NDArray[np.float32]) -> bool:
        """Whether that is one of them."""
        return np.shape(array) == self.shape and bool(np.all(array >= self.low) and np.all(array <= self.high))


class Env:
    """A robot that is asked to walk; an action is what is added to each joint's goal, rad.

    An action of zeros is the robot's own controller. Observed is only what a controller is told: joint angles (rad), the
    goals it chose (rad), gyro (rad/s), accelerometer (m/s2), the gait's phase and the velocity that is asked for. The
    reward of a tick is the way ahead in m, less `effort` times the squared action; a fall costs 1 and ends the episode.

    >>> env = Env(vx_m_s=0.15)
    >>> seen, info = env.reset(seed=1)
    >>> seen, reward, terminated, truncated, info = env.step(env.no_action())
    """

    def __init__(
        self,
        model: str = "generic21",
        *,
        world: str | None = None,
        vx_m_s: float = 0.15,
        wz_rad_s: float = 0.0,
        most_action_rad: float = 0.2,
        episode_s: float = 20.0,
        effort: float = 0.01,
    ) -> None:
        vx_m_s, wz_rad_s, effort = real(vx_m_s, "Env: vx_m_s"), real(wz_rad_s, "Env: wz_rad_s"), real(effort, "Env: effort")
        if not real(most_action_rad, "Env: most_action_rad") >= 0 or not real(episode_s, "Env: episode_s") > 0:
            raise ValueError("Env: most_action_rad is not negative, and episode_s more than 0")
        self._model, self._world = model, world
        self._velocity = (vx_m_s, 0.0, wz_rad_s)
        self._episode_s, self._effort = episode_s, effort
        with Core(model) as core:
            params = core.params()[0]
            self._joints = len(core.joint_names)
            self._scale = np.array([params[f"joint[{j}].counts_per_rad"] for j in range(self._joints)])
            self._gyro = float(params["imu.gyro_rad_s_per_count"])
            self._accel = float(params["imu.accel_m_s2_per_count"])
        n = 2 * self._joints + 6 + 2 + 3
        self.observation_space = Box(np.full(n, -np.inf, np.float32), np.full(n, np.inf, np.float32))
        most = np.full(self._joints, most_action_rad, np.float32)
        self.action_space = Box(-most, most)
        self._action = self.no_action()
        self._session: Session | None = None
        self._seed: int | None = None
        self._closed = False

    def no_action(self) -> NDArray[np.float32]:
        """The robot's own controller alone."""
        return np.zeros(self._joints, np.float32)

    def reset(self, *, seed: int | None = None, options: Info | None = None) -> tuple[NDArray[np.float32], Info]:
        """A robot of that seed, which stands and begins to walk; `options` may hold vx_m_s, vy_m_s, wz_rad_s. Without a seed:
        1 at first, then one that follows from the last, so that a series of episodes repeats and no two are alike."""
        self._need_open("reset")
        self._end()
        asked = dict(zip(_VELOCITY, self._velocity))
        if not isinstance(options, dict | None):
            raise TypeError(f"Env.reset: options are a dict, or None, not {options!r}")
        for name, value in (options or {}).items():
            if name not in asked:
                raise ValueError(f"Env.reset: there is no option '{name}'; there are {', '.join(asked)}")
            asked[name] = real(value, f"Env.reset: {name}")
        if seed is None:
            seed = 1 if self._seed is None else self._seed + _NEXT_SEED
        seed = whole(seed, "Env.reset: seed", 0, 2**64 - 1)
        try:
            self._begin(seed, asked)
        except BaseException:  # no half session remains
            self._end()
            raise
        self._seed = seed
        return self._observe(), {}

    def _begin(self, seed: int, asked: Info) -> None:
        self._asked = np.array([asked[k] for k in _VELOCITY], np.float32)
        session = self._session = Session(self._world)
        session.add(self._model, seed=seed, walk_s=self._episode_s, open_end=True, **asked)
        self._action = self.no_action()
        session.control(self._decide)
        while session.tick():
            if session.seen()["outputs"]["gait_phase"] != 0 or self._fallen():
                break
            if session.seen()["time_s"] > _PATIENCE_S:
                raise RuntimeError(f"Env.reset: in {_PATIENCE_S:g} s the robot did not begin to walk; give it a longer episode_s")
        self._began_s = session.seen()["time_s"]
        self._at_m = session.seen()["truth"]["body_m"].copy()

    def step(self, action: NDArray[np.float32]) -> Step:
        """One control tick: observation, reward, terminated (it fell), truncated (time is over), info."""
        session = self._running("step")
        given = reals(action, "Env.step: action", self.action_space.shape)
        if not np.all(np.isfinite(given)):
            raise ValueError(f"Env.step: action is not {self._joints} finite numbers")
        self._action = np.clip(given.astype(np.float32), self.action_space.low, self.action_space.high)
        session.tick()
        seen = session.seen()
        terminated = self._fallen()
        truncated = bool(seen["time_s"] - self._began_s >= self._episode_s)
        reward = self._way_ahead(seen) - self._effort * float(np.sum(self._action**2)) - float(terminated)
        return self._observe(), reward, terminated, truncated, {"digest": session.digest()}

    def render(self, view: str = "follow", **options: Any) -> NDArray[np.uint8]:
        """A picture of the robot in its world now, (480, 640, 3); see Session.render()."""
        return self._running("render").render(view, **options)

    def picture(self, what: str = "colour", **options: Any) -> Picture | None:
        """What the robot's camera last saw; None: nothing yet. See Session.picture()."""
        return self._running("picture").picture(what, **options)

    def close(self) -> None:
        """Later calls raise RuntimeError."""
        self._closed = True
        self._end()

    def _end(self) -> None:
        session, self._session = self._session, None
        if session is not None:
            session.close()

    def _need_open(self, what: str) -> None:
        if self._closed:
            raise RuntimeError(f"Env.{what}: this environment was closed; make another")

    def _running(self, what: str) -> Session:
        self._need_open(what)
        if self._session is None:
            raise RuntimeError(f"Env.{what}: call reset() before")
        return self._session

    def _decide(self, moment: Moment) -> None:
        moment.decide()
        added = np.rint(self._action * self._scale).astype(np.int32)
        moment.outputs["goal_count"][0, : self._joints] += added

    def _fallen(self) -> bool:
        return bool(self._session.seen()["truth"]["fallen"])

    def _way_ahead(self, seen: np.void) -> float:
        """Of the body since the tick before, m, along its heading."""
        truth = seen["truth"]
        yaw, now_m = truth["body_rpy_rad"][2], truth["body_m"].copy()
        by_m, self._at_m = now_m - self._at_m, now_m
        return float(np.cos(yaw) * by_m[0] + np.sin(yaw) * by_m[1])

    def _observe(self) -> NDArray[np.float32]:
        seen = self._session.seen()
        told, put_out = seen["inputs"], seen["outputs"]
        angle = 2 * np.pi * put_out["gait_state"] / 16
        walks = float(put_out["gait_phase"] != 0)
        return np.concatenate(
            [
                seen["joint_rad"][: self._joints],
                seen["goal_rad"][: self._joints],
                self._gyro * told["gyro_count"],
                self._accel * told["accel_count"],
                [walks * np.sin(angle), walks * np.cos(angle)],
                self._asked,
            ]
        ).astype(np.float32)


def _serve(pipe: Connection, options: Info) -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C reaches all processes; the parent decides
    env = Env(**options)
    while (asked := _asked(pipe)) is not None:
        number, what, value = asked
        try:
            if what == "reset":
                answer: Any = env.reset(seed=value)
            else:
                answer = env.step(value)
                if answer[2] or answer[3]:  # next episode; info holds the end of this one
                    last, first = answer, env.reset()
                    answer = (first[0], *last[1:4], last[4] | {"final_observation": last[0]})
            pipe.send((number, None, answer))
        except Exception as error:  # the parent raises it
            pipe.send((number, f"{type(error).__name__}: {error}", None))


def _asked(pipe: Connection) -> tuple[int, str, Any] | None:
    """None: no more is asked, or whoever did is gone."""
    try:
        return pipe.recv()
    except (EOFError, OSError):
        return None


class VectorEnv:
    """Many Envs, each in a process of its own; arrays with one row for each. One that ends begins anew by itself.

    >>> with VectorEnv(4, vx_m_s=0.1) as envs:
    ...     seen, infos = envs.reset(seed=1)
    ...     seen, rewards, terminated, truncated, infos = envs.step(envs.no_action())
    """

    def __init__(self, count: int, **options: Any) -> None:
        count = whole(count, "VectorEnv: count", 1, 2**16)
        example = Env(**options)
        self.observation_space, self.action_space = example.observation_space, example.action_space
        context = multiprocessing.get_context("spawn")
        self._pipes, self._processes, self._number = [], [], 0
        for _ in range(count):
            here, there = context.Pipe()
            process = context.Process(target=_serve, args=(there, options), daemon=True)
            process.start()
            there.close()
            self._pipes.append(here)
            self._processes.append(process)

    def no_action(self) -> NDArray[np.float32]:
        """The robots' own controllers alone."""
        return np.zeros((len(self._pipes), *self.action_space.shape), np.float32)

    def reset(self, *, seed: int | None = None) -> tuple[NDArray[np.float32], list[Info]]:
        """Environment n has seed + n. Without a seed: 1 at first, then each has one that follows from its last."""
        if seed is None and self._number == 0:
            seed = 1
        if seed is not None:
            seed = whole(seed, "VectorEnv.reset: seed", 0, 2**64 - len(self._pipes))
        answers = self._ask("reset", [None if seed is None else seed + n for n in range(len(self._pipes))])
        return np.stack([a[0] for a in answers]), [a[1] for a in answers]

    def step(self, actions: NDArray[np.float32]) -> tuple[Any, ...]:
        """What Env.step() gives, each as an array of all, infos as a list."""
        if self._pipes and np.shape(reals(actions, "VectorEnv.step: actions"))[:1] != (len(self._pipes),):
            raise ValueError(f"VectorEnv.step: actions have {len(self._pipes)} rows, not the shape {np.shape(actions)}")
        columns = list(zip(*self._ask("step", list(actions))))
        return (np.stack(columns[0]), *(np.array(column) for column in columns[1:4]), list(columns[4]))

    def close(self) -> None:
        """Ends the processes; later calls raise RuntimeError."""
        for pipe, process in zip(self._pipes, self._processes):
            try:
                pipe.send(None)
            except OSError:
                pass  # ended already
            process.join(timeout=10)
            if process.is_alive():
                process.kill()
        self._pipes, self._processes = [], []

    def __enter__(self) -> VectorEnv:
        return self

    def __exit__(self, *_: type[BaseException] | BaseException | TracebackType | None) -> None:
        self.close()

    def _ask(self, what: str, values: list[Any]) -> list[Any]:
        if not self._pipes:
            raise RuntimeError(f"VectorEnv.{what}: it was closed")
        self._number += 1
        for pipe, value in zip(self._pipes, values):
            try:
                pipe.send((self._number, what, value))
            except OSError:
                pass  # its answer will be missing
        answers, failed = [], ""
        for n, pipe in enumerate(self._pipes):
            number = 0
            while number != self._number:  # skips an answer that Ctrl-C left unread
                try:
                    number, error, answer = pipe.recv()
                except (EOFError, OSError):
                    number, error, answer = self._number, "its process has ended", None
            if error and not failed:
                failed = f"VectorEnv: environment {n}: {error}"
            answers.append(answer)
        if failed:
            raise RuntimeError(failed)
        return answers
