#include "host/apps/tool/robot/start_words.hpp"

#include "common/protocol/controller_table.hpp"

namespace verp::tool {

std::string brown_out_complaint(std::uint8_t brown_out) {
  using dxl::controller::BrownOut;
  switch (static_cast<BrownOut>(brown_out)) {
    case BrownOut::kWritten:
      return "the controller wrote its chip's brown-out level (2.7 V) at this start; reset it and "
             "ask again: if brown_out is 2 once more, the chip does not keep the level; change it";
    case BrownOut::kRefused:
      return "the controller's chip refused the brown-out level (2.7 V): it is readout protected "
             "(level 2), or its flash is worn; a supply below 2.7 V may spoil what it keeps: "
             "change the chip, or keep its supply up";
    default:
      return "";
  }
}

}  // namespace verp::tool
