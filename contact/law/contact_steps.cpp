#include <fmt/format.h>

#include <algorithm>

#include "contact/law/contact_term.hpp"

namespace bulbus::inline contact {
namespace {

constexpr int most_updates = 20;    // formulation, section 5.4
constexpr double most_missed = 10;  // times the tolerance; less is told at the end

}  // namespace

void ContactTerm::begin_increment() {
  predicted_.assign(current_.triangle.size(), 0);
  releases_.assign(current_.triangle.size(), 0);
  active_.clear();
  stepped_ = retried_ = false;
  augmentation_ = {};
  found_.key.clear();
}

// Bodies that a step brings to touch get there without a way; what is inside as the first step begins is in
// contact, but not what lies behind the master beside its rim.
void ContactTerm::begin_step(int, const State& state) {
  const bool first = start_.points.empty() && !start_.resumed && current_.overlap.empty();
  if (!start_.points.empty()) leave(state);
  commit(state);
  if (!first) return;
  for (const Touch& t : find(state, limits_, Search::whole).touches)
    if (beside(t) && gap(t) < 0) current_.triangle[t.slot] = -1;
  committed_ = current_;
}

void ContactTerm::pass_step(int, const State& start) { leave(start); }

void ContactTerm::set_progress(double s) {
  fade_ = 1 - s;
  begin_increment();
}

void ContactTerm::freeze() {
  current_.overlap.clear();
  committed_.overlap.clear();
}

std::string ContactTerm::refusal(const State& state) const {
  const double motion = comm_.max(found(state).motion), most = farthest_search * limits_.reach;
  if (motion > most)
    return fmt::format(
        "contact '{}': the surfaces move by {:.3g} mm relative to one another in one increment, farther than "
        "the search looks ({:.3g} mm), so that a contact may have been missed. Give the step more increments",
        name_, motion, most);
  if (augmentation_.gave_up && augmentation_.violation > most_missed * tolerance_)
    return fmt::format(
        "contact '{}': after {} updates of the multipliers the surfaces are {:.3g} mm from where they should "
        "be, farther than the tolerance of {:.3g} mm. Give a larger `penalty`, or the step more increments",
        name_, augmentation_.updates, augmentation_.violation, tolerance_);
  const Overlap o = of_all_ranks(behind(state), comm_);
  if (o.points == 0) return {};
  return fmt::format(
      "contact '{}': {} points of the slave have slipped around the master to its far side, the deepest at "
      "({:.4g}, {:.4g}, {:.4g}). The master is finer than the slave's faces can follow: give the contact "
      "more `divisions`, or refine "
      "the slave",
      name_, o.points, o.place[0], o.place[1], o.place[2]);
}

void ContactTerm::commit(const State& state) {
  std::ranges::fill(current_.triangle, -1);
  const Found f = find(state, limits_, Search::with_history);
  for (const Touch& t : f.touches) current_.triangle[t.slot] = t.triangle;
  committed_ = current_;
  found_.key.clear();
  leave(state);
  start_.deepest = penetration(f);
}

void ContactTerm::roll_back() {
  begin_increment();
  current_ = committed_;
}

void ContactTerm::serialize(Archive& archive) {
  const Archive::Group group(archive, "contact " + name_);
  archive.scalars("augmentation", augmentation_.updates, augmentation_.violation, augmentation_.gave_up);
  Archive::Keys rows_of;
  std::vector<double> rows;
  const std::size_t all = current_.triangle.size();
  const std::vector<double> overlap(current_.overlap.empty() ? std::vector<double>(all) : current_.overlap);
  const auto points = points_.keys(slave_);
  for (std::size_t k = 0; k < all; ++k) {
    const std::size_t slot = k % slots(), face = k / slots(), point = slot / master_.pieces(),
                      piece = slot % master_.pieces();
    const bool worth = current_.triangle[k] >= 0 || current_.pressure[k] != 0 || overlap[k] != 0;
    rows_of.add(
        (points[point] * master_.pieces() + static_cast<long long>(piece)) * master_.faces_at_a_point() +
            static_cast<long long>(face),
        worth && points_[static_cast<int>(point)].mine);
    rows.insert(rows.end(), {1. * current_.triangle[k], current_.pressure[k], overlap[k]});
  }
  if (!archive.reading()) return archive.rows("pairs", rows_of, 3, rows);
  for (std::size_t k = 0; k < all; ++k) std::ranges::copy(std::array{-1., 0., 0.}, &rows[3 * k]);
  archive.rows("pairs", rows_of, 3, rows);
  recall(rows);
}

// Triangle, multiplier and overlap of every slot, as at the end of an increment.
void ContactTerm::recall(std::span<const double> rows) {
  current_.overlap.assign(current_.triangle.size(), 0);
  for (std::size_t k = 0; k < current_.triangle.size(); ++k) {
    current_.triangle[k] = static_cast<int>(rows[3 * k]);
    current_.pressure[k] = rows[3 * k + 1];
    current_.overlap[k] = rows[3 * k + 2];
  }
  if (std::ranges::count(current_.overlap, 0.) == std::ssize(current_.overlap)) current_.overlap.clear();
  committed_ = current_;
  found_.key.clear();
  start_.resumed = true;
  if (!master_.rigid()) return;
  start_.places = master_.places({});
}

// Where an increment ends the next one's ways begin.
void ContactTerm::leave(const State& state) {
  start_.points = outermost(state);
  start_.places = master_.places(state);
  start_.resumed = false;
}

double ContactTerm::penetration(const Found& f) const {
  double worst = 0;
  for (const Touch& t : f.touches)
    if (!beside(t)) worst = std::max(worst, -gap(t));
  return worst;
}

// What is left of G ≥ 0, pressure · G = 0.
double ContactTerm::violation(const Found& f) const {
  double worst = penetration(f);
  for (const Touch& t : f.touches)
    if (!beside(t) && pressure(t).value > 0) worst = std::max(worst, gap(t));
  return worst;
}

// No pair may be in tension at the end of an increment.
bool ContactTerm::released(const Found& f) {
  bool any = false;
  for (const Touch& t : f.touches)
    if (pressure(t).value < 0) predicted_[t.slot] = 0, ++releases_[t.slot], any = true;
  return comm_.any(any);
}

// A set of active pairs that the last linear solution was not found with may not be the final one. Tried
// once.
bool ContactTerm::set_changed(const Found& f) {
  if (!stepped_ || retried_) return false;
  std::vector<int> now;
  for (const Touch& t : f.touches)
    if (pressure(t).slope > 0) now.push_back(t.slot);
  return retried_ = comm_.any(now != active_);
}

// Past a rim multipliers only fall: nothing has to be held there, and a small φ would ask for a high
// pressure.
double ContactTerm::updated(const Touch& t) const {
  const double p = current_.pressure[t.slot], next = std::max(0., p - penalty_ * gap(t));
  return beside(t) ? std::min(p, next) : next;
}

bool ContactTerm::unsettled(const State& state) {
  const Found& f = found(state);
  if (set_changed(f) || released(f)) return true;
  if (tolerance_ == 0) return false;
  augmentation_.violation = comm_.max(violation(f));
  if (augmentation_.violation <= tolerance_) return false;
  augmentation_.gave_up = augmentation_.updates == most_updates;
  if (augmentation_.gave_up) return false;
  ++augmentation_.updates;
  std::vector<double> p(current_.pressure.size());
  for (const Touch& t : f.touches) p[t.slot] = updated(t);
  current_.pressure = std::move(p);
  return true;
}

std::vector<double> ContactTerm::outermost(std::span<const double> x,
                                           const SlaveSurface::Shape& shape) const {
  std::vector<double> places = points_.places(x);
  for (int i = 0; i < points_.size(); ++i)
    for (int c = 0; c < 3; ++c) places[3 * i + c] += points_[i].chordal_offset * shape.normals[i][c];
  return places;
}

Overlap ContactTerm::overlaps(const State& start, double tolerance) const {
  return overlap_of(find(start, {limits_.reach, limits_.reach}, Search::whole), start,
                    [&](const Touch& t) { return -gap(t) > tolerance; });
}

void ContactTerm::resolve(const State& start) {
  current_.overlap.assign(current_.triangle.size(), 0);
  for (const Touch& t : find(start, {limits_.reach, limits_.reach}, Search::whole).touches) {
    current_.triangle[t.slot] = t.triangle;
    current_.overlap[t.slot] = std::max(0., -gap(t));
  }
  committed_ = current_;
  fade_ = 1;
  begin_increment();
}

}  // namespace bulbus::inline contact
