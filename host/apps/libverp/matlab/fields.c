#include "host/apps/libverp/matlab/fields.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "host/apps/libverp/verp.h"

#define FIELD(of, path, flat, type, many) \
  { #flat, type, offsetof(of, path), many }
#define SHAPE(what, of, fields) \
  { what, fields, sizeof(fields) / sizeof(fields[0]), sizeof(of) }

static const field kInputFields[] = {
    FIELD(verp_inputs, tick, tick, kU32, 1),
    FIELD(verp_inputs, fresh, fresh, kU32, 1),
    FIELD(verp_inputs, flags, flags, kU16, 1),
    FIELD(verp_inputs, parameter_id, parameter_id, kU16, 1),
    FIELD(verp_inputs, parameter_bits, parameter_bits, kU32, 1),
    FIELD(verp_inputs, command.request, command_request, kU8, 1),
    FIELD(verp_inputs, command.sequence, command_sequence, kU8, 1),
    FIELD(verp_inputs, command.vx_tenth_mm_s, command_vx_tenth_mm_s, kI16, 1),
    FIELD(verp_inputs, command.vy_tenth_mm_s, command_vy_tenth_mm_s, kI16, 1),
    FIELD(verp_inputs, command.wz_mrad_s, command_wz_mrad_s, kI16, 1),
    FIELD(verp_inputs, command.head_pan_mrad, command_head_pan_mrad, kI16, 1),
    FIELD(verp_inputs, command.head_tilt_mrad, command_head_tilt_mrad, kI16, 1),
    FIELD(verp_inputs, gyro_count, gyro_count, kI16, 3),
    FIELD(verp_inputs, accel_count, accel_count, kI16, 3),
    FIELD(verp_inputs, foot_count, foot_count, kU16, 8),
    FIELD(verp_inputs, slow_joint, slow_joint, kU8, 1),
    FIELD(verp_inputs, slow_temperature_c, slow_temperature_c, kU8, 1),
    FIELD(verp_inputs, slow_error, slow_error, kU8, 1),
    FIELD(verp_inputs, slow_voltage_tenth_v, slow_voltage_tenth_v, kU16, 1),
    FIELD(verp_inputs, mailbox, mailbox, kU16, 1),
    FIELD(verp_inputs, position_count, position_count, kI32, VERP_MAX_JOINTS)};
const shape kInputs = SHAPE("inputs", verp_inputs, kInputFields);

static const field kOutputFields[] = {
    FIELD(verp_outputs, torque_enable, torque_enable, kU32, 1),
    FIELD(verp_outputs, faults, faults, kU32, 1),
    FIELD(verp_outputs, mode, mode, kU8, 1),
    FIELD(verp_outputs, gait_phase, gait_phase, kU8, 1),
    FIELD(verp_outputs, gait_state, gait_state, kU8, 1),
    FIELD(verp_outputs, stance, stance, kU8, 1),
    FIELD(verp_outputs, tilt_tenth_mrad, tilt_tenth_mrad, kI16, 2),
    FIELD(verp_outputs, goal_count, goal_count, kI32, VERP_MAX_JOINTS)};
const shape kOutputs = SHAPE("outputs", verp_outputs, kOutputFields);

static const field kTruthFields[] = {
    FIELD(verp_truth, body_m, body_m, kDouble, 3),
    FIELD(verp_truth, body_quaternion, body_quaternion, kDouble, 4),
    FIELD(verp_truth, body_rpy_rad, body_rpy_rad, kDouble, 3),
    FIELD(verp_truth, body_m_s, body_m_s, kDouble, 3),
    FIELD(verp_truth, body_rad_s, body_rad_s, kDouble, 3),
    FIELD(verp_truth, com_m, com_m, kDouble, 3),
    FIELD(verp_truth, com_m_s, com_m_s, kDouble, 3),
    FIELD(verp_truth, zmp_m, zmp_m, kDouble, 2),
    FIELD(verp_truth, foot_n, foot_n, kDouble, 2),
    FIELD(verp_truth, sole_m[0], left_sole_m, kDouble, 3),
    FIELD(verp_truth, sole_m[1], right_sole_m, kDouble, 3),
    FIELD(verp_truth, joint_rad, joint_rad, kDouble, VERP_MAX_JOINTS),
    FIELD(verp_truth, joint_rad_s, joint_rad_s, kDouble, VERP_MAX_JOINTS),
    FIELD(verp_truth, torque_n_m, torque_n_m, kDouble, VERP_MAX_JOINTS),
    FIELD(verp_truth, zmp_valid, zmp_valid, kU32, 1),
    FIELD(verp_truth, held, held, kU32, 1),
    FIELD(verp_truth, fallen, fallen, kU32, 1),
    FIELD(verp_truth, joints, joints, kU32, 1)};
const shape kTruth = SHAPE("truth", verp_truth, kTruthFields);

static const field kTickFields[] = {FIELD(verp_tick, robot, robot, kU32, 1),
                                    FIELD(verp_tick, time_s, time_s, kDouble, 1),
                                    FIELD(verp_tick, gone_s, gone_s, kDouble, 1),
                                    FIELD(verp_tick, digest, digest, kU64, 1),
                                    FIELD(verp_tick, joint_rad, joint_rad, kFloat, VERP_MAX_JOINTS),
                                    FIELD(verp_tick, goal_rad, goal_rad, kFloat, VERP_MAX_JOINTS)};
const shape kTick = SHAPE("tick", verp_tick, kTickFields);

static const field kResultFields[] = {FIELD(verp_result, fallen, fallen, kU32, 1),
                                      FIELD(verp_result, ticks, ticks, kU64, 1),
                                      FIELD(verp_result, digest, digest, kU64, 1),
                                      FIELD(verp_result, simulated_s, simulated_s, kDouble, 1),
                                      FIELD(verp_result, walk_s, walk_s, kDouble, 1),
                                      FIELD(verp_result, distance_m, distance_m, kDouble, 1),
                                      FIELD(verp_result, ahead_m, ahead_m, kDouble, 1),
                                      FIELD(verp_result, aside_m, aside_m, kDouble, 1),
                                      FIELD(verp_result, turned_rad, turned_rad, kDouble, 1),
                                      FIELD(verp_result, speed_m_s, speed_m_s, kDouble, 1),
                                      FIELD(verp_result, zmp_bias_mm, zmp_bias_mm, kDouble, 1),
                                      FIELD(verp_result, faults, faults, kU32, 1)};
const shape kResult = SHAPE("result", verp_result, kResultFields);

static const field kPlanFields[] = {FIELD(verp_plan, body, body, kFloat, 12),
                                    FIELD(verp_plan, sole[0], left_sole, kFloat, 12),
                                    FIELD(verp_plan, sole[1], right_sole, kFloat, 12),
                                    FIELD(verp_plan, zmp_m, zmp_m, kFloat, 2),
                                    FIELD(verp_plan, carry, carry, kFloat, 2),
                                    FIELD(verp_plan, leg_rad, leg_rad, kFloat, 12),
                                    FIELD(verp_plan, phase, phase, kU8, 1),
                                    FIELD(verp_plan, state, state, kU8, 1),
                                    FIELD(verp_plan, swing, swing, kU8, 1),
                                    FIELD(verp_plan, flags, flags, kU8, 1)};
const shape kPlan = SHAPE("plan", verp_plan, kPlanFields);

static size_t bytes_of(field_type type) {
  static const size_t bytes[] = {1, 2, 4, 8, 2, 4, sizeof(float), sizeof(double)};
  return bytes[type];
}

static double number_at(field_type type, const char* at) {
#define READ(Type)                    \
  {                                   \
    Type value;                       \
    memcpy(&value, at, sizeof value); \
    return (double)value;             \
  }
  switch (type) {
    case kU8:
      READ(uint8_t)
    case kU16:
      READ(uint16_t)
    case kU32:
      READ(uint32_t)
    case kU64:
      READ(uint64_t)
    case kI16:
      READ(int16_t)
    case kI32:
      READ(int32_t)
    case kFloat:
      READ(float)
    case kDouble:
      READ(double)
  }
#undef READ
  return 0;
}

static mxArray* one_field(const field* what, const char* from) {
  const char* at = from + what->offset;
  if (what->type == kU64) {
    mxArray* word = mxCreateNumericMatrix(1, 1, mxUINT64_CLASS, mxREAL);
    memcpy(mxGetData(word), at, sizeof(uint64_t));
    return word;
  }
  mxArray* row = mxCreateDoubleMatrix(1, (mwSize)what->count, mxREAL);
  double* numbers = mxGetPr(row);
  for (size_t i = 0; i < what->count; ++i) {
    numbers[i] = number_at(what->type, at + i * bytes_of(what->type));
  }
  return row;
}

mxArray* to_matlab(const shape* of, const void* structs, size_t many) {
  const char* names[32];
  for (size_t i = 0; i < of->count; ++i) names[i] = of->fields[i].name;
  mxArray* made = mxCreateStructMatrix(1, (mwSize)many, (int)of->count, names);
  for (size_t each = 0; each < many; ++each) {
    const char* from = (const char*)structs + each * of->size;
    for (size_t i = 0; i < of->count; ++i) {
      mxSetFieldByNumber(made, (mwIndex)each, (int)i, one_field(&of->fields[i], from));
    }
  }
  return made;
}

static char words[256];

static const char* out_of_range(const field* what, double value) {
  snprintf(words, sizeof words, "%s: %g does not fit", what->name, value);
  return words;
}

static const char* no_whole(const field* what, double value) {
  snprintf(words, sizeof words, "%s: %g is no whole number; round() it", what->name, value);
  return words;
}

const char* set_number(const field* what, size_t index, double value, void* into) {
  char* at = (char*)into + what->offset + index * bytes_of(what->type);
#define WRITE(Type, low, high, as)                                              \
  {                                                                             \
    if (!(value >= (low) && value <= (high))) return out_of_range(what, value); \
    if (as(value) != value) return no_whole(what, value);                       \
    const Type number = (Type)as(value);                                        \
    memcpy(at, &number, sizeof number);                                         \
    return NULL;                                                                \
  }
  switch (what->type) {
    case kU8:
      WRITE(uint8_t, 0, UINT8_MAX, rint)
    case kU16:
      WRITE(uint16_t, 0, UINT16_MAX, rint)
    case kU32:
      WRITE(uint32_t, 0, UINT32_MAX, rint)
    case kU64:
      WRITE(uint64_t, 0, 9007199254740992.0, rint) /* to which a double counts */
    case kI16:
      WRITE(int16_t, INT16_MIN, INT16_MAX, rint)
    case kI32:
      WRITE(int32_t, INT32_MIN, INT32_MAX, rint)
    case kFloat:
      WRITE(float, -3e38, 3e38, )
    case kDouble:
      WRITE(double, -1e308, 1e308, )
  }
#undef WRITE
  return NULL;
}

const char* from_matlab(const shape* of, const mxArray* from, void* into) {
  if (!mxIsStruct(from) || mxGetNumberOfElements(from) != 1) {
    snprintf(words, sizeof words, "a struct of %s is needed", of->what);
    return words;
  }
  for (size_t i = 0; i < of->count; ++i) {
    const field* what = &of->fields[i];
    const mxArray* row = mxGetField(from, 0, what->name);
    if (row == NULL) continue;
    if (!mxIsDouble(row) || mxIsComplex(row) || mxGetNumberOfElements(row) != what->count) {
      snprintf(words, sizeof words, "%s.%s: %zu real double%s needed", of->what, what->name,
               what->count, what->count == 1 ? " is" : "s are");
      return words;
    }
    const double* numbers = mxGetPr(row);
    for (size_t each = 0; each < what->count; ++each) {
      const char* wrong = set_number(what, each, numbers[each], into);
      if (wrong != NULL) return wrong;
    }
  }
  return NULL;
}

const char* from_matlab_alone(const shape* of, const mxArray* from, void* into) {
  const int names = mxIsStruct(from) ? mxGetNumberOfFields(from) : 0;
  for (int k = 0; k < names; ++k) {
    const char* name = mxGetFieldNameByNumber(from, k);
    size_t i = 0;
    while (i < of->count && strcmp(of->fields[i].name, name) != 0) ++i;
    if (i < of->count) continue;
    snprintf(words, sizeof words, "%s has no field '%s'", of->what, name);
    return words;
  }
  return from_matlab(of, from, into);
}
