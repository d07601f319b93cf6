/* libverp for MATLAB and Octave: verp_mex(CALL, ...), behind the classes in +verp. Written against
 * MathWorks' documented C API only. An error of MATLAB's leaves a function by a long jump: none is
 * raised while the library is at work, so the user's controller is called with a trap. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "host/libverp/matlab/fields.h"
#include "host/libverp/verp.h"

typedef struct arguments {
  int given;
  const mxArray** in;
  int wanted;
  mxArray** out;
} arguments;

/* ---- errors, and what was given ---- */

static void refuse(const char* what) {
  mexErrMsgIdAndTxt("verp:argument", "verp: %s", what);
}

static int checked(int status) {
  if (status < 0) mexErrMsgIdAndTxt("verp:call", "%s", verp_last_error());
  return status;
}

static double number(const arguments* a, int index, const char* what) {
  const mxArray* given = index < a->given ? a->in[index] : NULL;
  if (given == NULL || mxGetNumberOfElements(given) != 1 || mxIsComplex(given) ||
      !(mxIsNumeric(given) || mxIsLogical(given))) {
    mexErrMsgIdAndTxt("verp:argument", "verp: %s: one number is needed", what);
  }
  return mxGetScalar(given);
}

static uint32_t whole(const arguments* a, int index, const char* what) {
  const double value = number(a, index, what);
  if (!(value >= 0 && value <= UINT32_MAX)) {
    mexErrMsgIdAndTxt("verp:argument", "verp: %s: %g is no count", what, value);
  }
  return (uint32_t)value;
}

/* Null where there is an empty array, or nothing. MATLAB frees it when the call is over. */
static char* text(const arguments* a, int index) {
  if (index >= a->given || mxIsEmpty(a->in[index])) return NULL;
  if (!mxIsChar(a->in[index])) refuse("a text is needed");
  return mxArrayToString(a->in[index]);
}

/* As many floats as the array has. */
static float* floats(const arguments* a, int index, size_t* count) {
  if (index >= a->given || !mxIsDouble(a->in[index]) || mxIsComplex(a->in[index])) {
    refuse("real doubles are needed");
  }
  const double* from = mxGetPr(a->in[index]);
  *count = mxGetNumberOfElements(a->in[index]);
  float* made = mxMalloc((*count + 1) * sizeof *made);
  for (size_t i = 0; i < *count; ++i) made[i] = (float)from[i];
  return made;
}

static mxArray* doubles(const float* from, size_t rows, size_t columns) {
  mxArray* made = mxCreateDoubleMatrix((mwSize)rows, (mwSize)columns, mxREAL);
  for (size_t i = 0; i < rows * columns; ++i) mxGetPr(made)[i] = from[i];
  return made;
}

static mxArray* word(uint64_t value) {
  mxArray* made = mxCreateNumericMatrix(1, 1, mxUINT64_CLASS, mxREAL);
  memcpy(mxGetData(made), &value, sizeof value);
  return made;
}

/* Handles are numbers to the library, and to MATLAB. */
static void* handle(const arguments* a) {
  if (a->given < 1 || !mxIsUint64(a->in[0]) || mxGetNumberOfElements(a->in[0]) != 1) {
    refuse("that is no handle");
  }
  uint64_t value;
  memcpy(&value, mxGetData(a->in[0]), sizeof value);
  return (void*)(uintptr_t)value; /* NOLINT(performance-no-int-to-ptr): never followed */
}
static verp_session session_of(const arguments* a) {
  return (verp_session)handle(a);
}
static verp_core core_of(const arguments* a) {
  return (verp_core)handle(a);
}

/* ---- what a session writes its ticks into ---- */

typedef struct seen {
  struct seen* next;
  verp_session session;
  uint32_t robot;
  verp_tick tick;
} seen;
static seen* all_seen = NULL;

static verp_tick* tick_of(verp_session session, uint32_t robot) {
  for (seen* each = all_seen; each != NULL; each = each->next) {
    if (each->session == session && each->robot == robot) return &each->tick;
  }
  refuse("there is no such robot in that session");
  return NULL;
}

