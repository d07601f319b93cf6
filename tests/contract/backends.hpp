#pragma once

#ifdef VERP_CAN_SOCKETS
#include "tests/contract/fakes.hpp"
#include "tests/contract/pc/can_sockets.hpp"
#elif defined(__linux__)
#include "tests/contract/pc/backends.hpp"
#else
#include "tests/contract/emulated/backends.hpp"
#endif
