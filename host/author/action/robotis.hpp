#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "common/model/params.hpp"
#include "host/author/action/document.hpp"

/// ROBOTIS motion files (motion_*.bin of DARwIn-OP, OP2, OP3): 256 pages of 512 bytes. A page has a
/// header of 64 bytes and up to seven steps of 64; positions by servo id, 1/4096 of a turn. An
/// action keeps bytes that it cannot express, so every page is written back byte for byte.
namespace verp::action {

inline constexpr std::size_t kPages = 256, kPageBytes = 512, kSteps = 7, kPageServos = 31;
using Page = std::array<std::uint8_t, kPageBytes>;
using Motion = std::vector<Page>;  ///< kPages of them

/// A page as ROBOTIS' editor resets a page.
Page blank_page();
/// Sets the checksum: all bytes then sum to 255.
void seal(Page& page);

/// Throws LoadError for a wrong size or checksum, too many steps, or steps without positions. Links
/// to pages without steps are ignored, as on the robot.
Motion read_motion(const std::filesystem::path& file);

/// One action per page with steps or content; joints by servo id.
std::vector<Document> from_motion(const Params& params, const Motion& motion);
/// Each action goes to its page or the first free one. Other bytes stay. Throws LoadError for
/// content that no page holds.
Motion to_motion(const Params& params, const std::vector<Document>& documents);

/// Lists the parts that pages neither hold nor need: "note, stance"; or empty.
std::string not_on_page(const Document& document);

}  // namespace verp::action
