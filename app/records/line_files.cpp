#include "app/records/line_files.hpp"

#include <cmath>

#include "app/records/record_names.hpp"
#include "core/io/output.hpp"

namespace bulbus::inline app {
namespace {

// Of a line as ranks send it: both ends, force, group.
constexpr std::size_t width = 8;

void add_line(const Vec3<double>& a, const Vec3<double>& b, double force, double group,
              std::vector<double>& lines) {
  lines.insert(lines.end(), a.begin(), a.end());
  lines.insert(lines.end(), b.begin(), b.end());
  lines.insert(lines.end(), {force, group});
}

void write_lines(const std::string& path, const std::vector<double>& lines,
                 const std::vector<Label>& labels) {
  std::vector<double> points;
  std::vector<std::array<int, 2>> ends;
  Field force{"force", 1, {}}, length{"length", 1, {}}, group{"group", 1, {}};
  for (std::size_t k = 0; k < lines.size(); k += width) {
    const double *a = &lines[k], *b = a + 3;
    const int first = static_cast<int>(points.size() / 3);
    points.insert(points.end(), a, a + 6);
    ends.push_back({first, first + 1});
    length.values.push_back(std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]));
    force.values.push_back(a[6]);
    group.values.push_back(a[7]);
  }
  write_vtp(path, {points, {}, ends, {force, length, group}, labels});
}

}  // namespace

LineFiles::LineFiles(const Problem& problem, std::shared_ptr<const Interactions> interactions,
                     const std::string& folder)
    : problem_(problem),
      interactions_(std::move(interactions)),
      folder_(folder),
      index_(folder + "/" + lines_index) {
  const auto add = [&](const std::string& name) {
    labels_.push_back({safe_name("group_" + name), static_cast<int>(labels_.size())});
  };
  for (const auto& [name, term] : problem_.bars()) add(name);
  for (const auto& [name, term] : interactions_->sutures()) add(name);
}

std::vector<double> LineFiles::lines(const State& state) const {
  std::vector<double> own;
  double group = 0;
  for (const auto& [name, term] : problem_.bars()) {
    const Bars& bars = term->bars();
    const std::vector<double> forces = bars.forces(state.x);
    for (std::size_t i = 0; i < forces.size(); ++i)
      add_line(place(bars.bars()[i].a, state.x), place(bars.bars()[i].b, state.x), forces[i], group, own);
    ++group;
  }
  std::vector<double> all = problem_.comm().gather(std::span<const double>(own));
  for (const auto& [name, term] : interactions_->sutures()) {
    for (const SutureTerm::String& s : term->strings())
      if (s.force > 0) add_line(s.S, s.T, s.force, group, all);
    ++group;
  }
  return all;
}

void LineFiles::save(int number, const State& state) const {
  if (!any()) return;
  const std::vector<double> all = lines(state);
  write_together(problem_.comm(), [&] {
    if (problem_.comm().rank() == 0) write_lines(folder_ + "/" + lines_file(number), all, labels_);
  });
}

void LineFiles::list(int number, double time) {
  if (any()) index_.add(lines_file(number), time);
}

}  // namespace bulbus::inline app
