#include "app/records/diagnosis.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/base/units.hpp"

namespace bulbus::inline app {
namespace {

constexpr double steep =
    4;  // times that the response grows faster at a limit point than at the start of the step
constexpr double implausible = 10;  // pressure over shear modulus
constexpr double squeezed = 0.3;    // Jacobian of a Gauss point
constexpr const char* jumping_contact =
    "contact that jumps: pairs change from one iteration to the next. Take more `increments`, a larger "
    "`depth`, or a smaller `penalty` in `contacts`.";
constexpr double far_away = 3;  // displacement over the model's size

std::string limit_point(const FailureFacts& f) {
  if (f.liquid.empty())
    return fmt::format(
        "a limit point: under the given pressure the displacements of step '{}' grow without bound beyond "
        "{:.4g} of its way. Prescribe "
        "displacements (`displace`), or enclose a liquid behind the surface and give its volume (`enclose` "
        "and `add`), in place of the pressure.",
        f.step, f.progress);
  return fmt::format(
      "a limit point: liquid '{0}' bears no more than about {1:.4g} kPa ({2:.4g} mmHg, the last stable "
      "pressure); beyond, its volume grows without "
      "more pressure. Give the volume in place of the pressure: `enclose: [{0}]` and `add: {{{0}: ...}}` in "
      "a step of its own.",
      f.liquid, 1e3 * f.pressure, f.pressure / mmHg);
}

std::string inverting(const FailureFacts& f) {
  return fmt::format(
      "hexahedron {} of region '{}' is about to turn inside out (least Jacobian {:.3g} in the last converged "
      "state): refine or smooth the mesh there, "
      "spread what acts on it, or take more increments.",
      f.squeezed_hex, f.squeezed_region, f.least_jacobian);
}

}  // namespace

std::string diagnosis(const FailureFacts& f) {
  if (f.outcome == Outcome::too_large)
    return "the factorisation does not fit into memory: choose `solver: {linear: {method: iterative}}`, or a "
           "coarser mesh.";
  if (!f.unstable_region.empty())
    return fmt::format(
        "an unstable material: {} hexahedra of region '{}' are beyond the stretch at which its law loses "
        "stability. Choose constants that stay "
        "stable there, such as none below 0, or stay below that stretch.",
        f.unstable_hexes, f.unstable_region);
  if (f.pressure_grows && f.largest_pressure > implausible)
    return fmt::format(
        "a wrong unit: the pressure given is {:.3g} times the largest shear modulus. Numbers without a unit "
        "are MPa: write `15 mmHg` or `2 kPa`.",
        f.largest_pressure);
  if (f.alternating) return "a checkerboard of pressures: " + sentence(*f.alternating) + ".";
  const bool unstable = f.surplus_pivots > 0, steeper = f.softening > steep;
  if (f.pressure_grows && f.progress > 0 && (steeper || unstable)) return limit_point(f);
  if (f.displacement > far_away)
    return fmt::format(
        "an under-supported part: nodes have moved {:.3g} times the model's size. Constrain what may drift "
        "with "
        "`fix`, `symmetry`, `displace` or bars.",
        f.displacement);
  if (f.outcome == Outcome::inadmissible) return "a state that is refused: " + f.reason + ".";
  if (f.least_jacobian < squeezed || f.outcome == Outcome::inverted_element) {
    if (!f.squeezed_region.empty() && f.least_jacobian < squeezed) return inverting(f);
    if (f.touching) return jumping_contact;
    if (!f.squeezed_region.empty()) return inverting(f);
  }
  if (f.touching) return jumping_contact;
  if (unstable)
    return "an unstable equilibrium: the last tangent has negative pivots too many, so the body is about to "
           "leave its path. Prescribe the motion instead of the load, or "
           "constrain the motion that is free.";
  if (f.contacts && f.progress == 0)
    return "nothing touches yet and the step does not begin: a part may be supported by contact alone. "
           "Support it "
           "with `fix` or `displace` until the contact bears.";
  if (f.outcome == Outcome::linear_solver_failed)
    return f.direct
               ? "the linear systems could not be solved: a part may be able to move freely (`fix`, "
                 "`symmetry`, `displace` or bars hold it). Else take more `increments`, or "
                 "`solver: {linear: {direct: mumps}}` where that is another one."
               : "the linear systems could not be solved: try `solver: {linear: {method: direct}}`, more "
                 "`increments`, or a larger `linear.max_iterations`.";
  return "Newton's iteration does not settle: take more `increments`, a smaller `stepping.minimum`, or "
         "divide the step; look at the last converged state for what is about to happen.";
}

}  // namespace bulbus::inline app
