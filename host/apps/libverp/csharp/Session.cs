using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;

namespace Verp {
  /// <summary>A robot and its walk; see verp_robot. Null selects the library's default.</summary>
  public sealed class Robot {
    public string Model = "generic21", Bus, Name, Tuning, Record;
    public ulong Seed = 1;
    /// <summary>0: the robot obeys Session.Command() alone.</summary>
    public double Walk_s = 20;
    /// <summary>If Vx_m_s is NaN: the velocity of `verp walk`.</summary>
    public double Vx_m_s = double.NaN, Vy_m_s, Wz_rad_s, X_m, Y_m, Yaw_rad;
    public bool OpenEnd;
  }

  public sealed unsafe partial class Session : Handle {
    readonly List<verp_tick[]> ticks = new List<verp_tick[]>();
    readonly List<GCHandle> pinned = new List<GCHandle>();  // the library writes there
    readonly Dictionary<uint, verp_controller> controllers = new Dictionary<uint, verp_controller>();
    Exception thrown;

    /// <summary>`world`: one of common/worlds, or an SDF file; null: a level floor.</summary>
    public Session(string world = null, uint physicsStep_us = 0) {
      fixed (byte* file = Texts.ToC(world, "verp_session_open: world")) {
        var what = new verp_world { size = (uint)sizeof(verp_world), physics_step_us = physicsStep_us, file = file };
        IntPtr session;
        Checked(Native.verp_session_open(&what, &session));
        SetHandle(session);
      }
    }

    protected override int CloseNow() { return Native.verp_session_close(handle); }
    protected override void LetGo() {
      foreach (GCHandle each in pinned) each.Free();
      pinned.Clear();
    }

    public uint Add(Robot robot) {
      if (robot == null) throw VerpException.Wrong("verp_session_add: robot is null");
      verp_robot what;
      Checked(Native.verp_robot_defaults(&what));
      what.flags = robot.OpenEnd ? (uint)Native.VERP_OPEN_END : 0;
      what.seed = robot.Seed;
      what.walk_s = robot.Walk_s;
      if (!double.IsNaN(robot.Vx_m_s)) what.vx_m_s = robot.Vx_m_s;
      what.vy_m_s = robot.Vy_m_s;
      what.wz_rad_s = robot.Wz_rad_s;
      what.x_m = robot.X_m;
      what.y_m = robot.Y_m;
      what.yaw_rad = robot.Yaw_rad;
      uint index;
      fixed (byte* model = Texts.ToC(robot.Model, "verp_session_add: Model"), bus = Texts.ToC(robot.Bus, "verp_session_add: Bus"), name = Texts.ToC(robot.Name, "verp_session_add: Name"),
             tuning = Texts.ToC(robot.Tuning, "verp_session_add: Tuning"), record = Texts.ToC(robot.Record, "verp_session_add: Record")) {
        what.model = model;
        what.bus = bus;
        what.name = name;
        what.tuning = tuning;
        what.record = record;
        lock (ticks) {  // the library's order
          Checked(Native.verp_session_add(handle, &what, &index));
          View(index);
        }
      }
      return index;
    }

    void View(uint robot) {
      var tick = new verp_tick[1];
      tick[0].size = (uint)sizeof(verp_tick);
      ticks.Add(tick);
      GCHandle place = GCHandle.Alloc(tick, GCHandleType.Pinned);
      pinned.Add(place);
      Checked(Native.verp_session_view(handle, robot, (verp_tick*)place.AddrOfPinnedObject()));
    }

    /// <summary>Runs at most `count` ticks, each of one robot. False: the run has ended. An exception of a controller
    /// becomes the InnerException.</summary>
    public bool Tick(uint count = 1) {
      int status = Native.verp_session_tick(handle, count, null, null);
      if (status == (int)verp_status.VERP_CALLBACK_FAILED && thrown != null) {
        Exception inner = thrown;
        thrown = null;
        throw new VerpException(verp_status.VERP_CALLBACK_FAILED, Texts.Of(Native.verp_last_error()) + ": " + inner.Message,
                                inner);
      }
      return Checked(status) == (int)verp_status.VERP_OK;
    }

    /// <summary>The robot's last tick; the next tick overwrites it. The memory outlives the session.</summary>
    public ref verp_tick Seen(uint robot = 0) {
      if (IsClosed)
        throw new VerpException(verp_status.VERP_BAD_HANDLE, "Session.Seen: this session was closed; open one");
      if (robot >= ticks.Count)
        throw VerpException.Wrong("Session.Seen: there is no robot " + robot + ": the session has " + ticks.Count);
      return ref ticks[(int)robot][0];
    }

    public ulong Digest(uint robot = 0) {
      ulong digest;
      Checked(Native.verp_session_digest(handle, robot, &digest));
      return digest;
    }

