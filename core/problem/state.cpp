#include "core/problem/state.hpp"

namespace bulbus {

void remember(Keeper& keeper, const std::string& name, std::vector<Pose>& poses) {
  std::vector<double> values;
  for (const Pose& p : poses) {
    for (const auto& row : p.rotation.m) values.insert(values.end(), std::begin(row), std::end(row));
    values.insert(values.end(), p.shift.begin(), p.shift.end());
  }
  keeper.numbers(name, values);
  for (std::size_t b = 0; b < poses.size(); ++b) {
    const double* v = &values.at(12 * b + 11) - 11;
    for (int i = 0; i < 9; ++i) poses[b].rotation(i / 3, i % 3) = v[i];
    for (int c = 0; c < 3; ++c) poses[b].shift[c] = v[9 + c];
  }
}

void State::remember(Keeper& keeper) {
  keeper.nodes("x", x);
  keeper.hexes("lambda", lambda);
  keeper.numbers("P", P);
  bulbus::remember(keeper, "bodies", bodies);
}

}  // namespace bulbus
