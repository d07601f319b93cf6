// ROBOTIS' motion files: pages with right checksums, made actions and pages again.
#include "host/author/action/robotis.hpp"

#include "host/author/action/compile.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/unit/support/test_robot.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace verp;
  fuzz::Bytes bytes(data, size);
  action::Motion motion(action::kPages, action::blank_page());
  for (int pages = 0; bytes.left() > 0 && pages < 8; ++pages) {
    const std::uint8_t how = bytes.byte();
    action::Page& page = motion[bytes.byte()];
    const std::string_view some = bytes.take(1 + bytes.word() % action::kPageBytes);
    std::copy(some.begin(), some.end(), page.begin());
    if (how < 240) action::seal(page);
  }
  std::string file;
  for (const action::Page& page : motion) file.append(page.begin(), page.end());
  fuzz::refuses_only_by<model::LoadError>([&] {
    const action::Motion read = action::read_motion(fuzz::in_file("motion.bin", file));
    const auto actions = action::from_motion(test::kRobot, read);
    fuzz::require(action::to_motion(test::kRobot, actions) == read, "pages come back as they were");
    for (const action::Document& each : actions) {
      const std::string text = action::text_of(each);
      fuzz::require(action::text_of(action::parse_document("a", text)) == text,
                    "a page's text is read as it was written");
      action::not_on_page(each);
    }
    action::make_library(test::kRobot, actions);
  });
  return 0;
}
