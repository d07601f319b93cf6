"""The Python package: its bits, its arrays, its errors, and the environments for learning."""

import os
import signal
import tempfile
import unittest
from pathlib import Path

import numpy as np

import verp
from verp.env import Env, VectorEnv


class SessionTest(unittest.TestCase):
    def test_view_is_not_a_copy_and_outlives_the_session(self) -> None:
        with verp.Session() as session:
            session.add(walk_s=1)
            seen = session.seen()
            session.tick(30)
            self.assertEqual(seen["inputs"]["tick"], session.seen()["inputs"]["tick"])
            self.assertEqual(seen["digest"], session.digest())
            height_m = seen["truth"]["body_m"][2]
        self.assertEqual(seen["truth"]["body_m"][2], height_m)

    def test_core_steps_what_the_session_saw(self) -> None:
        with verp.Session() as session, verp.Core() as core:
            session.add(walk_s=1)
            for seen in session:
                core.inputs[0] = seen["inputs"]
                core.step()
            self.assertEqual(core.digest, session.digest())
            self.assertEqual(session.state()["digest.chain"][0], core.digest)

    def test_misuse_is_an_error_that_names_the_call(self) -> None:
        session = verp.Session()
        session.add(walk_s=1)
        with self.assertRaisesRegex(verp.VerpError, "verp_session_read: .*moon"):
            session.read("moon")
        with self.assertRaisesRegex(verp.VerpError, "verp_session_tuning: .*robot 3"):
            session.tuning("gait.lift_m", robot=3)
        with self.assertRaises(TypeError):
            session.add(colour=1)
        session.close()
        with self.assertRaisesRegex(verp.VerpError, "verp_session_tick: .*closed"):
            session.tick()
        with self.assertRaisesRegex(verp.VerpError, "verp_core_forward: .*bytes"), verp.Core() as core:
            core.forward(np.zeros(3, np.float32))

    def test_angles_of_another_shape_are_refused(self) -> None:
        with verp.Core() as core:
            for shape in ((21, 0), (21, 2), (1, 21), ()):
                for call in (core.forward, core.com):
                    with self.assertRaisesRegex(ValueError, "one row of angles"):
                        call(np.zeros(shape))

    def test_memory_that_the_library_looks_at_is_not_replaced(self) -> None:
        def replace(moment: verp.Moment) -> None:
            moment.outputs = np.zeros(1)

        with verp.Session() as session, verp.Core() as core:
            session.add(walk_s=1)
            session.control(replace)
            with self.assertRaises(AttributeError):
                session.tick()
            with self.assertRaises(AttributeError):
                core.inputs = np.zeros(1)

    def test_close_inside_a_controller_leaves_it_open(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            trace = Path(folder) / "a.mcap"
            with verp.Session() as session:
                session.add(walk_s=1, record=str(trace))

                def close(moment: verp.Moment) -> None:
                    moment.decide()
                    with self.assertRaisesRegex(verp.VerpError, "verp_session_close: .*callback"):
                        session.close()

                session.control(close)
                self.assertTrue(session.tick(3))
            self.assertEqual(verp.replay(str(trace))[0], 3)

    def test_exception_of_a_controller_comes_back(self) -> None:
        with verp.Session() as session:
            session.add(walk_s=1)
            session.control(lambda moment: moment.inputs["nothing"])
            with self.assertRaisesRegex(ValueError, "nothing"):
                session.tick()

    def test_numbers_that_are_none_are_named(self) -> None:
        with verp.Core() as core:
            angles = core.zeros()
            angles[4] = np.nan
            for call in (core.forward, core.com):
                with self.assertRaisesRegex(verp.VerpError, r"angle_rad\[4\] is not a finite number"):
                    call(angles)
            with self.assertRaisesRegex(verp.VerpError, r"verp_core_leg_ik: sole\[11\]"):
                core.leg_ik(0, np.eye(3), [0, 0.04, np.inf])

    def test_fork_harms_no_trace_of_the_parent(self) -> None:
        with tempfile.TemporaryDirectory() as folder, verp.Session() as session:
            trace = Path(folder) / "a.mcap"
            session.add(walk_s=1, record=str(trace))
            session.tick(50)
            child = os.fork()
            if child == 0:  # exits as Python does: collects, closes
                code = "not refused"
                try:
                    session.tick()
                except verp.VerpError as error:
                    code = "" if "forked" in str(error) else str(error)
                session.__del__()
                os._exit(code != "")
            self.assertEqual(os.waitpid(child, 0)[1], 0)
            while session.tick(100):
                pass
            digest = session.digest()
            session.close()
            self.assertEqual(verp.replay(str(trace))[1], digest)

    def test_robots_talk_by_radio(self) -> None:
        with verp.Session() as session:
            session.add(walk_s=1)
            session.add(walk_s=1, y_m=1)
            with self.assertRaisesRegex(TypeError, "colour"):
                session.radio(colour=1)
            with self.assertRaisesRegex(verp.VerpError, "verp_session_radio: .*range_m"):
                session.radio(range_m=-1)
            session.radio(loss=0, fade=0)
            session.tick(2)
            self.assertTrue(session.send(b"a\0b", robot=1))
            with self.assertRaises(TypeError):
                session.send("a text")
            with self.assertRaisesRegex(verp.VerpError, "verp_session_send: .*96"):
                session.send(bytes(97))
            session.tick(20)
            self.assertEqual(session.take(0), [(1, b"a\0b")])
            self.assertEqual(session.take(0), [])

    def test_damaged_trace_is_refused(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            trace = Path(folder) / "a.mcap"
            with verp.Session() as session:
                session.add(walk_s=1, record=str(trace))
                while session.tick(100):
                    pass
                digest = session.digest()
            self.assertEqual(verp.replay(str(trace))[1], digest)
            trace.write_bytes(trace.read_bytes()[:-100])
            with self.assertRaisesRegex(verp.VerpError, "verp_replay: .*a.mcap"):
                verp.replay(str(trace))


class EnvTest(unittest.TestCase):
    def test_episode_repeats_and_answers_to_actions(self) -> None:
        def run(scale: float) -> tuple[float, int]:
            env, total = Env(vx_m_s=0.1), 0.0
            seen, _ = env.reset(seed=3)
            self.assertEqual(seen.shape, env.observation_space.shape)
            chance = np.random.default_rng(1)
            for _ in range(60):
                action = (scale * env.action_space.sample(chance)).astype(np.float32)
                seen, reward, terminated, _, info = env.step(action)
                total += reward
                if terminated:
                    break
            env.close()
            return total, info["digest"]

        still = run(0)
        self.assertEqual(still, run(0))
        self.assertNotEqual(still[1], run(0.2)[1])
        self.assertGreater(still[0], 0.003)

    def test_action_that_is_none_is_refused(self) -> None:
        env = Env()
        with self.assertRaisesRegex(RuntimeError, "reset"):
            env.step(env.no_action())

    def test_seed_is_optional_and_then_follows_from_the_last(self) -> None:
        env, alike = Env(vx_m_s=0.1), Env(vx_m_s=0.1)
        firsts = [env.reset(seed=None)[0], env.reset()[0]]
        np.testing.assert_array_equal(firsts[0], alike.reset(seed=1)[0])
        np.testing.assert_array_equal(firsts[1], alike.reset()[0])
        self.assertFalse(np.array_equal(firsts[0], firsts[1]))
        env.close()
        alike.close()

    def test_reset_that_failed_leaves_nothing(self) -> None:
        env = Env()
        env.reset(seed=1)
        with self.assertRaisesRegex(ValueError, "no option 'vx'; there are vx_m_s"):
            env.reset(options={"vx": 0.1})
        with self.assertRaisesRegex(ValueError, "Env.reset: seed may be 0"):
            env.reset(seed=-1)
        with self.assertRaisesRegex(RuntimeError, "call reset"):
            env.step(env.no_action())
        for wrong in ({"episode_s": 0}, {"episode_s": float("nan")}, {"most_action_rad": -0.1}):
            with self.assertRaisesRegex(ValueError, "Env: "):
                Env(**wrong)

    def test_vector_that_was_interrupted_gives_no_old_answers(self) -> None:
        def interrupt(*_: object) -> None:
            raise KeyboardInterrupt

        with VectorEnv(2, vx_m_s=0.1) as envs:
            first, _ = envs.reset(seed=3)
            wanted = envs.step(envs.no_action())[4][0]["digest"]
            os.kill(envs._processes[0].pid, signal.SIGSTOP)
            before = signal.signal(signal.SIGALRM, interrupt)
            signal.setitimer(signal.ITIMER_REAL, 0.2)
            with self.assertRaises(KeyboardInterrupt):
                envs.step(envs.no_action())
            signal.signal(signal.SIGALRM, before)
            for process in envs._processes:
                os.kill(process.pid, signal.SIGINT)  # Ctrl-C reaches them too
                os.kill(process.pid, signal.SIGCONT)
            np.testing.assert_array_equal(envs.reset(seed=3)[0], first)
            self.assertEqual(envs.step(envs.no_action())[4][0]["digest"], wanted)

    def test_vector_says_who_was_killed_and_that_it_was_closed(self) -> None:
        with VectorEnv(1) as envs:
            killed = envs._processes[0]
            os.kill(killed.pid, signal.SIGSTOP)  # its request stays unread
            envs._pipes[0].send((0, "step", envs.no_action()[0]))
            os.kill(killed.pid, signal.SIGKILL)
            killed.join()
            with self.assertRaisesRegex(RuntimeError, "environment 0: its process has ended"):
                envs.step(envs.no_action())
        envs.close()
        with self.assertRaisesRegex(RuntimeError, "VectorEnv.step: it was closed"):
            envs.step(envs._pipes)
        with self.assertRaisesRegex(RuntimeError, "VectorEnv.reset: it was closed"):
            envs.reset()

    def test_vector_is_the_same_as_one_by_one(self) -> None:
        with VectorEnv(2, vx_m_s=0.1) as envs:
            first, _ = envs.reset(seed=3)
            _, rewards, terminated, _, infos = envs.step(envs.no_action())
            with self.assertRaisesRegex(ValueError, "2 rows"):
                envs.step(envs.no_action()[:1])
            with self.assertRaisesRegex(RuntimeError, "environment 0: ValueError"):
                envs.step(envs.no_action()[:, :3])
        env = Env(vx_m_s=0.1)
        alone, _ = env.reset(seed=3)
        np.testing.assert_array_equal(first[0], alone)
        self.assertEqual(infos[0]["digest"], env.step(env.no_action())[4]["digest"])
        self.assertEqual((rewards.shape, terminated.any()), ((2,), False))
        env.close()


if __name__ == "__main__":
    unittest.main()
