#include "app/report/probe_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <map>

namespace bulbus::inline app {
namespace {

std::string statistic(const ProbeSpec& p) {
  return p.statistic == "max" ? "largest " : p.statistic == "min" ? "smallest " : "mean ";
}

std::string component(const ProbeSpec& p) {
  return p.component == "magnitude" ? ""
         : p.component == "radial"  ? "radial "
                                    : p.component + " component of the ";
}

std::string along(const ProbeSpec& p) {
  return p.component == "magnitude" ? ""
         : p.component == "radial"  ? ", away from the z axis"
                                    : " along " + p.component;
}

std::string of_set(const ProbeSpec& p, const char* word = " of ") {
  return p.set.empty() ? "" : word + p.set;
}

std::string of_cells(const ProbeSpec& p) {
  return p.region.empty() ? p.set.empty() ? " of all cells" : " of the cells at " + p.set : " in " + p.region;
}

std::string exceeded(const ProbeSpec& p) {
  if (p.percentile >= 100) return "largest Mises stress";
  return fmt::format("Mises stress that {:.3g} % of the volume exceed", 100 - p.percentile);
}

std::string of_zone(const ProbeSpec& p) { return fmt::format(" in its central {:g} mm", p.zone); }

std::string figure(const ProbeSpec& p) {
  static const std::map<std::string, std::function<std::string(const ProbeSpec&)>> words{
      {"displacement", [](auto& p) { return statistic(p) + component(p) + "displacement" + of_set(p); }},
      {"position", [](auto& p) { return statistic(p) + component(p) + "position" + of_set(p); }},
      {"distance", [](auto& p) { return "distance from " + p.set + " to " + p.to + along(p); }},
      {"buckle_height", [](auto& p) { return "how far " + p.set + " stands inwards of " + p.to; }},
      {"reaction",
       [](auto& p) { return "force of the supports on the body" + of_set(p, " at ") + along(p); }},
      {"moment",
       [](auto& p) { return "moment of the supports about the origin" + of_set(p, " at ") + along(p); }},
      {"pressure", [](auto& p) { return "pressure of the liquid " + p.liquid; }},
      {"volume", [](auto& p) { return "volume of the liquid " + p.liquid; }},
      {"mises", [](auto& p) { return exceeded(p) + of_cells(p); }},
      {"volume_ratio", [](auto& p) { return statistic(p) + "current over undeformed volume" + of_cells(p); }},
      {"bar_force",
       [](auto& p) { return statistic(p) + "force of the bars " + p.region + ", tension positive"; }},
      {"contact_area", [](auto& p) { return "area that touches at the contact " + p.contact; }},
      {"contact_force", [](auto& p) { return "force of the contact " + p.contact + along(p); }},
      {"contact_pressure", [](auto& p) { return "largest pressure of the contact " + p.contact; }},
      {"mean_contact_pressure", [](auto& p) { return "mean pressure of the contact " + p.contact; }},
      {"penetration", [](auto& p) { return "largest penetration of the contact " + p.contact; }},
      {"gap", [](auto& p) { return statistic(p) + "gap of the contact " + p.contact + of_set(p, " at "); }},
      {"closed_fraction",
       [](auto& p) {
         return fmt::format("part of the nodes{} that are closer than {:g} mm at the contact {}", of_set(p),
                            p.tolerance, p.contact);
       }},
      {"sealed_fraction",
       [](auto& p) {
         return "part of the edge" + of_set(p) + " that the contact " + p.contact + " presses";
       }},
      {"contact_fraction",
       [](auto& p) { return "part of the slave's area that touches at the contact " + p.contact; }},
      {"body_force", [](auto& p) { return "force of all contacts on " + p.body + along(p); }},
      {"body_moment",
       [](auto& p) { return "moment of all contacts on " + p.body + " about the origin" + along(p); }},
      {"band_tension", [](auto& p) { return "hoop force of the band " + p.body; }},
      {"suture_force", [](auto& p) { return "force of one string of the suture " + p.suture; }},
      {"suture_mises",
       [](auto& p) {
         const std::string what = p.within > 0 ? fmt::format("mean Mises stress within {:g} mm of", p.within)
                                               : exceeded(p) + " around";
         return what + " the bites of the suture " + p.suture;
       }},
      {"corneal_power", [](auto& p) { return "power of the cornea" + of_zone(p); }},
      {"corneal_astigmatism", [](auto& p) { return "astigmatism of the cornea" + of_zone(p); }},
      {"steep_meridian",
       [](auto& p) { return "steepest meridian of the cornea" + of_zone(p) + ", from +x towards +y"; }},
      {"refraction", [](auto&) {
         return std::string("refraction of cornea and lens (spherical equivalent), negative: myopia");
       }}};
  const auto found = words.find(p.kind);
  return found == words.end() ? p.kind : found->second(p);
}

}  // namespace

std::string meaning_of(const ProbeSpec& p) {
  std::string words = figure(p);
  if (p.of == "part") words += ", of the drawn part alone";
  if (p.peak) words += ", largest so far";
  if (!p.since.empty()) words += ", change since the end of " + p.since;
  if (p.scale != 1) words += fmt::format(", times {:g}", p.scale);
  return words;
}

std::string title_of(const std::string& name) {
  std::string title = name;
  std::ranges::replace(title, '_', ' ');
  if (!title.empty()) title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(title[0])));
  return title;
}

}  // namespace bulbus::inline app
