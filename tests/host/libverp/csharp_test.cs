// The C# interface: its bits, and what it says to misuse. The host never crashes, and nothing is lost of a controller's exception.
using System;
using System.IO;
using System.Threading;
using Verp;

static class CsharpTest {
  static int Main() {
    ClosedAndNullHandlesAreKnown();
    WrongArgumentsAreErrorsThatNameTheCall();
    CoreStepsWhatASessionSaw();
    RobotsTalkByRadio();
    ControllersExceptionComesBack();
    ControllerOutlivesGarbageCollection();
    RobotsOfOneWorldMayCollectGarbage();
    SecondThreadAndCallbackAreTold();
    MomentThatIsOverIsKnown();
    DamagedTraceIsRefused();
    Console.WriteLine("csharp: all is well");
    return 0;
  }

  static Session Walking(double walk_s = 1, int robots = 1) {
    var session = new Session();
    for (int i = 0; i < robots; ++i) session.Add(new Robot { Walk_s = walk_s, Y_m = 2 * i });
    return session;
  }

  static void ClosedAndNullHandlesAreKnown() {
    Session session = Walking();
    session.Tick(3);
    double seen_m = session.Seen().truth.body_m[2];
    session.Dispose();
    session.Dispose();  // twice is as good as once
    Says("verp_session_tick: this session was closed", () => session.Tick());
    Says("verp_session_digest: this session was closed", () => session.Digest());
    That(session.Seen().truth.body_m[2] == seen_m, "what was seen lives on");
    unsafe {
      That(Native.verp_session_tick(IntPtr.Zero, 1, null, null) == (int)verp_status.VERP_BAD_HANDLE, "a null handle");
      That(Native.verp_session_tick(new IntPtr(0x12345), 1, null, null) == (int)verp_status.VERP_BAD_HANDLE, "no handle");
    }
    new WeakReference(Walking());
    GC.Collect();
    GC.WaitForPendingFinalizers();  // close one that nobody has
  }

  static void WrongArgumentsAreErrorsThatNameTheCall() {
    using (var session = new Session()) {
      Says("verp_session_tick: nobody is in the world", () => session.Tick());
      Says("verp_session_add: ", () => session.Add(new Robot { Model = "nobody" }));
      Says("verp_session_add: walk_s", () => session.Add(new Robot { Walk_s = double.NaN }));
      Throws<ArgumentNullException>(() => session.Add(null));
      session.Add(new Robot { Walk_s = 1 });
      Says("verp_session_read: ", () => session.Read("moon"));
      Says("verp_session_read: quantity is null", () => session.Read(null));
      Throws<ArgumentException>(() => session.Read("trunk.mass_kg\0"));
      Says("verp_session_tuning: there is no robot 3", () => session.Tuning("gait.lift_m", 3));
      Says("verp_session_command: request", () => session.Command((verp_request)9));
      Says("verp_session_state: state is of 10 bytes", () => session.State(new byte[10]));
      Says("verp_session_state: state is null", () => session.State(null));
      Says("verp_session_control: there is no robot 7", () => session.Control(moment => moment.Decide(), 7));
      That(session.Tick(), "and it still runs");
      That(session.Quantities()[0].name.ToString() != "", "a quantity has a name");
      var tick = session.Seen();
      Throws<IndexOutOfRangeException>(() => tick.outputs.goal_count[32] = 1);
      Throws<IndexOutOfRangeException>(() => tick.truth.sole_m[1, 3] = 1);
    }
    using (var core = new Core()) {
      Says("verp_core_forward: ", () => core.Forward(new float[3]));
      Says("verp_core_com: ", () => core.Com(null));
      uint flags;
      Throws<ArgumentException>(() => core.LegIk(0, new float[3], out flags));
      var angles = new float[21];
      angles[20] = float.NaN;
      Says("verp_core_forward: angle_rad[20] is not a finite number", () => core.Forward(angles));
      Says("verp_core_com: angle_rad[20]", () => core.Com(angles));
      var sole = new float[12];
      sole[3] = float.PositiveInfinity;
      Says("verp_core_leg_ik: sole[3]", () => core.LegIk(0, sole, out flags));
    }
  }

  static void CoreStepsWhatASessionSaw() {
    using (Session session = Walking())
    using (var core = new Core()) {
      var outputs = new verp_outputs();
      while (session.Tick()) core.Step(ref session.Seen().inputs, ref outputs);
      That(core.Digest() == session.Digest(), "the controller alone has the session's bits");
      verp_plan[] plan = core.Plan(0.1, 0, 0, 200);
      That(plan[199].phase != 0 && core.Forward(new float[21]).Length == 22 * 12, "a plan and forward kinematics");
    }
  }

