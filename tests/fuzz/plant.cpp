#include "tests/fuzz/plant.hpp"

#include <csignal>
#include <stdexcept>
#include <vector>

#include "core/base/error.hpp"
#include "tests/fuzz/prepared.hpp"

namespace bulbus::fuzz {
namespace {

int fill_stack(int depth) {
  volatile char room[1024] = {};
  room[depth % 1024] = 1;
  return depth < 0 ? 0 : fill_stack(depth + 1) + room[0];
}

}  // namespace

void strike(const std::string& plant, long long index) {
  if (plant.empty() || index % 100 != 13) return;
  if (plant == "exception") throw std::out_of_range("planted");
  if (plant == "crash") std::raise(SIGSEGV);
  if (plant == "stack") fill_stack(0);
  if (plant == "hang")
    for (volatile bool on = true; on;) {
    }
  if (plant == "memory") std::vector<char>(std::size_t{1} << 33).back() = 1;
  if (plant == "silent") throw Silent("planted");
  if (plant == "no_remedy") throw InputError("scene.yaml:1: planted");
}

}  // namespace bulbus::fuzz
