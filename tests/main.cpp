#include <gtest/gtest.h>

#include "core/base/parallel.hpp"

int main(int argc, char** argv) {
  bulbus::Session session(argc, argv);
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
