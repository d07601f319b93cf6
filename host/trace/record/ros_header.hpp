#pragma once

/// Header of a message schema. A macro: only literals join at compile time. Private to this folder.
#define VERP_ROS_HEADER                                                                \
  "================================================================================\n" \
  "MSG: std_msgs/Header\n"                                                             \
  "builtin_interfaces/Time stamp\n"                                                    \
  "string frame_id\n"                                                                  \
  "================================================================================\n" \
  "MSG: builtin_interfaces/Time\n"                                                     \
  "int32 sec\n"                                                                        \
  "uint32 nanosec\n"