static void close_session(verp_session session) {
  for (seen** each = &all_seen; *each != NULL;) {
    seen* one = *each;
    if (one->session != session) {
      each = &one->next;
      continue;
    }
    *each = one->next;
    free(one);
  }
}

/* When MATLAB ends, or forgets this file: traces that are written become whole. */
static void close_all(void) {
  while (all_seen != NULL) {
    const verp_session session = all_seen->session;
    verp_session_close(session);
    close_session(session);
  }
}

/* ---- sessions ---- */

static void session_open(const arguments* a) {
  const verp_world world = {sizeof world, whole(a, 1, "physics step"), text(a, 0)};
  verp_session session;
  checked(verp_session_open(&world, &session));
  a->out[0] = word((uint64_t)(uintptr_t)session);
}

static void session_close(const arguments* a) {
  const int status = verp_session_close(session_of(a));
  close_session(session_of(a));
  checked(status);
}

static const field kRobotNumbers[] = {{"flags", kU32, offsetof(verp_robot, flags), 1},
                                      {"seed", kU64, offsetof(verp_robot, seed), 1},
                                      {"walk_s", kDouble, offsetof(verp_robot, walk_s), 1},
                                      {"vx_m_s", kDouble, offsetof(verp_robot, vx_m_s), 1},
                                      {"vy_m_s", kDouble, offsetof(verp_robot, vy_m_s), 1},
                                      {"wz_rad_s", kDouble, offsetof(verp_robot, wz_rad_s), 1},
                                      {"x_m", kDouble, offsetof(verp_robot, x_m), 1},
                                      {"y_m", kDouble, offsetof(verp_robot, y_m), 1},
                                      {"yaw_rad", kDouble, offsetof(verp_robot, yaw_rad), 1}};
static const shape kRobot = {"robot", kRobotNumbers, sizeof kRobotNumbers / sizeof kRobotNumbers[0],
                             sizeof(verp_robot)};

static void set_text(const mxArray* from, const char* name, const char** into) {
  const mxArray* given = mxGetField(from, 0, name);
  if (given == NULL || mxIsEmpty(given)) return;
  if (!mxIsChar(given)) mexErrMsgIdAndTxt("verp:argument", "verp: %s: a text is needed", name);
  *into = mxArrayToString(given);
}

static void session_add(const arguments* a) {
  const verp_session session = session_of(a);
  verp_robot robot;
  checked(verp_robot_defaults(&robot));
  const char* wrong = a->given < 2 ? "a struct is needed" : from_matlab(&kRobot, a->in[1], &robot);
  if (wrong != NULL) refuse(wrong);
  set_text(a->in[1], "model", &robot.model);
  set_text(a->in[1], "bus", &robot.bus);
  set_text(a->in[1], "name", &robot.name);
  set_text(a->in[1], "tuning", &robot.tuning);
  set_text(a->in[1], "record", &robot.record);
  uint32_t index = 0;
  checked(verp_session_add(session, &robot, &index));
  seen* one = calloc(1, sizeof *one);
  if (one == NULL) refuse("out of memory");
  *one = (seen){.next = all_seen, .session = session, .robot = index};
  one->tick.size = sizeof one->tick;
  all_seen = one;
  checked(verp_session_view(session, index, &one->tick));
  a->out[0] = mxCreateDoubleScalar(index);
}

/* The users' controllers of the call that is under way: a struct array, one element a robot, with a
 * function (or nothing) and whether the robot's own controller decides first. In place of outputs a
 * function may give a text: what went wrong. */
static const mxArray* controllers = NULL;
static char thrown[512];

