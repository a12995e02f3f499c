#include "core/problem/idle_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "core/base/error.hpp"

namespace bulbus::inline problem {
namespace {

void refuse_idle(bool idle, const std::string& key, const std::string& why, const std::string& remedy) {
  if (idle) throw scene_error(key, "has no effect: " + why, remedy);
}

using Kinds = std::vector<std::string_view>;

const Kinds& with_statistic() {
  static const Kinds kinds{"displacement", "position", "gap", "volume_ratio", "bar_force"};
  return kinds;
}

struct ProbeKey {
  const char* name;
  bool given;
  Kinds kinds;  // that it acts on
};

std::vector<ProbeKey> keys_of(const ProbeSpec& p) {
  const ProbeSpec none;
  const Kinds cornea{"corneal_power", "corneal_astigmatism", "steep_meridian", "refraction"};
  Kinds sets{"displacement", "position", "distance", "buckle_height",   "reaction",
             "moment",       "mises",    "gap",      "closed_fraction", "sealed_fraction"};
  sets.insert(sets.end(), cornea.begin(), cornea.end());
  return {
      {"set", !p.set.empty(), sets},
      {"to", !p.to.empty(), {"distance", "buckle_height", "refraction"}},
      {"liquid", !p.liquid.empty(), {"pressure", "volume"}},
      {"region", !p.region.empty(), {"mises", "volume_ratio", "suture_mises", "bar_force", "refraction"}},
      {"contact",
       !p.contact.empty(),
       {"contact_area", "contact_force", "contact_pressure", "mean_contact_pressure", "penetration", "gap",
        "closed_fraction", "sealed_fraction", "contact_fraction"}},
      {"body", !p.body.empty(), {"body_force", "body_moment", "band_tension"}},
      {"suture", !p.suture.empty(), {"suture_force", "suture_mises"}},
      {"component",
       p.component != none.component,
       {"displacement", "position", "distance", "reaction", "moment", "contact_force", "body_force",
        "body_moment"}},
      {"statistic",
       p.statistic != none.statistic && !(p.kind == "mises" && p.statistic == "max" && p.percentile == 100),
       with_statistic()},
      {"percentile", p.percentile != none.percentile, {"mises", "suture_mises"}},
      {"tolerance", p.tolerance != none.tolerance, {"closed_fraction"}},
      {"within", p.within != none.within, {"suture_mises"}},
      {"zone", p.zone != none.zone, cornea},
      {"lens_power", p.lens_power != none.lens_power, {"refraction"}},
  };
}

// Of stresses there is a percentile in place of a statistic.
std::string remedy_of(const ProbeKey& k, const ProbeSpec& p) {
  if (k.name == std::string_view("statistic") && p.kind.ends_with("mises"))
    return "Give `percentile` in its place: 100 is the largest, 50 the median, 0 the least.";
  return fmt::format("Leave it out; it is for {}.", fmt::join(k.kinds, ", "));
}

}  // namespace

bool has_statistic(const std::string& kind) { return std::ranges::count(with_statistic(), kind) > 0; }

void refuse_idle_keys(const DisplaceSpec& d, const std::string& key) {
  const DisplaceSpec none;
  const char* whole = d.affine ? "affine" : d.rotate ? "rotate" : d.translate ? "translate" : nullptr;
  for (const auto& [name, given] :
       {std::pair{"x", &d.x}, {"y", &d.y}, {"z", &d.z}, {"radial", &d.radial}, {"by", &d.by}})
    refuse_idle(whole && *given, key + "." + name,
                fmt::format("`{}` gives the whole displacement of '{}'", whole ? whole : "", d.set),
                "Keep one of the two.");
  refuse_idle(!d.by && d.along != none.along, key + ".along", "`by` is missing, the displacement along it",
              "Give `by`, in mm, or leave `along` out.");
  for (const auto& [name, idle] :
       {std::pair{"axis", d.axis != none.axis}, {"center", d.center != none.center}})
    refuse_idle(!d.radial && idle, key + "." + name, "it is for `radial` alone",
                d.rotate ? fmt::format("Write it into `rotate`: `rotate: {{{}: ...}}`.", name)
                         : "Give `radial`, or leave it out.");
  refuse_idle(d.affine && d.from != none.from, key + ".from", "`affine` counts from the reference position",
              "Leave it out, and give the product of the two motions as `affine`.");
}

void refuse_idle_keys(const LoadSpec& l, const std::string& key) {
  const LoadSpec none;
  const std::string follows = "a pressure that is not `dead` follows the face and presses against it";
  const std::string no_pressure = "there is no `pressure` in this load";
  const std::string give = "Give `pressure`, or leave it out.";
  refuse_idle(l.pressure && !l.dead && l.direction != none.direction, key + ".direction", follows,
              "Add `dead: true` for a load in a fixed direction, or leave `direction` out.");
  refuse_idle(l.pressure && l.dead && l.direction != none.direction && !l.region.empty(), key + ".region",
              "a `dead` pressure with a `direction` has no side", "Leave `region` out.");
  refuse_idle(!l.pressure && l.direction != none.direction, key + ".direction", no_pressure, give);
  refuse_idle(!l.pressure && l.dead, key + ".dead", no_pressure, give);
  refuse_idle(!l.pressure && !l.region.empty(), key + ".region", no_pressure, give);
  refuse_idle(!l.pressure && !l.surface.empty(), key + ".surface", no_pressure, give);
  refuse_idle(!l.force && !l.set.empty(), key + ".set", "there is no `force` in this load",
              "Give `force`, or leave it out; `surface` is what a pressure acts on.");
}

void refuse_idle_keys(const ProbeSpec& p, const std::string& key) {
  for (const ProbeKey& k : keys_of(p))
    refuse_idle(k.given && std::ranges::count(k.kinds, p.kind) == 0, key + "." + k.name,
                fmt::format("the probe '{}' is of the kind {}", p.name, p.kind), remedy_of(k, p));
  refuse_idle(p.kind == "suture_mises" && p.within > 0 && p.percentile != ProbeSpec{}.percentile,
              key + ".percentile", "`within` makes it a mean", "Keep one of the two.");
}

}  // namespace bulbus::inline problem
