#pragma once
#include <optional>

#include "core/io/archive.hpp"

namespace bulbus::inline contact {

/// An elastic band around the eye: its closing c, the same radial way of all its arcs, is the one at which
/// its tension balances the hoop force T of what it presses on (formulation, section 5.9),
///     T(c) = EA (D − κ c) / (C − D),
/// with the circumference C where it came to touch, D what it has been shortened by since, and κ what it
/// loses per way by which its arcs close (RigidSurface::shortening). c is found by the secant method on T,
/// each value of which takes Newton's method some iterations.
class ElasticBand {
 public:
  /// Tension per strain EA, N; κ, about 2π.
  ElasticBand(double stiffness, double shortening) : stiffness_(stiffness), shortening_(shortening) {}

  /// The coming step shortens it by `by` (mm, linearly); C is taken where it first does.
  void shorten(double circumference, double by);
  /// What it closes by in the next increment is guessed to be `factor` times what it did in the last one:
  /// what it presses on begins there, and would lose it otherwise.
  void extrapolate(double factor) { ahead_ = factor; }
  /// At the part s of the step done, with a guess of the closing: without extrapolate() from how it followed
  /// its shortening.
  void set_progress(double s);
  /// With the hoop force (N) of what it presses on in equilibrium: true if the closing had to change.
  bool balance(double pressed);
  void commit();
  void freeze();
  void serialize(Archive& archive);

  /// Since the start of the step, mm.
  double closing() const { return closed_ - closed_before_; }
  /// N; it is slack where this would be negative.
  double tension() const;
  bool touches() const { return circumference_ > 0; }
  bool gave_up() const { return gave_up_; }

 private:
  struct Sample {
    double closed, pressed;
  };
  double length() const { return circumference_ - shortened_; }

  double stiffness_, shortening_, circumference_ = 0;
  double from_ = 0, to_ = 0, shortened_ = 0;  // D at the start and the end of the step, and now, mm
  double closed_ = 0, closed_before_ = 0;     // c now and at the start of the step, mm
  double kept_ = 0, kept_shortened_ = 0;      // c and D of the last increment, mm
  double rate_ = 0, change_ = 0;              // dc/dD of the last increment, and its change of c, mm
  double slope_ = 0;                          // dT/dc of what it presses on, N/mm
  std::optional<double> ahead_;               // of the next increment, in the last one's change
  std::optional<Sample> last_;                // of this increment
  int updates_ = 0;
  bool gave_up_ = false;
};

}  // namespace bulbus::inline contact