static int controller(const verp_moment* moment, void* user) {
  (void)user;
  const mxArray* function = mxGetField(controllers, moment->robot, "function");
  const mxArray* first = mxGetField(controllers, moment->robot, "own_first");
  if (first != NULL && mxGetScalar(first) != 0 && verp_decide(moment->token) < 0) {
    snprintf(thrown, sizeof thrown, "%s", verp_last_error());
    return 1;
  }
  mxArray* in[] = {(mxArray*)function, to_matlab(&kInputs, moment->inputs, 1),
                   to_matlab(&kOutputs, moment->outputs, 1)};
  mxArray* out = NULL;
  mxArray* exception = mexCallMATLABWithTrap(1, &out, 3, in, "feval");
  mxDestroyArray(in[1]);
  mxDestroyArray(in[2]);
  char* said = out != NULL && mxIsChar(out) ? mxArrayToString(out) : NULL;
  const char* wrong = exception != NULL || out == NULL ? "it could not be called"
                      : said != NULL                   ? said
                                     : from_matlab(&kOutputs, out, moment->outputs);
  if (wrong != NULL) {
    snprintf(thrown, sizeof thrown, "the controller of robot %u: %s", moment->robot, wrong);
  }
  if (out != NULL) mxDestroyArray(out);
  return wrong != NULL;
}

/* session_tick(session, count, controllers): true while there is a further tick. */
static void session_tick(const arguments* a) {
  const mxArray* before = controllers;
  controllers = a->given > 2 ? a->in[2] : NULL;
  thrown[0] = '\0';
  uint32_t done = 0;
  const int status = verp_session_tick(session_of(a), whole(a, 1, "count"), NULL, &done);
  controllers = before;
  if (thrown[0] != '\0') mexErrMsgIdAndTxt("verp:controller", "%s", thrown);
  a->out[0] = mxCreateLogicalScalar(checked(status) == VERP_OK);
}

/* session_control(session, robot, on): the function itself comes with each tick. */
static void session_control(const arguments* a) {
  const int on = number(a, 2, "on") != 0;
  checked(verp_session_control(session_of(a), whole(a, 1, "robot"), on ? controller : NULL, NULL));
}

static void add_field(mxArray* to, const char* name, mxArray* value) {
  mxSetFieldByNumber(to, 0, mxAddField(to, name), value);
}

static void session_seen(const arguments* a) {
  const verp_tick* tick = tick_of(session_of(a), whole(a, 1, "robot"));
  a->out[0] = to_matlab(&kTick, tick, 1);
  add_field(a->out[0], "inputs", to_matlab(&kInputs, &tick->inputs, 1));
  add_field(a->out[0], "outputs", to_matlab(&kOutputs, &tick->outputs, 1));
  add_field(a->out[0], "truth", to_matlab(&kTruth, &tick->truth, 1));
}

static void session_result(const arguments* a) {
  verp_result result = {.size = sizeof result};
  checked(verp_session_result(session_of(a), whole(a, 1, "robot"), &result));
  a->out[0] = to_matlab(&kResult, &result, 1);
  add_field(a->out[0], "failure", mxCreateString(result.failure));
  add_field(a->out[0], "remark", mxCreateString(result.remark));
}

static void session_digest(const arguments* a) {
  uint64_t digest = 0;
  checked(verp_session_digest(session_of(a), whole(a, 1, "robot"), &digest));
  a->out[0] = word(digest);
}

static void session_command(const arguments* a) {
  checked(verp_session_command(session_of(a), whole(a, 1, "robot"), whole(a, 2, "request"),
                               number(a, 3, "vx_m_s"), number(a, 4, "vy_m_s"),
                               number(a, 5, "wz_rad_s"), number(a, 6, "pan_rad"),
                               number(a, 7, "tilt_rad")));
}

static void session_give_back(const arguments* a) {
  checked(verp_session_give_back(session_of(a), whole(a, 1, "robot")));
}

static void session_stop(const arguments* a) {
  checked(verp_session_emergency_stop(session_of(a), whole(a, 1, "robot"),
                                      number(a, 2, "pressed") != 0));
}

static void session_tune(const arguments* a) {
  checked(
      verp_session_tune(session_of(a), whole(a, 1, "robot"), text(a, 2), number(a, 3, "value")));
}

static void session_tuning(const arguments* a) {
  double value = 0;
  checked(verp_session_tuning(session_of(a), whole(a, 1, "robot"), text(a, 2), &value));
  a->out[0] = mxCreateDoubleScalar(value);
}

