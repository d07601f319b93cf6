#ifndef VERP_MATLAB_ARGUMENTS_H
#define VERP_MATLAB_ARGUMENTS_H
/* Arguments and results of a call from MATLAB. A wrong argument raises a MATLAB error, which leaves
 * the function by a long jump, so call none of these while the library runs. */
#include <mex.h>
#include <stddef.h>
#include <stdint.h>

typedef struct arguments {
  int given;
  const mxArray** in;
  int wanted;
  mxArray** out;
} arguments;

/* Sets the name of the current call for error messages; returns the previous one. */
const char* begin_call(const char* name);
/* Raises an error about an argument; arguments as for printf. */
void refuse(const char* words, ...);
/* Raises an error if the status is one; else returns it. */
int checked(int status);

double number(const arguments* a, int index, const char* what);
uint32_t whole(const arguments* a, int index, const char* what);
int32_t signed_whole(const arguments* a, int index, const char* what);
/* Null for an empty array or a missing argument. MATLAB frees the text after the call. */
char* text(const arguments* a, int index, const char* what);
char* text_of(const mxArray* given, const char* what);
/* All elements of the array; `count` receives their number. */
float* floats(const arguments* a, int index, size_t* count, const char* what);
/* The handle in the first argument; handles are numbers in MATLAB too. */
void* handle(const arguments* a);

mxArray* doubles(const float* from, size_t rows, size_t columns);
mxArray* word(uint64_t value);

#endif
