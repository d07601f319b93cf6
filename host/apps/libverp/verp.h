/* VERP as a library: runs robots in a simulated world, one control tick at a time, and gives access
 * to the controller's own algorithms.
 *
 * Functions that return int return a verp_status. verp_last_error() describes the failure in one
 * line that names the call. No exception leaves the library, whatever a callback throws.
 *
 * Handles are numbers that the library never reuses, so it recognises a closed handle. One thread
 * may use a handle at a time; a second one gets VERP_BUSY. Different threads may use different
 * handles at the same time; equal calls then give equal bits. A callback runs inside
 * verp_session_tick(), on its thread and stack. Inside it, calls with that session's handle return
 * VERP_BUSY, except verp_session_send() and verp_session_take(); other calls work. In a forked
 * process the parent's handles are VERP_BAD_HANDLE; the child opens its own, and its exit leaves
 * the parent's intact.
 *
 * Structs begin with `size`, which the caller sets to sizeof; the library refuses any other size.
 * The caller owns the memory that it passes. The library returns no pointers to its own memory
 * except constant strings.
 *
 * SI units. World frame: z up, the floor at 0. Body frame: origin at the trunk's centre, x forward,
 * y left, z up. Index 0 is left, 1 is right. Rotations are row-major matrices, or quaternions x, y,
 * z, w.
 *
 * Other languages parse this file (README.md), so declarations contain no macros.
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
  VERP_OVER = 1,          /* the run has ended: no further tick */
  VERP_DIFFERS = 2,       /* a replayed trace gave other bits */
  VERP_NO_PICTURE = 3,    /* the camera has not taken a picture yet */
  VERP_NO_MESSAGE = 4,    /* no further message was received */
  VERP_NOT_SENT = 5,      /* too many messages wait to be sent */
  VERP_BAD_ARGUMENT = -1, /* null, wrong size, unknown name, out of range, too early or too late */
  VERP_BAD_HANDLE = -2,   /* closed, or never opened */
  VERP_BUSY = -3,         /* in use by another thread, or called from its own callback */
  VERP_BAD_FILE = -4,     /* a robot, world or trace cannot be read or written */
  VERP_CALLBACK_FAILED = -5, /* the controller returned nonzero, or threw */
  VERP_FAILED = -6           /* any other failure */
} verp_status;

enum { VERP_MAX_JOINTS = 32, VERP_LEG_JOINTS = 6, VERP_POSE = 12, VERP_NAME = 64, VERP_TEXT = 256 };

/* A world and the robots in it. */
typedef struct verp_session_handle* verp_session;
/* The controller of one robot, without a world. */
typedef struct verp_core_handle* verp_core;

/* ---- about the library ---- */

/* ABI of this header. Libraries with another ABI number are not compatible. */
enum { VERP_ABI = 0 };
/* ABI of the loaded library. */
uint32_t verp_abi(void);
/* Revision of the library's sources. The string is constant. */
const char* verp_version(void);
/* The error of this thread's last failed call, or "". Valid until its next failed call. */
const char* verp_last_error(void);
/* Layout of "inputs", "outputs", "state" or "params", one line per field: offset, type, name. Null:
 * there is no such struct. The string is constant. */
const char* verp_layout(const char* name);

/* ---- the controller's inputs and outputs ---- */

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

/* The operator's standing order, body frame, in the units of the wire. */
typedef struct verp_command {
  uint8_t request; /* verp_request */
  uint8_t sequence;
  int16_t vx_tenth_mm_s;
  int16_t vy_tenth_mm_s;
  int16_t wz_mrad_s;
  int16_t head_pan_mrad;
  int16_t head_tilt_mrad;
} verp_command;

/* All inputs of the controller in one tick, as counts (common/io/io.hpp). */
typedef struct verp_inputs {
  uint32_t tick;  /* number of the control period */
  uint32_t fresh; /* bit j: position_count[j] was read in this tick */
  uint16_t flags;
  uint16_t parameter_id;
  uint32_t parameter_bits;
  verp_command command;
  int16_t gyro_count[3];
  int16_t accel_count[3];
  uint16_t foot_count[2][4]; /* of each sole: front-left, front-right, back-left, back-right */
  uint8_t slow_joint;
  uint8_t slow_temperature_c;
  uint8_t slow_error;
  uint8_t reserved;
  uint16_t slow_voltage_tenth_v;
  uint16_t mailbox;
  int32_t position_count[32];
} verp_inputs;

