using System;
using Verp;

static class CsharpPicturesTest {
  static int Main() {
    using (var session = new Session("demo")) {
      session.Add(new Robot { Walk_s = 1 });
      verp_camera camera = session.Cameras()[0];
      That(camera.name.ToString() == "camera" && camera.gives == Native.VERP_COLOUR, "a camera says what it is");
      That(session.Colour() == null, "before the first tick nothing has been seen");
      session.Tick(30);
      Picture<byte> seen = session.Colour();
      That(seen.Pixels.Length == 3 * 320 * 240 && !Equal(seen.Pixels, new byte[3 * 320 * 240]), "there is something to see");
      That(seen.Time_s > 0 && seen.Time_s <= session.Seen().time_s, "and it was seen before now");
      GC.Collect();
      That(Equal(session.Colour().Pixels, seen.Pixels), "it stays what it was until the camera looks again");
      Picture<byte> front = session.Render("front", 64, 48);
      That(Equal(front.Pixels, session.Render("front", 64, 48).Pixels), "the world does not change by itself");
      Picture<byte> there = session.Render(new[] { 2.0, -2, 1 }, new[] { 0, 0, 0.25 }, 0.5, 64, 48);
      That(!Equal(there.Pixels, front.Pixels), "from elsewhere it looks otherwise");
      Says("verp_session_picture: camera 'camera' gives colour", () => session.Depth());
      Says("verp_session_camera: there is no camera 3", () => session.Colour(3));
      Says("verp_session_render: there is no view 'moon'", () => session.Render("moon", 64, 48));
      Says("verp_session_render: view->width may be", () => session.Render("front", 1, 48));
      Says("verp_session_render: eye_m and target_m are three", () => session.Render(new[] { 1.0 }, new[] { 0, 0, 0.25 }));
      session.Control(moment => {
        Says("verp_session_camera: another thread", () => session.Colour());
        moment.Decide();
      });
      session.Tick();
      session.Dispose();
      Says("verp_session_render: this session was closed", () => session.Render());
    }
    Console.WriteLine("pictures: all is well");
    return 0;
  }

  static bool Equal(byte[] a, byte[] b) {
    for (int i = 0; i < a.Length; ++i) {
      if (a[i] != b[i]) return false;
    }
    return a.Length == b.Length;
  }
  static void That(bool holds, string what) {
    if (!holds) throw new Exception("not so: " + what);
  }
  static T Throws<T>(Action call) where T : Exception {
    try {
      call();
    } catch (T error) {
      return error;
    }
    throw new Exception("nothing was thrown, but " + typeof(T) + " was to come");
  }
  static void Says(string words, Action call) {
    var error = Throws<VerpException>(call);
    That(error.Message.StartsWith(words), "'" + error.Message + "' begins with '" + words + "'");
  }
}
