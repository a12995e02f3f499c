#pragma once
#include <iosfwd>
#include <memory>
#include <optional>

#include "app/cli/arguments.hpp"
#include "app/cli/outline.hpp"
#include "core/io/terminal.hpp"

namespace bulbus::inline app {

/// The commands with their options, declared once.
class Parser {
 public:
  Parser();
  ~Parser();

  /// Reads a command line. Where it asks for help or for the version, that is printed and the exit status
  /// comes out: 0. Throws InputError where it is wrong.
  std::optional<int> parse(std::vector<std::string> arguments, const Terminal& to, std::ostream& out,
                           std::ostream& err);
  const Arguments& given() const;

  std::vector<CommandOutline> commands() const;
  /// What the program does, in a line.
  std::string about() const;

 private:
  struct Declared;
  std::unique_ptr<Declared> declared_;
};

}  // namespace bulbus::inline app
