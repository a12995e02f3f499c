#include "core/base/units.hpp"

#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>
#include <stdexcept>

namespace bulbus {
namespace {

struct Unit {
  Quantity quantity;
  double factor;  // kept unit per this unit
};

const std::map<std::string, Unit>& units() {
  using Q = Quantity;
  static const std::map<std::string, Unit> table{{"mm", {Q::length, 1}},
                                                 {"um", {Q::length, 1e-3}},
                                                 {"µm", {Q::length, 1e-3}},
                                                 {"cm", {Q::length, 10}},
                                                 {"m", {Q::length, 1e3}},
                                                 {"mm2", {Q::area, 1}},
                                                 {"mm²", {Q::area, 1}},
                                                 {"um2", {Q::area, 1e-6}},
                                                 {"mm3", {Q::volume, 1}},
                                                 {"mm³", {Q::volume, 1}},
                                                 {"uL", {Q::volume, 1}},
                                                 {"µL", {Q::volume, 1}},
                                                 {"mL", {Q::volume, 1e3}},
                                                 {"N", {Q::force, 1}},
                                                 {"mN", {Q::force, 1e-3}},
                                                 {"gf", {Q::force, 9.80665e-3}},
                                                 {"MPa", {Q::stress, 1}},
                                                 {"kPa", {Q::stress, 1e-3}},
                                                 {"Pa", {Q::stress, 1e-6}},
                                                 {"GPa", {Q::stress, 1e3}},
                                                 {"mmHg", {Q::stress, mmHg}},
                                                 {"rad", {Q::angle, 1}},
                                                 {"deg", {Q::angle, std::numbers::pi / 180}},
                                                 {"°", {Q::angle, std::numbers::pi / 180}},
                                                 {"s", {Q::time, 1}}};
  return table;
}

std::string trimmed(const std::string& s) {
  auto first = s.find_first_not_of(" \t"), last = s.find_last_not_of(" \t");
  return first == std::string::npos ? "" : s.substr(first, last - first + 1);
}

std::string known_units(Quantity q) {
  std::string list;
  for (const std::string& name : units_of(q)) list += (list.empty() ? "" : ", ") + name;
  return list;
}

}  // namespace

std::string unit_of(Quantity q) {
  switch (q) {
    case Quantity::length:
      return "mm";
    case Quantity::area:
      return "mm2";
    case Quantity::volume:
      return "mm3";
    case Quantity::force:
      return "N";
    case Quantity::stress:
      return "MPa";
    case Quantity::angle:
      return "rad";
    case Quantity::time:
      return "s";
    default:
      return "";
  }
}

std::vector<std::string> units_of(Quantity q) {
  std::vector<std::string> names{unit_of(q)};
  for (const auto& [name, unit] : units())
    if (unit.quantity == q && name != names.front()) names.push_back(name);
  return names;
}

double parse_quantity(const std::string& text, Quantity q) {
  const std::string s = trimmed(text);
  char* end = nullptr;
  double value = std::strtod(s.c_str(), &end);
  if (s.find_first_of("xX") < static_cast<std::size_t>(end - s.c_str()))
    throw std::invalid_argument("'" + text + "' is a hexadecimal number: write it in decimal");
  if (end == s.c_str() || !std::isfinite(value))
    throw std::invalid_argument("'" + text + "' is not a number");
  const std::string name = trimmed(end);
  if (name.empty()) return value;
  if (name[0] == ',')
    throw std::invalid_argument("'" + text + "' has a decimal comma: write " +
                                s.substr(0, s.size() - name.size()) + "." + trimmed(name.substr(1)));
  auto unit = units().find(name);
  if (unit == units().end() || unit->second.quantity != q)
    throw std::invalid_argument(
        "'" + name + "' is not a unit that fits here" +
        (q == Quantity::number ? " (a plain number is wanted)" : " (known: " + known_units(q) + ")"));
  value *= unit->second.factor;
  if (!std::isfinite(value))
    throw std::invalid_argument("'" + text + "' is not a finite number in " + unit_of(q));
  return value;
}

}  // namespace bulbus
