#pragma once

/// What each suite runs against, where it is built for.
#ifdef __linux__
#include "tests/contract/pc/backends.hpp"
#else
#include "tests/contract/emulated/backends.hpp"
#endif