/* All outputs of the controller in one tick. */
typedef struct verp_outputs {
  uint32_t torque_enable; /* bit j: servo j holds its goal */
  uint32_t faults;        /* common/safety */
  uint8_t mode;
  uint8_t gait_phase; /* 0 idle, 1 start, 2 transition, 3 final */
  uint8_t gait_state; /* 0 to 15, within the cycle */
  uint8_t stance;     /* supporting foot; 2: both */
  int16_t tilt_tenth_mrad[2];
  int32_t goal_count[32];
} verp_outputs;

/* True state of the robot in the world. The controller never sees it. */
typedef struct verp_truth {
  double body_m[3];
  double body_quaternion[4];
  double body_rpy_rad[3]; /* roll, pitch, yaw */
  double body_m_s[3];
  double body_rad_s[3];
  double com_m[3];
  double com_m_s[3];
  double zmp_m[2]; /* on the floor; valid only if zmp_valid */
  double foot_n[2];
  double sole_m[2][3];
  double joint_rad[32];
  double joint_rad_s[32];
  double torque_n_m[32];
  uint32_t zmp_valid;
  uint32_t held;   /* the cradle still holds the robot, until its servos do */
  uint32_t fallen; /* stays set after a fall */
  uint32_t joints;
} verp_truth;

/* One tick of one robot. */
typedef struct verp_tick {
  uint32_t size;
  uint32_t robot;
  double time_s;   /* simulated */
  double gone_s;   /* elapsed time of the requested walk */
  uint64_t digest; /* of all ticks up to this one */
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

enum { VERP_OPEN_END = 1 /* the run ends neither at its length nor at a fall */ };

/* A robot and its walk, as in `verp walk`. verp_robot_defaults() fills it in. */
typedef struct verp_robot {
  uint32_t size;
  uint32_t flags;
  const char* model;  /* a robot of common/robots, or an SDF file */
  const char* bus;    /* one of the robot's buses; null: the first */
  const char* name;   /* unique among the robots; null: the model's name */
  const char* tuning; /* "gait.lift_m=0.012 balance.zeros_enable=0", or null */
  const char* record; /* trace file to write (.mcap), or null */
  uint64_t seed;
  double walk_s; /* of gait; 0: the robot obeys verp_session_command() alone, and the run has an
                    open end */
  double vx_m_s; /* velocity, body frame */
  double vy_m_s;
  double wz_rad_s;
  double x_m; /* start position, world frame */
  double y_m;
  double yaw_rad;
} verp_robot;

/* Result of a walk. */
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
  double speed_m_s;   /* mean; 0: the robot did not walk */
  double zmp_bias_mm; /* mean; 0: not measured */
  uint32_t faults;
  uint32_t reserved;
  char failure[256]; /* why the walk failed; empty: it did not */
  char remark[256];
} verp_result;

/* A quantity of the physics. */
typedef struct verp_quantity {
  uint32_t size;
  uint32_t settable;
  double low; /* range of values that may be set */
  double high;
  char name[64];
  char unit[64];
  char what[256];
} verp_quantity;

/* Opens a session. `world` null: a level floor. */
int verp_session_open(const verp_world* world, verp_session* session);
/* Ends the run, completes its traces and closes the handle. The handle is closed even if a trace
 * fails. */
int verp_session_close(verp_session session);

/* The robot of `verp walk`: generic21, seed 1, 20 s of 4 cm steps. */
int verp_robot_defaults(verp_robot* robot);
/* Adds a robot, before the first tick and at least 0.1 m from all others. `robot` receives its
 * index, from 0, and may be null. */
int verp_session_add(verp_session session, const verp_robot* what, uint32_t* robot);

/* Runs at most `count` ticks, each of one robot. `robot` receives the robot of the last tick,
 * `done` the number of ticks; both may be null. VERP_OVER: the run has ended. */
int verp_session_tick(verp_session session, uint32_t count, uint32_t* robot, uint32_t* done);
/* Makes the library write each tick of the robot to `tick`; null stops it. That memory must stay
 * valid until then or until the session is closed. */
