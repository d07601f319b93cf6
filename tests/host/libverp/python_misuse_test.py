"""What the Python package says to misuse: each is one error that names the call, and the argument where there is one."""

import gc
import inspect
import threading
import unittest
import weakref
from collections.abc import Callable
from unittest import mock

import numpy as np

import verp
import verp.env
from verp.env import Env, VectorEnv

NAN, ONE = float("nan"), np.eye(3)
FOOT_M = [0, 0.04, -0.3]
Calls = list[tuple[str, Callable[[], object]]]


def fresh() -> verp.Session:
    return verp.Session()


class MisuseTest(unittest.TestCase):
    def setUp(self) -> None:
        self.core, self.session = verp.Core(), fresh()
        self.session.add(walk_s=1)

    def tearDown(self) -> None:
        self.session.close()
        self.core.close()

    def refused(self, wrong: Calls, kind: type[Exception] | tuple[type[Exception], ...]) -> None:
        for words, call in wrong:
            with self.subTest(words), self.assertRaisesRegex(kind, words):
                call()

    def test_texts_with_a_zero_are_not_cut(self) -> None:
        s = self.session
        self.refused([
            ("verp_core_open: model has a zero", lambda: verp.Core("generic21\0y")),
            ("verp_core_open: bus has a zero", lambda: verp.Core("generic21", "can\0y")),
            ("verp_core_open: tuning has a zero", lambda: verp.Core(tuning="gait.lift_m=0.01\0y")),
            ("verp_session_open: file has a zero", lambda: verp.Session("pitch\0")),
            ("verp_session_add: model has a zero", lambda: fresh().add("generic21\0")),
            ("verp_session_add: name has a zero", lambda: fresh().add(name="a\0b")),
            ("verp_session_add: tuning has a zero", lambda: fresh().add(tuning="gait.lift_m=0.01\0")),
            ("verp_session_add: record has a zero", lambda: fresh().add(record="/tmp/a.mcap\0")),
            ("verp_session_tune: name has a zero", lambda: s.tune("gait.lift_m\0b", 0.01)),
            ("verp_session_tuning: name has a zero", lambda: s.tuning("gait.lift_m\0b")),
            ("verp_session_read: quantity has a zero", lambda: s.read("trunk.mass_kg\0")),
            ("verp_session_set: quantity has a zero", lambda: s.set("trunk.mass_kg\0", 1)),
            ("verp_session_push: thing has a zero", lambda: s.push("trunk\0", (1, 0, 0), 1)),
            ("verp_session_render: name has a zero", lambda: s.render("front\0x")),
            ("verp_replay: file has a zero", lambda: verp.replay("a\0b")),
        ], ValueError)  # fmt: skip

    def test_numbers_out_of_range_are_named(self) -> None:
        s, c = self.session, self.core
        self.refused([
            ("verp_session_open: physics_step_us may be 0 to", lambda: verp.Session(None, -1)),
            ("verp_session_tick: count may be 0 to 4294967295, not -1", lambda: s.tick(-1)),
            ("verp_session_tick: count may be 0 to 4294967295", lambda: s.tick(2**32)),
            ("verp_session_state: robot may be 0 to", lambda: s.state(-1)),
            ("verp_session_digest: robot may be 0 to", lambda: s.digest(-1)),
            ("Session.seen: robot may be 0 to 0, not 9", lambda: s.seen(9)),
            ("Session.seen: robot may be 0 to 0, not -1", lambda: s.seen(-1)),
            ("Session.seen: nobody is in the world", lambda: fresh().seen()),
            ("verp_session_add: seed may be 0 to", lambda: fresh().add(seed=-1)),
            ("verp_session_radio: most_bytes may be 0 to", lambda: fresh().radio(most_bytes=-1)),
            ("verp_session_send: to may be -2147483648 to", lambda: s.send(b"a", 2**40)),
            ("verp_session_render: width may be 0 to", lambda: s.render(width=-1)),
            ("verp_session_picture: camera may be 0 to", lambda: s.picture(camera=-1)),
            ("verp_core_count: joint may be 0 to", lambda: c.count(-1, 0)),
            ("verp_core_angle: count may be -2147483648 to", lambda: c.angle(0, 2**31)),
            ("verp_core_plan: ticks may be 0 to 1000000, not -1", lambda: c.plan(0.1, 0, 0, -1)),
            ("verp_core_plan: ticks may be 0 to 1000000, not 2147483648", lambda: c.plan(0.1, 0, 0, 2**31)),
            ("verp_core_plan: stop may be 0 to", lambda: c.plan(0.1, 0, 0, 5, -1)),
            ("VectorEnv: count may be 1 to", lambda: VectorEnv(0)),
        ], ValueError)  # fmt: skip
        self.refused([("view->width may be 16 to 8192", lambda: s.render(width=10**6, height=10**6))], verp.VerpError)

    def test_things_of_the_wrong_type_or_shape_are_named(self) -> None:
        s, c = self.session, self.core
        self.refused([
            ("verp_core_open: model is a text, not 5", lambda: verp.Core(5)),
            ("verp_core_open: model is a text, not 5", lambda: Env(5)),
            ("verp_session_tick: count is a whole number, not 1.5", lambda: s.tick(1.5)),
            ("verp_session_tick: count is a whole number, not '3'", lambda: s.tick("3")),
            ("verp_session_command: request is a whole number, not 'walk'", lambda: s.command("walk")),
            ("verp_session_emergency_stop: pressed is a whole", lambda: s.emergency_stop("no")),
            ("verp_session_tune: value is a number, not '1'", lambda: s.tune("gait.lift_m", "1")),
            ("verp_session_push: force_n is of the shape", lambda: s.push("trunk", (1, 2), 1)),
            ("verp_session_push: force_n is an array of real", lambda: s.push("trunk", "abc", 1)),
            ("verp_session_control: controller is a function", lambda: s.control(5)),
            ("Session.add.* 'colour'", lambda: fresh().add(colour=1)),
            ("verp_session_add: walk_s is a number", lambda: fresh().add(walk_s="a")),
            ("verp_session_add: seed is a whole number, not 1.5", lambda: fresh().add(seed=1.5)),
            ("verp_session_radio: range_m is a number", lambda: fresh().radio(range_m="a")),
            ("verp_session_send: data is bytes", lambda: s.send("a")),
            ("verp_session_render: eye_m is of the shape", lambda: s.render(eye_m=[1, 2])),
            ("verp_session_render: out: a writeable", lambda: s.render(out=[1])),
            ("verp_session_picture: there is no \\[\\]", lambda: s.picture([])),
            ("verp_session_picture: camera is a whole", lambda: s.picture(camera=0.5)),
            ("verp_core_forward: angle_rad is an array", lambda: c.forward("abc")),
            ("verp_core_com: angle_rad is an array", lambda: c.com(np.zeros(21, complex))),
            ("verp_core_leg_ik: rotation is of the shape", lambda: c.leg_ik(0, [1, 2, 3], np.ones(9))),
            ("verp_core_leg_ik: position_m is of the shape", lambda: c.leg_ik(0, ONE, [1, 2])),
            ("verp_core_plan: vx_m_s is a number", lambda: c.plan("a", 0, 0, 5)),
            ("verp_replay: file is a text", lambda: verp.replay(5)),
            ("Env: most_action_rad is a number", lambda: Env(most_action_rad="a")),
            ("VectorEnv: count is a whole number", lambda: VectorEnv(1.5)),
        ], (TypeError, ValueError))  # fmt: skip

    def test_what_the_library_refuses_it_names(self) -> None:
        s, c = self.session, self.core
        self.refused([
            ("verp_core_open: model is empty", lambda: verp.Core("")),
            ("verp_core_open: bus is empty", lambda: verp.Core("generic21", "")),
            ("verp_core_open: model is null", lambda: verp.Core(None)),
            ("verp_session_open: world->file is empty", lambda: verp.Session("")),
            ("verp_session_add: name is empty", lambda: fresh().add(name="")),
            ("verp_session_add: record is empty", lambda: fresh().add(record="")),
            ("verp_session_read: quantity is empty", lambda: s.read("")),
            ("verp_session_set: value is not a finite", lambda: s.set("trunk.mass_kg", NAN)),
            ("verp_session_push: fz_n is not a finite", lambda: s.push("trunk", (1, 2, NAN), 1)),
            ("verp_session_command: vx_m_s is not a finite", lambda: s.command(verp.WALK, NAN)),
            ("verp_replay: file is empty", lambda: verp.replay("")),
            ("verp_core_leg_ik: sole's .* no rotation", lambda: c.leg_ik(0, 2 * ONE, FOOT_M)),
            ("verp_core_leg_ik: sole's .* no rotation", lambda: c.leg_ik(0, -ONE, FOOT_M)),
            ("verp_core_leg_ik: sole's .* no rotation", lambda: c.leg_ik(0, 0 * ONE, FOOT_M)),
        ], verp.VerpError)  # fmt: skip

    def test_closed_is_told_by_every_call(self) -> None:
        core, session, env = verp.Core(), fresh(), Env()
        session.add(walk_s=1)
        kept = session.seen()
        for each in (core, session, env):
            each.close()
        env.close()  # as in Gymnasium, harmless
        self.assertEqual(kept["time_s"], 0)
        takes_more = {"tune": ("gait.lift_m", 0.01), "tuning": ("gait.lift_m",), "read": ("trunk.mass_kg",), "set": ("trunk.mass_kg", 1),
                      "push": ("trunk", (1, 0, 0), 1), "command": (verp.WALK,), "send": (b"",), "control": (None,), "count": (0, 0),
                      "angle": (0, 0), "forward": (np.zeros(21),), "com": (np.zeros(21),), "leg_joints": (0,),
                      "leg_ik": (0, ONE, FOOT_M), "plan": (0, 0, 0, 5)}  # fmt: skip
        constants = {"zeros", "joint_names", "period_s"}
        for thing, owner in ((core, "verp_core_|Core"), (session, "verp_session_|Session")):
            names = [n for n in dir(type(thing)) if not n.startswith("_") and n not in constants]
            self.assertGreater(len(names), 10)
            for name in names:
                with self.subTest(name), self.assertRaisesRegex(verp.VerpError, f"({owner}).*closed"):
                    found = getattr(thing, name)
                    if callable(found):
                        found(*takes_more.get(name, ()))
        with self.assertRaisesRegex(verp.VerpError, "closed"), session:
            pass
        for name, arguments in (("reset", ()), ("step", (env.no_action(),)), ("render", ()), ("picture", ())):
            with self.subTest(name), self.assertRaisesRegex(RuntimeError, f"Env.{name}: .*closed"):
                getattr(env, name)(*arguments)

    def test_controller_that_returns_something_is_told(self) -> None:
        self.session.control(lambda moment: 7)
        with self.assertRaisesRegex(TypeError, "Session.tick: the controller of robot 0 returned 7"):
            self.session.tick()
        self.assertFalse(self.session.tick(), "the run is over")

    def test_controller_cannot_take_memory_away(self) -> None:
        self.session.control(lambda moment: moment.outputs.resize((0,), refcheck=False))
        with self.assertRaisesRegex(ValueError, "resize"):
            self.session.tick()

    def test_second_thread_is_told(self) -> None:
        told: list[str] = []

        def attempt(call: Callable[[], object]) -> None:
            try:
                call()
                told.append("nothing")
            except verp.VerpError as error:
                told.append(str(error))

        def control(moment: verp.Moment) -> None:
            for call in (self.session.tick, self.session.close, moment.decide):
                thread = threading.Thread(target=attempt, args=(call,))
                thread.start()
                thread.join()
            raise RuntimeError("mine")

        self.session.control(control)
        with self.assertRaisesRegex(RuntimeError, "mine"):  # not the other thread's exception
            self.session.tick()
        for words, text in zip(("verp_session_tick: another thread", "verp_session_close: another thread", "verp_decide: .*another thread"), told, strict=True):
            self.assertRegex(text, words)

    def test_controller_in_force_is_kept_though_two_threads_set_one(self) -> None:
        class Own:
            def __call__(self, moment: verp.Moment) -> None:
                moment.decide()

        entered, over = threading.Event(), threading.Event()
        control = verp._lib.calls.session_control

        def slow(*given: object) -> int:
            status = control(*given)
            if not entered.is_set():  # the first waits until the second set it or is blocked
                entered.set()
                over.wait(0.5)
            return status

        own = [Own(), Own()]
        last = weakref.ref(own[1])
        with mock.patch.object(verp._lib.calls, "session_control", slow):
            first = threading.Thread(target=self.session.control, args=(own[0],))
            first.start()
            entered.wait()
            self.session.control(own[1])
            over.set()
            first.join()
        del own, first
        gc.collect()
        self.assertIsNotNone(last(), "what the library calls is gone")
        self.assertTrue(self.session.tick())

    def test_environment_names_what_it_is_given(self) -> None:
        env = Env()
        self.refused([
            ("Env.reset: seed may be 0", lambda: env.reset(seed=-1)),
            ("Env.reset: seed is a whole", lambda: env.reset(seed="a")),
            ("Env.reset: options are a dict", lambda: env.reset(options=5)),
            ("Env.reset: vx_m_s is a number", lambda: env.reset(options={"vx_m_s": "a"})),
        ], (TypeError, ValueError))  # fmt: skip
        env.reset(seed=1)
        self.refused([
            ("Env.step: action is an array", lambda: env.step("abc")),
            ("Env.step: action is of the shape", lambda: env.step(np.zeros(3))),
            ("Env.step: action is not 21 finite", lambda: env.step(np.full(21, NAN))),
        ], (TypeError, ValueError))  # fmt: skip
        env.close()


class WordsTest(unittest.TestCase):
    def test_all_that_is_public_has_words(self) -> None:
        seen = 0
        for module in (verp, verp.env):
            self.assertTrue(module.__doc__)
            for name, thing in vars(module).items():
                if name.startswith("_") or not (inspect.isclass(thing) or inspect.isfunction(thing)) or not thing.__module__.startswith("verp"):
                    continue
                self.assertTrue(thing.__doc__, name)
                for part, what in vars(thing).items() if inspect.isclass(thing) else ():
                    if not part.startswith("_") and (inspect.isfunction(what) or isinstance(what, property)):
                        seen += 1
                        self.assertTrue(what.__doc__, f"{name}.{part}")
        self.assertGreater(seen, 40)


if __name__ == "__main__":
    unittest.main()
