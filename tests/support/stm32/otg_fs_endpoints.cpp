#include <algorithm>
#include <string>

#include "tests/support/stm32/machine.hpp"
#include "tests/support/stm32/otg_fs_model.hpp"
#include "tests/support/stm32/registers/otg_fs_table.hpp"

namespace verp::hal::stm32::model {

using namespace otg_fs;

std::string OtgFsModel::named(bool in, unsigned endpoint) const {
  return (in ? "IN endpoint " : "OUT endpoint ") + std::to_string(endpoint);
}

std::uint32_t OtgFsModel::max_packet(unsigned endpoint, bool in) const {
  if (endpoint == 0) return 64u >> (reg(diepctl(0)) & kEpctlMpsiz0);
  return reg(in ? diepctl(endpoint) : doepctl(endpoint)) & kEpctlMpsiz;
}

std::uint32_t OtgFsModel::depth(unsigned endpoint) const {
  return reg(dieptxf(endpoint)) >> kDieptxfDepthShift;
}

bool OtgFsModel::may_write_endpoint(std::uint32_t offset, std::uint32_t raw) {
  for (unsigned e = 0; e < endpoints_; ++e) {
    for (const bool in : {true, false}) {
      const std::uint32_t control = in ? diepctl(e) : doepctl(e);
      const bool enabled = has(control, kEpctlEpena);
      if (offset == (in ? dieptsiz(e) : doeptsiz(e)) && enabled) {
        violate("transfer size of " + named(in, e) + " written while EPENA is set");
        return false;
      }
      const std::uint32_t fixed = kEpctlMpsiz | kEpctlEptyp | (in ? kDiepctlTxfnum : 0);
      if (offset == control && enabled && ((raw ^ reg(control)) & fixed) != 0) {
        violate(named(in, e) + " configured while EPENA is set");
      }
    }
  }
  return true;
}

void OtgFsModel::nak_written(std::uint32_t control, std::uint32_t raw) {
  if ((raw & kEpctlSnak) != 0 && (raw & kEpctlCnak) != 0) violate("SNAK and CNAK at once");
  if ((raw & kEpctlSnak) != 0) set(control, kEpctlNaksts);
  if ((raw & kEpctlCnak) != 0) clear(control, kEpctlNaksts);
  const std::uint32_t kind = (raw & kEpctlEptyp) >> kEpctlEptypShift;
  if (kind == kTypeIsochronous) violate("isochronous endpoints are not modelled");
}

void OtgFsModel::in_written(unsigned endpoint, std::uint32_t raw, std::uint32_t old) {
  nak_written(diepctl(endpoint), raw);
  if ((raw & kEpctlSnak) != 0) set(diepint(endpoint), kDiepInepne);
  if ((raw & kEpctlCnak) != 0) clear(diepint(endpoint), kDiepInepne);
  if (endpoint != 0 && (raw & kEpctlSd0pid) != 0) in_[endpoint].data1 = false;
  if (endpoint != 0 && (raw & kEpctlSd1pid) != 0) in_[endpoint].data1 = true;
  if (endpoint == 0) {
    reg(doepctl(0)) = (reg(doepctl(0)) & ~kEpctlMpsiz0) | (raw & kEpctlMpsiz0);
  } else {
    clear(diepctl(endpoint), kEpctlDpid);
    if (in_[endpoint].data1) set(diepctl(endpoint), kEpctlDpid);
  }
  if ((raw & ~old & kEpctlEpdis) != 0) disable(endpoint, true, old);
  if ((raw & ~old & kEpctlEpena) != 0) start_in(endpoint);
}

void OtgFsModel::out_written(unsigned endpoint, std::uint32_t raw, std::uint32_t old) {
  nak_written(doepctl(endpoint), raw);
  if (endpoint != 0 && (raw & kEpctlSd0pid) != 0) out_[endpoint].data1 = false;
  if (endpoint != 0 && (raw & kEpctlSd1pid) != 0) out_[endpoint].data1 = true;
  if (endpoint != 0) {
    clear(doepctl(endpoint), kEpctlDpid);
    if (out_[endpoint].data1) set(doepctl(endpoint), kEpctlDpid);
  }
  if (endpoint != 0 && (raw & ~old & kEpctlEpdis) != 0) disable(endpoint, false, old);
  if ((raw & ~old & kEpctlEpena) != 0) start_out(endpoint);
}

void OtgFsModel::disable(unsigned endpoint, bool in, std::uint32_t old) {
  const std::uint32_t control = in ? diepctl(endpoint) : doepctl(endpoint);
  if ((old & kEpctlEpena) == 0) {
    violate("EPDIS of " + named(in, endpoint) + ", which isn't enabled");
    clear(control, kEpctlEpdis);
    return;
  }
  if (in && !has(control, kEpctlNaksts)) violate(named(in, endpoint) + " disabled without NAK");
  if (!in && !has(kGintsts, kGintGonakeff)) {
    violate(named(in, endpoint) + " disabled without global OUT NAK");
  }
  if (disable_stuck) return;
  later(disable_time, [this, endpoint, in, control] {
    clear(control, kEpctlEpdis | kEpctlEpena);
    set(in ? diepint(endpoint) : doepint(endpoint), in ? kDiepEpdisd : kDoepEpdisd);
  });
}

/// It must lie inside the memory, apart from the others.
void OtgFsModel::check_fifo(unsigned endpoint) {
  const std::uint32_t start = reg(dieptxf(endpoint)) & kDieptxfStart;
  const std::uint32_t end = start + depth(endpoint);
  const std::string which = "FIFO of " + named(true, endpoint);
  if (depth(endpoint) < kFifoWordsMin) violate(which + " has less than 16 words");
  if (end > kFifoWords) violate(which + " ends beyond the memory");
  if (start < reg(kGrxfsiz)) violate(which + " overlaps the receive FIFO");
  for (unsigned e = 0; e < endpoints_; ++e) {
    if (e == endpoint || !active(e, true)) continue;
    const std::uint32_t other = reg(dieptxf(e)) & kDieptxfStart;
    if (start < other + depth(e) && other < end) {
      violate(which + " overlaps that of " + named(true, e));
    }
  }
}

void OtgFsModel::start_in(unsigned endpoint) {
  const std::uint32_t control = diepctl(endpoint);
  const std::string which = named(true, endpoint);
  if (!active(endpoint, true)) {
    violate(which + " enabled without USBAEP");
    clear(control, kEpctlEpena);
    return;
  }
  check_fifo(endpoint);
  const std::uint32_t number = (reg(control) & kDiepctlTxfnum) >> kDiepctlTxfnumShift;
  if (number != endpoint) violate(which + " with the FIFO of another is not modelled");
  In& in = in_[endpoint];
  if (!in.fifo.empty()) violate(which + " enabled with old words in its FIFO: flush it");
  in.total = reg(dieptsiz(endpoint)) & kTsizXfrsiz;
  in.pushed = in.sent = 0;
  const std::uint32_t packets = (reg(dieptsiz(endpoint)) & kTsizPktcnt) >> kTsizPktcntShift;
  const std::uint32_t most = std::max<std::uint32_t>(1u, max_packet(endpoint, true));
  if (packets != std::max<std::uint32_t>(1u, (in.total + most - 1) / most)) {
    violate(which + ": PKTCNT is not what XFRSIZ makes");
  }
}

void OtgFsModel::start_out(unsigned endpoint) {
  const std::uint32_t control = doepctl(endpoint);
  const std::string which = named(false, endpoint);
  if (!active(endpoint, false)) {
    violate(which + " enabled without USBAEP");
    clear(control, kEpctlEpena);
    return;
  }
  set(control, kEpctlEpena);  // write-only for endpoint 0
  const std::uint32_t size = reg(doeptsiz(endpoint)) & kTsizXfrsiz;
  const std::uint32_t packets = (reg(doeptsiz(endpoint)) & kTsizPktcnt) >> kTsizPktcntShift;
  const std::uint32_t most = std::max<std::uint32_t>(1u, max_packet(endpoint, false));
  if (size % most != 0) violate(which + ": XFRSIZ is no multiple of the packet size");
  if (packets != std::max<std::uint32_t>(1u, size / most))
    violate(which + ": PKTCNT is not what XFRSIZ makes");
}

void OtgFsModel::push(unsigned endpoint, std::uint32_t word) {
  In& in = in_[endpoint];
  const std::string which = "FIFO of " + named(true, endpoint);
  if (!has(diepctl(endpoint), kEpctlEpena)) {
    violate(which + " written while the endpoint isn't enabled");
    return;
  }
  if (in.pushed >= in.total) {
    violate(which + " written beyond XFRSIZ");
    return;
  }
  if (in.fifo.size() >= depth(endpoint)) {
    violate(which + " written while it is full: a word is lost");
    return;
  }
  in.fifo.push_back(word);
  in.pushed = std::min(in.total, in.pushed + 4);
  if (in.pushed == in.total ||
      in.pushed % std::max<std::uint32_t>(1u, max_packet(endpoint, true)) == 0) {
    clear(dieptsiz(endpoint), kTsizXfrsiz);  // counts whole packets
    set(dieptsiz(endpoint), in.total - in.pushed);
  }
}

}  // namespace verp::hal::stm32::model
