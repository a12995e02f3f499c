#pragma once
#include <functional>
#include <string>

#include "core/base/parallel.hpp"
#include "core/element/pressure_surface.hpp"
#include "core/io/archive.hpp"

namespace bulbus::inline problem {

/// Enclosed liquid with the law P = P_i + K (V_i − V)/V_i, or with a given pressure. Volumes are the model's
/// (half of the eye's with one symmetry plane).
class Liquid {
 public:
  Liquid(std::string name, PressureSurface surface, const Point& x0, double K, const Comm& comm)
      : name_(std::move(name)), surface_(std::move(surface)), x0_(x0), K_(K), comm_(comm) {}

  const std::string& name() const { return name_; }
  const PressureSurface& surface() const { return surface_; }
  /// Collective.
  double volume(std::span<const double> x) const { return comm_.sum(surface_.volume(x, x0_)); }

  bool enclosed() const { return enclosed_; }
  /// The pressure is an unknown from here on: V_i := V, P_i := P, so that the law holds as it is.
  void enclose(double V, double P) { enclosed_ = true, V_i_ = V_start_ = V, P_i_ = P; }
  /// The pressure is given by a function of the part of the step done.
  void prescribe_pressure(std::function<double(double s)> pressure) {
    enclosed_ = false, given_ = std::move(pressure);
  }
  double given(double s) const { return given_ ? given_(s) : 0; }

  /// Volume (at P_i) that is added in this step; negative: drained.
  void add(double volume) { added_ = volume; }
  void set_progress(double s) { V_i_ = V_start_ + added_ * s; }
  void freeze();

  /// D = V − V_i + (P − P_i) V_i / K; zero where the pressure is given.
  double violation(double V, double P) const { return enclosed_ ? V - V_i_ + (P - P_i_) * compliance() : 0; }
  /// V_i / K, mm³/MPa
  double compliance() const { return (enclosed_ ? V_i_ : V_scale_) / K_; }
  /// What it is enclosed with at the start of the step, without what the step adds, mm³.
  double at_start() const { return V_start_; }
  /// A volume that makes violations relative.
  double scale() const { return enclosed_ ? V_i_ : V_scale_; }
  void set_scale(double V) { V_scale_ = V; }
  /// V_i and P_i; a given pressure comes from the steps.
  void serialize(Archive& archive) { archive.scalars("liquid " + name_, enclosed_, V_i_, V_start_, P_i_); }

 private:
  std::string name_;
  PressureSurface surface_;
  Point x0_;
  double K_;
  Comm comm_;
  bool enclosed_ = false;
  double V_i_ = 0, V_start_ = 0, P_i_ = 0, added_ = 0, V_scale_ = 1;
  std::function<double(double)> given_;
};

inline void Liquid::freeze() {
  if (enclosed_) {
    V_start_ += added_;
    V_i_ = V_start_;
    added_ = 0;
  } else {
    given_ = [end = given(1)](double) { return end; };
  }
}

}  // namespace bulbus::inline problem
