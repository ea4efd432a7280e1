#include "io/xml_text.h"

#include <gtest/gtest.h>

#include <pugixml.hpp>

namespace argil::io {
namespace {

TEST(XmlText, IsReadBackByAnXmlReader) {
  const std::string text = "a < b && c > \"d\"\n\tE\u0301 \u2264 1/60 s";
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(("<t a=\"" + xml_text("<\"&\">") + "\">" + xml_text(text) + "</t>").c_str()));
  EXPECT_EQ(document.child("t").child_value(), text);
  EXPECT_STREQ(document.child("t").attribute("a").value(), "<\"&\">");
}

TEST(XmlText, ControlCharactersThatXmlDoesNotHaveBecomeSpaces) {
  for (int c = 0; c < 0x20; ++c) {
    const std::string found = xml_text(std::string(1, static_cast<char>(c)));
    EXPECT_EQ(found, c == '\n' || c == '\t' ? std::string(1, static_cast<char>(c)) : " ") << c;
  }
}

}  // namespace
}  // namespace argil::io
