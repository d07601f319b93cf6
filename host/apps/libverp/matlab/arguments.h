#ifndef VERP_MATLAB_ARGUMENTS_H
#define VERP_MATLAB_ARGUMENTS_H
/* What MATLAB gave to a call and wants of it. What is wrong becomes an error of MATLAB's, which
 * leaves the function by a long jump: none of these may be called while the library is at work. */
#include <mex.h>
#include <stddef.h>
#include <stdint.h>

typedef struct arguments {
  int given;
  const mxArray** in;
  int wanted;
  mxArray** out;
} arguments;

/* The call that is under way, for its errors. Gives the one before. */
const char* begin_call(const char* name);
/* An error of its arguments: printf's words. */
void refuse(const char* words, ...);
/* A call's status, if it is no error. */
int checked(int status);

double number(const arguments* a, int index, const char* what);
uint32_t whole(const arguments* a, int index, const char* what);
int32_t signed_whole(const arguments* a, int index, const char* what);
/* Null where there is an empty array, or nothing. MATLAB frees it when the call is over. */
char* text(const arguments* a, int index, const char* what);
char* text_of(const mxArray* given, const char* what);
/* As many floats as the array has. */
float* floats(const arguments* a, int index, size_t* count, const char* what);
/* The first argument: handles are numbers to the library, and to MATLAB. */
void* handle(const arguments* a);

mxArray* doubles(const float* from, size_t rows, size_t columns);
mxArray* word(uint64_t value);

#endif
