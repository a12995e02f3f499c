#include "core/problem/probes/cancelled_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/problem/closed_surface.hpp"

namespace bulbus::inline problem {
namespace {

bool is_moment(const std::string& kind) { return kind == "moment" || kind == "body_moment"; }

// The plane whose image cancels component c of a force, or of a moment, which is no true vector; empty: none.
std::string cancelling_plane(const Model& model, bool moment, int c) {
  for (const std::string& plane : model.symmetry)
    if (moment != (axis_of(plane) == c)) return plane;
  return "";
}

// What to do about it; a plane that doubles component c leaves out as much of its side as is drawn.
std::string remedy(const Model& model, bool moment, int c) {
  int times = 1;
  for (const std::string& plane : model.symmetry) times *= moment == (axis_of(plane) == c) ? 2 : 1;
  return "`of: part` gives that of the drawn part" +
         (times > 1 ? fmt::format(", and with `scale: {}` that of its whole side of the plane", times) : "");
}

std::string sentence(const Model& model, const ProbeSpec& p) {
  const bool moment = is_moment(p.kind);
  if (p.component == "x" || p.component == "y" || p.component == "z") {
    const std::string plane = cancelling_plane(model, moment, axis_of(p.component));
    if (plane.empty()) return "";
    return fmt::format(
        "component {} of probe '{}' is {} the plane of symmetry {}: its image cancels it and the figure is "
        "always 0; {}",
        p.component, p.name, moment ? "along" : "across", plane, remedy(model, moment, axis_of(p.component)));
  }
  for (int c = 0; c < 3; ++c)
    if (cancelling_plane(model, moment, c).empty()) return "";
  if (p.component == "radial" && !moment) return "";
  return fmt::format(
      "every component of probe '{}' is cancelled by its images in the planes of symmetry and the figure is "
      "always 0; `of: part` gives that of the drawn part",
      p.name);
}

}  // namespace

bool sums_forces(const std::string& kind) {
  constexpr std::array kinds{"reaction", "moment", "contact_force", "body_force", "body_moment"};
  return std::ranges::find(kinds, kind) != kinds.end();
}

std::vector<std::string> cancelled_figures(const Model& model) {
  std::vector<std::string> sentences;
  for (const ProbeSpec& p : model.probes)
    if (p.of == "whole" && sums_forces(p.kind))
      if (std::string s = sentence(model, p); !s.empty()) sentences.push_back(std::move(s));
  return sentences;
}

}  // namespace bulbus::inline problem
