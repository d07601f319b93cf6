/* VERP as a library: robots in a world, a control tick at a time, and the controller's own
 * algorithms.
 *
 * Every function gives a verp_status; what went wrong, verp_last_error() says in one line that
 * names the call. No exception leaves the library, whatever a callback throws.
 *
 * Handles are numbers that are never used twice, so one that was closed is known as such. A handle
 * is for one thread at a time: a second one gets VERP_BUSY. Different handles may be used by
 * different threads at the same time, and equal calls give equal bits whatever the others do. A
 * callback runs inside verp_session_tick(), in its thread and on its stack: calls with the handle
 * of that session then give VERP_BUSY, but for verp_session_send() and verp_session_take(); all
 * others work. To a process that was forked its parent's handles are VERP_BAD_HANDLE, and its end
 * harms none of them: it opens its own.
 *
 * Structs begin with `size`, which the caller sets to sizeof: another one's is refused. Memory that
 * the caller gives is the caller's, and no pointer to the library's own is ever handed out, but
 * texts that never change.
 *
 * SI units. World frame: z up, the floor at 0. Body frame: origin at the trunk's centre, x forward,
 * y left, z up. Index 0 is left, 1 is right. Rotations are row-major matrices, or quaternions x, y,
 * z, w.
 *
 * This file keeps to the C that other languages read (README.md): no macros in declarations.
 */
