"""The Python package: its bits, its arrays, its errors, and the environments for learning."""

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

    def test_exception_of_a_controller_comes_back(self) -> None:
        with verp.Session() as session:
            session.add(walk_s=1)
            session.control(lambda moment: moment.inputs["nothing"])
            with self.assertRaisesRegex(ValueError, "nothing"):
                session.tick()

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
        self.assertGreater(still[0], 0.003)  # it has begun to walk

    def test_action_that_is_none_is_refused(self) -> None:
        env = Env()
        with self.assertRaisesRegex(RuntimeError, "reset"):
            env.step(env.no_action())

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
