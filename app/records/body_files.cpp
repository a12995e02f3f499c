#include "app/records/body_files.hpp"

#include "app/records/record_names.hpp"

namespace bulbus::inline app {

void BodyFiles::save(int number) const {
  if (interactions_->bodies().empty()) return;
  std::vector<double> points;
  std::vector<std::array<int, 3>> triangles;
  Field body{"body", 1, {}}, part{"part", 1, {}};
  std::vector<Label> labels;
  for (const auto& [name, surface] : interactions_->bodies()) {
    const int first = static_cast<int>(points.size() / 3);
    points.insert(points.end(), surface->places.begin(), surface->places.end());
    for (auto t : surface->facets.triangles) {
      for (int& n : t) n += first;
      triangles.push_back(t);
    }
    body.values.resize(triangles.size(), static_cast<double>(labels.size()));
    labels.push_back({safe_name("body_" + name), static_cast<int>(labels.size())});
    for (std::size_t p = 0; p < surface->parts.size(); ++p)
      part.values.insert(part.values.end(), surface->parts[p].triangles, static_cast<double>(p));
  }
  write_vtp(folder_ + "/" + bodies_file(number), {points, triangles, {}, {body, part}, labels});
}

void BodyFiles::list(int number, double time) {
  if (!interactions_->bodies().empty()) index_.add(bodies_file(number), time);
}

}  // namespace bulbus::inline app
