// Whether the facets of an STL file bound a body.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "contact/rigid/stl.hpp"
#include "core/base/error.hpp"
#include "core/mesh/geometry.hpp"

namespace bulbus::inline contact {
namespace {

constexpr double least_height = 1e-7;  // of a facet's longest edge: single precision

struct Edge {
  int a, b;  // a < b
  int triangle;
  bool forward;  // the triangle runs from a to b
  bool same(const Edge& o) const { return a == o.a && b == o.b; }
};

class Body {
 public:
  Body(const StlSurface& surface, const std::string& path)
      : surface_(surface), path_(path), neighbours_(surface.triangles.size()) {}

  void require() {
    refuse_flat();
    join();
    orient();
    if (open_)
      refuse(open_->triangle,
             fmt::format("the surface is open: nothing continues the {} across its edge from {} to {}",
                         facet(open_->triangle), place(open_->a), place(open_->b)),
             "Close the surface; equal corners must have equal coordinates.");
    require_outside();
  }

 private:
  struct Neighbour {
    int triangle;
    bool agrees;  // on which side is out
  };

  Point point(int p) const { return at(surface_.points, p); }
  std::string place(int p) const {
    return fmt::format("({:g}, {:g}, {:g})", surface_.points[3 * p], surface_.points[3 * p + 1],
                       surface_.points[3 * p + 2]);
  }
  std::string facet(int t) const {
    return surface_.text ? fmt::format("facet in line {}", surface_.places[t])
                         : fmt::format("facet {}", surface_.places[t]);
  }
  std::string corners(int t) const {
    const auto& [a, b, c] = surface_.triangles[t];
    return place(a) + ", " + place(b) + ", " + place(c);
  }
  [[noreturn]] void refuse(int t, const std::string& what, const std::string& remedy) const {
    throw input_error(path_, surface_.text ? surface_.places[t] : 0, what, remedy);
  }

  void refuse_flat() const {
    for (int t = 0; t < static_cast<int>(surface_.triangles.size()); ++t) {
      const auto& [a, b, c] = surface_.triangles[t];
      const Point u = point(b) - point(a), v = point(c) - point(a), w = point(c) - point(b);
      const double longest = std::max({norm(u), norm(v), norm(w)});
      if (!(norm(cross(u, v)) > least_height * longest * longest))
        refuse(t, fmt::format("the {} has no area: its corners {} lie on a line", facet(t), corners(t)),
               "Mesh the surface again without slivers (MeshLab: Remove T-Vertices).");
    }
  }

  void join() {
    std::vector<Edge> edges;
    edges.reserve(3 * surface_.triangles.size());
    for (int t = 0; t < static_cast<int>(surface_.triangles.size()); ++t)
      for (int i = 0; i < 3; ++i) {
        const int a = surface_.triangles[t][i], b = surface_.triangles[t][(i + 1) % 3];
        edges.push_back({std::min(a, b), std::max(a, b), t, a < b});
      }
    std::ranges::sort(edges, {}, [](const Edge& e) { return std::array{e.a, e.b, e.triangle}; });
    for (auto e = edges.begin(); e != edges.end();) {
      const auto next = std::find_if(e, edges.end(), [&](const Edge& o) { return !o.same(*e); });
      join(e, static_cast<int>(next - e));
      e = next;
    }
  }

  void join(std::vector<Edge>::const_iterator e, int count) {
    if (count > 2)
      refuse(e[2].triangle,
             fmt::format("the edge from {} to {} belongs to {} facets, the {}, the {} and the {} among them",
                         place(e->a), place(e->b), count, facet(e[0].triangle), facet(e[1].triangle),
                         facet(e[2].triangle)),
             "Let two facets meet at every edge; save bodies that touch each other as files of their own.");
    if (count == 1) {
      if (!open_ || e->triangle < open_->triangle) open_ = *e;
      return;
    }
    const bool agrees = e[0].forward != e[1].forward;
    neighbours_[e[0].triangle].push_back({e[1].triangle, agrees});
    neighbours_[e[1].triangle].push_back({e[0].triangle, agrees});
  }

