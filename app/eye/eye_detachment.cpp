#include "app/eye/eye_detachment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/eye/degree.hpp"
#include "app/eye/eye_parts.hpp"
#include "core/base/error.hpp"

namespace bulbus::inline eye {
namespace {

double middle_azimuth(const EyeSheet& sheet, int quad) {
  double sum = 0;
  for (int k : sheet.quads[quad]) sum += azimuth(sheet.nodes[k]);
  return sum / 4;
}

void check(const Detachment& d, const EyeShape& e) {
  if (!(d.half_length > 0 && d.half_width > 0 && d.height > 0))
    throw input_error(fmt::format("eye: a detachment of half_length {:g}, half_width {:g} and height {:g}",
                                  d.half_length, d.half_width, d.height),
                      "give extents and a height above 0");
  if (!(d.center - d.half_length >= e.nerve_edge() - 1e-9 && d.center + d.half_length <= e.ora + 1e-9))
    throw input_error(
        fmt::format("eye: the detachment from {:g} to {:g} degrees reaches beyond the retina, which is free "
                    "of nerve and ciliary body from {:.4g} to {:g} degrees",
                    d.center - d.half_length, d.center + d.half_length, e.nerve_edge(), e.ora),
        "move its center or give a smaller half_length");
}

void check_room(const EyeShape& e, double t, double lift) {
  const double depth = e.wall(t) + e.choroid(t) + e.retina(t) + lift;
  const EyeShape::Place p = e.place(t, depth);
  const bool in_lens =
      p.rho <= .5 * e.lens_diameter && p.z >= e.lens_bottom(p.rho) && p.z <= e.lens_top(p.rho);
  if (depth < e.sclera_radius && !in_lens) return;
  throw input_error(fmt::format("eye: at {:.4g} degrees the retina, lifted by {:.4g} mm, reaches the {}", t,
                                lift, in_lens ? "lens" : "globe's centre"),
                    "give the detachment a smaller height");
}

// Of the bed of the choroid at the tear, mm.
double bed_radius(const EyeShape& e, const Tear& tear) {
  return e.sclera_radius - e.wall(tear.center) - e.choroid(tear.center);
}

std::vector<bool> torn_quads(const EyeSheet& sheet, const EyeShape& e, const Tear& tear) {
  const TearEdges edges = edges_of(tear, e);
  std::vector<bool> torn(sheet.quads.size(), false);
  const auto from_center = [&](int q) {
    return std::hypot(sheet.middle(q) - tear.center, middle_azimuth(sheet, q));
  };
  int nearest = 0;
  for (int q = 0; q < static_cast<int>(torn.size()); ++q) {
    torn[q] = sheet.middle(q) >= edges.back && sheet.middle(q) <= edges.front &&
              middle_azimuth(sheet, q) <= edges.side;
    if (from_center(q) < from_center(nearest)) nearest = q;
  }
  torn[nearest] = true;
  return torn;
}

}  // namespace

TearEdges edges_of(const Tear& tear, const EyeShape& e) {
  if (!(tear.width > 0 && tear.length > 0))
    throw input_error(fmt::format("eye: a tear of width {:g} and length {:g} mm", tear.width, tear.length),
                      "give sizes above 0 mm");
  const double radius = bed_radius(e, tear), length = tear.length / radius / degree,
               width = tear.width / (radius * std::sin(tear.center * degree)) / degree;
  return {tear.center - .5 * length, tear.center + .5 * length, .5 * width};
}

double azimuth(const SheetMap::Place& place) { return std::atan2(place.x, place.y) / degree; }

double Detachment::lift(double t, double azimuth) const {
  const double u = (t - center) / half_length, v = azimuth / half_width, q = u * u + v * v;
  // Nearer to the edge the gap would drown in rounding: nanometres.
  return q < 1 - 1e-3 ? height * (1 - q) * (1 - q) : 0;
}

DetachedSheet detached_sheet(const EyeSheet& sheet, const EyeSettings& s) {
  DetachedSheet result;
  result.lift.assign(sheet.nodes.size(), 0);
  result.torn.assign(sheet.quads.size(), false);
  if (!s.detachment) return result;

  const Detachment& d = *s.detachment;
  check(d, s.shape);
  for (std::size_t k = 0; k < sheet.nodes.size(); ++k) {
    const double lift = result.lift[k] = d.lift(sheet.nodes[k].t, azimuth(sheet.nodes[k]));
    if (lift > 0) check_room(s.shape, sheet.nodes[k].t, lift);
  }
  if (d.tear) result.torn = torn_quads(sheet, s.shape, *d.tear);

  std::vector<bool> whole(sheet.nodes.size(), false), cut = whole;
  for (std::size_t q = 0; q < sheet.quads.size(); ++q)
    for (int k : sheet.quads[q]) (result.torn[q] ? cut : whole)[k] = true;
  for (int k = 0; k < static_cast<int>(sheet.nodes.size()); ++k) {
    const bool lifted = result.lift[k] > 0;
    if (cut[k] && !lifted)
      throw input_error(fmt::format("eye: the tear reaches to {:.4g} degrees and azimuth {:.4g}, where the "
                                    "retina is attached",
                                    sheet.nodes[k].t, azimuth(sheet.nodes[k])),
                        "give a smaller tear or a larger detachment");
    if (lifted && whole[k]) result.nodes.push_back(k);
    if (cut[k] && whole[k]) result.rim.push_back(k);
  }
  if (result.nodes.empty())
    throw input_error("eye: no node of the mesh lies within the detachment",
                      "give a larger detachment or a larger n");
  return result;
}

std::string unlike_tear(const EyeSettings& s) {
  if (!s.detachment || !s.detachment->tear) return "";
  const Tear& tear = *s.detachment->tear;
  const EyeSheet sheet = eye_sheet(s);
  const auto torn = torn_quads(sheet, s.shape, tear);
  const double radius = bed_radius(s.shape, tear);
  double side = 0, front = 0, back = 180;
  for (std::size_t q = 0; q < torn.size(); ++q)
    for (int k : sheet.quads[q])
      if (const auto& node = sheet.nodes[k]; torn[q]) {
        side = std::max(side, azimuth(node));
        front = std::max(front, node.t), back = std::min(back, node.t);
      }
  const double length = (front - back) * degree * radius,
               width = 2 * side * degree * radius * std::sin(tear.center * degree);
  const auto alike = [](double is, double wanted) { return std::abs(is / wanted - 1) <= .2; };
  if (alike(width, tear.width) && alike(length, tear.length)) return "";
  return fmt::format(
      "eye: the tear is {:.2f} mm wide and {:.2f} mm long, where {:g} and {:g} mm are asked for: it is made "
      "of whole "
      "cells. Take another n or other sizes",
      width, length, tear.width, tear.length);
}

}  // namespace bulbus::inline eye
