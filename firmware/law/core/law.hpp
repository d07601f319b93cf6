#pragma once
#include "firmware/app/app.hpp"

namespace verp::app {
using Law = Core;
}
