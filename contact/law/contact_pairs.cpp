// Which triangles the slave points of a contact are measured from.
#include <algorithm>
#include <cmath>

#include "contact/law/contact_term.hpp"
#include "contact/search/nearest_point.hpp"
#include "core/base/disjoint_sets.hpp"

namespace bulbus::inline contact {
namespace {

FaceGap face_gap(const MasterSurface& master, const Vec3<double>& x, const Pair& flat, int triangle) {
  if (master.normals.empty()) return {flat.gap, flat.normal};
  return smoothed_gap(x, flat, master.corners(triangle), master.normals[triangle]);
}

// How far the projection of a point lies beside a triangle.
double distance_beside(const Pair& p, const Triangle& v) {
  Vec3<double> projection{};
  for (int i = 0; i < 3; ++i)
    for (int c = 0; c < 3; ++c) projection[c] += p.weights[i] * v[i][c];
  return nearest_point(projection, v).distance;
}

}  // namespace

std::vector<double> ContactTerm::surfaces(const State& state) const {
  std::vector<double> key{static_cast<double>(master_.moves())};
  const auto add = [&](int n) {
    for (int c = 0; c < 3; ++c) key.push_back(state.x[3 * n + c]);
  };
  for (const Quad& q : slave_.faces()) std::ranges::for_each(q, add);
  std::ranges::for_each(master_.nodes(), add);
  return key;
}

const ContactTerm::Found& ContactTerm::found(const State& state) const {
  auto key = surfaces(state);
  if (key != found_.key) {
    found_ = find(state, limits_, Search::near_last);
    found_.key = std::move(key);
  }
  return found_;
}

SlaveSurface::Shape ContactTerm::shape(std::span<const double> x) const {
  return points_.on_faces() ? points_.shape(x) : slave_.shape(x);
}

ContactTerm::Found ContactTerm::find(const State& state, const SearchLimits& near_by, Search how) const {
  Found f;
  f.shape = shape(state.x);
  const MasterSurface master = master_.at(state);
  const std::vector<double> points = outermost(state.x, f.shape);
  const auto finite = [](double v) { return std::isfinite(v); };
  if (!std::ranges::all_of(points, finite) || !std::ranges::all_of(master.places, finite)) return f;
  const bool history = how != Search::whole && look_back(points, master.places);
  SearchLimits limits = near_by;
  const double master_motion = history ? greatest_motion(master.places, start_.places) : 0;
  if (history) {
    // a point stays a candidate however deep it was
    f.motion = greatest_motion(points, start_.points) + master_motion + start_.deepest;
    if (f.motion > limits.reach) limits.reach = std::min(1.5 * f.motion, farthest_search * limits_.reach);
  }
  const Candidates& near = search_.update(points, master.facets.triangles, master.places, limits.reach);
  clearances_.move(points, master.places);
  const double margin = limits.depth + rise_;  // a point deeper than the depth may come back to the surface
  // Farther than the search follows, a point may be on the other side without having been seen to come
  // through.
  const bool followed = !history || f.motion <= limits.reach;
  for (int i = 0; i < points_.size(); ++i) {
    if (how == Search::near_last && idle(i)) continue;
    const Vec3<double> x = at(points, i);
    double nearest = limits.reach;
    for (auto rest = near.of(i); !rest.empty();) {
      const int piece = master_.piece_of(rest.front()), slot = i * master_.pieces() + piece;
      const auto end = std::ranges::find_if(rest, [&](int t) { return master_.piece_of(t) != piece; });
      const auto candidates = rest.first(end - rest.begin());
      rest = rest.subspan(candidates.size());
      const int start = how != Search::whole ? committed_.triangle[slot] : -1;
      Selection chosen = select(master, x, f.shape.normals[i], start, candidates, limits);
      if (history)
        follow(master, master_motion, {at(start_.points, i), x}, f.shape.normals[i], start, candidates,
               chosen);
      nearest = std::min(nearest, chosen.distance);
      if (chosen.triangle < 0) continue;
      const std::size_t before = f.touches.size();
      add_touches(master, x, i, slot, closest_triangle(master, x, chosen.triangle), f.touches);
      for (std::size_t k = before; k < f.touches.size(); ++k)
        if (f.touches[k].pair.gap <= 0) nearest = 0;
    }
    clearances_.set(i, followed ? nearest - margin : 0);
  }
  return f;
}

// The triangle whose curved surface a point is measured from; that of its normal line where it has come in
// too far to tell.
int ContactTerm::closest_triangle(const MasterSurface& master, const Vec3<double>& x, int triangle) const {
  if ((master_.rigid() && !master_.smooth()) || project(x, master.corners(triangle)).gap < -limits_.depth)
    return triangle;
  return triangle_of_projection(master, x, triangle);
}

// Is it known where the points were when the last increment ended? After a restart they are still there.
bool ContactTerm::look_back(std::span<const double> points, std::span<const double> places) const {
  if (start_.resumed) {
    start_.resumed = false;
    start_.points.assign(points.begin(), points.end());
    if (!master_.rigid()) start_.places.assign(places.begin(), places.end());
  }
  return !start_.points.empty();
}

void ContactTerm::rests(const State& state) const {
  if (start_.resumed) look_back(outermost(state), master_.places(state));
}

// History decides: a point behind the surface is inside if it was in contact before or has come through the
// surface since, however deep it is now; on the far side of a thin layer it is not.
void ContactTerm::follow(const MasterSurface& master, double motion, const Way& way, const Vec3<double>& N,
                         int start, std::span<const int> candidates, Selection& chosen) const {
  const bool inside = chosen.triangle >= 0 && project(way.to, master.corners(chosen.triangle)).gap < 0;
  if (inside && start >= 0) return;
  if (!inside && start < 0 && chosen.distance > farthest_crossing(master, motion, way)) return;
  const double on_surface = 1e-9 * limits_.reach;
  const bool touched =
      start >= 0 && project(way.from, corners_of(master.facets, start_.places, start)).gap <= on_surface;
  const int through =
      touched ? start : entered_through(master, start_.places, motion, way, candidates, on_surface, rise_);
  if (inside && through < 0) chosen.triangle = -1;
  if (inside || through < 0) return;
  const int met = track(master, way.to, N, through),
            t = met >= 0 ? met : nearest_from(master, way.to, through);
  const Pair p = project(way.to, master.corners(t));
  const bool over = met >= 0 || std::ranges::min(p.weights) >=
                                    -1e-6;  // a way that leads in and out again ends beside the triangle
  if (over && p.gap < 0) chosen.triangle = t, chosen.distance = 0;
}

// Too far away to touch, not in contact when the increment began, and without a multiplier or a predicted
// pressure that could pull it back.
bool ContactTerm::idle(int point) const {
  if (!clearances_.far(point)) return false;
  for (std::size_t first = point * master_.pieces(); first < current_.pressure.size(); first += slots())
    for (int k = 0; k < master_.pieces(); ++k)
      if (current_.pressure[first + k] != 0 || predicted_[first + k] != 0 ||
          committed_.triangle[first + k] >= 0)
        return false;
  return true;
}

// The faces that meet in a concave edge or corner of a rigid body keep a point out together, each in a slot
// of its own; of those that lie alike the nearest one.
void ContactTerm::add_touches(const MasterSurface& master, const Vec3<double>& x, int point, int slot,
                              int triangle, std::vector<Touch>& touches) const {
  struct Face {
    int triangle;
    double beside;
    Vec3<double> normal;
  };
  std::vector<Face> faces{{triangle, 0, project(x, master.corners(triangle)).normal}};
  for (int other : master_.across_hollows(triangle)) {
    const Triangle corners = master.corners(other);
    const Pair p = project(x, corners);
    const double beside = distance_beside(p, corners);
    if (std::abs(p.gap) > limits_.depth || beside > limits_.depth) continue;
    const auto alike =
        std::ranges::find_if(faces, [&](const Face& f) { return dot(f.normal, p.normal) > smooth_edge; });
    if (alike == faces.end())
      faces.push_back({other, beside, p.normal});
    else if (beside < alike->beside)
      *alike = {other, beside, p.normal};
  }
  if (std::ssize(faces) > master_.faces_at_a_point()) faces.resize(master_.faces_at_a_point());
  std::ranges::sort(faces, {}, &Face::triangle);
  for (std::size_t k = 0; k < faces.size(); ++k)
    touches.push_back(touch(master, x, point, slot + static_cast<int>(k) * slots(), faces[k].triangle));
}

// The faces that meet in a convex edge or corner, one for each side of it: of triangles that go on smoothly
// into one another the one nearest to the point's projection, so that a point is measured alike from every
// triangle of the edge.
std::vector<FaceGap> ContactTerm::faces_at_edge(const MasterSurface& master, const Vec3<double>& x,
                                                int triangle) const {
  struct Face {
    int side;
    double beside;
    Vec3<double> normal;
    FaceGap gap;
  };
  std::vector<Face> all;
  const auto across = master_.across_edges(triangle);
  DisjointSets sides_of(static_cast<int>(across.size()) + 1);
  const auto add = [&](int t) {
    const Triangle corners = master.corners(t);
    const Pair flat = project(x, corners);
    const int number = static_cast<int>(all.size());
    for (int k = 0; k < number; ++k)
      if (dot(all[k].normal, flat.normal) > smooth_edge) sides_of.join(k, number);
    all.push_back({number, distance_beside(flat, corners), flat.normal, face_gap(master, x, flat, t)});
  };
  add(triangle);
  std::ranges::for_each(across, add);
  for (Face& f : all) f.side = sides_of.root(f.side);
  std::ranges::stable_sort(all, {}, [](const Face& f) { return std::pair(f.side, f.beside); });
  std::vector<FaceGap> sides;
  for (std::size_t k = 0; k < all.size(); ++k)
    if ((k == 0 || all[k].side != all[k - 1].side) && all[k].gap.gap > -edge_radius_)
      sides.push_back(all[k].gap);
  if (sides.empty())
    sides.push_back(std::ranges::max_element(all, {}, [](const Face& f) { return f.gap.gap; })->gap);
  return sides;
}

ContactTerm::Touch ContactTerm::touch(const MasterSurface& master, const Vec3<double>& x, int point, int slot,
                                      int triangle) const {
  Touch t{point, slot, triangle, project(x, master.corners(triangle))};
  if (!master_.rigid()) {
    t.along = project_along_normals(x, t.pair, master.corners(triangle), master.normals[triangle],
                                    master.facets.neighbours[triangle]);
    if (t.along) t.pair = t.along->pair;
    return t;
  }
  const FaceGap g = master_.across_edges(triangle).empty()
                        ? face_gap(master, x, t.pair, triangle)
                        : rounded_gap(faces_at_edge(master, x, triangle), edge_radius_);
  t.pair.gap = g.gap;
  t.pair.normal = g.normal;
  t.bend = g.bend;
  return t;
}

}  // namespace bulbus::inline contact
