#include "core/base/base64.hpp"

#include <gtest/gtest.h>

namespace {

// RFC 4648, section 10.
TEST(Base64, AgreesWithItsStandard) {
  const auto of = [](const std::string& text) { return bulbus::base64(std::as_bytes(std::span(text))); };
  EXPECT_EQ(of(""), "");
  EXPECT_EQ(of("f"), "Zg==");
  EXPECT_EQ(of("fo"), "Zm8=");
  EXPECT_EQ(of("foo"), "Zm9v");
  EXPECT_EQ(of("foob"), "Zm9vYg==");
  EXPECT_EQ(of("fooba"), "Zm9vYmE=");
  EXPECT_EQ(of("foobar"), "Zm9vYmFy");
  EXPECT_EQ(of("\xff\xfe"), "//4=");
}

}  // namespace
