#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "host/apps/libverp/matlab/calls.h"
#include "host/apps/libverp/matlab/fields.h"
#include "host/apps/libverp/verp.h"

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
  const int status = verp_session_close(handle(a));
  if (status != VERP_BUSY) close_session(handle(a)); /* it writes there until it is closed */
  checked(status);
}

void session_add(const arguments* a) {
  const verp_session session = handle(a);
  verp_robot robot;
  checked(verp_robot_defaults(&robot));
  take_struct(a, 1, &kRobot, &robot);
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
  const verp_session session = handle(a); /* arguments are checked before anything is kept */
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
  checked(verp_session_control(handle(a), whole(a, 1, "robot"), on ? controller : NULL, NULL));
}

void session_seen(const arguments* a) {
  a->out[0] = to_matlab(&kTick, tick_of(handle(a), whole(a, 1, "robot")), 1);
}

/* ---- radio ---- */

enum { kMostBytes = 65536 };

/* session_send(session, robot, to, uint8): false if too many messages wait. */
void session_send(const arguments* a) {
  const verp_session session = handle(a);
  if (a->given < 4 || !mxIsUint8(a->in[3])) refuse("data: a row of uint8 is needed");
  const int status = verp_session_send(session, whole(a, 1, "robot"), signed_whole(a, 2, "to"),
                                       mxGetData(a->in[3]), mxGetNumberOfElements(a->in[3]));
  a->out[0] = mxCreateLogicalScalar(checked(status) == VERP_OK);
}

/* session_take(session, robot): a row of uint8 and the sender; -1: no message. */
void session_take(const arguments* a) {
  uint64_t size = 0;
  uint32_t from = 0;
  void* room = mxMalloc(kMostBytes);
  const int status =
      checked(verp_session_take(handle(a), whole(a, 1, "robot"), room, kMostBytes, &size, &from));
  a->out[0] = mxCreateNumericMatrix(status == VERP_OK, (mwSize)size, mxUINT8_CLASS, mxREAL);
  if (size > 0) memcpy(mxGetData(a->out[0]), room, size);
  if (a->wanted > 1) a->out[1] = mxCreateDoubleScalar(status == VERP_OK ? (double)from : -1);
}
