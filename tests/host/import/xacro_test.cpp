#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "host/author/import/import.hpp"
#include "host/author/xacro/expression.hpp"
#include "host/author/xacro/packages.hpp"
#include "host/author/xacro/xacro.hpp"
#include "host/os/files/temporary_directory.hpp"
#include "host/robot/model/load_error.hpp"
#include "tests/host/import/refusal.hpp"

namespace verp::xacro {
namespace {

namespace fs = std::filesystem;

Value look_up(const std::string& name) {
  if (name == "side") return std::string("left");
  if (name == "length") return 0.5;
  throw ExpressionError("there is no property '" + name + "'");
}

TEST(XacroExpression, IsWhatPythonSays) {
  for (const auto& [text, expected] : {std::pair{"1+2*3", "7"},
                                       {"(1+2)*3", "9"},
                                       {"-2**2", "-4"},
                                       {"2**-1", "0.5"},
                                       {"7 // 2", "3"},
                                       {"-7 % 3", "2"},
                                       {"1e-3*2", "0.002"},
                                       {"length/2", "0.25"},
                                       {"cos(pi)", "-1"},
                                       {"math.radians(180) == pi", "1"},
                                       {"atan2(1, 1)*4 == pi", "1"},
                                       {"'a' + \"b\"", "ab"},
                                       {"side == 'left'", "1"},
                                       {"1 if side == 'right' else -1", "-1"},
                                       {"not 0 and (0 or 2)", "2"},
                                       {"max(1, 2) >= min(3, 2)", "1"},
                                       {"str(2) + side", "2left"},
                                       {"abs(-.5)", "0.5"},
                                       {"True", "1"},
                                       {"ns.length", "0.5"},
                                       {"--1", "1"}}) {
    const auto named = [](const std::string& name) {
      return look_up(name.rfind("ns.", 0) == 0 ? name.substr(3) : name);
    };
    EXPECT_EQ(text_of(evaluate(text, named)), expected) << text;
  }
}

TEST(XacroExpression, WhatIsNoneIsRefused) {
  for (const char* const text : {"", "1+", "1 2", "(1", "'a", "a b", "nobody", "f(1)", "1/0",
                                 "1 if 2", "sin()", "'a'*2", "1..2", "[1, 2]", "min(1", "@"}) {
    EXPECT_THROW(evaluate(text, look_up), ExpressionError) << text;
  }
  EXPECT_THROW(evaluate(std::string(5000, '('), look_up), ExpressionError);
  EXPECT_THROW(evaluate(std::string(5000, '-') + "1", look_up), ExpressionError);
}

class XacroFile : public ::testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& inside) {
    const fs::path path = folder_.path() / name;
    fs::create_directories(path.parent_path());
    std::ofstream(path) << "<robot name=\"r\" xmlns:xacro=\"http://www.ros.org/wiki/xacro\">\n"
                        << inside << "</robot>";
    return path.string();
  }

  /// Without white space between elements, and without the <robot> around it.
  std::string expanded(const std::string& inside) {
    result_ = expand(write("robot.xacro", inside), folder_.path().string());
    std::string out;
    bool at_start = true;
    for (const char c : result_.urdf) {
      if (c == '\n') at_start = true;
      if (c != ' ' && c != '\n') at_start = false;
      if (c != '\n' && !at_start) out += c;
    }
    const std::string head = "<robot name=\"r\">";
    if (out.rfind(head, 0) != 0) return out;
    return out.substr(head.size(), out.size() - head.size() - 8);
  }

  std::string refusal(const std::string& inside) {
    return import::refusal_of([&] { expanded(inside); });
  }

  files::TemporaryDirectory folder_;
  Expanded result_;
};

TEST_F(XacroFile, PropertiesFillAttributesAndTexts) {
  EXPECT_EQ(expanded("<xacro:property name=\"a\" value=\"2\"/><xacro:property name=\"b\" "
                     "value=\"${a*3}\"/><m x=\"0 ${b} -${a}\" y=\"$${a}\">${a + b}</m>"),
            "<m x=\"0 6 -2\" y=\"${a}\">8</m>");
}

TEST_F(XacroFile, ArgumentsTakeTheirDefaults) {
  EXPECT_EQ(
      expanded("<xacro:arg name=\"hand\" default=\"true\"/><xacro:if value=\"$(arg "
               "hand)\"><h/></xacro:if><xacro:unless value=\"${1 == 1}\"><u/></xacro:unless>"),
      "<h/>");
}

TEST_F(XacroFile, ArgumentWithoutDefaultIsFalseAndSaid) {
  EXPECT_EQ(expanded("<xacro:if value=\"$(arg crane)\"><c/></xacro:if><p/>"), "<p/>");
  ASSERT_EQ(result_.left_out.size(), 1U);
  EXPECT_NE(result_.left_out[0].find("the argument crane has no default"), std::string::npos);
}