int verp_session_view(verp_session session, uint32_t robot, verp_tick* tick);
/* The controller's State after the last tick. `size` is that of verp_layout("state"). */
int verp_session_state(verp_session session, uint32_t robot, void* state, uint64_t size);
/* Digest of all ticks of the robot so far; 0 before the first. */
int verp_session_digest(verp_session session, uint32_t robot, uint64_t* digest);
/* Ends the runs of all robots and completes their traces; returns the robot's result. */
int verp_session_result(verp_session session, uint32_t robot, verp_result* result);

/* Takes control of the robot: velocity in its body frame, head angles positive to the left and
 * down. The order passes through the robot's registers, like any other. Relaxed, the robot lies
 * down by its action lie_down before torque goes, if it has that action. With walk_s = 0 it also
 * has its other actions, and gets up when ordered. */
int verp_session_command(verp_session session, uint32_t robot, uint32_t request, double vx_m_s,
                         double vy_m_s, double wz_rad_s, double pan_rad, double tilt_rad);
/* Ends the caller's control; the requested walk continues. */
int verp_session_give_back(verp_session session, uint32_t robot);
/* While pressed, the robot is limp. */
int verp_session_emergency_stop(verp_session session, uint32_t robot, int32_t pressed);
/* Sets a tuning value (`verp parameters`) by an order; it takes effect in one of the next ticks. */
int verp_session_tune(verp_session session, uint32_t robot, const char* name, double value);
/* The tuning value in force. */
int verp_session_tuning(verp_session session, uint32_t robot, const char* name, double* value);

/* Number of named physics quantities, after all robots were added. */
int verp_session_quantities(verp_session session, uint32_t* count);
/* Describes one quantity; `index` counts from 0. */
int verp_session_quantity(verp_session session, uint32_t index, verp_quantity* quantity);
/* Current value of a quantity, in the unit of its verp_quantity. */
int verp_session_read(verp_session session, const char* quantity, double* value);
/* Sets a quantity from the next physics step on. The trace of robot 0 records it. */
int verp_session_set(verp_session session, const char* quantity, double value);
/* Pushes a link or object at its centre of mass for `for_s`; force in N, world axes. */
int verp_session_push(verp_session session, const char* thing, double fx_n, double fy_n,
                      double fz_n, double for_s);

/* One tick, passed to a controller. `outputs` holds those of the previous tick. What the controller
 * leaves there passes the robot's own safety table: its goals count while the robot stands or
 * walks, no faster than the joints may move, and it may only take torque away. A goal outside its
 * joint's range is not sent: the joint keeps the goal before. */
typedef struct verp_moment {
  uint32_t size;
  uint32_t robot;
  uint64_t token; /* for verp_decide() */
  const verp_inputs* inputs;
  verp_outputs* outputs;
} verp_moment;
/* A user's controller. Returns 0 for success; any other value ends the run with
 * VERP_CALLBACK_FAILED. The pointers are valid until it returns. */
typedef int (*verp_controller)(const verp_moment* moment, void* user);
/* Replaces the robot's own controller from the next tick on; null restores it. If the callback
 * calls verp_decide(), the tick's digest is the own controller's, even if the goals were changed.
 * Otherwise the digest also covers the outputs that were sent. */
int verp_session_control(verp_session session, uint32_t robot, verp_controller controller,
                         void* user);
/* Runs the robot's own controller for this moment, once; the callback may then change the outputs.
 * Call it on the callback's thread; other threads get VERP_BUSY. */
int verp_decide(uint64_t token);

/* ---- what robots see, and pictures of the world ---- */

/* Content of a picture, per pixel, in rows from the top. Bits of verp_camera.gives. */
enum {
  VERP_COLOUR = 1, /* three bytes: red, green, blue */
  VERP_DEPTH = 2,  /* uint16_t, mm along the camera's axis; 0: nothing between near_m and far_m */
  VERP_LABELS = 4  /* uint16_t: links first, then objects of the world; 0: the floor, or nothing */
};

