#pragma once
#include <gtest/gtest.h>

#include "core/base/error.hpp"

namespace bulbus::test {

/// `read` throws an InputError whose message has all of `parts`.
template <class Read>
void expect_refusal(Read&& read, const std::vector<std::string>& parts) {
  try {
    read();
    FAIL() << "not refused";
  } catch (const InputError& e) {
    for (const std::string& part : parts)
      EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what() << "\nlacks " << part;
  }
}

}  // namespace bulbus::test
