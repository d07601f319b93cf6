using System;

namespace Verp {
  /// <summary>Decides a tick. If it throws, the run ends and Session.Tick() throws.</summary>
  public delegate void Controller(Moment moment);

  /// <summary>One tick, passed to a controller. It holds copies, so later access is safe.</summary>
  public sealed unsafe class Moment {
    public uint Robot { get; private set; }
    public verp_inputs Inputs;
    /// <summary>At first those of the previous tick; the library sends what the controller leaves here.</summary>
    public verp_outputs Outputs;
    ulong token;
    verp_outputs* sent;

    /// <summary>Runs the robot's own controller; Outputs may then be changed.</summary>
    public void Decide() {
      VerpException.Checked(Native.verp_decide(token));
      Outputs = *sent;
    }

    internal void Run(verp_moment* seen, Controller controller) {
      Robot = seen->robot;
      Inputs = *seen->inputs;
      Outputs = *seen->outputs;
      token = seen->token;
      sent = seen->outputs;
      controller(this);
      *seen->outputs = Outputs;
    }
  }

  public struct Replayed {
    public ulong Ticks, Digest;

    /// <summary>Throws if a bit differs.</summary>
    public static unsafe Replayed Of(string trace) {
      var replayed = new Replayed();
      fixed (byte* file = Texts.ToC(trace, "verp_replay: file")) {
        int status = Native.verp_replay(file, &replayed.Ticks, &replayed.Digest);
        if (status != (int)verp_status.VERP_OK)
          throw new VerpException((verp_status)status, Texts.Of(Native.verp_last_error()));
      }
      return replayed;
    }
  }
}
