#ifndef VERP_MATLAB_CALLS_H
#define VERP_MATLAB_CALLS_H
/* The calls of verp_mex(CALL, ...): each does what the function of that name in verp.h does. */
#include "host/apps/libverp/matlab/arguments.h"

void session_open(const arguments* a);
void session_close(const arguments* a);
void session_add(const arguments* a);
void session_tick(const arguments* a);
void session_control(const arguments* a);
void session_seen(const arguments* a);
void session_result(const arguments* a);
void session_digest(const arguments* a);
void session_command(const arguments* a);
void session_give_back(const arguments* a);
void session_emergency_stop(const arguments* a);
void session_tune(const arguments* a);
void session_tuning(const arguments* a);
void session_quantities(const arguments* a);
void session_read(const arguments* a);
void session_set(const arguments* a);
void session_push(const arguments* a);
void session_cameras(const arguments* a);
void session_picture(const arguments* a);
void session_render(const arguments* a);
void session_radio(const arguments* a);
void session_send(const arguments* a);
void session_take(const arguments* a);
/* Closes all sessions and so completes their traces, when MATLAB exits or unloads this file. */
void close_all(void);

void core_open(const arguments* a);
void core_close(const arguments* a);
void core_reset(const arguments* a);
void core_step(const arguments* a);
void core_digest(const arguments* a);
void core_period(const arguments* a);
void core_names(const arguments* a);
void core_count(const arguments* a);
void core_angle(const arguments* a);
void core_forward(const arguments* a);
void core_com(const arguments* a);
void core_leg_ik(const arguments* a);
void core_plan(const arguments* a);

#endif
