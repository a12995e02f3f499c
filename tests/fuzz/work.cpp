#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iostream>

#include "core/base/clock.hpp"
#include "core/base/parallel.hpp"
#include "tests/fuzz/campaign.hpp"
#include "tests/fuzz/guard.hpp"
#include "tests/fuzz/plant.hpp"
#include "tests/fuzz/verdict.hpp"

namespace bulbus::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr int seconds_of_one = sanitized ? 100 : 10;
// Of 24 mutants; scenes say most.
constexpr int weights[kinds] = {12, 1, 3, 3, 1, 4};

// A target with the plant in it.
class Planted final : public Target {
 public:
  Planted(const Target& target, const std::string& plant, long long index)
      : target_(target), plant_(plant), index_(index) {}
  std::string name() const override { return target_.name(); }
  std::string extension() const override { return target_.extension(); }
  Mutant make(Random& random) const override { return target_.make(random); }
  void judge(const Mutant& mutant) const override {
    strike(plant_, index_);
    target_.judge(mutant);
  }

 private:
  const Target& target_;
  const std::string& plant_;
  long long index_;
};

// Made when first needed.
class Targets {
 public:
  explicit Targets(std::string scratch) : scratch_(std::move(scratch)) {}
  const Target& operator[](int kind) {
    if (!made_[kind]) made_[kind] = make(kind);
    return *made_[kind];
  }

 private:
  std::unique_ptr<Target> make(int kind) const {
    switch (kind) {
      case 0:
        return scenes(BULBUS_DATA, BULBUS_CASES);
      case 1:
        return studies(BULBUS_DATA);
      case 2:
        return meshes(BULBUS_CASES, scratch_);
      case 3:
        return bodies(BULBUS_CASES, scratch_);
      case 4:
        return checkpoints(scratch_);
      default:
        return foreign_meshes(scratch_);
    }
  }
  std::string scratch_;
  std::unique_ptr<Target> made_[kinds];
};

int kind_of(const Options& options, Random& random) {
  static const std::vector<std::string> names{"scene", "study", "mesh", "body", "checkpoint", "foreign"};
  for (int k = 0; k < kinds; ++k)
    if (names[k] == options.kind) return k;
  int left = static_cast<int>(random.below(24));
  int kind = 0;
  while (left >= weights[kind]) left -= weights[kind++];
  return kind;
}

void keep(const std::string& folder, long long index, const Target& target, const Mutant& mutant) {
  fs::create_directories(folder);
  std::ofstream file(folder + "/" + std::to_string(index) + target.extension(), std::ios::binary);
  if (target.extension() == ".yaml") file << "# from " << mutant.seed << "\n";
  file << mutant.content;
}

void count(const Verdict& v, Tally& tally) {
  tally.accepted += v.kind == Verdict::Kind::accepted;
  tally.refused += v.kind == Verdict::Kind::refused;
  tally.failures += v.kind == Verdict::Kind::failure;
  tally.without_line += !v.has_line;
  tally.without_remedy += !v.has_remedy;
}

// In memory where there is such a folder: files of mutants are written thousands of times.
std::string scratch_folder() {
  const fs::path parent = fs::exists("/dev/shm") ? "/dev/shm" : fs::temp_directory_path();
  const fs::path folder = parent / ("bulbus_fuzz_" + std::to_string(getppid()));
  fs::create_directories(folder);
  return folder;
}

}  // namespace

void work(const Options& options, Progress& progress) {
  Targets targets(scratch_folder());
  bool guarded = false;
  for (long long& i = progress.next; i < options.mutants; ++i) {
    if (options.seconds > 0 && Clock::now() - progress.start > options.seconds) break;
    Random random(options.seed, static_cast<std::uint64_t>(i));
    progress.kind = kind_of(options, random);
    const Target& target = targets[progress.kind];
    const Mutant mutant = target.make(random);
    if (options.show) {
      std::cout << "# " << target.name() << " from " << mutant.seed << "\n" << mutant.content << std::flush;
      break;
    }
    if (!guarded) guard_process();
    guarded = true;
    const double before = Clock::now();
    wind_up(seconds_of_one);
    const Verdict v = verdict_on(Planted(target, options.plant, i), mutant);
    wind_up(0);
    progress.tally[progress.kind].seconds += Clock::now() - before;
    count(v, progress.tally[progress.kind]);
    const bool failed = v.kind == Verdict::Kind::failure || !v.has_remedy;
    if (failed || (options.messages && v.kind == Verdict::Kind::refused))
      std::cout << (failed       ? "FAILED"
                    : v.has_line ? "refused"
                                 : "NO LINE")
                << " mutant " << i << " (" << target.name() << " from " << mutant.seed << "): " << v.message
                << std::endl;
    if (failed && !options.keep.empty()) keep(options.keep, i, target, mutant);
    if (v.kind == Verdict::Kind::accepted && progress.kind == 0 && !options.accepted.empty())
      keep(options.accepted, i, target, mutant);
  }
  progress.finished = true;
}

}  // namespace bulbus::fuzz
