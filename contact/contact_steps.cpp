#include <algorithm>

#include "contact/contact_term.hpp"

namespace bulbus {
namespace {

constexpr int most_updates = 20;

}  // namespace

void ContactTerm::begin_increment() {
  const std::size_t slots = current_.triangle.size();
  for (auto* v : {&last_, &before_, &held_}) v->assign(slots, -1);
  changes_.assign(slots, 0);
  linearized_ = false;
  augmentation_ = {};
  found_.key.clear();
}

void ContactTerm::begin_step(int, const State& state) { commit(state); }

void ContactTerm::set_progress(double s) {
  fade_ = 1 - s;
  begin_increment();
}

void ContactTerm::freeze() {
  current_.overlap.clear();
  committed_.overlap.clear();
}

void ContactTerm::commit(const State& state) {
  std::ranges::fill(current_.triangle, -1);
  for (const Touch& t : found(state).touches) current_.triangle[t.slot] = t.triangle;
  committed_ = current_;
}

void ContactTerm::roll_back() {
  current_ = committed_;
  begin_increment();
}

double ContactTerm::penetration(const Found& f) const {
  double worst = 0;
  for (const Touch& t : f.touches) worst = std::max(worst, -gap(t));
  return worst;
}

// What is left of G ≥ 0, pressure · G = 0.
double ContactTerm::violation(const Found& f) const {
  double worst = penetration(f);
  for (const Touch& t : f.touches)
    if (pressure(t).value > 0) worst = std::max(worst, gap(t));
  return worst;
}

bool ContactTerm::revise(const State& state) {
  if (tolerance_ == 0) return false;
  const Found& f = found(state);
  augmentation_.violation = comm_.max(violation(f));
  if (augmentation_.violation <= tolerance_) return false;
  augmentation_.gave_up = augmentation_.updates == most_updates;
  if (augmentation_.gave_up) return false;
  ++augmentation_.updates;
  std::vector<double> p(current_.pressure.size());
  for (const Touch& t : f.touches) p[t.slot] = std::max(0., current_.pressure[t.slot] - penalty_ * gap(t));
  current_.pressure = std::move(p);
  return true;
}

Overlap ContactTerm::overlaps(const State& start, double tolerance) const {
  Overlap o;
  const Found f = find(start, {limits_.reach, limits_.reach}, false);
  for (const Touch& t : f.touches) {
    if (-t.pair.gap <= tolerance) continue;
    ++o.nodes;
    if (-t.pair.gap <= o.depth) continue;
    o.depth = -t.pair.gap;
    o.worst = slave_.nodes()[t.slave];
    for (int c = 0; c < 3; ++c) o.place[c] = start.x[3 * o.worst + c];
  }
  return o;
}

void ContactTerm::resolve(const State& start) {
  current_.overlap.assign(current_.triangle.size(), 0);
  for (const Touch& t : find(start, {limits_.reach, limits_.reach}, false).touches) {
    current_.triangle[t.slot] = t.triangle;
    current_.overlap[t.slot] = std::max(0., -t.pair.gap);
  }
  committed_ = current_;
  fade_ = 1;
  begin_increment();
}

}  // namespace bulbus
