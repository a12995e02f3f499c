#include "core/problem/fibre_directions.hpp"

#include <fmt/format.h>

#include <functional>

#include "core/base/error.hpp"
#include "core/problem/formula.hpp"

namespace bulbus::inline problem {
namespace {

using Direction = std::function<Vec3<double>(const Vec3<double>& X)>;

Vec3<double> scaled(const Vec3<double>& a, double factor) {
  return {factor * a[0], factor * a[1], factor * a[2]};
}
Vec3<double> unit(const Vec3<double>& a) { return scaled(a, 1 / norm(a)); }

Direction by_formulas(const std::vector<std::string>& texts, const std::string& key) {
  if (texts.size() != 3)
    throw scene_error(key, fmt::format("a direction has three formulas, not {}", texts.size()),
                      "Give one for each of x, y and z, such as [-Y, X, 0].");
  std::vector<std::shared_ptr<const Formula>> formulas;
  for (const std::string& text : texts) {
    formulas.push_back(std::make_shared<const Formula>(text, key));
    formulas.back()->require_timeless();
  }
  return [formulas](const Vec3<double>& X) {
    return Vec3<double>{(*formulas[0])(X, 0, 0), (*formulas[1])(X, 0, 0), (*formulas[2])(X, 0, 0)};
  };
}

// Circles run as the axis × the way from it; a meridian, from the circle × the way from the centre, towards
// the axis. Where the axis itself passes, a hexahedron has no circle, and gets the zero vector.
Direction by_angle(const FibreFamilySpec& f) {
  return [axis = unit(f.axis), center = f.center, c = std::cos(*f.angle),
          s = std::sin(*f.angle)](const Vec3<double>& X) {
    const Vec3<double> way = minus(X, center), circle = cross(axis, way);
    if (norm(circle) <= 1e-9 * norm(way)) return Vec3<double>{0, 0, 0};
    const Vec3<double> along = unit(circle), meridian = unit(cross(way, along));
    return Vec3<double>{c * along[0] + s * meridian[0], c * along[1] + s * meridian[1],
                        c * along[2] + s * meridian[2]};
  };
}

Direction direction_of(const FibreFamilySpec& f, const std::string& key) {
  if (f.direction.has_value() == f.angle.has_value())
    throw scene_error(key, "a family of fibres needs either `direction` or `angle`",
                      "Give one of them, such as `angle: 0 deg`.");
  const FibreFamilySpec none;
  if (f.direction && (f.axis != none.axis || f.center != none.center))
    throw scene_error(key, "`axis` and `center` have no effect beside `direction`",
                      "Give `angle` in place of `direction`, or leave them out.");
  if (f.direction) return by_formulas(*f.direction, key + ".direction");
  if (norm(f.axis) == 0) throw scene_error(key + ".axis", "the axis has no direction", "Give it a length.");
  return by_angle(f);
}

Vec3<double> middle(std::span<const double> X, const Hex& hex) {
  Vec3<double> sum{0, 0, 0};
  for (int n : hex)
    for (int c = 0; c < 3; ++c) sum[c] += X[3 * static_cast<std::size_t>(n) + c] / 8;
  return sum;
}

}  // namespace

std::vector<double> fibre_directions(const FibresSpec& fibres, const std::string& key,
                                     std::span<const double> X, std::span<const Hex> hexes) {
  if (fibres.families.empty())
    throw scene_error(key + ".families", "there is no family of fibres",
                      "Give at least one, such as [{angle: 0 deg}], or leave `fibres` out.");
  std::vector<Direction> families;
  const auto key_of = [&](std::size_t i) { return fmt::format("{}.families.{}", key, i); };
  for (std::size_t i = 0; i < fibres.families.size(); ++i)
    families.push_back(direction_of(fibres.families[i], key_of(i)));
  std::vector<double> directions;
  directions.reserve(3 * hexes.size() * families.size());
  for (const Hex& hex : hexes) {
    const Vec3<double> at = middle(X, hex);
    for (std::size_t i = 0; i < families.size(); ++i) {
      const Vec3<double> d = families[i](at);
      if (!(norm(d) > 0))
        throw scene_error(
            key_of(i),
            fmt::format("the fibres of the hexahedron around ({:.4g}, {:.4g}, {:.4g}) mm have no "
                        "direction",
                        at[0], at[1], at[2]),
            "Give a formula that vanishes at no hexahedron's middle, or another `center`.");
      const Vec3<double> one = unit(d);
      directions.insert(directions.end(), one.begin(), one.end());
    }
  }
  return directions;
}

}  // namespace bulbus::inline problem
