// record.exe FILE [SECONDS]: records a walk, and replays it bit for bit.
using System;
using System.Globalization;
using Verp;

static class Record {
  static int Main(string[] args) {
    CultureInfo.CurrentCulture = CultureInfo.InvariantCulture;  // 0.5, not 0,5
    if (args.Length < 1) {
      Console.Error.WriteLine("usage: record.exe FILE [SECONDS]");
      return 2;
    }
    var robot = new Robot { Record = args[0] };
    if (args.Length > 1) robot.Walk_s = double.Parse(args[1]);
    using (var session = new Session()) {
      session.Add(robot);
      while (session.Tick(100)) {
      }
    }  // closing the session completes the file
    Replayed replayed = Replayed.Of(args[0]);
    Console.WriteLine("{0} ticks 0x{1:x16}", replayed.Ticks, replayed.Digest);
    return 0;
  }
}
