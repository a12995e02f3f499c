#include "tests/fuzz/verdict.hpp"

#include <cctype>
#include <typeinfo>

#include "core/base/error.hpp"

namespace bulbus::fuzz {
namespace {

// `file:12: ` in the first line.
bool begins_with_line(const std::string& message) {
  for (std::size_t colon = message.find(':'); colon != std::string::npos && colon < message.find('\n');
       colon = message.find(':', colon + 1)) {
    std::size_t end = colon + 1;
    while (end < message.size() && std::isdigit(static_cast<unsigned char>(message[end]))) ++end;
    if (end > colon + 1 && message.compare(end, 2, ": ") == 0) return true;
  }
  return false;
}

Verdict refusal(const std::string& message) {
  const auto line = message.find("\n  ");
  const bool of_file = message.find(".h5: ") < message.find('\n');  // a checkpoint has no lines
  return {Verdict::Kind::refused, message, of_file || begins_with_line(message),
          line != std::string::npos && message.size() > line + 6};
}

}  // namespace

Verdict verdict_on(const Target& target, const Mutant& mutant) {
  try {
    target.judge(mutant);
    return {};
  } catch (const InputError& fault) {
    return refusal(fault.what());
  } catch (const std::exception& fault) {
    return {Verdict::Kind::failure, std::string(typeid(fault).name()) + ": " + fault.what()};
  }
}

}  // namespace bulbus::fuzz
