#include "app/eye/eye_shape.hpp"

#include <algorithm>
#include <cmath>

#include "app/eye/degree.hpp"
#include "core/base/error.hpp"

namespace bulbus::inline eye {
namespace {

/// Height above its rim of a spherical cap of base radius a and height h, at a distance from the axis.
double cap(double a, double h, double rho) {
  const double r = (a * a + h * h) / (2 * h);
  return std::sqrt(std::max(0.0, r * r - rho * rho)) - (r - h);
}

void check_profile(const MeridianProfile& p, const std::string& name) {
  if (p.angle.empty() || p.angle.size() != p.value.size() || !std::is_sorted(p.angle.begin(), p.angle.end()))
    throw input_error("eye: the profile of the " + name + " is not a table of rising angles",
                      "give as many values as angles, the angles rising");
  if (*std::min_element(p.value.begin(), p.value.end()) <= 0)
    throw input_error("eye: the " + name + " has a thickness that is not positive",
                      "give thicknesses above 0 mm");
}

}  // namespace

double MeridianProfile::operator()(double degrees) const {
  const auto above = std::upper_bound(angle.begin(), angle.end(), degrees);
  if (above == angle.begin()) return value.front();
  if (above == angle.end()) return value.back();
  const std::size_t i = above - angle.begin();
  const double s = (degrees - angle[i - 1]) / (angle[i] - angle[i - 1]);
  return (1 - s) * value[i - 1] + s * value[i];
}

double EyeShape::limbus() const { return 180 - std::asin(limbus_radius / sclera_radius) / degree; }

double EyeShape::cornea_angle() const { return std::asin(limbus_radius / cornea_radius) / degree; }

double EyeShape::nerve_edge() const { return std::asin(.5 * nerve_diameter / sclera_radius) / degree; }

EyeShape::Place EyeShape::place(double t, double depth) const {
  const double edge = limbus();
  if (t <= edge) {
    const double r = sclera_radius - depth;
    return {r * std::sin(t * degree), -r * std::cos(t * degree)};
  }
  // alpha about the corneal centre and beta of the column, both from the axis: beta/alpha is constant, so
  // that the column is the globe's radius at the limbus and the axis at the apex.
  const double alpha = (meridian_end() - t) * degree;
  const double beta = alpha * (180 - edge) / cornea_angle();
  const double center =
      -sclera_radius * std::cos(edge * degree) - cornea_radius * std::cos(cornea_angle() * degree);
  return {cornea_radius * std::sin(alpha) - depth * std::sin(beta),
          center + cornea_radius * std::cos(alpha) - depth * std::cos(beta)};
}

double EyeShape::wall(double t) const {
  const double edge = limbus();
  if (t <= edge) return sclera(t);
  const double angle = cornea_angle(), q = (meridian_end() - t) / angle;  // 0 at the apex, 1 at the limbus
  const double tilt = q * (angle - (180 - edge)) * degree;                // between normal and column
  const double normal = cornea_center + (cornea_edge - cornea_center) * q * q;
  const double step = sclera(edge) - cornea_edge / std::cos((angle - (180 - edge)) * degree);
  return normal / std::cos(tilt) +
         step * std::pow(q, 6);  // runs into the sclera's thickness close to the limbus
}

double EyeShape::lens_pole() const { return place(meridian_end(), cornea_center).z - lens_depth; }

double EyeShape::lens_top(double rho) const {
  return lens_pole() - lens_front + cap(.5 * lens_diameter, lens_front, rho);
}

double EyeShape::lens_bottom(double rho) const {
  return lens_pole() - lens_front - lens_rim - cap(.5 * lens_diameter, lens_back(), rho);
}

void EyeShape::check() const {
  check_profile(sclera, "sclera");
  check_profile(choroid, "choroid");
  check_profile(retina, "retina");
  check_profile(ciliary, "ciliary body");
  if (!(limbus_radius < cornea_radius && limbus_radius < sclera_radius))
    throw input_error("eye: limbus_radius is not below cornea_radius and sclera_radius",
                      "give a smaller limbus_radius");
  if (!(ora < ciliary_end && ciliary_end < limbus()))
    throw input_error("eye: ora, ciliary_end and limbus do not follow each other",
                      "give ora < ciliary_end < limbus (" + std::to_string(limbus()) + " degrees)");
  if (!(lens_back() > 0))
    throw input_error("eye: lens_rim and lens_front leave no posterior cap",
                      "make them smaller than lens_thickness");
  const double t = .5 * (ora + ciliary_end);
  if (lens_diameter > 2 * place(t, wall(t)).rho)
    throw input_error("eye: the lens does not fit into the globe", "give a smaller lens_diameter");
  if (!(nerve_edge() < 30))
    throw input_error("eye: the optic nerve is too thick", "give a smaller nerve_diameter");
}

}  // namespace bulbus::inline eye
