#pragma once
#include <map>
#include <string>

#include "contact/band_tension.hpp"
#include "contact/elastic_band.hpp"
#include "contact/interactions.hpp"

namespace bulbus::inline contact {

/// The elastic bands of a model: when Newton's method has converged for the radius that each has, it is moved
/// to a better one, until they balance. Comes after the contacts, whose active sets settle first.
class ElasticBands final : public Term {
 public:
  /// Throws InputError where a step closes an elastic band otherwise than by shortening it.
  ElasticBands(Problem& problem, Interactions& interactions);
  bool empty() const { return bands_.empty(); }
  const ElasticBand& band(const std::string& name) const { return bands_.at(name).band; }

  void add_residual(const State&, std::span<double>, std::span<double>) const override {}
  void begin_step(int step, const State& start) override;
  bool update_multipliers(const State& state) override;
  std::string refusal(const State& state) const override;
  void extrapolate(double factor) override;
  void set_progress(double s) override;
  void freeze() override;
  void commit(const State&) override;
  void serialize(Archive& archive) override;

 private:
  struct Ring {
    ElasticBand band;
    RigidMotion& motion;
    const RigidSurface& surface;
    double radius;  // of the inner face as drawn, mm
    BandArcs arcs;
    std::vector<const Interactions::Contact*> contacts;
  };
  double circumference(const Ring& ring) const;
  double pressed(const Ring& ring, const State& state) const;

  Problem& problem_;
  std::map<std::string, Ring> bands_;
};

}  // namespace bulbus::inline contact
