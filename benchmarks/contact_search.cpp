// Finding contact pairs: time per slave node against the number of nodes, for a wavy sheet just above one
// that does not match.
#include <cmath>

#include "benchmarks/common.hpp"
#include "contact/search/local_search.hpp"
#include "contact/search/position_codes.hpp"
#include "contact/surfaces/slave_surface.hpp"

using namespace bulbus;
using namespace bulbus::bench;

namespace {

struct Sheet {
  std::vector<double> X;
  std::vector<Quad> faces;
};

// n² faces of about size 1, `above` the wave; the normal points down or up.
Sheet sheet(int n, double size, double above, bool down) {
  Sheet s;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const double x = size * i / n, y = size * j / n;
      s.X.insert(s.X.end(), {x, y, 3 * std::sin(.1 * x) * std::cos(.07 * y) + above});
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i;
      Quad q{a, a + 1, a + n + 2, a + n + 1};
      if (down) std::swap(q[1], q[3]);
      s.faces.push_back(q);
    }
  return s;
}

void measure(int nodes, const Options& o, json& rows) {
  const int n = static_cast<int>(std::lround(std::sqrt(nodes))) - 1;
  const Sheet slave = sheet(n, n, -.05, true), master = sheet(std::max(1, n * 9 / 10), n, 0, false);
  const SearchLimits limits{.depth = .2, .reach = .4};
  const Facets facets = split(master.faces);
  const SlaveSurface surface(slave.X, (n + 1) * (n + 1), slave.faces, {}, {});
  const MasterSurface there{facets, master.X};
  std::vector<double> global, normals, fresh, tracked;
  std::vector<int> found(surface.nodes().size(), -1);
  std::size_t candidates = 0;
  const auto choose = [&](const Candidates& near, const SlaveSurface::Shape& shape) {
    for (std::size_t i = 0; i < found.size(); ++i)
      found[i] = select(there, {slave.X[3 * i], slave.X[3 * i + 1], slave.X[3 * i + 2]}, shape.normals[i],
                        found[i], near.of(static_cast<int>(i)), limits)
                     .triangle;
  };
  for (int r = 0; r <= o.repetitions; ++r) {  // the first round warms up
    std::ranges::fill(found, -1);
    const double start = cpu_seconds();
    const Candidates near = find_candidates(slave.X, facets.triangles, master.X, 1.5 * limits.reach);
    const double searched = cpu_seconds();
    const auto shape = surface.shape(slave.X);
    const double shaped = cpu_seconds();
    choose(near, shape);
    const double chosen = cpu_seconds();
    choose(near, shape);
    const double again = cpu_seconds();
    candidates = near.triangles.size();
    if (r == 0) continue;
    global.push_back(searched - start), normals.push_back(shaped - searched);
    fresh.push_back(chosen - shaped), tracked.push_back(again - chosen);
  }
  const double count = static_cast<double>(found.size());
  const auto ns = [&](const std::vector<double>& seconds) { return 1e9 * median(seconds) / count; };
  rows.push_back({{"nodes", found.size()},
                  {"triangles", facets.triangles.size()},
                  {"candidates_per_node", candidates / count},
                  {"in_contact", std::ranges::count_if(found, [](int t) { return t >= 0; }) / count},
                  {"global_ns_per_node", ns(global)},
                  {"normals_ns_per_node", ns(normals)},
                  {"local_ns_per_node", ns(fresh)},
                  {"tracked_ns_per_node", ns(tracked)}});
}

}  // namespace

int main(int argc, char** argv) {
  const Options o = parse(argc, argv, {1000, 10000, 100000, 1000000}, {1000}, 7);
  json report = new_report("contact_search", o);
  report["notes"] =
      "seconds are processor time, medians; global: all candidate pairs by position code; normals: slave "
      "normals and areas; "
      "local: selection among the candidates; tracked: the same from the triangle found before";
  for (int nodes : o.sizes) measure(nodes, o, report["rows"]);
  finish(report,
         {"nodes", "triangles", "candidates_per_node", "in_contact", "global_ns_per_node",
          "normals_ns_per_node", "local_ns_per_node", "tracked_ns_per_node"},
         o);
}