/* A camera of a robot's file. */
typedef struct verp_camera {
  uint32_t size;
  uint32_t gives; /* bits such as VERP_COLOUR */
  uint32_t width; /* pixels */
  uint32_t height;
  double rate_hz; /* pictures per second, at whole periods of simulated time */
  double fx_px;   /* pinhole lens: a point at x (right), y (down), z (ahead) appears at */
  double fy_px;   /* fx x / z + cx, fy y / z + cy before distortion; */
  double cx_px;   /* the middle of the first pixel is 0 */
  double cy_px;
  double distortion[5]; /* k1, k2, p1, p2, k3 of the Brown-Conrady model ("plumb_bob") */
  double near_m;
  double far_m;
  double pose[12]; /* in its link, in the format of verp_core_forward(); x ahead, y left, z up */
  uint32_t link;   /* index as in verp_core_forward() */
  uint32_t reserved;
  char name[64];
} verp_camera;

enum { VERP_PLAIN = 1 /* without shadows and antialiasing, which take most of the time */ };
enum { VERP_MOST_PIXELS = 8192 /* limit of a view's width and height */ };

/* A viewpoint on the world. */
typedef struct verp_view {
  uint32_t size;
  uint32_t flags; /* VERP_PLAIN */
  uint32_t width; /* 16 to VERP_MOST_PIXELS */
  uint32_t height;
  const char* name; /* front, side, three-quarter, back, top, follow, head, or a camera that a file
                       declares; null: from eye_m to target_m */
  uint32_t robot;   /* the robot that a named view follows */
  uint32_t reserved;
  double eye_m[3];
  double target_m[3];
  double fov_rad; /* vertical; 0: 0.5; a named view has its own */
} verp_view;

/* Number of the robot's cameras. */
int verp_session_cameras(verp_session session, uint32_t robot, uint32_t* count);
/* Describes one camera; `index` counts from 0. */
int verp_session_camera(verp_session session, uint32_t robot, uint32_t index, verp_camera* camera);
/* A camera's last picture, up to the robot's last tick: `size` bytes of VERP_COLOUR or another
 * content in verp_camera.gives. `time_s` receives its time as in verp_tick.time_s, and may be null.
 * VERP_NO_PICTURE: the camera has not taken one yet. The library draws a picture on request, in a
 * separate program that the first call starts (VERP_CAMERA_PROGRAM may name it); drawing does not
 * affect the run. */
int verp_session_picture(verp_session session, uint32_t robot, uint32_t camera, uint32_t what,
                         void* picture, uint64_t size, double* time_s);
/* Draws the world as it is now: VERP_COLOUR, so 3 width height bytes. */
int verp_session_render(verp_session session, const verp_view* view, void* picture, uint64_t size);

/* ---- what robots say to each other ---- */

/* Radio modem and channel of the robots (host/twin/radio). verp_radio_defaults() fills it in: an
 * IEEE 802.15.4 modem, 250 kbit/s, in a hall. */
typedef struct verp_radio {
  uint32_t size;
  uint32_t most_bytes;     /* per message; longer ones are refused */
  uint32_t most_waiting;   /* messages of one robot */
  uint32_t overhead_bytes; /* added to every message */
  uint64_t seed;           /* of the losses; equal runs are equal */
  double range_m;          /* no reception beyond */
  double loss;     /* share of messages lost next to the sender; it grows to all at range_m */
  double fade;     /* share of the time in which two robots receive nothing from each other, */
  double fade_s;   /* in stretches of this length */
  double delay_s;  /* from sending until the message can be on the air, */
  double jitter_s; /* plus up to this much */
  double bytes_s;  /* capacity of the air, shared by all within range_m */
} verp_radio;

enum { VERP_EVERYBODY = -1 };

/* The modem described at verp_radio. */
int verp_radio_defaults(verp_radio* radio);
/* Gives each robot of the session a radio, once, before the first tick. The antenna is in the
 * middle of the body. The radio sends nothing by itself. */
int verp_session_radio(verp_session session, const verp_radio* radio);
/* Sends `size` bytes from a robot to another one or to VERP_EVERYBODY, after the first tick. There
 * is no acknowledgement. The traces of sender and receivers record it at /radio. VERP_NOT_SENT:
 * most_waiting messages wait. Call it between ticks, or inside a controller of this session; the
 * message then leaves in the current tick. */
int verp_session_send(verp_session session, uint32_t robot, int32_t to, const void* data,
                      uint64_t size);
/* Takes the next message that the robot received up to its last tick (in a controller: the previous
 * tick). `room` is the capacity of `data`; `size` and `from` receive the length and the sender.
 * VERP_NO_MESSAGE: there is no further one. The queue holds 256 messages; a further one removes the
 * oldest. */
