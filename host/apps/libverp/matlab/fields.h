#ifndef VERP_MATLAB_FIELDS_H
#define VERP_MATLAB_FIELDS_H
/* Structs of verp.h as MATLAB's: a field is a row of doubles, but digests (uint64). */
#include <mex.h>
#include <stddef.h>

typedef enum field_type { kU8, kU16, kU32, kU64, kI16, kI32, kFloat, kDouble } field_type;

/* A number or an array of them, in a struct. Names are flat: command.request is command_request. */
typedef struct field {
  const char* name;
  field_type type;
  size_t offset;
  size_t count;
} field;

/* The fields of one struct; `parts` are structs inside it. */
typedef struct shape {
  const char* what;
  const field* fields;
  size_t count;
  size_t size;
} shape;

extern const shape kInputs, kOutputs, kTruth, kTick, kResult, kPlan;

/* `many` structs that lie one behind the other, as a row. */
mxArray* to_matlab(const shape* of, const void* structs, size_t many);
/* Writes those fields that `from` has. Null, or in words what is wrong with one, in memory of its
 * own until the next call. */
const char* from_matlab(const shape* of, const mxArray* from, void* into);
/* The same of a struct that has no other fields: a name that is none of them was meant as another.
 */
const char* from_matlab_alone(const shape* of, const mxArray* from, void* into);
/* One number of a struct; the same words. */
const char* set_number(const field* what, size_t index, double value, void* into);

#endif
