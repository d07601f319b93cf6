"""Pictures in Python: arrays as numpy has them, and what is said to misuse."""

import unittest

import numpy as np

import verp
from verp.env import Env


class PicturesTest(unittest.TestCase):
    def test_picture_is_an_array_and_costs_the_run_nothing(self) -> None:
        def walk(looks: bool) -> int:
            with verp.Session("demo") as session:
                session.add(walk_s=1)
                while session.tick(20):
                    if looks:
                        session.picture()
                        session.render(width=64, height=48, plain=True)
                return session.digest()

        self.assertEqual(walk(True), walk(False))

    def test_cameras_say_what_they_are(self) -> None:
        with verp.Session() as session:
            session.add()
            (camera,) = session.cameras()
            self.assertEqual((camera.name, camera.gives), ("camera", ("colour",)))
            self.assertEqual((camera.width, camera.height), (320, 240))
            # Half a pixel from a pixel's centre.
            np.testing.assert_allclose(camera.matrix[:2, 2], (159.5, 119.5))
            self.assertGreater(camera.matrix[0, 0], 100)
            np.testing.assert_allclose(camera.rotation @ camera.rotation.T, np.eye(3), atol=1e-12)
            self.assertEqual(len(verp.Core().forward(np.zeros(21, np.float32))[0]), 22)
            self.assertLess(camera.link, 22)

    def test_picture_comes_when_the_camera_has_looked(self) -> None:
        with verp.Session("demo") as session:
            session.add(walk_s=1)
            self.assertIsNone(session.picture())
            session.tick(30)
            mine = np.zeros((240, 320, 3), np.uint8)
            seen = session.picture(camera="camera", out=mine)
            self.assertIs(seen.pixels, mine)
            self.assertGreater(mine.std(), 5)
            self.assertLessEqual(seen.time_s, session.seen()["time_s"])
            np.testing.assert_array_equal(session.picture().pixels, mine)

    def test_world_is_seen_from_where_one_says(self) -> None:
        with verp.Session("demo") as session:
            session.add()
            front = session.render("front", width=320, height=200)
            self.assertEqual((front.shape, front.dtype), ((200, 320, 3), np.uint8))
            here = session.render(eye_m=(2, -2, 1), width=320, height=200)
            self.assertGreater(np.abs(front.astype(int) - here).mean(), 2)
            again = np.empty_like(front)
            self.assertIs(session.render("front", width=320, height=200, out=again), again)
            np.testing.assert_array_equal(front, again)

    def test_misuse_says_what_is_wrong(self) -> None:
        with verp.Session() as session:
            session.add(walk_s=1)
            session.tick(30)
            with self.assertRaisesRegex(ValueError, "no camera 'left': it has camera"):
                session.picture(camera="left")
            with self.assertRaisesRegex(ValueError, "no 'heat'"):
                session.picture("heat")
            with self.assertRaisesRegex(verp.VerpError, "verp_session_picture: camera 'camera' gives colour"):
                session.picture("depth")
            with self.assertRaisesRegex(verp.VerpError, "verp_session_picture: there is no camera 4"):
                session.picture(camera=4)
            with self.assertRaisesRegex(verp.VerpError, "verp_session_cameras: there is no robot 1"):
                session.picture(robot=1)
            for wrong in (np.zeros((240, 320), np.uint8), np.zeros((240, 320, 3)), np.zeros((240, 640, 3), np.uint8)[:, ::2]):
                with self.assertRaisesRegex(ValueError, r"out: .*\(240, 320, 3\), uint8"):
                    session.picture(out=wrong)
            with self.assertRaisesRegex(verp.VerpError, "verp_session_render: there is no view 'moon'"):
                session.render("moon")
            with self.assertRaisesRegex(verp.VerpError, "verp_session_render: view->width may be 16 to 8192"):
                session.render(width=2)
        with self.assertRaisesRegex(verp.VerpError, "verp_session_picture: .*closed"):
            session.picture()

    def test_environment_shows_itself(self) -> None:
        env = Env()
        with self.assertRaisesRegex(RuntimeError, "Env.render: call reset"):
            env.render()
        env.reset(seed=1)
        self.assertEqual(env.render(width=64, height=48).shape, (48, 64, 3))
        self.assertEqual(env.picture().pixels.shape, (240, 320, 3))
        env.close()


if __name__ == "__main__":
    unittest.main()
