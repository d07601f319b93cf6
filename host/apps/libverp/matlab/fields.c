#include "host/apps/libverp/matlab/fields.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Each type of number, its range, and what makes a whole number of it. */
#define NUMBERS(X)                                                              \
  X(kU8, uint8_t, 0, UINT8_MAX, rint)                                           \
  X(kU16, uint16_t, 0, UINT16_MAX, rint)                                        \
  X(kU32, uint32_t, 0, UINT32_MAX, rint)                                        \
  X(kU64, uint64_t, 0, 9007199254740992.0, rint) /* to which a double counts */ \
  X(kI16, int16_t, INT16_MIN, INT16_MAX, rint)                                  \
  X(kI32, int32_t, INT32_MIN, INT32_MAX, rint)                                  \
  X(kFloat, float, -3e38, 3e38, )                                               \
  X(kDouble, double, -1e308, 1e308, )

static double number_at(const field* what, size_t index, const char* at) {
  switch (what->type) {
#define READ(kind, Type, low, high, as)                      \
  case kind: {                                               \
    Type value;                                              \
    memcpy(&value, at + index * sizeof value, sizeof value); \
    return (double)value;                                    \
  }
    NUMBERS(READ)
#undef READ
    default:
      return 0;
  }
}

static mxArray* one_field(const field* what, const char* from) {
  const char* at = from + what->offset;
  if (what->type == kStruct) return to_matlab(what->of, at, 1);
  if (what->type == kChars) return mxCreateString(at);
  if (what->type == kU64) {
    uint64_t value;
    memcpy(&value, at, sizeof value);
    return word(value);
  }
  mxArray* row = mxCreateDoubleMatrix(1, (mwSize)what->count, mxREAL);
  for (size_t i = 0; i < what->count; ++i) mxGetPr(row)[i] = number_at(what, i, at);
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

static const char* set_number(const field* what, size_t index, double value, char* at) {
  switch (what->type) {
#define WRITE(kind, Type, low, high, as)                                        \
  case kind: {                                                                  \
    if (!(value >= (low) && value <= (high))) return out_of_range(what, value); \
    if (as(value) != value) return no_whole(what, value);                       \
    const Type number = (Type)as(value);                                        \
    memcpy(at + index * sizeof number, &number, sizeof number);                 \
    return NULL;                                                                \
  }
    NUMBERS(WRITE)
#undef WRITE
    default:
      return NULL;
  }
}

static void set_text(const mxArray* given, const char* name, char* at) {
  if (mxIsEmpty(given)) return;
  const char* text = text_of(given, name);
  memcpy(at, &text, sizeof text);
}

const char* from_matlab(const shape* of, const mxArray* from, void* into) {
  if (from == NULL || !mxIsStruct(from) || mxGetNumberOfElements(from) != 1) {
    snprintf(words, sizeof words, "a struct of %s is needed", of->what);
    return words;
  }
  for (size_t i = 0; i < of->count; ++i) {
    const field* what = &of->fields[i];
    const mxArray* row = mxGetField(from, 0, what->name);
    if (row == NULL) continue;
    char* at = (char*)into + what->offset;
    if (what->type == kText) {
      set_text(row, what->name, at);
      continue;
    }
    if (!mxIsDouble(row) || mxIsComplex(row) || mxGetNumberOfElements(row) != what->count) {
      snprintf(words, sizeof words, "%s.%s: %zu real double%s needed", of->what, what->name,
               what->count, what->count == 1 ? " is" : "s are");
      return words;
    }
    const double* numbers = mxGetPr(row);
    for (size_t each = 0; each < what->count; ++each) {
      const char* wrong = set_number(what, each, numbers[each], at);
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

void take_struct(const arguments* a, int index, const shape* of, void* into) {
  const char* wrong = from_matlab(of, index < a->given ? a->in[index] : NULL, into);
  if (wrong != NULL) refuse("%s", wrong);
}
