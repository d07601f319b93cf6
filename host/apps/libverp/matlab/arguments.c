#include "host/apps/libverp/matlab/arguments.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "host/apps/libverp/verp.h"

static const char* called = "mex";

const char* begin_call(const char* name) {
  const char* before = called;
  called = name;
  return before;
}

void refuse(const char* words, ...) {
  char said[512];
  va_list values;
  va_start(values, words);
  vsnprintf(said, sizeof said, words, values);
  va_end(values);
  mexErrMsgIdAndTxt("verp:argument", "verp_%s: %s", called, said);
}

int checked(int status) {
  if (status == VERP_BUSY) mexErrMsgIdAndTxt("verp:busy", "%s", verp_last_error());
  if (status < 0) mexErrMsgIdAndTxt("verp:call", "%s", verp_last_error());
  return status;
}

double number(const arguments* a, int index, const char* what) {
  const mxArray* given = index < a->given ? a->in[index] : NULL;
  if (given == NULL || mxGetNumberOfElements(given) != 1 || mxIsComplex(given) ||
      !(mxIsNumeric(given) || mxIsLogical(given))) {
    refuse("%s: one number is needed", what);
  }
  return mxGetScalar(given);
}

uint32_t whole(const arguments* a, int index, const char* what) {
  const double value = number(a, index, what);
  if (!(value >= 0 && value <= UINT32_MAX && value == floor(value))) {
    refuse("%s: %g is no count", what, value);
  }
  return (uint32_t)value;
}

int32_t signed_whole(const arguments* a, int index, const char* what) {
  const double value = number(a, index, what);
  if (!(value >= INT32_MIN && value <= INT32_MAX && value == floor(value))) {
    refuse("%s: %g is no whole number of 32 bits", what, value);
  }
  return (int32_t)value;
}

char* text_of(const mxArray* given, const char* what) {
  if (mxIsEmpty(given)) return NULL;
  if (!mxIsChar(given) || mxGetM(given) != 1) refuse("%s: a text is needed", what);
  char* made = mxArrayToString(given);
  if (made == NULL || strlen(made) < mxGetNumberOfElements(given)) {
    refuse("%s has a zero character in it", what); /* where C would end it */
  }
  return made;
}

char* text(const arguments* a, int index, const char* what) {
  return index < a->given ? text_of(a->in[index], what) : NULL;
}

float* floats(const arguments* a, int index, size_t* count, const char* what) {
  if (index >= a->given || !mxIsDouble(a->in[index]) || mxIsComplex(a->in[index])) {
    refuse("%s: real doubles are needed", what);
  }
  const double* from = mxGetPr(a->in[index]);
  *count = mxGetNumberOfElements(a->in[index]);
  float* made = mxMalloc((*count + 1) * sizeof *made);
  for (size_t i = 0; i < *count; ++i) made[i] = (float)from[i];
  return made;
}

mxArray* doubles(const float* from, size_t rows, size_t columns) {
  mxArray* made = mxCreateDoubleMatrix((mwSize)rows, (mwSize)columns, mxREAL);
  for (size_t i = 0; i < rows * columns; ++i) mxGetPr(made)[i] = from[i];
  return made;
}

mxArray* word(uint64_t value) {
  mxArray* made = mxCreateNumericMatrix(1, 1, mxUINT64_CLASS, mxREAL);
  memcpy(mxGetData(made), &value, sizeof value);
  return made;
}

void* handle(const arguments* a) {
  if (a->given > 0 && mxIsEmpty(a->in[0])) refuse("that is no handle: it was closed; open another");
  if (a->given < 1 || !mxIsUint64(a->in[0]) || mxGetNumberOfElements(a->in[0]) != 1) {
    refuse("that is no handle");
  }
  uint64_t value;
  memcpy(&value, mxGetData(a->in[0]), sizeof value);
  return (void*)(uintptr_t)value; /* NOLINT(performance-no-int-to-ptr): never followed */
}
