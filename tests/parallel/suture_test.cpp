// A suture pulls the same nodes the same way however many ranks hold them.
#include <gtest/gtest.h>

#include "contact/rigid/rigid_shapes.hpp"
#include "contact/suture/suture_term.hpp"
#include "core/mesh/distributed/partition.hpp"
#include "core/mesh/generate/generate.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/term_tangent.hpp"

namespace bulbus {
namespace {

/// The suture on the ranks of a communicator: what a node of the mesh is given there.
struct Ranks {
  LocalMesh local;
  SutureTerm term;
  State state;

  Ranks(const Mesh& mesh, const Comm& comm, const std::vector<SuturePoint>& points,
        std::shared_ptr<RigidSurface> tire, const SutureSpec& spec)
      : local(distribute(mesh, partition(mesh, comm.size()), comm)), term(local, points, tire, spec, "") {
    state.x = local.X;
    for (int n = 0; n < local.nodes(); ++n)
      for (int c = 0; c < 3; ++c) state.x[3 * n + c] += .05 * noise(3, 3 * local.input_node[n] + c);
    term.sew(.1);
    term.begin_step(0, state);
    term.set_progress(1);
  }
  std::vector<double> by_mesh_node(std::span<const double> v, std::size_t nodes) const {
    std::vector<double> all(3 * nodes);
    for (int n = 0; n < local.nodes(); ++n)
      for (int c = 0; c < 3; ++c) all[3 * local.input_node[n] + c] += v[3 * n + c];
    local.comm.sum(all);
    return all;
  }
  std::vector<double> force(std::size_t nodes) const {
    std::vector<double> f(state.x.size());
    term.add_residual(state, f, {});
    return by_mesh_node(f, nodes);
  }
  std::vector<double> action(std::size_t nodes) const {
    std::vector<double> dx(state.x.size());
    for (int n = 0; n < local.nodes(); ++n)
      for (int c = 0; c < 3; ++c) dx[3 * n + c] = noise(4, 3 * local.input_node[n] + c);
    return by_mesh_node(bulbus::action(term, state, dx), nodes);
  }
};

TEST(Suture, IsTheSameOnAnyNumberOfRanks) {
  const Mesh mesh = generate(ShellShape{.inner = 11, .outer = 12, .n = 12, .layers = 1, .part = "half"});
  RigidBodySpec body;
  body.tire = TireShape{.radius = 12.1};
  const auto tire = std::make_shared<RigidSurface>(make_rigid_surface("tire", body, ""));
  for (bool follow : {false, true})
    for (double azimuth : {0., 13., 26., 39.}) {
      SutureSpec spec;
      spec.surface = "outer";
      spec.pair = SutureSpec::Pair{azimuth, 8.9, 0};
      spec.follow = follow;
      spec.bite = .3;
      const std::vector<std::string> symmetry{"x"};
      const auto points = suture_points(mesh, spec, symmetry, "");
      const Ranks alone(mesh, Comm(MPI_COMM_SELF), points, tire, spec), all(mesh, Comm(), points, tire, spec);
      for (int i = 0; i < 2; ++i) {
        EXPECT_LT(norm(minus(alone.term.strings()[i].S, all.term.strings()[i].S)), 1e-12);
        EXPECT_LT(norm(minus(alone.term.strings()[i].direction, all.term.strings()[i].direction)), 1e-12);
      }
      const std::size_t nodes = mesh.points.size();
      EXPECT_LT(relative_difference(all.force(nodes), alone.force(nodes)), 1e-12);
      const auto wanted = alone.action(nodes), found = all.action(nodes);
      EXPECT_EQ(largest(wanted) > 0, follow);
      // every bite is so small that one rank holds its nodes, ghosts included
      EXPECT_LE(largest(plus(found, -1, wanted)), 1e-12 * largest(wanted));
    }
}

}  // namespace
}  // namespace bulbus
