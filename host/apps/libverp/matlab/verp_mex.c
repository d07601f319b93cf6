/* libverp for MATLAB and Octave: verp_mex(CALL, ...), behind the classes in +verp. Uses only
 * MathWorks' documented C API. A MATLAB error leaves a function by a long jump, so none may occur
 * while the library runs; the user's controller is therefore called with a trap. */
#include <string.h>

#include "host/apps/libverp/matlab/calls.h"
#include "host/apps/libverp/verp.h"

static void version(const arguments* a) {
  a->out[0] = mxCreateString(verp_version());
}

static void replay(const arguments* a) {
  uint64_t ticks = 0;
  uint64_t digest = 0;
  if (checked(verp_replay(text(a, 0, "file"), &ticks, &digest)) == VERP_DIFFERS) {
    mexErrMsgIdAndTxt("verp:differs", "%s", verp_last_error());
  }
  a->out[0] = word(digest);
  if (a->wanted > 1) a->out[1] = mxCreateDoubleScalar((double)ticks);
}

#define CALL(name) \
  { #name, name }
static const struct {
  const char* name;
  void (*call)(const arguments*);
} kCalls[] = {CALL(session_open),
              CALL(session_close),
              CALL(session_add),
              CALL(session_tick),
              CALL(session_control),
              CALL(session_seen),
              CALL(session_result),
              CALL(session_digest),
              CALL(session_command),
              CALL(session_give_back),
              CALL(session_emergency_stop),
              CALL(session_tune),
              CALL(session_tuning),
              CALL(session_quantities),
              CALL(session_read),
              CALL(session_set),
              CALL(session_push),
              CALL(session_cameras),
              CALL(session_picture),
              CALL(session_render),
              CALL(session_radio),
              CALL(session_send),
              CALL(session_take),
              CALL(core_open),
              CALL(core_close),
              CALL(core_reset),
              CALL(core_step),
              CALL(core_digest),
              CALL(core_period),
              CALL(core_names),
              CALL(core_count),
              CALL(core_angle),
              CALL(core_forward),
              CALL(core_com),
              CALL(core_leg_ik),
              CALL(core_plan),
              CALL(version),
              CALL(replay)};

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
      /* A call by a controller is nested in another call. After an error its name remains, until
       * the next call sets its own. */
      const char* before = begin_call(kCalls[i].name);
      kCalls[i].call(&given);
      begin_call(before);
      return;
    }
  }
  begin_call("mex");
  refuse("there is no such call; see help verp.Session and verp.Core");
}
