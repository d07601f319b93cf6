#include "host/libverp/matlab/arguments.h"

#include <math.h>
#include <string.h>

#include "host/libverp/verp.h"

void refuse(const char* what) {
  mexErrMsgIdAndTxt("verp:argument", "verp: %s", what);
}

int checked(int status) {
  if (status < 0) mexErrMsgIdAndTxt("verp:call", "%s", verp_last_error());
  return status;
}

double number(const arguments* a, int index, const char* what) {
  const mxArray* given = index < a->given ? a->in[index] : NULL;
  if (given == NULL || mxGetNumberOfElements(given) != 1 || mxIsComplex(given) ||
      !(mxIsNumeric(given) || mxIsLogical(given))) {
    mexErrMsgIdAndTxt("verp:argument", "verp: %s: one number is needed", what);
  }
  return mxGetScalar(given);
}

uint32_t whole(const arguments* a, int index, const char* what) {
  const double value = number(a, index, what);
  if (!(value >= 0 && value <= UINT32_MAX && value == floor(value))) {
    mexErrMsgIdAndTxt("verp:argument", "verp: %s: %g is no count", what, value);
  }
  return (uint32_t)value;
}

int32_t signed_whole(const arguments* a, int index, const char* what) {
  const double value = number(a, index, what);
  if (!(value >= INT32_MIN && value <= INT32_MAX && value == floor(value))) {
    mexErrMsgIdAndTxt("verp:argument", "verp: %s: %g is no whole number of 32 bits", what, value);
  }
  return (int32_t)value;
}

char* text(const arguments* a, int index) {
  if (index >= a->given || mxIsEmpty(a->in[index])) return NULL;
  if (!mxIsChar(a->in[index])) refuse("a text is needed");
  return mxArrayToString(a->in[index]);
}

float* floats(const arguments* a, int index, size_t* count) {
  if (index >= a->given || !mxIsDouble(a->in[index]) || mxIsComplex(a->in[index])) {
    refuse("real doubles are needed");
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
