// controller.exe [SECONDS]: a user's controller. It runs the robot's own controller and adds a nod of the head.
using System;
using System.Globalization;
using Verp;

static class OwnController {
  static int Main(string[] args) {
    CultureInfo.CurrentCulture = CultureInfo.InvariantCulture;  // 0.5, not 0,5
    var robot = new Robot();
    if (args.Length > 0) robot.Walk_s = double.Parse(args[0]);
    using (var core = new Core())
    using (var session = new Session()) {
      int pitch = Array.IndexOf(core.JointNames(), "head_pitch");
      session.Add(robot);
      session.Control(moment => {
        moment.Decide();
        double up_rad = 0.3 * Math.Sin(0.05 * moment.Inputs.tick);
        moment.Outputs.goal_count[pitch] += core.Count((uint)pitch, (float)up_rad) - core.Count((uint)pitch, 0);
      });
      double most_rad = 0;
      while (session.Tick()) most_rad = Math.Max(most_rad, session.Seen().joint_rad[pitch]);
      Console.WriteLine("nodded by {0:f2} rad, body at {1:f2} m", most_rad, session.Seen().truth.body_m[0]);
      return most_rad < 0.2 ? 1 : 0;
    }
  }
}
