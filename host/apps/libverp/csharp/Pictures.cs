using System;

namespace Verp {
  /// <summary>Rows from the top. Colour: red, green, blue per pixel. Depth: mm, 0 where there is nothing.</summary>
  public sealed class Picture<Pixel> {
    public uint Width, Height;
    public double Time_s;
    public Pixel[] Pixels;
  }

  public sealed unsafe partial class Session {
    public verp_camera[] Cameras(uint robot = 0) {
      uint count;
      Checked(Native.verp_session_cameras(handle, robot, &count));
      var all = new verp_camera[count];
      for (uint i = 0; i < count; ++i) all[i] = CameraOf(robot, i);
      return all;
    }

    /// <summary>The camera's last picture; null: it has not taken one yet.</summary>
    public Picture<byte> Colour(uint camera = 0, uint robot = 0) {
      verp_camera by = CameraOf(robot, camera);
      var seen = new Picture<byte> { Width = by.width, Height = by.height, Pixels = new byte[3 * by.width * by.height] };
      fixed (byte* to = seen.Pixels) return Read(robot, camera, Native.VERP_COLOUR, to, seen.Pixels.Length, seen) ? seen : null;
    }
    /// <summary>Distance along the camera's axis.</summary>
    public Picture<ushort> Depth(uint camera = 0, uint robot = 0) { return Words(robot, camera, Native.VERP_DEPTH); }
    /// <summary>One number per link, then per object; 0: the floor, or nothing.</summary>
    public Picture<ushort> Labels(uint camera = 0, uint robot = 0) { return Words(robot, camera, Native.VERP_LABELS); }

    /// <summary>The world as it is now. `view`: front, side, three-quarter, back, top, follow or head of a robot, or a
    /// camera that a file declares.</summary>
    public Picture<byte> Render(string view = "follow", uint width = 640, uint height = 480, uint robot = 0,
                                bool plain = false) {
      fixed (byte* name = Texts.ToC(view, "verp_session_render: view")) {
        var what = new verp_view { name = name, robot = robot, flags = plain ? (uint)Native.VERP_PLAIN : 0 };
        return Render(what, width, height);
      }
    }
    /// <summary>The world seen from eye_m to target_m, world frame; `fov_rad` is vertical.</summary>
    public Picture<byte> Render(double[] eye_m, double[] target_m, double fov_rad = 0.5, uint width = 640, uint height = 480,
                                bool plain = false) {
      if (eye_m == null || target_m == null || eye_m.Length != 3 || target_m.Length != 3)
        throw VerpException.Wrong("verp_session_render: eye_m and target_m are three numbers each");
      var what = new verp_view { fov_rad = fov_rad, flags = plain ? (uint)Native.VERP_PLAIN : 0 };
      for (int i = 0; i < 3; ++i) {
        what.eye_m[i] = eye_m[i];
        what.target_m[i] = target_m[i];
      }
      return Render(what, width, height);
    }

    Picture<byte> Render(verp_view what, uint width, uint height) {
      what.size = (uint)sizeof(verp_view);
      what.width = width;
      what.height = height;
      bool fits = width > 0 && height > 0 && Math.Max(width, height) <= Native.VERP_MOST_PIXELS;  // the library refuses the rest
      var drawn = new Picture<byte> { Width = width, Height = height, Pixels = new byte[fits ? 3UL * width * height : 1] };
      fixed (byte* to = drawn.Pixels) Checked(Native.verp_session_render(handle, &what, to, (ulong)drawn.Pixels.LongLength));
      return drawn;
    }

    verp_camera CameraOf(uint robot, uint index) {
      var camera = new verp_camera { size = (uint)sizeof(verp_camera) };
      Checked(Native.verp_session_camera(handle, robot, index, &camera));
      return camera;
    }

    Picture<ushort> Words(uint robot, uint camera, int what) {
      verp_camera by = CameraOf(robot, camera);
      var seen = new Picture<ushort> { Width = by.width, Height = by.height, Pixels = new ushort[by.width * by.height] };
      fixed (ushort* to = seen.Pixels) return Read(robot, camera, what, to, 2 * seen.Pixels.Length, seen) ? seen : null;
    }

    bool Read<Pixel>(uint robot, uint camera, int what, void* to, int size, Picture<Pixel> seen) {
      double time_s;
      int status = Native.verp_session_picture(handle, robot, camera, (uint)what, to, (ulong)size, &time_s);
      seen.Time_s = time_s;
      return Checked(status) != (int)verp_status.VERP_NO_PICTURE;
    }
  }
}
