// camera.exe FILE.ppm [SECONDS]: walks through a room, writes the robot's last view to FILE and renders a picture of the
// robot.
using System;
using System.Globalization;
using System.IO;
using System.Text;
using Verp;

static class CameraOfARobot {
  static double Mean(byte[] pixels) {
    double sum = 0;
    foreach (byte each in pixels) sum += each;
    return sum / pixels.Length;
  }

  static int Main(string[] args) {
    CultureInfo.CurrentCulture = CultureInfo.InvariantCulture;  // 0.5, not 0,5
    if (args.Length < 1) {
      Console.Error.WriteLine("usage: camera.exe FILE.ppm [SECONDS]");
      return 2;
    }
    var robot = new Robot();
    if (args.Length > 1) robot.Walk_s = double.Parse(args[1]);
    using (var session = new Session("demo")) {
      session.Add(robot);
      while (session.Tick(100)) {
      }
      Picture<byte> seen = session.Colour();
      Picture<byte> outside = session.Render("follow", 320, 240);
      Console.WriteLine("{0}: {1}x{2} at {3:f2} s, mean {4:f1}; from outside {5:f1}", session.Cameras()[0].name, seen.Width,
                        seen.Height, seen.Time_s, Mean(seen.Pixels), Mean(outside.Pixels));
      using (FileStream file = File.Create(args[0])) {
        byte[] head = Encoding.ASCII.GetBytes("P6\n" + seen.Width + " " + seen.Height + "\n255\n");
        file.Write(head, 0, head.Length);
        file.Write(seen.Pixels, 0, seen.Pixels.Length);
      }
    }
    return 0;
  }
}
