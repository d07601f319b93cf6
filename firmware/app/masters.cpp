#include "firmware/app/bus_master.hpp"
#include "firmware/app/feetech_master.hpp"

namespace verp::app {

template class RequestMaster<DynamixelWords>;
template class RequestMaster<FeetechWords>;

}  // namespace verp::app
