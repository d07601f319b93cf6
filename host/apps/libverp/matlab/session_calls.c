#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "host/apps/libverp/matlab/calls.h"
#include "host/apps/libverp/matlab/fields.h"
#include "host/apps/libverp/verp.h"

static verp_session session_of(const arguments* a) {
  return (verp_session)handle(a);
}

/* ---- the memory for a session's ticks ---- */

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
  refuse("there is no robot %u in that session", robot);
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

void close_all(void) {
  while (all_seen != NULL) {
    seen* one = all_seen;
    all_seen = one->next;
    /* A busy session still writes to this memory. For a second robot, the session is already
     * closed. */
    if (verp_session_close(one->session) != VERP_BUSY) free(one);
  }
}

/* ---- sessions ---- */

void session_open(const arguments* a) {
  const verp_world world = {sizeof world, whole(a, 1, "physics_step_us"), text(a, 0, "world")};
  verp_session session;
  checked(verp_session_open(&world, &session));
  a->out[0] = word((uint64_t)(uintptr_t)session);
}

void session_close(const arguments* a) {
  const int status = verp_session_close(session_of(a));
  if (status != VERP_BUSY) close_session(session_of(a)); /* it writes there until it is closed */
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
  if (given != NULL && !mxIsEmpty(given)) *into = text_of(given, name);
}

void session_add(const arguments* a) {
  const verp_session session = session_of(a);
  verp_robot robot;
  checked(verp_robot_defaults(&robot));
  const char* wrong = a->given < 2 ? "a struct is needed" : from_matlab(&kRobot, a->in[1], &robot);
  if (wrong != NULL) refuse("%s", wrong);
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

/* The controllers of the current call: a struct array with, per robot, a function (or nothing) and
 * whether the robot's own controller runs first. Instead of outputs a function may return an error
 * text. */
static const mxArray* controllers = NULL;
static char thrown[512];

static int controller(const verp_moment* moment, void* user) {
  (void)user;
  const int known = controllers != NULL && moment->robot < mxGetNumberOfElements(controllers);
  const mxArray* function = known ? mxGetField(controllers, moment->robot, "function") : NULL;
  const mxArray* first = known ? mxGetField(controllers, moment->robot, "own_first") : NULL;
  if (function == NULL) {
    snprintf(thrown, sizeof thrown, "the controller of robot %u is missing", moment->robot);
    return 1;
  }
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
                                     : from_matlab_alone(&kOutputs, out, moment->outputs);
  if (wrong != NULL) {
    snprintf(thrown, sizeof thrown, "the controller of robot %u: %s", moment->robot, wrong);
  }
  if (out != NULL) mxDestroyArray(out);
  return wrong != NULL;
}

/* session_tick(session, count, controllers): true while there is a further tick. */
void session_tick(const arguments* a) {
  const verp_session session = session_of(a); /* arguments are checked before anything is kept */
  const uint32_t count = whole(a, 1, "count");
  const mxArray* given = a->given > 2 ? a->in[2] : NULL;
  if (given != NULL && !mxIsStruct(given)) refuse("controllers: a struct array is needed");
  const mxArray* before = controllers;
  controllers = given;
  thrown[0] = '\0';
  uint32_t done = 0;
  mexLock(); /* a controller may have MATLAB forget all it can, and this is at work */
  const int status = verp_session_tick(session, count, NULL, &done);
  mexUnlock();
  controllers = before;
  if (status == VERP_CALLBACK_FAILED && thrown[0] != '\0') {
    char said[sizeof thrown];
    memcpy(said, thrown, sizeof said);
    thrown[0] = '\0'; /* it is this tick's, not that of one around it */
    mexErrMsgIdAndTxt("verp:controller", "verp_session_tick: %s", said);
  }
  a->out[0] = mxCreateLogicalScalar(checked(status) == VERP_OK);
}

/* session_control(session, robot, on): the function itself is passed with each tick. */
void session_control(const arguments* a) {
  const int on = number(a, 2, "on") != 0;
  checked(verp_session_control(session_of(a), whole(a, 1, "robot"), on ? controller : NULL, NULL));
}

static void add_field(mxArray* to, const char* name, mxArray* value) {
  mxSetFieldByNumber(to, 0, mxAddField(to, name), value);
}

void session_seen(const arguments* a) {
  const verp_tick* tick = tick_of(session_of(a), whole(a, 1, "robot"));
  a->out[0] = to_matlab(&kTick, tick, 1);
  add_field(a->out[0], "inputs", to_matlab(&kInputs, &tick->inputs, 1));
  add_field(a->out[0], "outputs", to_matlab(&kOutputs, &tick->outputs, 1));
  add_field(a->out[0], "truth", to_matlab(&kTruth, &tick->truth, 1));
}

void session_result(const arguments* a) {
  verp_result result = {.size = sizeof result};
  checked(verp_session_result(session_of(a), whole(a, 1, "robot"), &result));
  a->out[0] = to_matlab(&kResult, &result, 1);
  add_field(a->out[0], "failure", mxCreateString(result.failure));
  add_field(a->out[0], "remark", mxCreateString(result.remark));
}

void session_digest(const arguments* a) {
  uint64_t digest = 0;
  checked(verp_session_digest(session_of(a), whole(a, 1, "robot"), &digest));
  a->out[0] = word(digest);
}

void session_command(const arguments* a) {
  checked(verp_session_command(session_of(a), whole(a, 1, "robot"), whole(a, 2, "request"),
                               number(a, 3, "vx_m_s"), number(a, 4, "vy_m_s"),
                               number(a, 5, "wz_rad_s"), number(a, 6, "pan_rad"),
                               number(a, 7, "tilt_rad")));
}

void session_give_back(const arguments* a) {
  checked(verp_session_give_back(session_of(a), whole(a, 1, "robot")));
}

void session_emergency_stop(const arguments* a) {
  checked(verp_session_emergency_stop(session_of(a), whole(a, 1, "robot"),
                                      number(a, 2, "pressed") != 0));
}

void session_tune(const arguments* a) {
  checked(verp_session_tune(session_of(a), whole(a, 1, "robot"), text(a, 2, "name"),
                            number(a, 3, "value")));
}

void session_tuning(const arguments* a) {
  double value = 0;
  checked(verp_session_tuning(session_of(a), whole(a, 1, "robot"), text(a, 2, "name"), &value));
  a->out[0] = mxCreateDoubleScalar(value);
}

void session_quantities(const arguments* a) {
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

void session_read(const arguments* a) {
  double value = 0;
  checked(verp_session_read(session_of(a), text(a, 1, "quantity"), &value));
  a->out[0] = mxCreateDoubleScalar(value);
}

void session_set(const arguments* a) {
  checked(verp_session_set(session_of(a), text(a, 1, "quantity"), number(a, 2, "value")));
}

void session_push(const arguments* a) {
  checked(verp_session_push(session_of(a), text(a, 1, "thing"), number(a, 2, "force x"),
                            number(a, 3, "force y"), number(a, 4, "force z"),
                            number(a, 5, "time")));
}
