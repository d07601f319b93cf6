#pragma once
#include "controller.hpp"
#include "firmware/law/own_law.hpp"

namespace verp::app {
using Law = OwnLaw<::Controller>;
}
