#include "core/problem/state.hpp"

namespace bulbus::inline problem {

void serialize(Archive& archive, const std::string& name, std::vector<Pose>& poses) {
  std::vector<double> values;
  for (const Pose& p : poses) {
    for (const auto& row : p.rotation.m) values.insert(values.end(), std::begin(row), std::end(row));
    values.insert(values.end(), p.shift.begin(), p.shift.end());
  }
  archive.numbers(name, values);
  for (std::size_t b = 0; b < poses.size(); ++b) {
    const double* v = &values.at(12 * b + 11) - 11;
    for (int i = 0; i < 9; ++i) poses[b].rotation(i / 3, i % 3) = v[i];
    for (int c = 0; c < 3; ++c) poses[b].shift[c] = v[9 + c];
  }
}

void State::serialize(Archive& archive) {
  archive.nodes("x", x);
  archive.hexes("lambda", lambda);
  archive.numbers("P", P);
  bulbus::serialize(archive, "bodies", bodies);
}

}  // namespace bulbus::inline problem
