#pragma once
#include "app/records/record_names.hpp"
#include "contact/interactions.hpp"
#include "core/io/vtp.hpp"

namespace bulbus::inline app {

/// The rigid bodies where they are, beside the result files: bodies_0001.vtp and so on with bodies.pvd. The
/// triangles carry the number of their body, of which a label `body_NAME` says the name, and of its part. Not
/// collective: for one rank.
class BodyFiles {
 public:
  BodyFiles(std::shared_ptr<const Interactions> interactions, const std::string& folder)
      : interactions_(std::move(interactions)), folder_(folder), index_(folder + "/" + bodies_index) {}

  /// Nothing if there are no bodies. Throws std::runtime_error.
  void save(int number) const;
  /// Adds what was saved to the index. Throws std::runtime_error.
  void list(int number, double time);

 private:
  std::shared_ptr<const Interactions> interactions_;
  std::string folder_;
  Collection index_;
};

}  // namespace bulbus::inline app
