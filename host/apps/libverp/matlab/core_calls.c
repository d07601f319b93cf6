#include <string.h>

#include "host/apps/libverp/matlab/calls.h"
#include "host/apps/libverp/matlab/fields.h"
#include "host/apps/libverp/verp.h"

void core_names(const arguments* a) {
  uint32_t joints = 0;
  checked(verp_core_joints(handle(a), &joints));
  a->out[0] = mxCreateCellMatrix(1, joints);
  for (uint32_t i = 0; i < joints; ++i) {
    char name[VERP_NAME];
    checked(verp_core_joint_name(handle(a), i, name, sizeof name));
    mxSetCell(a->out[0], i, mxCreateString(name));
  }
}

void core_forward(const arguments* a) {
  size_t joints = 0;
  const float* angle_rad = floats(a, 1, &joints, "angle_rad");
  float* poses = mxMalloc((joints + 1) * VERP_POSE * sizeof *poses);
  checked(verp_core_forward(handle(a), angle_rad, (uint32_t)joints, poses));
  a->out[0] = doubles(poses, VERP_POSE, joints + 1);
}

void core_com(const arguments* a) {
  size_t joints = 0;
  const float* angle_rad = floats(a, 1, &joints, "angle_rad");
  float com_m[3];
  checked(verp_core_com(handle(a), angle_rad, (uint32_t)joints, com_m));
  a->out[0] = doubles(com_m, 1, 3);
}

/* core_leg_ik(core, side, sole): angles and flags in one row. */
void core_leg_ik(const arguments* a) {
  size_t count = 0;
  const float* sole = floats(a, 2, &count, "sole");
  if (count != VERP_POSE) refuse("sole: 12 numbers are needed");
  float found[VERP_LEG_JOINTS + 1];
  uint32_t flags = 0;
  checked(verp_core_leg_ik(handle(a), whole(a, 1, "side"), sole, NULL, found, &flags));
  found[VERP_LEG_JOINTS] = (float)flags;
  a->out[0] = doubles(found, 1, VERP_LEG_JOINTS + 1);
}

void core_plan(const arguments* a) {
  const uint32_t ticks = whole(a, 4, "ticks");
  const uint32_t room = ticks <= VERP_MOST_PLANNED ? ticks : 0; /* if not, it is refused */
  verp_plan* plan = mxCalloc((size_t)room + 1, sizeof *plan);
  checked(verp_core_plan(handle(a), number(a, 1, "vx_m_s"), number(a, 2, "vy_m_s"),
                         number(a, 3, "wz_rad_s"), plan, ticks, whole(a, 5, "stop")));
  a->out[0] = to_matlab(&kPlan, plan, ticks);
}
