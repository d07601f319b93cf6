#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "common/model/params.hpp"
#include "host/author/action/document.hpp"

/// ROBOTIS motion files (motion_*.bin of DARwIn-OP, OP2, OP3): 256 pages of 512 bytes. A page has a
/// header of 64 and up to seven steps of 64; positions by servo id, 1/4096 of a turn. An action
/// keeps the values that it cannot express (checksums, gains, unknown ids) as bytes of the page. So
/// every page is written back byte for byte.
namespace verp::action {

inline constexpr std::size_t kPages = 256, kPageBytes = 512, kSteps = 7, kPageServos = 31;
using Page = std::array<std::uint8_t, kPageBytes>;
using Motion = std::vector<Page>;  ///< kPages of them

/// As ROBOTIS' own editor resets a page.
Page blank_page();
/// Sets the checksum so that the page's bytes sum to 255.
void seal(Page& page);

/// Throws LoadError for another size, a wrong checksum, too many steps, or steps without positions.
/// A link to a page without steps is ignored, as on the robot.
Motion read_motion(const std::filesystem::path& file);

/// One action per page that has steps or is not blank. Servo ids select the joints.
std::vector<Document> from_motion(const Params& params, const Motion& motion);
/// Each action goes to its page or the first free one. Changes only the bytes that the action
/// changes. Throws LoadError for what pages cannot hold.
Motion to_motion(const Params& params, const std::vector<Document>& documents);

/// Lists the parts that pages cannot hold and do not need: "note, stance"; may be empty.
std::string not_on_page(const Document& document);

}  // namespace verp::action
