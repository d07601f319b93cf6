#include <gtest/gtest.h>

#include <string>

#include "host/robot/model/encoding.hpp"
#include "tests/host/model/bad_input.hpp"

/// Robots' files of programs that write no UTF-8.
namespace verp::model {
namespace {

/// A robot whose name has one letter beyond ASCII, as ISO-8859-1.
std::string green_robot(const std::string& encoding) {
  std::string text = edited("<model name=\"generic21\">", "<model name=\"gr\xFCn21\">");
  const std::string first = "<?xml version=\"1.0\" encoding=\"" + encoding + "\"?>";
  return (encoding.empty() ? "" : first) + text.substr(text.find('\n'));
}

std::string in_utf16(const std::string& latin1, bool little) {
  std::string out;
  for (const char c : latin1) out += little ? std::string{c, '\0'} : std::string{'\0', c};
  return out;
}

std::string name_in(const std::string& bytes) {
  const TemporaryFile file("robot.sdf", bytes);
  return load_robot(file.path()).name;
}

TEST(Encoding, Latin1AndUtf16AreReadAsUtf8) {
  const std::string name = "gr\xC3\xBCn21";
  EXPECT_EQ(name_in(green_robot("ISO-8859-1")), name);
  EXPECT_EQ(name_in(green_robot("windows-1252")), name);
  EXPECT_EQ(name_in("\xFF\xFE" + in_utf16(green_robot("UTF-16"), true)), name);
  EXPECT_EQ(name_in("\xFE\xFF" + in_utf16(green_robot(""), false)), name);
  EXPECT_EQ(name_in(in_utf16("<?xml version=\"1.0\"?>" + green_robot(""), true)), name);
}

TEST(Encoding, TextThatWasConvertedIsNotConvertedTwice) {
  const std::string once =
      utf8_of("a", "<?xml version=\"1.0\" encoding='Latin1'?>\n<a b=\"\xFC\"/>");
  EXPECT_EQ(once, "<?xml version=\"1.0\" encoding='UTF-8'?>\n<a b=\"\xC3\xBC\"/>");
  EXPECT_EQ(utf8_of("a", once), once);
}

TEST(Encoding, BytesOfNoKnownEncodingAreRefusedAtTheirLine) {
  const std::string fix = "save it as UTF-8";
  const std::string bare = green_robot("");
  expect_refused(bare, "<model name", "a letter here is no UTF-8; " + fix);
  expect_refused(green_robot("UTF-8"), "<model name", "a letter here is no UTF-8; " + fix);
  expect_refused(green_robot("GBK"), "<?xml", "its encoding, 'gbk', is not read here; " + fix);
  expect_refused(std::string("\xFF\xFE\0\0<", 5), "\xFF", "UTF-32 is not read here; " + fix);
  const std::string half = "\xFF\xFE" + in_utf16("<sdf>\n", true) + std::string("\0\xD8", 2);
  const TemporaryFile cut("cut.sdf", half + in_utf16("</sdf>", true));
  EXPECT_EQ(refusal_of(cut.path()).line, 2);
}

TEST(Encoding, SurrogatesAndLettersThatAreTooLongAreNoUtf8) {
  for (const char* const bad : {"\xC0\xAF", "\xE0\x80\xAF", "\xED\xA0\x80", "\xF4\x90\x80\x80",
                                "\xF0\x80\x80\xAF", "\xC3", "\xE2\x82", "\x80", "\xFF"})
    EXPECT_THROW(require_utf8("a", bad), LoadError) << bad;
  require_utf8("a", "\xC3\xBC \xE2\x82\xAC \xF0\x9F\xA4\x96 \xED\x9F\xBF \xF4\x8F\xBF\xBF");
}

TEST(Encoding, SecondOuterElementIsRefused) {
  const std::string text = read_text(robot_file("generic21"));
  expect_refused(text + "<robot name=\"b\"/>", "<robot name", "a second outer element, <robot>");
}

}  // namespace
}  // namespace verp::model