int verp_session_take(verp_session session, uint32_t robot, void* data, uint64_t room,
                      uint64_t* size, uint32_t* from);

/* Runs the controller again on the inputs of a trace. VERP_DIFFERS: verp_last_error() says where.
 * `ticks` and `digest` may be null. */
int verp_replay(const char* file, uint64_t* ticks, uint64_t* digest);

/* ---- the controller alone, bit for bit ---- */

/* Opens a controller. `bus` null: the robot's first. `tuning` as in verp_robot. */
int verp_core_open(const char* model, const char* bus, const char* tuning, verp_core* core);
/* Closes the handle. */
int verp_core_close(verp_core core);
/* Returns to the state at power-on. */
int verp_core_reset(verp_core core);
/* Runs one control tick. */
int verp_core_step(verp_core core, const verp_inputs* inputs, verp_outputs* outputs);
/* Digest of all ticks since the core was opened or reset. */
int verp_core_digest(verp_core core, uint64_t* digest);
/* State that the last tick leaves for the next. `size` is that of verp_layout("state"). */
int verp_core_state(verp_core core, void* state, uint64_t size);
/* The robot's constants. `size` is that of verp_layout("params"). */
int verp_core_params(verp_core core, void* params, uint64_t size);
/* Number of joints. */
int verp_core_joints(verp_core core, uint32_t* joints);
/* Control period, s. */
int verp_core_period(verp_core core, double* period_s);
/* Name of a joint; `size` is the capacity of `name`. */
int verp_core_joint_name(verp_core core, uint32_t joint, char* name, uint64_t size);
/* Servo count for a joint angle, which must be finite. */
int verp_core_count(verp_core core, uint32_t joint, float angle_rad, int32_t* count);
/* Joint angle for a servo count. */
int verp_core_angle(verp_core core, uint32_t joint, int32_t count, float* angle_rad);

/* Forward kinematics. Takes `joints` finite angles, one per joint. Gives joints + 1 poses of 12
 * numbers, rotation then position, body frame; the first is the body's own. */
int verp_core_forward(verp_core core, const float* angle_rad, uint32_t joints, float* poses);
/* Centre of mass, m, body frame. */
int verp_core_com(verp_core core, const float* angle_rad, uint32_t joints, float* com_m);
/* Inverse kinematics of one leg: six angles, hip to ankle, that bring its sole to a pose (12
 * numbers, body frame). `before_rad` (six angles, or null) is the start of an iterative solver. All
 * numbers must be finite, and the rotation R must be one: no element of R R^T - 1 exceeds 0.001,
 * and its determinant is not negative. `flags`: 1 out of reach, 2 a joint at its limit, 4 not
 * converged. */
int verp_core_leg_ik(verp_core core, uint32_t side, const float* sole, const float* before_rad,
                     float* angle_rad, uint32_t* flags);
/* Joint indices of those six angles; 255: the leg has no such joint, and its angle is 0. */
int verp_core_leg_joints(verp_core core, uint32_t side, uint32_t* joint);

/* One tick of a planned walk. Walk frame: the body's axes at the start, z up, the floor at 0; it
 * moves once per step. */
typedef struct verp_plan {
  float body[12];
  float sole[2][12]; /* body frame */
  float zmp_m[2];
  float carry[2];    /* share of the weight on each foot */
  float leg_rad[12]; /* left hip to ankle, right hip to ankle */
  uint8_t phase;
  uint8_t state;
  uint8_t swing; /* swing foot; 2: none */
  uint8_t flags; /* flags of verp_core_leg_ik(), of both legs */
} verp_plan;
enum { VERP_MOST_PLANNED = 1000000 /* ticks: over two hours of 8 ms */ };
/* Plans `count` ticks (at most VERP_MOST_PLANNED) of a walk from standing with that velocity, of
 * which the last `stop` follow a stop order. Only the gait runs, without physics. */
int verp_core_plan(verp_core core, double vx_m_s, double vy_m_s, double wz_rad_s, verp_plan* plan,
                   uint32_t count, uint32_t stop);

#ifdef __GNUC__
#pragma GCC visibility pop
#endif
#ifdef __cplusplus
}
#endif
#endif
