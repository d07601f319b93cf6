// walk.exe [SECONDS]: the walk of `verp walk`, and its digest.
using System;
using System.Globalization;
using Verp;

static class Walk {
  static int Main(string[] args) {
    CultureInfo.CurrentCulture = CultureInfo.InvariantCulture;  // 0.5, not 0,5
    var robot = new Robot();
    if (args.Length > 0) robot.Walk_s = double.Parse(args[0]);
    using (var session = new Session()) {
      session.Add(robot);
      while (session.Tick(100)) {
      }
      verp_result result = session.Result();
      Console.WriteLine("{0:f2} m 0x{1:x16}", result.distance_m, result.digest);
      return result.failure.ToString() == "" ? 0 : 1;
    }
  }
}