  // Facets that hang together are one shell; the fewer of those that disagree on which side is out are
  // turned.
  void orient() {
    std::vector<int> side(surface_.triangles.size());
    for (int t = 0; t < static_cast<int>(side.size()); ++t) {
      if (side[t] != 0) continue;
      shells_.push_back(shell_from(t, side));
      std::vector<int> turned, others;
      for (int k : shells_.back()) (side[k] > 0 ? others : turned).push_back(k);
      if (turned.size() > others.size()) std::swap(turned, others);
      if (turned.empty()) continue;
      const int first = *std::ranges::min_element(turned);
      refuse(first,
             fmt::format("{} of {} facets {} turned against the others, first the {} with the corners {}",
                         turned.size(), surface_.triangles.size(), turned.size() == 1 ? "is" : "are",
                         facet(first), corners(first)),
             "Exchange two of its corners, or let a mesh program orient all facets alike (Blender: "
             "Recalculate Outside).");
    }
  }

  std::vector<int> shell_from(int start, std::vector<int>& side) const {
    std::vector<int> shell{start};
    side[start] = 1;
    for (std::size_t i = 0; i < shell.size(); ++i)
      for (const auto& [other, agrees] : neighbours_[shell[i]]) {
        const int wanted = agrees ? side[shell[i]] : -side[shell[i]];
        if (side[other] == 0) {
          side[other] = wanted;
          shell.push_back(other);
        } else if (side[other] != wanted) {
          refuse(other,
                 fmt::format("the surface has one side only, like a Moebius strip: the {} cannot agree with "
                             "all of its neighbours",
                             facet(other)),
                 "Mesh the body again.");
        }
      }
    return shell;
  }

  struct Box {
    Point low, high;
    double volume;  // inside the shell, negative if it is inside out
    bool holds(const Box& o) const {
      for (int c = 0; c < 3; ++c)
        if (!(low[c] < o.low[c] && o.high[c] < high[c])) return false;
      return true;
    }
  };

  Box box_of(const std::vector<int>& shell) const {
    std::vector<std::array<int, 3>> triangles;
    Box box{point(surface_.triangles[shell[0]][0]), point(surface_.triangles[shell[0]][0]), 0};
    for (int t : shell) {
      triangles.push_back(surface_.triangles[t]);
      for (int p : surface_.triangles[t])
        for (int c = 0; c < 3; ++c)
          box.low[c] = std::min(box.low[c], point(p)[c]), box.high[c] = std::max(box.high[c], point(p)[c]);
    }
    box.volume = enclosed_volume(surface_.points, triangles);
    return box;
  }

  // A shell that is inside out bounds a cavity of another one.
  void require_outside() const {
    std::vector<Box> boxes;
    for (const auto& shell : shells_) boxes.push_back(box_of(shell));
    const std::string what = "the body is inside out: its triangles turn their normals inwards",
                      remedy = "Turn all triangles of it and save the file again.";
    if (boxes.size() == 1 && !(boxes[0].volume > 0)) throw input_error(path_, 0, what, remedy);
    for (std::size_t i = 0; i < boxes.size(); ++i)
      if (!(boxes[i].volume > 0) &&
          std::ranges::none_of(boxes, [&](const Box& o) { return o.volume > 0 && o.holds(boxes[i]); }))
        refuse(shells_[i][0],
               fmt::format("{} (closed surface {} of {}, from the {} on)", what, i + 1, boxes.size(),
                           facet(shells_[i][0])),
               remedy);
  }

  const StlSurface& surface_;
  const std::string& path_;
  std::vector<std::vector<Neighbour>> neighbours_;
  std::optional<Edge> open_;
  std::vector<std::vector<int>> shells_;
};

}  // namespace

void require_body(const StlSurface& surface, const std::string& path) { Body(surface, path).require(); }

}  // namespace bulbus::inline contact
