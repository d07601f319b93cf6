// C#: the host never crashes, and a controller's exception arrives complete.
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
    ref verp_tick seen = ref session.Seen();
    double seen_m = seen.truth.body_m[2];
    session.Dispose();
    session.Dispose();  // harmless
    Says("verp_session_tick: this session was closed", () => session.Tick());
    Says("verp_session_digest: this session was closed", () => session.Digest());
    That(seen.truth.body_m[2] == seen_m, "what was seen lives on");
    var core = new Core();
    core.Dispose();
    uint flags;
    var outputs = new verp_outputs();
    var inputs = new verp_inputs();
    foreach (Action call in new Action[] {
               () => session.Add(new Robot()), () => session.Result(), () => session.Command(verp_request.VERP_WALK),
               () => session.GiveBack(), () => session.EmergencyStop(), () => session.Tune("gait.lift_m", 0.01),
               () => session.Tuning("gait.lift_m"), () => session.Quantities(), () => session.Read("trunk.mass_kg"),
               () => session.Set("trunk.mass_kg", 1), () => session.Push("trunk", 1, 0, 0, 1), () => session.Control(null),
               () => session.Radio(Session.RadioDefaults()), () => session.Send(new byte[1]), () => session.Take(out flags),
               () => session.State(new byte[1]), () => session.Cameras(), () => session.Colour(), () => session.Render(),
               () => session.Seen().ToString(), () => core.Reset(), () => core.Step(ref inputs, ref outputs), () => core.Digest(),
               () => core.Period_s(), () => core.JointNames(), () => core.Count(0, 0), () => core.Angle(0, 0),
               () => core.Forward(new float[21]), () => core.Com(new float[21]), () => core.LegIk(0, Standing(), out flags),
               () => core.Plan(0, 0, 0, 5) }) {
      string said = Throws<VerpException>(call).Message;
      That(said.Contains("was closed") || said.Contains("state is of 1 bytes"), said);
    }
    unsafe {
      That(Native.verp_session_tick(IntPtr.Zero, 1, null, null) == (int)verp_status.VERP_BAD_HANDLE, "a null handle");
      That(Native.verp_session_tick(new IntPtr(0x12345), 1, null, null) == (int)verp_status.VERP_BAD_HANDLE, "no handle");
    }
    new WeakReference(Walking());
    GC.Collect();
    GC.WaitForPendingFinalizers();  // close one without owner
  }

  static void WrongArgumentsAreErrorsThatNameTheCall() {
    using (var session = new Session()) {
      Says("verp_session_tick: nobody is in the world", () => session.Tick());
      Says("verp_session_add: ", () => session.Add(new Robot { Model = "nobody" }));
      Says("verp_session_add: walk_s", () => session.Add(new Robot { Walk_s = double.NaN }));
      Says("verp_session_add: robot is null", () => session.Add(null));
      Says("verp_session_add: Name has a zero", () => session.Add(new Robot { Name = "a\0b" }));
      Says("verp_session_add: Model has a zero", () => session.Add(new Robot { Model = "generic21\0b" }));
      Says("verp_session_add: model is empty", () => session.Add(new Robot { Model = "" }));
      Says("verp_session_add: record is empty", () => session.Add(new Robot { Record = "" }));
      Says("Session.Seen: there is no robot 0", () => session.Seen().ToString());
      session.Add(new Robot { Walk_s = 1 });
      Says("verp_session_read: ", () => session.Read("moon"));
      Says("verp_session_read: quantity is null", () => session.Read(null));
      Says("verp_session_read: quantity has a zero", () => session.Read("trunk.mass_kg\0"));
      Says("verp_session_set: quantity has a zero", () => session.Set("trunk.mass_kg\0", 1));
      Says("verp_session_tune: name has a zero", () => session.Tune("gait.lift_m\0", 0.01));
      Says("verp_session_tuning: name has a zero", () => session.Tuning("gait.lift_m\0"));
      Says("verp_session_push: thing has a zero", () => session.Push("trunk\0", 1, 0, 0, 1));
      Says("verp_session_render: view has a zero", () => session.Render("front\0"));
      Says("verp_session_render: view->width may be", () => session.Render("front", uint.MaxValue, uint.MaxValue));
      Says("verp_session_render: view->width may be", () => session.Render("front", 0, 48));
      Says("verp_session_render: eye_m and target_m", () => session.Render(new double[2], new double[3]));
      Says("verp_session_send: data is null", () => session.Send(null));
      Says("verp_session_push: fx_n is not a finite", () => session.Push("trunk", double.NaN, 0, 0, 1));
      Says("verp_replay: file has a zero", () => Replayed.Of("a\0b"));
      Says("verp_replay: file is null", () => Replayed.Of(null));
      Says("verp_session_open: world has a zero", () => new Session("pitch\0"));
      Says("verp_core_open: model has a zero", () => new Core("generic21\0"));
      Says("Session.Seen: there is no robot 9", () => session.Seen(9).ToString());
      Says("Session.Seen: there is no robot 4294967295", () => session.Seen(uint.MaxValue).ToString());
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
      Says("verp_core_leg_ik: sole is no pose of 12", () => core.LegIk(0, new float[3], out flags));
      Says("verp_core_leg_ik: sole is no pose of 12", () => core.LegIk(0, null, out flags));
      Says("verp_core_leg_ik: sole's first nine numbers are no rotation", () => core.LegIk(0, new float[12], out flags));
      Says("verp_core_leg_ik: side", () => core.LegIk(2, Standing(), out flags));
      Says("verp_core_plan: count is 4294967295: at most 1000000", () => core.Plan(0, 0, 0, uint.MaxValue));
      That(core.Plan(0, 0, 0, 0).Length == 0, "a plan of nothing");
      var angles = new float[21];
      angles[20] = float.NaN;
      Says("verp_core_forward: angle_rad[20] is not a finite number", () => core.Forward(angles));
      Says("verp_core_com: angle_rad[20]", () => core.Com(angles));
      var sole = new float[12];
      sole[3] = float.PositiveInfinity;
      Says("verp_core_leg_ik: sole[3]", () => core.LegIk(0, sole, out flags));
    }
  }

  static float[] Standing() { return new float[] { 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0.04f, -0.3f }; }

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

  // A callback collects: the runtime scans its stack.
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
        other = new Thread(() => Says("verp_decide: that moment is in the hands of a controller in another thread", moment.Decide));
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
