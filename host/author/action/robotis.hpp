#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "common/model/params.hpp"
#include "host/author/action/document.hpp"

/// ROBOTIS motion files (motion_*.bin of DARwIn-OP, OP2, OP3): 256 pages of 512 bytes, each a
/// header of 64 and up to seven steps of 64, positions by servo id in 1/4096 of a turn. What an
/// action cannot say (checksums, gains, ids that the robot lacks) stays in its file as bytes of the
/// page, so that whatever was read is written back byte for byte.
namespace verp::action {

inline constexpr std::size_t kPages = 256, kPageBytes = 512, kSteps = 7, kPageServos = 31;
using Page = std::array<std::uint8_t, kPageBytes>;
using Motion = std::vector<Page>;  ///< kPages of them

/// As ROBOTIS' own editor resets one.
Page blank_page();
/// Bytes that make the page's sum 255, as its checksum must.
void seal(Page& page);

/// Throws LoadError for what is no such file: another size, a page whose checksum is wrong, with
/// more steps than it has room for, or whose steps hold no positions. A link to a page without
/// steps is none, as on the robot.
Motion read_motion(const std::filesystem::path& file);

/// The pages that have steps, or are not blank: an action each. Joints are those whose servo has
/// the id.
std::vector<Document> from_motion(const Params& params, const Motion& motion);
/// The other way: each action on its page, one without on the first that is free; what was changed
/// in it is changed there, and nothing else. Throws LoadError for what pages cannot hold.
Motion to_motion(const Params& params, const std::vector<Document>& documents);

/// What of an action no page holds and none needs, in words: "note, stance"; empty: nothing.
std::string not_on_page(const Document& document);

}  // namespace verp::action
