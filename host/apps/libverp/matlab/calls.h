#ifndef VERP_MATLAB_CALLS_H
#define VERP_MATLAB_CALLS_H
/* The calls of verp_mex(CALL, ...): each does what the function of that name in verp.h does.
 * mex_calls.py reads the list below; it generates all other calls and the table. */
#include "host/apps/libverp/matlab/arguments.h"

void session_open(const arguments* a);
void session_close(const arguments* a);
void session_add(const arguments* a);
void session_tick(const arguments* a);
void session_control(const arguments* a);
void session_seen(const arguments* a);
void session_picture(const arguments* a);
void session_render(const arguments* a);
void session_send(const arguments* a);
void session_take(const arguments* a);
void core_names(const arguments* a);
void core_forward(const arguments* a);
void core_com(const arguments* a);
void core_leg_ik(const arguments* a);
void core_plan(const arguments* a);
void replay(const arguments* a);

typedef struct call {
  const char* name;
  void (*run)(const arguments*);
} call;
/* All calls; ends with a null name. */
extern const call kCalls[];

/* Closes all sessions and so completes their traces, when MATLAB exits or unloads this file. */
void close_all(void);

#endif
