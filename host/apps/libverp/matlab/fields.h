#ifndef VERP_MATLAB_FIELDS_H
#define VERP_MATLAB_FIELDS_H
/* Converts structs of verp.h to MATLAB structs and back. A field is a row of doubles, a text or a
 * struct; a digest is uint64. */
#include <stddef.h>

#include "host/apps/libverp/matlab/arguments.h"

typedef enum field_type {
  kU8,
  kU16,
  kU32,
  kU64,
  kI16,
  kI32,
  kFloat,
  kDouble,
  kChars, /* an array of char, to MATLAB only */
  kText,  /* const char*, from MATLAB only */
  kStruct /* to MATLAB only */
} field_type;

/* A number, array, text or struct in a struct. */
typedef struct field {
  const char* name;
  field_type type;
  size_t offset;
  size_t count;
  const struct shape* of; /* kStruct */
} field;

/* The fields of one struct. */
typedef struct shape {
  const char* what;
  const field* fields;
  size_t count;
  size_t size;
} shape;

/* Made by mex_calls.py; calls written by hand use these. */
extern const shape kInputs, kOutputs, kTick, kRobot, kPlan;

/* Converts an array of `many` structs to a struct row. */
mxArray* to_matlab(const shape* of, const void* structs, size_t many);
/* Writes the fields that `from` has. Returns null, or an error text that is valid until the next
 * call. */
const char* from_matlab(const shape* of, const mxArray* from, void* into);
/* Like from_matlab(), but refuses unknown fields, which are probably misspelt. */
const char* from_matlab_alone(const shape* of, const mxArray* from, void* into);
/* Writes the fields of an argument; raises an error if they are wrong. */
void take_struct(const arguments* a, int index, const shape* of, void* into);

#endif
