#include <string.h>

#include "host/apps/libverp/matlab/calls.h"
#include "host/apps/libverp/matlab/fields.h"
#include "host/apps/libverp/verp.h"

static verp_core core_of(const arguments* a) {
  return (verp_core)handle(a);
}

void core_open(const arguments* a) {
  verp_core core;
  checked(verp_core_open(text(a, 0, "model"), text(a, 1, "bus"), text(a, 2, "tuning"), &core));
  a->out[0] = word((uint64_t)(uintptr_t)core);
}

void core_close(const arguments* a) {
  checked(verp_core_close(core_of(a)));
}
void core_reset(const arguments* a) {
  checked(verp_core_reset(core_of(a)));
}

/* core_step(core, inputs): outputs. */
void core_step(const arguments* a) {
  verp_inputs inputs;
  verp_outputs outputs;
  memset(&inputs, 0, sizeof inputs);
  memset(&outputs, 0, sizeof outputs);
  const char* wrong =
      a->given < 2 ? "a struct of inputs is needed" : from_matlab(&kInputs, a->in[1], &inputs);
  if (wrong != NULL) refuse("%s", wrong);
  checked(verp_core_step(core_of(a), &inputs, &outputs));
  a->out[0] = to_matlab(&kOutputs, &outputs, 1);
}

void core_digest(const arguments* a) {
  uint64_t digest = 0;
  checked(verp_core_digest(core_of(a), &digest));
  a->out[0] = word(digest);
}

void core_period(const arguments* a) {
  double period_s = 0;
  checked(verp_core_period(core_of(a), &period_s));
  a->out[0] = mxCreateDoubleScalar(period_s);
}

void core_names(const arguments* a) {
  uint32_t joints = 0;
  checked(verp_core_joints(core_of(a), &joints));
  a->out[0] = mxCreateCellMatrix(1, joints);
  for (uint32_t i = 0; i < joints; ++i) {
    char name[VERP_NAME];
    checked(verp_core_joint_name(core_of(a), i, name, sizeof name));
    mxSetCell(a->out[0], i, mxCreateString(name));
  }
}

void core_count(const arguments* a) {
  int32_t count = 0;
  checked(verp_core_count(core_of(a), whole(a, 1, "joint"), (float)number(a, 2, "angle"), &count));
  a->out[0] = mxCreateDoubleScalar(count);
}

void core_angle(const arguments* a) {
  float angle_rad = 0;
  checked(
      verp_core_angle(core_of(a), whole(a, 1, "joint"), signed_whole(a, 2, "count"), &angle_rad));
  a->out[0] = mxCreateDoubleScalar(angle_rad);
}

void core_forward(const arguments* a) {
  size_t joints = 0;
  const float* angle_rad = floats(a, 1, &joints, "angle_rad");
  float* poses = mxMalloc((joints + 1) * VERP_POSE * sizeof *poses);
  checked(verp_core_forward(core_of(a), angle_rad, (uint32_t)joints, poses));
  a->out[0] = doubles(poses, VERP_POSE, joints + 1);
}

void core_com(const arguments* a) {
  size_t joints = 0;
  const float* angle_rad = floats(a, 1, &joints, "angle_rad");
  float com_m[3];
  checked(verp_core_com(core_of(a), angle_rad, (uint32_t)joints, com_m));
  a->out[0] = doubles(com_m, 1, 3);
}

/* core_leg_ik(core, side, sole): angles and flags in one row. */
void core_leg_ik(const arguments* a) {
  size_t count = 0;
  const float* sole = floats(a, 2, &count, "sole");
  if (count != VERP_POSE) refuse("sole: 12 numbers are needed");
  float found[VERP_LEG_JOINTS + 1];
  uint32_t flags = 0;
  checked(verp_core_leg_ik(core_of(a), whole(a, 1, "side"), sole, NULL, found, &flags));
  found[VERP_LEG_JOINTS] = (float)flags;
  a->out[0] = doubles(found, 1, VERP_LEG_JOINTS + 1);
}

void core_plan(const arguments* a) {
  const uint32_t ticks = whole(a, 4, "ticks");
  const uint32_t room = ticks <= VERP_MOST_PLANNED ? ticks : 0; /* if not, it is refused */
  verp_plan* plan = mxCalloc((size_t)room + 1, sizeof *plan);
  checked(verp_core_plan(core_of(a), number(a, 1, "vx_m_s"), number(a, 2, "vy_m_s"),
                         number(a, 3, "wz_rad_s"), plan, ticks, whole(a, 5, "stop")));
  a->out[0] = to_matlab(&kPlan, plan, ticks);
}