TEST_F(XacroFile, MacrosTakeValuesPresetsAndBlocks) {
  EXPECT_EQ(expanded("<xacro:property name=\"outer\" value=\"7\"/>"
                     "<xacro:macro name=\"m\" params=\"a b:=4 c='x y' outer:=^ d:=^|9 *one **all\">"
                     "<p a=\"${a}\" b=\"${b}\" c=\"${c}\" o=\"${outer}\" d=\"${d}\"/>"
                     "<xacro:insert_block name=\"one\"/><xacro:insert_block name=\"all\"/>"
                     "</xacro:macro>"
                     "<xacro:m a=\"${outer+1}\"><q v=\"${outer}\"/><w><r/><s/></w></xacro:m>"),
            "<p a=\"8\" b=\"4\" c=\"x y\" o=\"7\" d=\"9\"/><q v=\"7\"/><r/><s/>");
}

TEST_F(XacroFile, NamesOfAMacroEndWithIt) {
  EXPECT_NE(refusal("<xacro:macro name=\"m\" params=\"a\"><p/></xacro:macro><xacro:m a=\"1\"/>"
                    "\n<q a=\"${a}\"/>")
                .find("3: '${a}': there is no property 'a'"),
            std::string::npos);
}

TEST_F(XacroFile, PackagesAreFoundBesideAndAbove) {
  write("bot_description/urdf/leg.xacro",
        "<xacro:macro name=\"leg\"><mesh filename=\"../meshes/leg.stl\"/></xacro:macro>");
  const std::string main =
      write("bot_description/urdf/bot.xacro",
            "<xacro:include filename=\"$(find bot_description)/urdf/leg.xacro\"/>"
            "<xacro:include filename=\"$(find other)/x.xacro\"/><xacro:leg/>"
            "<mesh filename=\"package://bot_description/meshes/a.stl\"/>"
            "<mesh filename=\"package://other/a.stl\"/><xacro:x/>");
  const Expanded out = expand(main, folder_.path().string());
  EXPECT_NE(out.urdf.find("\"bot_description/meshes/leg.stl\""), std::string::npos) << out.urdf;
  EXPECT_NE(out.urdf.find("\"bot_description/meshes/a.stl\""), std::string::npos) << out.urdf;
  EXPECT_NE(out.urdf.find("\"package://other/a.stl\""), std::string::npos) << out.urdf;
  ASSERT_EQ(out.left_out.size(), 2U);
  EXPECT_NE(out.left_out[0].find("package://other/x.xacro is not found"), std::string::npos);
  EXPECT_NE(out.left_out[1].find("the macro x"), std::string::npos);
}

TEST_F(XacroFile, WhatHasNoEndIsRefused) {
  EXPECT_NE(refusal("<xacro:macro name=\"m\"><xacro:m/></xacro:macro><xacro:m/>").find("no end"),
            std::string::npos);
  EXPECT_NE(refusal("<xacro:include filename=\"robot.xacro\"/>").find("no end"), std::string::npos);
  std::string longer = "<xacro:property name=\"a\" value=\"text\"/>";
  std::string sum = longer;
  for (int i = 0; i < 40; ++i) {
    longer += "<xacro:property name=\"a\" value=\"${a}${a}\"/>";
    sum += "<xacro:property name=\"a\" value=\"${a + a}\"/>";
  }
  EXPECT_NE(refusal(longer).find("64 kB"), std::string::npos);
  EXPECT_NE(refusal(sum).find("64 kB"), std::string::npos);
  std::string doubling = "<xacro:macro name=\"m0\"/>";
  for (int i = 1; i < 30; ++i) {
    const std::string below = "<xacro:m" + std::to_string(i - 1) + "/>";
    doubling +=
        "<xacro:macro name=\"m" + std::to_string(i) + "\">" + below + below + "</xacro:macro>";
  }
  EXPECT_NE(refusal(doubling + "<xacro:m29/>").find("50000"), std::string::npos);
}

TEST_F(XacroFile, MistakesAreRefusedAtTheirLine) {
  EXPECT_NE(refusal("\n\n<p a=\"${1 +}\"/>").find("4: '${1 +}': it ends"), std::string::npos);
  EXPECT_NE(refusal("<xacro:nothing/>").find("no macro 'nothing'"), std::string::npos);
  EXPECT_NE(refusal("<xacro:insert_block name=\"b\"/>").find("no block 'b'"), std::string::npos);
  EXPECT_NE(refusal("<xacro:macro name=\"m\" params=\"a\"/><xacro:m/>").find("lacks a"),
            std::string::npos);
  EXPECT_NE(refusal("<xacro:macro name=\"m\" params=\"*a\"/><xacro:m/>").find("lacks the block a"),
            std::string::npos);
  EXPECT_NE(refusal("<p a=\"${1\"/>").find("not closed"), std::string::npos);
  EXPECT_NE(refusal("<xacro:if><p/></xacro:if>").find("has no value"), std::string::npos);
}

TEST_F(XacroFile, IsImportedAsUrdf) {
  import::Wish wish{
      write("bot.urdf.xacro", "<xacro:property name=\"a\" value=\"1\"/><link name=\"l\"/>"),
      folder_.path().string(), "", ""};
  import::make_urdf(wish);
  EXPECT_EQ(fs::path(wish.file).filename(), "bot_from_xacro.urdf");
  EXPECT_THROW(import::import_robot(wish), model::LoadError);
}

}  // namespace
}  // namespace verp::xacro
