#include "app/commands.hpp"

#include <stdexcept>

namespace bulbus {

int run(const Scene&, const std::string&, const std::string&, const Comm&) {
  throw std::logic_error("run: not wired yet");
}

int check(const Scene&, const Comm&) { throw std::logic_error("check: not wired yet"); }

}  // namespace bulbus
