#pragma once

/// What a message definition with a header carries of it: a macro, as only literals join to one
/// text at compile time. Private to this folder.
#define VERP_ROS_HEADER                                                                \
  "================================================================================\n" \
  "MSG: std_msgs/Header\n"                                                             \
  "builtin_interfaces/Time stamp\n"                                                    \
  "string frame_id\n"                                                                  \
  "================================================================================\n" \
  "MSG: builtin_interfaces/Time\n"                                                     \
  "int32 sec\n"                                                                        \
  "uint32 nanosec\n"
