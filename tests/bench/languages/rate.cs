// rate.exe TIMES: control ticks per second of CPU time, one call per tick, over a walk's inputs.
// One line each time.
using System;
using System.Collections.Generic;
using System.Diagnostics;
using Verp;

static class Rate {
  const int kPasses = 100;  // the clock counts hundredths

  static int Main(string[] args) {
    var saw = new List<verp_inputs>();
    ulong digest;
    using (var session = new Session()) {
      var robot = new Robot();
      robot.Walk_s = 3;
      session.Add(robot);
      while (session.Tick()) saw.Add(session.Seen().inputs);
      digest = session.Digest();
    }
    using (var core = new Core()) {
      var outputs = new verp_outputs();
      for (int n = int.Parse(args[0]); n > 0; --n) {
        TimeSpan start = Process.GetCurrentProcess().TotalProcessorTime;
        for (int pass = 0; pass < kPasses; ++pass) {
          core.Reset();
          foreach (verp_inputs each in saw) {
            verp_inputs inputs = each;
            core.Step(ref inputs, ref outputs);
          }
        }
        double took_s = (Process.GetCurrentProcess().TotalProcessorTime - start).TotalSeconds;
        if (core.Digest() != digest) {
          Console.Error.WriteLine("the controller did not decide what it did in the walk");
          return 1;
        }
        Console.WriteLine("{0}", (long)(kPasses * saw.Count / took_s));
      }
    }
    return 0;
  }
}
