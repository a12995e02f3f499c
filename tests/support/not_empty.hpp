#pragma once
#include <gtest/gtest.h>

#include <ranges>
#include <utility>

namespace bulbus {

/// The range that is given, for loops over what was computed or read: an empty one fails the test, which
/// would else check nothing.
template <class Range>
Range not_empty(Range&& range) {
  EXPECT_FALSE(std::ranges::empty(range)) << "nothing to loop over";
  return std::forward<Range>(range);
}

}  // namespace bulbus
