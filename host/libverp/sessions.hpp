#pragma once
#include "host/libverp/handles.hpp"
#include "host/libverp/run.hpp"

namespace verp::abi {

/// All that are open.
Handles<Run>& sessions();

}  // namespace verp::abi