#ifndef VERP_H
#define VERP_H
#include <stdint.h>
#ifdef __cplusplus
extern "C" {
#endif
#ifdef __GNUC__
#pragma GCC visibility push(default)
#endif

typedef enum verp_status {
  VERP_OK = 0,
  VERP_OVER = 1,       /* the run has ended: there is no further tick */
  VERP_DIFFERS = 2,    /* a trace was replayed, and not with the same bits */
  VERP_NO_PICTURE = 3, /* a camera has not looked yet */
  VERP_NO_MESSAGE = 4, /* the radio has brought nothing more */
  VERP_NOT_SENT = 5,   /* too many messages wait for the air already */
  VERP_BAD_ARGUMENT =
      -1,               /* null, a wrong size, no such name, out of range, too early or too late */
  VERP_BAD_HANDLE = -2, /* closed, or never one */
  VERP_BUSY = -3,       /* another thread is using the handle, or a callback of it */
  VERP_BAD_FILE = -4,   /* a robot, world or trace that cannot be read, or written */
  VERP_CALLBACK_FAILED = -5, /* the controller gave another number than 0, or threw */
  VERP_FAILED = -6           /* anything else */
} verp_status;

enum { VERP_MAX_JOINTS = 32, VERP_LEG_JOINTS = 6, VERP_POSE = 12, VERP_NAME = 64, VERP_TEXT = 256 };

/* A world and the robots in it. */
typedef struct verp_session_handle* verp_session;
/* The controller of one robot, without a world. */
typedef struct verp_core_handle* verp_core;

/* ---- about the library ---- */

/* Of this header: a library of another first number has another ABI. */
enum { VERP_ABI = 0 };
/* The ABI of the library that is loaded. */
uint32_t verp_abi(void);
/* The revision of its sources. Never changes. */
const char* verp_version(void);
/* What went wrong in the last call of this thread that failed, or "". Valid until this thread's
 * next call that fails. */
const char* verp_last_error(void);
/* The bytes of "inputs", "outputs", "state" or "params", a line a field: offset, type, name; null:
 * no such struct. Never changes. */
const char* verp_layout(const char* name);

/* ---- what crosses the controller's border ---- */

/* Bits of verp_inputs.flags. */
enum {
  VERP_IMU_FRESH = 1,
  VERP_FEET_FRESH = 2,
  VERP_SLOW_FRESH = 4,
  VERP_OVERRUN = 8,
  VERP_EMERGENCY_STOP = 16,
  VERP_COMMAND_FRESH = 32,
  VERP_PARAMETER_WRITE = 64
};

typedef enum verp_request {
  VERP_RELAX = 0,
  VERP_STAND = 1,
  VERP_WALK = 2,
  VERP_GET_UP = 3
} verp_request;

/* The operator's standing order, body frame, in the wire's units. */
typedef struct verp_command {
  uint8_t request; /* verp_request */
  uint8_t sequence;
  int16_t vx_tenth_mm_s;
  int16_t vy_tenth_mm_s;
  int16_t wz_mrad_s;
  int16_t head_pan_mrad;
  int16_t head_tilt_mrad;
} verp_command;

/* All that the controller is told in one tick, as counts (common/io/io.hpp). */
typedef struct verp_inputs {
  uint32_t tick;  /* counts control periods */
  uint32_t fresh; /* bit j: position_count[j] was read in this tick */
  uint16_t flags;
  uint16_t parameter_id;
  uint32_t parameter_bits;
  verp_command command;
  int16_t gyro_count[3];
  int16_t accel_count[3];
  uint16_t foot_count[2][4]; /* front-left, front-right, back-left, back-right of each sole */
  uint8_t slow_joint;
  uint8_t slow_temperature_c;
  uint8_t slow_error;
  uint8_t reserved;
  uint16_t slow_voltage_tenth_v;
  uint16_t mailbox;
  int32_t position_count[32];
} verp_inputs;

/* All that the controller wants done. */
typedef struct verp_outputs {
  uint32_t torque_enable; /* bit j: servo j holds its goal */
  uint32_t faults;        /* common/safety */
  uint8_t mode;
  uint8_t gait_phase; /* 0 idle, 1 start, 2 transition, 3 final */
  uint8_t gait_state; /* 0 to 15, within the cycle */
  uint8_t stance;     /* foot that carries; 2: both */
  int16_t tilt_tenth_mrad[2];
  int32_t goal_count[32];
} verp_outputs;

/* What really happens in the world. The controller never sees it. */
typedef struct verp_truth {
  double body_m[3];
  double body_quaternion[4];
  double body_rpy_rad[3]; /* roll, pitch, yaw */
  double body_m_s[3];
  double body_rad_s[3];
  double com_m[3];
  double com_m_s[3];
  double zmp_m[2]; /* on the floor; valid only while a foot carries */
  double foot_n[2];
  double sole_m[2][3];
  double joint_rad[32];
  double joint_rad_s[32];
  double torque_n_m[32];
  uint32_t zmp_valid;
  uint32_t held;   /* still in the cradle that holds it until its servos do */
  uint32_t fallen; /* once, and for good */
  uint32_t joints;
} verp_truth;

/* One tick of one robot. */
typedef struct verp_tick {
  uint32_t size;
  uint32_t robot;
  double time_s;   /* simulated */
  double gone_s;   /* of the walk that was asked for */
  uint64_t digest; /* of this tick and all before it */
  verp_inputs inputs;
  verp_outputs outputs;
  float joint_rad[32]; /* as the controller read them */
  float goal_rad[32];
  verp_truth truth;
} verp_tick;

/* ---- worlds and robots ---- */

typedef struct verp_world {
  uint32_t size;
  uint32_t physics_step_us; /* 0: 1000 */
  const char* file;         /* a world of common/worlds, or an SDF file; null: a level floor */
} verp_world;

enum { VERP_OPEN_END = 1 /* neither its length nor a fall ends the run */ };

/* A robot and its walk, as `verp walk` has it. verp_robot_defaults() fills it in. */
typedef struct verp_robot {
  uint32_t size;
  uint32_t flags;
  const char* model;  /* a robot of common/robots, or an SDF file */
  const char* bus;    /* of its buses; null: the first */
  const char* name;   /* among others; null: the model's */
  const char* tuning; /* "gait.lift_m=0.012 balance.zeros_enable=0", or null */
  const char* record; /* a trace to be written (.mcap), or null */
  uint64_t seed;
  double
      walk_s; /* of gait; 0: it obeys verp_session_command() alone, and the run has an open end */
  double vx_m_s; /* body frame */
  double vy_m_s;
  double wz_rad_s;
  double x_m; /* where it stands at the start, world frame */
  double y_m;
  double yaw_rad;
} verp_robot;

/* How a walk went. */
typedef struct verp_result {
  uint32_t size;
  uint32_t fallen;
  uint64_t ticks;
  uint64_t digest;
  double simulated_s;
  double walk_s;
  double distance_m;
  double ahead_m;
  double aside_m; /* to the left */
  double turned_rad;
  double speed_m_s;   /* mean; 0: it did not walk */
  double zmp_bias_mm; /* mean; 0: not measured */
  uint32_t faults;
  uint32_t reserved;
  char failure[256]; /* why the walk is no good; empty: it is */
  char remark[256];
} verp_result;

/* A number of the physics. */
typedef struct verp_quantity {
  uint32_t size;
  uint32_t settable;
  double low; /* of what it may be set to */
  double high;
  char name[64];
  char unit[64];
  char what[256];
} verp_quantity;

/* `world` null: a level floor. */
int verp_session_open(const verp_world* world, verp_session* session);
/* Ends the run; a trace that is being written becomes whole. The handle is closed also if that
 * fails. */
int verp_session_close(verp_session session);

/* generic21 with seed 1, 20 s of 4 cm steps, as `verp walk` has it. */
int verp_robot_defaults(verp_robot* robot);
/* Before the first tick, and at least 0.1 m from every other robot. `robot` may be null; it counts
 * from 0. */
int verp_session_add(verp_session session, const verp_robot* what, uint32_t* robot);

/* At most so many ticks, each of one robot: `robot` had the last one, `done` were done. VERP_OVER:
 * the run has ended. Both may be null. */
int verp_session_tick(verp_session session, uint32_t count, uint32_t* robot, uint32_t* done);
/* Writes each tick of the robot there from now on, until null is given: that memory outlives the
 * session, or this. */
int verp_session_view(verp_session session, uint32_t robot, verp_tick* tick);
/* The controller's State after the last tick, of so many bytes: verp_layout("state"). */
int verp_session_state(verp_session session, uint32_t robot, void* state, uint64_t size);
/* Of all ticks of the robot so far; 0 before the first. */
int verp_session_digest(verp_session session, uint32_t robot, uint64_t* digest);
/* Ends the run of all robots; traces become whole. */
int verp_session_result(verp_session session, uint32_t robot, verp_result* result);

/* From now on the caller has the robot: velocity in its body frame, head to the left and down. The
 * robot takes it as any order, through its registers. */
int verp_session_command(verp_session session, uint32_t robot, uint32_t request, double vx_m_s,
                         double vy_m_s, double wz_rad_s, double pan_rad, double tilt_rad);
/* The walk that was asked for goes on. */
int verp_session_give_back(verp_session session, uint32_t robot);
/* While it is pressed the robot is limp. */
int verp_session_emergency_stop(verp_session session, uint32_t robot, int32_t pressed);
/* A number of the tuning (`verp parameters`), as an order: in force one of the next ticks. */
int verp_session_tune(verp_session session, uint32_t robot, const char* name, double value);
/* As it is in force. */
int verp_session_tuning(verp_session session, uint32_t robot, const char* name, double* value);

/* How many numbers the physics has by name, once all robots were added. */
int verp_session_quantities(verp_session session, uint32_t* count);
/* What one of them is; `index` counts from 0. */
int verp_session_quantity(verp_session session, uint32_t index, verp_quantity* quantity);
/* Its value now, in the unit that verp_quantity has. */
int verp_session_read(verp_session session, const char* quantity, double* value);
/* From the next physics step on; it is kept in the trace of robot 0. */
int verp_session_set(verp_session session, const char* quantity, double value);
/* Pushes a link or an object at its centre of mass, N in the world's axes. */
int verp_session_push(verp_session session, const char* thing, double fx_n, double fy_n,
                      double fz_n, double for_s);

/* One tick, inside a controller. `outputs` holds those of the tick before; what stands there
 * afterwards is sent. */
typedef struct verp_moment {
  uint32_t size;
  uint32_t robot;
  uint64_t token; /* for verp_decide() */
  const verp_inputs* inputs;
  verp_outputs* outputs;
} verp_moment;
/* 0: done; any other number ends the run with VERP_CALLBACK_FAILED. The pointers are good until it
 * returns. */
typedef int (*verp_controller)(const verp_moment* moment, void* user);
/* In place of the robot's own controller, from the next tick on; null: its own again. A tick's
 * digest is the own controller's if verp_decide() was called in it, whatever the goals became; else
 * it covers inputs and outputs. */
int verp_session_control(verp_session session, uint32_t robot, verp_controller controller,
                         void* user);
/* Has the robot's own controller decide this moment, once: the controller may then change what it
 * put out. From the thread of the controller: another one gets VERP_BUSY. */
int verp_decide(uint64_t token);

/* ---- what robots see, and pictures of the world ---- */

/* What a picture holds: of each pixel, in rows from the top. Bits of verp_camera.gives. */
enum {
  VERP_COLOUR = 1, /* three bytes: red, green, blue */
  VERP_DEPTH = 2,  /* uint16_t: along the camera's axis, mm; 0: nothing between its planes */
  VERP_LABELS = 4  /* uint16_t: a number a link, then one a thing of the world; 0: the floor, or
                      nothing */
};

/* A camera of a robot's file. */
typedef struct verp_camera {
  uint32_t size;
  uint32_t gives; /* VERP_COLOUR and the like */
  uint32_t width; /* pixels */
  uint32_t height;
  double rate_hz; /* it looks so often, at whole periods of simulated time */
  double fx_px;   /* its lens: where a thing at x (right), y (down), z (ahead) is seen, */
  double fy_px;   /* without distortion: fx x / z + cx, fy y / z + cy, the middle of the */
  double cx_px;   /* first pixel being 0 */
  double cy_px;
  double distortion[5]; /* k1, k2, p1, p2, k3 of Brown and Conrady ("plumb_bob") */
  double near_m;
  double far_m;
  double pose[12]; /* in its link, as verp_core_forward() has poses; x ahead, y left, z up */
  uint32_t link;   /* of verp_core_forward()'s */
  uint32_t reserved;
  char name[64];
} verp_camera;

enum { VERP_PLAIN = 1 /* without shadows and smoothed edges, which take most of the time */ };
enum { VERP_MOST_PIXELS = 8192 /* of a view's width, and of its height */ };

/* From where the world is looked at. */
typedef struct verp_view {
  uint32_t size;
  uint32_t flags; /* VERP_PLAIN */
  uint32_t width; /* 16 to VERP_MOST_PIXELS */
  uint32_t height;
  const char* name; /* front, side, three-quarter, back, top, follow, head, or a camera that a file
                       declares; null: from eye_m to target_m */
  uint32_t robot;   /* whose front and so on */
  uint32_t reserved;
  double eye_m[3];
  double target_m[3];
  double fov_rad; /* of the height; 0: 0.5; of what has a name: its own */
} verp_view;

/* How many cameras the robot has. */
int verp_session_cameras(verp_session session, uint32_t robot, uint32_t* count);
/* What one of them is; `index` counts from 0. */
int verp_session_camera(verp_session session, uint32_t robot, uint32_t index, verp_camera* camera);
/* What that camera saw when it last looked, up to the robot's last tick: `size` bytes of
 * VERP_COLOUR or what else it gives, and when, as verp_tick.time_s; that may be null.
 * VERP_NO_PICTURE: it has not looked yet. It is drawn when it is asked for, by a program beside
 * this one that the first call starts and VERP_CAMERA_PROGRAM may name; nothing of it reaches the
 * run. */
int verp_session_picture(verp_session session, uint32_t robot, uint32_t camera, uint32_t what,
                         void* picture, uint64_t size, double* time_s);
/* The world as it is now, drawn likewise: VERP_COLOUR, so of 3 width height bytes. */
int verp_session_render(verp_session session, const verp_view* view, void* picture, uint64_t size);

/* ---- what robots say to each other ---- */

/* What a robot's modem and the air do to messages (host/twin/radio). verp_radio_defaults() fills it
 * in: an IEEE 802.15.4 modem, 250 kbit/s, in a hall. */
typedef struct verp_radio {
  uint32_t size;
  uint32_t most_bytes;     /* of a message; a longer one is refused */
  uint32_t most_waiting;   /* messages of one robot */
  uint32_t overhead_bytes; /* that every message has besides its own */
  uint64_t seed;           /* of what is lost and when: equal runs are equal */
  double range_m;          /* nothing is heard beyond */
  double loss;             /* share of messages lost beside the sender; all are at range_m */
  double fade;             /* share of the time in which two robots hear nothing of each other, */
  double fade_s;           /* at a stretch */
  double delay_s;          /* until a message could be on the air, */
  double jitter_s;         /* and at most so much more */
  double bytes_s;          /* on the air, which all within range_m share */
} verp_radio;

enum { VERP_EVERYBODY = -1 };

/* Fills it in. */
int verp_radio_defaults(verp_radio* radio);
/* Each robot of the session has a radio: before the first tick, once. It hears from the middle of
 * its body, and sends nothing by itself. */
int verp_session_radio(verp_session session, const verp_radio* radio);
/* A message of `size` bytes from a robot to another one, or VERP_EVERYBODY, after the first tick.
 * Nothing acknowledges it. It stands in the traces of who says and who hears it, at /radio.
 * VERP_NOT_SENT: most_waiting. Between ticks, or inside a controller of this session: then it
 * leaves in the tick that is being decided. */
int verp_session_send(verp_session session, uint32_t robot, int32_t to, const void* data,
                      uint64_t size);
/* The next message that the robot heard up to its last tick (a controller: the one before), of
 * `size` bytes into `room`, and from whom. VERP_NO_MESSAGE: no further one. Of 256 that nobody
 * took, the oldest is lost. */
int verp_session_take(verp_session session, uint32_t robot, void* data, uint64_t room,
                      uint64_t* size, uint32_t* from);

/* Runs the controller once more over what a trace says that it saw. VERP_DIFFERS: verp_last_error()
 * says where. `ticks` and `digest` may be null. */
int verp_replay(const char* file, uint64_t* ticks, uint64_t* digest);

/* ---- the controller alone, bit for bit ---- */

/* `bus` null: the robot's first. `tuning` as in verp_robot. */
int verp_core_open(const char* model, const char* bus, const char* tuning, verp_core* core);
/* The handle is closed, and known as such. */
int verp_core_close(verp_core core);
/* As it is when power comes on. */
int verp_core_reset(verp_core core);
/* One control tick. */
int verp_core_step(verp_core core, const verp_inputs* inputs, verp_outputs* outputs);
/* Of all ticks since it was opened or reset. */
int verp_core_digest(verp_core core, uint64_t* digest);
/* All that the last tick leaves for the next, of so many bytes: verp_layout("state"). */
int verp_core_state(verp_core core, void* state, uint64_t size);
/* The robot as constants, of so many bytes: verp_layout("params"). */
int verp_core_params(verp_core core, void* params, uint64_t size);
/* How many joints it has. */
int verp_core_joints(verp_core core, uint32_t* joints);
/* The control period, s. */
int verp_core_period(verp_core core, double* period_s);
/* Into `name`, of so many bytes. */
int verp_core_joint_name(verp_core core, uint32_t joint, char* name, uint64_t size);
/* The counts at which a servo has its joint at a (finite) angle. */
int verp_core_count(verp_core core, uint32_t joint, float angle_rad, int32_t* count);
/* The angle of a joint whose servo is at these counts. */
int verp_core_angle(verp_core core, uint32_t joint, int32_t count, float* angle_rad);

/* Forward kinematics: of `joints` finite angles, joints + 1 poses of 12 numbers, rotation then
 * position, body frame; the first is the body's own. */
int verp_core_forward(verp_core core, const float* angle_rad, uint32_t joints, float* poses);
/* Centre of mass, body frame. */
int verp_core_com(verp_core core, const float* angle_rad, uint32_t joints, float* com_m);
/* Six angles, hip to ankle, that put the sole of a leg to a pose (12 numbers, body frame);
 * `before_rad` (six angles, or null) is where a solver that iterates starts. All of them finite,
 * and the pose's rotation R is one: no element of R R^T - 1 is beyond 0.001, and its determinant is
 * not negative. `flags`: 1 out of reach, 2 a joint at its limit, 4 not converged. */
int verp_core_leg_ik(verp_core core, uint32_t side, const float* sole, const float* before_rad,
                     float* angle_rad, uint32_t* flags);
/* Which joints those are. */
int verp_core_leg_joints(verp_core core, uint32_t side, uint32_t* joint);

/* One tick of a walk as planned. Walk frame: as the body's at the start, z up, the floor at 0; it
 * moves on once a step. */
typedef struct verp_plan {
  float body[12];
  float sole[2][12]; /* body frame */
  float zmp_m[2];
  float carry[2];    /* share of the weight on each foot */
  float leg_rad[12]; /* left hip to ankle, right hip to ankle */
  uint8_t phase;
  uint8_t state;
  uint8_t swing; /* foot in the air; 2: none */
  uint8_t flags; /* of both legs' inverse kinematics */
} verp_plan;
enum { VERP_MOST_PLANNED = 1000000 /* ticks: over two hours of 8 ms */ };
/* The gait from standing, `count` ticks (at most VERP_MOST_PLANNED) of a walk with that velocity,
 * of which the last `stop` are after it was asked to stop: planned by the gait alone, without
 * physics. */
int verp_core_plan(verp_core core, double vx_m_s, double vy_m_s, double wz_rad_s, verp_plan* plan,
                   uint32_t count, uint32_t stop);

#ifdef __GNUC__
#pragma GCC visibility pop
#endif
#ifdef __cplusplus
}
#endif
#endif
