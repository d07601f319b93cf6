#include <string.h>

#include "host/apps/libverp/matlab/calls.h"
#include "host/apps/libverp/matlab/fields.h"
#include "host/apps/libverp/verp.h"

enum { kMostBytes = 65536 };

static const field kRadioNumbers[] = {
    {"most_bytes", kU32, offsetof(verp_radio, most_bytes), 1},
    {"most_waiting", kU32, offsetof(verp_radio, most_waiting), 1},
    {"overhead_bytes", kU32, offsetof(verp_radio, overhead_bytes), 1},
    {"seed", kU64, offsetof(verp_radio, seed), 1},
    {"range_m", kDouble, offsetof(verp_radio, range_m), 1},
    {"loss", kDouble, offsetof(verp_radio, loss), 1},
    {"fade", kDouble, offsetof(verp_radio, fade), 1},
    {"fade_s", kDouble, offsetof(verp_radio, fade_s), 1},
    {"delay_s", kDouble, offsetof(verp_radio, delay_s), 1},
    {"jitter_s", kDouble, offsetof(verp_radio, jitter_s), 1},
    {"bytes_s", kDouble, offsetof(verp_radio, bytes_s), 1}};
static const shape kRadio = {"radio", kRadioNumbers, sizeof kRadioNumbers / sizeof kRadioNumbers[0],
                             sizeof(verp_radio)};

static verp_session session_of(const arguments* a) {
  return (verp_session)handle(a);
}

/* session_radio(session, struct) */
void session_radio(const arguments* a) {
  const verp_session session = session_of(a);
  verp_radio radio;
  checked(verp_radio_defaults(&radio));
  const char* wrong = a->given < 2 ? "a struct is needed" : from_matlab(&kRadio, a->in[1], &radio);
  if (wrong != NULL) refuse("%s", wrong);
  checked(verp_session_radio(session, &radio));
}

/* session_send(session, robot, to, uint8): false if too many messages wait. */
void session_send(const arguments* a) {
  const verp_session session = session_of(a);
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
  const int status = checked(
      verp_session_take(session_of(a), whole(a, 1, "robot"), room, kMostBytes, &size, &from));
  a->out[0] = mxCreateNumericMatrix(status == VERP_OK, (mwSize)size, mxUINT8_CLASS, mxREAL);
  if (size > 0) memcpy(mxGetData(a->out[0]), room, size);
  if (a->wanted > 1) a->out[1] = mxCreateDoubleScalar(status == VERP_OK ? (double)from : -1);
}
