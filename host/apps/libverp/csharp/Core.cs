using System;

namespace Verp {
  /// <summary>One robot's controller without a world, with the robot's own bits.</summary>
  public sealed unsafe class Core : Handle {
    public Core(string model = "generic21", string bus = null, string tuning = null) {
      IntPtr core;
      fixed (byte* name = Texts.ToC(model, "verp_core_open: model"), of = Texts.ToC(bus, "verp_core_open: bus"), tuned = Texts.ToC(tuning, "verp_core_open: tuning"))
        Checked(Native.verp_core_open(name, of, tuned, &core));
      SetHandle(core);
    }

    protected override int CloseNow() { return Native.verp_core_close(handle); }

    public void Reset() { Checked(Native.verp_core_reset(handle)); }
    public void Step(ref verp_inputs inputs, ref verp_outputs outputs) {
      fixed (verp_inputs* seen = &inputs)
      fixed (verp_outputs* sent = &outputs) Checked(Native.verp_core_step(handle, seen, sent));
    }
    public ulong Digest() {
      ulong digest;
      Checked(Native.verp_core_digest(handle, &digest));
      return digest;
    }
    public double Period_s() {
      double period_s;
      Checked(Native.verp_core_period(handle, &period_s));
      return period_s;
    }

    public string[] JointNames() {
      uint joints;
      Checked(Native.verp_core_joints(handle, &joints));
      var names = new string[joints];
      byte* name = stackalloc byte[Native.VERP_NAME];
      for (uint joint = 0; joint < joints; ++joint) {
        Checked(Native.verp_core_joint_name(handle, joint, name, Native.VERP_NAME));
        names[joint] = Texts.Of(name, Native.VERP_NAME);
      }
      return names;
    }
    public int Count(uint joint, float angle_rad) {
      int count;
      Checked(Native.verp_core_count(handle, joint, angle_rad, &count));
      return count;
    }
    public float Angle(uint joint, int count) {
      float angle_rad;
      Checked(Native.verp_core_angle(handle, joint, count, &angle_rad));
      return angle_rad;
    }

    /// <summary>Poses of all links, the body's first: 12 numbers each, rotation then position, body frame.</summary>
    public float[] Forward(float[] angle_rad) {
      uint links = Math.Min(Length(angle_rad), (uint)Native.VERP_MAX_JOINTS) + 1;  // the library refuses more
      var poses = new float[links * Native.VERP_POSE];
      fixed (float* angles = angle_rad, to = poses)
        Checked(Native.verp_core_forward(handle, angles, Length(angle_rad), to));
      return poses;
    }
    /// <summary>Centre of mass, body frame.</summary>
    public float[] Com(float[] angle_rad) {
      var com_m = new float[3];
      fixed (float* angles = angle_rad, to = com_m) Checked(Native.verp_core_com(handle, angles, Length(angle_rad), to));
      return com_m;
    }
    /// <summary>Six angles, hip to ankle, that bring the sole of a leg to a pose (12 numbers, body frame). `flags`: 0 if
    /// the solution is exact.</summary>
    public float[] LegIk(uint side, float[] sole, out uint flags) {
      if (sole == null || sole.Length != Native.VERP_POSE)
        throw VerpException.Wrong("verp_core_leg_ik: sole is no pose of 12 numbers");
      var angle_rad = new float[Native.VERP_LEG_JOINTS];
      fixed (float* pose = sole, to = angle_rad)
      fixed (uint* said = &flags) Checked(Native.verp_core_leg_ik(handle, side, pose, null, to, said));
      return angle_rad;
    }
    public verp_plan[] Plan(double vx_m_s, double vy_m_s, double wz_rad_s, uint ticks, uint stop = 0) {
      var plan = new verp_plan[ticks <= Native.VERP_MOST_PLANNED ? ticks : 1];  // the library refuses more
      fixed (verp_plan* to = plan) Checked(Native.verp_core_plan(handle, vx_m_s, vy_m_s, wz_rad_s, to, ticks, stop));
      return plan;
    }

    static uint Length(float[] array) { return array == null ? 0 : (uint)array.Length; }
  }
}