static void session_quantities(const arguments* a) {
  static const char* names[] = {"name", "unit", "what", "low", "high", "settable"};
  uint32_t count = 0;
  checked(verp_session_quantities(session_of(a), &count));
  a->out[0] = mxCreateStructMatrix(1, count, 6, names);
  for (uint32_t i = 0; i < count; ++i) {
    verp_quantity each = {.size = sizeof each};
    checked(verp_session_quantity(session_of(a), i, &each));
    mxSetFieldByNumber(a->out[0], i, 0, mxCreateString(each.name));
    mxSetFieldByNumber(a->out[0], i, 1, mxCreateString(each.unit));
    mxSetFieldByNumber(a->out[0], i, 2, mxCreateString(each.what));
    mxSetFieldByNumber(a->out[0], i, 3, mxCreateDoubleScalar(each.low));
    mxSetFieldByNumber(a->out[0], i, 4, mxCreateDoubleScalar(each.high));
    mxSetFieldByNumber(a->out[0], i, 5, mxCreateLogicalScalar(each.settable != 0));
  }
}

static void session_read(const arguments* a) {
  double value = 0;
  checked(verp_session_read(session_of(a), text(a, 1), &value));
  a->out[0] = mxCreateDoubleScalar(value);
}

static void session_set(const arguments* a) {
  checked(verp_session_set(session_of(a), text(a, 1), number(a, 2, "value")));
}

static void session_push(const arguments* a) {
  checked(verp_session_push(session_of(a), text(a, 1), number(a, 2, "force x"),
                            number(a, 3, "force y"), number(a, 4, "force z"),
                            number(a, 5, "time")));
}

/* ---- the controller alone ---- */

static void core_open(const arguments* a) {
  verp_core core;
  checked(verp_core_open(text(a, 0), text(a, 1), text(a, 2), &core));
  a->out[0] = word((uint64_t)(uintptr_t)core);
}

static void core_close(const arguments* a) {
  checked(verp_core_close(core_of(a)));
}
static void core_reset(const arguments* a) {
  checked(verp_core_reset(core_of(a)));
}

/* core_step(core, inputs): outputs. */
static void core_step(const arguments* a) {
  verp_inputs inputs;
  verp_outputs outputs;
  memset(&inputs, 0, sizeof inputs);
  memset(&outputs, 0, sizeof outputs);
  const char* wrong =
      a->given < 2 ? "a struct of inputs is needed" : from_matlab(&kInputs, a->in[1], &inputs);
  if (wrong != NULL) refuse(wrong);
  checked(verp_core_step(core_of(a), &inputs, &outputs));
  a->out[0] = to_matlab(&kOutputs, &outputs, 1);
}

static void core_digest(const arguments* a) {
  uint64_t digest = 0;
  checked(verp_core_digest(core_of(a), &digest));
  a->out[0] = word(digest);
}

static void core_period(const arguments* a) {
  double period_s = 0;
  checked(verp_core_period(core_of(a), &period_s));
  a->out[0] = mxCreateDoubleScalar(period_s);
}

static void core_names(const arguments* a) {
  uint32_t joints = 0;
  checked(verp_core_joints(core_of(a), &joints));
  a->out[0] = mxCreateCellMatrix(1, joints);
  for (uint32_t i = 0; i < joints; ++i) {
    char name[VERP_NAME];
    checked(verp_core_joint_name(core_of(a), i, name, sizeof name));
    mxSetCell(a->out[0], i, mxCreateString(name));
  }
}

static void core_count(const arguments* a) {
  int32_t count = 0;
  checked(verp_core_count(core_of(a), whole(a, 1, "joint"), (float)number(a, 2, "angle"), &count));
  a->out[0] = mxCreateDoubleScalar(count);
}

static void core_angle(const arguments* a) {
  float angle_rad = 0;
  checked(verp_core_angle(core_of(a), whole(a, 1, "joint"), (int32_t)number(a, 2, "count"),
                          &angle_rad));
  a->out[0] = mxCreateDoubleScalar(angle_rad);
}

static void core_forward(const arguments* a) {
  size_t joints = 0;
  const float* angle_rad = floats(a, 1, &joints);
  float* poses = mxMalloc((joints + 1) * VERP_POSE * sizeof *poses);
  checked(verp_core_forward(core_of(a), angle_rad, (uint32_t)joints, poses));
  a->out[0] = doubles(poses, VERP_POSE, joints + 1);
}

