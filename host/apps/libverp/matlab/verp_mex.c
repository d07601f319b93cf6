/* libverp for MATLAB and Octave: verp_mex(CALL, ...), behind the classes in +verp. Uses only
 * MathWorks' documented C API. A MATLAB error leaves a function by a long jump, so none may occur
 * while the library runs; the user's controller is therefore called with a trap. */
#include <string.h>

#include "host/apps/libverp/matlab/calls.h"
#include "host/apps/libverp/verp.h"

void replay(const arguments* a) {
  uint64_t ticks = 0;
  uint64_t digest = 0;
  if (checked(verp_replay(text(a, 0, "file"), &ticks, &digest)) == VERP_DIFFERS) {
    mexErrMsgIdAndTxt("verp:differs", "%s", verp_last_error());
  }
  a->out[0] = word(digest);
  if (a->wanted > 1) a->out[1] = mxCreateDoubleScalar((double)ticks);
}

void mexFunction(int nlhs, mxArray* plhs[], int nrhs, const mxArray* prhs[]) {
  static int known = 0;
  if (!known) {
    if (verp_abi() != VERP_ABI) refuse("libverp.so has another ABI: build both together");
    mexAtExit(close_all);
    known = 1;
  }
  char* name = nrhs > 0 && mxIsChar(prhs[0]) ? mxArrayToString(prhs[0]) : NULL;
  const arguments given = {nrhs - 1, prhs + 1, nlhs, plhs};
  for (const call* each = kCalls; name != NULL && each->name != NULL; ++each) {
    if (strcmp(name, each->name) == 0) {
      mxFree(name);
      /* A call by a controller is nested in another call. After an error its name remains, until
       * the next call sets its own. */
      const char* before = begin_call(each->name);
      each->run(&given);
      begin_call(before);
      return;
    }
  }
  begin_call("mex");
  refuse("there is no such call; see help verp.Session and verp.Core");
}
