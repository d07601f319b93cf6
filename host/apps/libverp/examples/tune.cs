// tune.exe [SECONDS]: changes a number of the gait and one of the physics during a walk.
using System;
using System.Globalization;
using Verp;

static class Tune {
  static void Main(string[] args) {
    CultureInfo.CurrentCulture = CultureInfo.InvariantCulture;  // 0.5, not 0,5
    var robot = new Robot();
    if (args.Length > 0) robot.Walk_s = double.Parse(args[0]);
    using (var session = new Session()) {
      session.Add(robot);
      session.Tick(400);
      session.Tune("gait.lift_m", 0.015);
      session.Set("trunk.mass_kg", 1.02 * session.Read("trunk.mass_kg"));
      while (session.Tick(100)) {
      }
      Console.WriteLine("lift {0:f4} m, trunk {1:f3} kg", session.Tuning("gait.lift_m"), session.Read("trunk.mass_kg"));
    }
  }
}
