#include "app/eye/eye_map.hpp"

#include <cmath>

namespace bulbus::inline eye {

EyeMap::EyeMap(const EyeSettings& s)
    : scale(scaled(1, s.n)),
      wall(3 * scale * s.layers),
      choroid(4 * scale * s.layers),
      inner(6 * scale * s.layers),
      nerve(8 * scale),
      lens_layers(6 * scale),
      lens_disc{s.n / 2, scale, .72},
      shape_(s.shape),
      sheet_(s),
      detachment_(s.detachment) {}

double EyeMap::depth(double t, double level) const {
  const double w = shape_.wall(t);
  if (level <= wall) return w * level / wall;
  const double coat = shape_.choroid(t), film = shape_.retina(t);
  const double coats = level <= choroid ? coat * (level - wall) / (choroid - wall)
                                        : coat + film * (level - choroid) / (inner - choroid);
  if (t <= shape_.ora) return w + coats;
  // The ciliary body's layers go from those of choroid and retina at the ora to equal ones at its end.
  const double even = (level - wall) / (inner - wall);
  const double s = (t - shape_.ora) / (shape_.ciliary_end - shape_.ora);
  return w + shape_.ciliary(t) * ((1 - s) * coats / (coat + film) + s * even);
}

Point EyeMap::under(const SheetMap::Place& column, double depth) const {
  const EyeShape::Place p = shape_.place(column.t, depth);
  return {p.rho * column.x, p.rho * column.y, p.z};
}

Point EyeMap::lens_place(const Parameters& p) const {
  const DiscMap::Place d = lens_disc(p[0], p[1], p[2]);
  const double rho = d.radius * .5 * shape_.lens_diameter, u = p[3] / lens_layers;
  return {rho * d.x, rho * d.y, (1 - u) * shape_.lens_bottom(rho) + u * shape_.lens_top(rho)};
}

Point EyeMap::operator()(const Parameters& p) const {
  const double level = p[3], part = p[4];
  if (part == lens) return lens_place(p);
  const SheetMap::Place column = sheet_(p[0], p[1], p[2]);
  if (level < 0) {
    Point x = under(column, 0);
    const double end = -(shape_.sclera_radius + shape_.nerve_length), s = -level / nerve;
    x[2] = level == -nerve ? end : (1 - s) * x[2] + s * end;
    return x;
  }
  const double lift = part > attached ? detachment_->lift(column.t, azimuth(column)) : 0;
  return under(column, depth(column.t, level) + lift);
}

}  // namespace bulbus::inline eye