static void core_com(const arguments* a) {
  size_t joints = 0;
  const float* angle_rad = floats(a, 1, &joints);
  float com_m[3];
  checked(verp_core_com(core_of(a), angle_rad, (uint32_t)joints, com_m));
  a->out[0] = doubles(com_m, 1, 3);
}

/* core_leg_ik(core, side, sole): angles and flags in one row. */
static void core_leg_ik(const arguments* a) {
  size_t count = 0;
  const float* sole = floats(a, 2, &count);
  if (count != VERP_POSE) refuse("sole: 12 numbers are needed");
  float found[VERP_LEG_JOINTS + 1];
  uint32_t flags = 0;
  checked(verp_core_leg_ik(core_of(a), whole(a, 1, "side"), sole, NULL, found, &flags));
  found[VERP_LEG_JOINTS] = (float)flags;
  a->out[0] = doubles(found, 1, VERP_LEG_JOINTS + 1);
}

static void core_plan(const arguments* a) {
  const uint32_t ticks = whole(a, 4, "ticks");
  if (ticks > 1000000) refuse("ticks: at most a million");
  verp_plan* plan = mxCalloc(ticks + 1, sizeof *plan);
  checked(verp_core_plan(core_of(a), number(a, 1, "vx_m_s"), number(a, 2, "vy_m_s"),
                         number(a, 3, "wz_rad_s"), plan, ticks, whole(a, 5, "stop")));
  a->out[0] = to_matlab(&kPlan, plan, ticks);
}

/* ---- both ---- */

static void version(const arguments* a) {
  a->out[0] = mxCreateString(verp_version());
}

static void replay(const arguments* a) {
  uint64_t ticks = 0;
  uint64_t digest = 0;
  if (checked(verp_replay(text(a, 0), &ticks, &digest)) == VERP_DIFFERS) {
    mexErrMsgIdAndTxt("verp:differs", "%s", verp_last_error());
  }
  a->out[0] = word(digest);
  if (a->wanted > 1) a->out[1] = mxCreateDoubleScalar((double)ticks);
}

static const struct {
  const char* name;
  void (*call)(const arguments*);
} kCalls[] = {{"session_open", session_open},
              {"session_close", session_close},
              {"session_add", session_add},
              {"session_tick", session_tick},
              {"session_control", session_control},
              {"session_seen", session_seen},
              {"session_result", session_result},
              {"session_digest", session_digest},
              {"session_command", session_command},
              {"session_give_back", session_give_back},
              {"session_stop", session_stop},
              {"session_tune", session_tune},
              {"session_tuning", session_tuning},
              {"session_quantities", session_quantities},
              {"session_read", session_read},
              {"session_set", session_set},
              {"session_push", session_push},
              {"core_open", core_open},
              {"core_close", core_close},
              {"core_reset", core_reset},
              {"core_step", core_step},
              {"core_digest", core_digest},
              {"core_period", core_period},
              {"core_names", core_names},
              {"core_count", core_count},
              {"core_angle", core_angle},
              {"core_forward", core_forward},
              {"core_com", core_com},
              {"core_leg_ik", core_leg_ik},
              {"core_plan", core_plan},
              {"version", version},
              {"replay", replay}};

void mexFunction(int nlhs, mxArray* plhs[], int nrhs, const mxArray* prhs[]) {
  static int known = 0;
  if (!known) {
    if (verp_abi() != VERP_ABI) refuse("libverp.so has another ABI: build both together");
    mexAtExit(close_all);
    known = 1;
  }
  char* name = nrhs > 0 && mxIsChar(prhs[0]) ? mxArrayToString(prhs[0]) : NULL;
  const arguments given = {nrhs - 1, prhs + 1, nlhs, plhs};
  for (size_t i = 0; name != NULL && i < sizeof kCalls / sizeof kCalls[0]; ++i) {
    if (strcmp(name, kCalls[i].name) == 0) {
      mxFree(name);
      kCalls[i].call(&given);
      return;
    }
  }
  refuse("there is no such call; see help verp.Session and verp.Core");
}
