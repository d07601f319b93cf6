// The editor's markup: paths lead back to their elements, a change is taken back byte for byte.
#include "host/author/edit/change.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace verp::fuzz {
namespace {

void change(edit::Document& document, int element, std::uint8_t how) {
  const std::string before = document.text();
  refuses_only_by<model::LoadError>([&] {
    const edit::Edit wanted = how % 5 == 0   ? edit::remove(document, element)
                              : how % 5 == 1 ? edit::rename(document, element, "new")
                              : how % 5 == 2 ? edit::duplicate(document, element, "new")
                              : how % 5 == 3 ? edit::mirror(document, element)
                                             : edit::set(document, document.path(element), "1");
    document.apply(wanted);
    document.apply(wanted.reversed());
    require(document.text() == before, "a change is taken back");
  });
}

}  // namespace
}  // namespace verp::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace verp;
  const std::string text(reinterpret_cast<const char*>(data), size);
  fuzz::refuses_only_by<model::LoadError>([&] {
    edit::Document document("a.sdf", text);
    const auto count = document.markup().elements().size();
    for (std::size_t i = 0; i < count && i < 12; ++i) {
      const int element = static_cast<int>(i * 7 % count);
      document.look_for(document.path(element));
      document.text_of(element);
      fuzz::change(document, element, static_cast<std::uint8_t>(size + i));
    }
    document.at_line(3);
    edit::difference(text, "", "a.sdf");
  });
  return 0;
}
