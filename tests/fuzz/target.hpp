#pragma once
#include <memory>
#include <string>
#include <vector>

#include "tests/fuzz/random.hpp"

namespace bulbus::fuzz {

/// A faulty input: what a file would hold.
struct Mutant {
  std::string seed;  ///< the file that it was made from
  std::string content;
};

/// A kind of input, and the part of the program that reads it.
class Target {
 public:
  virtual ~Target() = default;
  virtual std::string name() const = 0;
  virtual std::string extension() const = 0;
  virtual Mutant make(Random& random) const = 0;
  /// Does with it what `bulbus check` does. Throws InputError where that is refused.
  virtual void judge(const Mutant& mutant) const = 0;
};

/// `data`: the folder with scenes and meshes; `cases`: tests/cases; `scratch`: for files of mutants.
std::unique_ptr<Target> scenes(const std::string& data, const std::string& cases);
std::unique_ptr<Target> studies(const std::string& data);
std::unique_ptr<Target> meshes(const std::string& cases, const std::string& scratch);
std::unique_ptr<Target> foreign_meshes(const std::string& scratch);
std::unique_ptr<Target> bodies(const std::string& cases, const std::string& scratch);
std::unique_ptr<Target> checkpoints(const std::string& scratch);

}  // namespace bulbus::fuzz