  static void RobotsTalkByRadio() {
    using (Session session = Walking(1, 2)) {
      verp_radio radio = Session.RadioDefaults();
      radio.loss = radio.fade = 0;
      session.Radio(radio);
      session.Tick(2);
      That(session.Send(new byte[] { 7, 0, 9 }, 0, 1), "it is on its way");
      session.Tick(20);
      uint from;
      byte[] data = session.Take(out from);
      That(data != null && data.Length == 3 && data[2] == 9 && from == 1, "it has come");
      That(session.Take(out from) == null, "no further one");
      Says("verp_session_send: to is 0", () => session.Send(new byte[1], 0, 0));
    }
  }

  static void ControllersExceptionComesBack() {
    using (Session session = Walking()) {
      session.Control(moment => { throw new InvalidOperationException("on purpose"); });
      VerpException error = Says("verp_session_tick: the controller of robot 0", () => session.Tick());
      That(error.Status == verp_status.VERP_CALLBACK_FAILED && error.Message.Contains("on purpose"), error.Message);
      That(error.InnerException is InvalidOperationException && error.InnerException.StackTrace.Contains("CsharpTest"),
           "the exception knows where it was thrown");
      That(!session.Tick(), "the run is over");
    }
  }

  static void ControllerOutlivesGarbageCollection() {
    using (Session session = Walking()) {
      Attach(session);
      for (int i = 0; i < 40; ++i) {
        if (i % 10 == 0) GC.Collect();
        session.Tick();
      }
      That(session.Seen().outputs.torque_enable == 0, "its controller lives");
      session.Control(null);
      session.Tick(5);
      That(session.Seen().outputs.torque_enable != 0, "its own controller has it again");
    }
  }
  static void Attach(Session session) { session.Control(moment => moment.Outputs.torque_enable = 0); }

  // Collected from inside a callback: the runtime looks through the stack that it runs on.
  static void RobotsOfOneWorldMayCollectGarbage() {
    using (Session session = Walking(1, 2)) {
      int ticks = 0;
      for (uint robot = 0; robot < 2; ++robot) {
        session.Control(moment => {
          var kept = new[] { moment.Robot };
          if (++ticks % 16 == 0) GC.Collect();
          moment.Decide();
          That(kept[0] == moment.Robot, "what a controller holds stays");
        }, robot);
      }
      session.Tick(100);
      That(ticks == 100, ticks + " ticks");
      session.Control(moment => { throw new InvalidOperationException("one of two"); }, 1);
      Says("verp_session_tick: the controller of robot 1", () => session.Tick(4));
    }
  }

  static void SecondThreadAndCallbackAreTold() {
    using (Session session = Walking()) {
      session.Control(moment => {
        Says("verp_session_read: another thread, or a callback's caller", () => session.Read("trunk.mass_kg"));
        Says("verp_session_close: another thread, or a callback's caller", session.Dispose);
        var other = new Thread(() => Says("verp_session_tick: another thread", () => session.Tick()));
        other.Start();
        other.Join();
        moment.Decide();
      });
      session.Tick();
      session.Control(null);
      That(session.Tick(), "it is open, and runs");
    }
  }

  static void MomentThatIsOverIsKnown() {
    using (Session session = Walking()) {
      Moment kept = null;
      session.Control(moment => kept = moment);
      session.Tick();
      kept.Outputs.goal_count[0] = 1;
      Says("verp_decide: no controller is deciding", kept.Decide);
      session.Control(moment => {
        moment.Decide();
        Says("verp_decide: it has decided this moment already", moment.Decide);
      });
      session.Tick();
    }
  }

  static void DamagedTraceIsRefused() {
    string trace = Path.GetTempFileName();
    using (var session = new Session()) {
      session.Add(new Robot { Walk_s = 1, Record = trace });
      while (session.Tick(100)) {
      }
    }
    That(Replayed.Of(trace).Ticks > 100, "a whole trace");
    using (var file = new FileStream(trace, FileMode.Open)) file.SetLength(file.Length - 100);
    Says("verp_replay: " + trace, () => Replayed.Of(trace));
    File.Delete(trace);
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
  static VerpException Says(string words, Action call) {
    var error = Throws<VerpException>(call);
    That(error.Message.StartsWith(words), "'" + error.Message + "' begins with '" + words + "'");
    return error;
  }
}
