#pragma once
#include "tests/hil/can_fault_run.hpp"
#include "tests/hil/promises.hpp"

namespace verp::test {

void lost_few(const CanFaultResult& result);
void lost_many(const CanFaultResult& result);
void missed(const CanFaultResult& result);
void doubled(const CanFaultResult& result);
void overtaken(const CanFaultResult& result);
void delayed(const CanFaultResult& result);
void held_back(const CanFaultResult& result);
void everything(const CanFaultResult& result);
void errors(const CanFaultResult& result);
void bus_off(const CanFaultResult& result);
void bus_offs(const CanFaultResult& result);
void reboots(const CanFaultResult& result);
void many_reboot(const CanFaultResult& result);
void all_reboot(const CanFaultResult& result);
void imu_reboots(const CanFaultResult& result);
void foot_reboots(const CanFaultResult& result);
void urgent(const CanFaultResult& result);
void crowd(const CanFaultResult& result);
void flood(const CanFaultResult& result);
void foreign(const CanFaultResult& result);
void unasked(const CanFaultResult& result);
void twin(const CanFaultResult& result);
void foreign_sync(const CanFaultResult& result);
void down(const CanFaultResult& result);

}  // namespace verp::test