    /// <summary>After the last tick; verp_layout("state") lists its fields.</summary>
    public void State(byte[] state, uint robot = 0) {
      fixed (byte* to = state) Checked(Native.verp_session_state(handle, robot, to, state == null ? 0 : (ulong)state.Length));
    }

    public verp_result Result(uint robot = 0) {
      var result = new verp_result { size = (uint)sizeof(verp_result) };
      Checked(Native.verp_session_result(handle, robot, &result));
      return result;
    }

    /// <summary>Takes control of the robot: velocity in its body frame, head angles positive to the left and
    /// down.</summary>
    public void Command(verp_request request, double vx_m_s = 0, double vy_m_s = 0, double wz_rad_s = 0, double pan_rad = 0,
                        double tilt_rad = 0, uint robot = 0) {
      Checked(Native.verp_session_command(handle, robot, (uint)request, vx_m_s, vy_m_s, wz_rad_s, pan_rad, tilt_rad));
    }
    /// <summary>Parameters for Radio(): an IEEE 802.15.4 modem in a hall.</summary>
    public static verp_radio RadioDefaults() {
      verp_radio radio;
      VerpException.Checked(Native.verp_radio_defaults(&radio));
      return radio;
    }
    public void Radio(verp_radio radio) { Checked(Native.verp_session_radio(handle, &radio)); }
    /// <summary>False: too many messages wait to be sent. `to` -1: all robots.</summary>
    public bool Send(byte[] data, int to = -1, uint robot = 0) {
      if (data == null) throw VerpException.Wrong("verp_session_send: data is null");
      fixed (byte* from = data)
        return Checked(Native.verp_session_send(handle, robot, to, from, (ulong)data.Length)) == (int)verp_status.VERP_OK;
    }
    /// <summary>The next message and its sender; null: there is none.</summary>
    public byte[] Take(out uint from, uint robot = 0) {
      var room = new byte[65536];
      ulong size;
      fixed (byte* to = room)
      fixed (uint* sender = &from) {
        *sender = 0;
        if (Checked(Native.verp_session_take(handle, robot, to, (ulong)room.Length, &size, sender)) != (int)verp_status.VERP_OK)
          return null;
      }
      Array.Resize(ref room, (int)size);
      return room;
    }
    public void GiveBack(uint robot = 0) { Checked(Native.verp_session_give_back(handle, robot)); }
    public void EmergencyStop(bool pressed = true, uint robot = 0) {
      Checked(Native.verp_session_emergency_stop(handle, robot, pressed ? 1 : 0));
    }

    public void Tune(string name, double value, uint robot = 0) {
      fixed (byte* text = Texts.ToC(name, "verp_session_tune: name")) Checked(Native.verp_session_tune(handle, robot, text, value));
    }
    public double Tuning(string name, uint robot = 0) {
      double value;
      fixed (byte* text = Texts.ToC(name, "verp_session_tuning: name")) Checked(Native.verp_session_tuning(handle, robot, text, &value));
      return value;
    }

    /// <summary>The quantities of the physics, after all robots were added.</summary>
    public verp_quantity[] Quantities() {
      uint count;
      Checked(Native.verp_session_quantities(handle, &count));
      var all = new verp_quantity[count];
      for (uint i = 0; i < count; ++i) {
        all[i].size = (uint)sizeof(verp_quantity);
        fixed (verp_quantity* one = &all[i]) Checked(Native.verp_session_quantity(handle, i, one));
      }
      return all;
    }
    public double Read(string quantity) {
      double value;
      fixed (byte* text = Texts.ToC(quantity, "verp_session_read: quantity")) Checked(Native.verp_session_read(handle, text, &value));
      return value;
    }
    /// <summary>From the next physics step on.</summary>
    public void Set(string quantity, double value) {
      fixed (byte* text = Texts.ToC(quantity, "verp_session_set: quantity")) Checked(Native.verp_session_set(handle, text, value));
    }
    /// <summary>Pushes a link or object at its centre of mass, N in world axes.</summary>
    public void Push(string thing, double fx_n, double fy_n, double fz_n, double for_s) {
      fixed (byte* text = Texts.ToC(thing, "verp_session_push: thing")) Checked(Native.verp_session_push(handle, text, fx_n, fy_n, fz_n, for_s));
    }

    /// <summary>Replaces the robot's own controller from the next tick on; null restores it.</summary>
    public void Control(Controller controller, uint robot = 0) {
      verp_controller callback = controller == null ? (verp_controller)null : Callback(controller);
      lock (controllers) {  // keeps the one that is in force
        Checked(Native.verp_session_control(handle, robot, callback, null));
        controllers[robot] = callback;  // protects it from the garbage collector
      }
    }

    verp_controller Callback(Controller controller) {
      var moment = new Moment();
      return (seen, user) => {
        try {
          moment.Run(seen, controller);
          return 0;
        } catch (Exception error) {  // must not reach the C code below; Tick() rethrows it
          thrown = error;
          return 1;
        }
      };
    }
  }
}
