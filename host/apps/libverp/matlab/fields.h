#ifndef VERP_MATLAB_FIELDS_H
#define VERP_MATLAB_FIELDS_H
/* Converts structs of verp.h to MATLAB structs. A field is a row of doubles; a digest is uint64. */
#include <mex.h>
#include <stddef.h>

typedef enum field_type { kU8, kU16, kU32, kU64, kI16, kI32, kFloat, kDouble } field_type;

/* A number or an array in a struct. Nested names are flat: command.request is command_request. */
typedef struct field {
  const char* name;
  field_type type;
  size_t offset;
  size_t count;
} field;

/* The fields of one struct; `parts` are the structs inside it. */
typedef struct shape {
  const char* what;
  const field* fields;
  size_t count;
  size_t size;
} shape;

extern const shape kInputs, kOutputs, kTruth, kTick, kResult, kPlan;

/* Converts an array of `many` structs to a struct row. */
mxArray* to_matlab(const shape* of, const void* structs, size_t many);
/* Writes the fields that `from` has. Returns null, or an error text that is valid until the next
 * call. */
const char* from_matlab(const shape* of, const mxArray* from, void* into);
/* Like from_matlab(), but refuses unknown fields, which are probably misspelt. */
const char* from_matlab_alone(const shape* of, const mxArray* from, void* into);
/* Sets one number of a struct; returns null or an error text. */
const char* set_number(const field* what, size_t index, double value, void* into);

#endif
