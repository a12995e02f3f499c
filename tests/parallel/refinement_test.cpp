// Every rank refines its part only, and has what it would have of the whole refined mesh.
#include <gtest/gtest.h>

#include <cmath>

#include "app/eye/eye.hpp"
#include "contact/interactions.hpp"
#include "core/base/error.hpp"
#include "core/mesh/distributed/mesh_levels.hpp"
#include "core/mesh/distributed/partition.hpp"
#include "core/mesh/quality.hpp"
#include "core/mesh/running_sums.hpp"
#include "tests/support/models.hpp"

namespace bulbus {
namespace {

const std::set<std::string> shared{"outer_sclera"};

Mesh eye(int n) {
  EyeSettings s;
  s.n = n;
  s.detachment = Detachment{.tear = Tear{}};
  return generate(s);
}

std::vector<int> inherited(const std::vector<int>& rank, int level) {
  std::vector<int> fine;
  for (int r : rank) fine.insert(fine.end(), std::size_t{1} << 3 * level, r);
  return fine;
}

void expect_equal(const std::map<std::string, std::vector<Bar>>& found,
                  const std::map<std::string, std::vector<Bar>>& wanted) {
  ASSERT_EQ(found.size(), wanted.size());
  for (const auto& [name, group] : wanted) {
    const auto& other = found.at(name);
    ASSERT_EQ(other.size(), group.size()) << name;
    for (std::size_t i = 0; i < group.size(); ++i) {
      EXPECT_EQ(other[i].share, group[i].share);
      for (auto [a, b] : {std::pair{&other[i].a, &group[i].a}, {&other[i].b, &group[i].b}}) {
        EXPECT_EQ(a->nodes, b->nodes);
        EXPECT_EQ(a->weights, b->weights);
      }
    }
  }
}

void expect_equal(const Halo& found, const Halo& wanted) {
  ASSERT_EQ(found.neighbours().size(), wanted.neighbours().size());
  for (std::size_t i = 0; i < wanted.neighbours().size(); ++i) {
    EXPECT_EQ(found.neighbours()[i].rank, wanted.neighbours()[i].rank);
    EXPECT_TRUE(found.neighbours()[i].send == wanted.neighbours()[i].send);
    EXPECT_TRUE(found.neighbours()[i].receive == wanted.neighbours()[i].receive);
  }
}

void expect_equal(const LocalMesh& found, const LocalMesh& wanted) {  // EXPECT_TRUE: too much to print
  EXPECT_EQ(found.owned, wanted.owned);
  EXPECT_TRUE(found.X == wanted.X);
  EXPECT_TRUE(found.number == wanted.number);
  EXPECT_TRUE(found.input_node == wanted.input_node);
  EXPECT_EQ(found.first_node, wanted.first_node);
  EXPECT_EQ(found.all_nodes, wanted.all_nodes);
  EXPECT_TRUE(found.hexes == wanted.hexes);
  EXPECT_TRUE(found.input_hex == wanted.input_hex);
  EXPECT_EQ(found.first_hex, wanted.first_hex);
  EXPECT_EQ(found.all_hexes, wanted.all_hexes);
  EXPECT_EQ(found.region_names, wanted.region_names);
  EXPECT_TRUE(found.surfaces == wanted.surfaces);
  EXPECT_TRUE(found.shared == wanted.shared);
  EXPECT_TRUE(found.input_bar == wanted.input_bar);
  EXPECT_TRUE(found.sets == wanted.sets);
  EXPECT_TRUE(found.region_nodes == wanted.region_nodes);
  expect_equal(found.bars, wanted.bars);
  expect_equal(found.halo, wanted.halo);
}

void expect_equal(const Interpolation& found, const Interpolation& wanted, int nodes) {
  for (int n = 0; n < nodes; ++n) {
    const auto a = found.stencil(n), b = wanted.stencil(n);
    ASSERT_TRUE(std::ranges::equal(a.nodes, b.nodes) && std::ranges::equal(a.weights, b.weights)) << n;
  }
}

// Owners by hexahedra, numbers by owners in the order in which their hexahedra meet nodes: from the whole
// mesh.
void expect_numbered(const LocalMesh& m, const Mesh& whole, const std::vector<int>& rank_of_hex) {
  std::vector<int> owner(whole.points.size(), m.comm.size());
  for (std::size_t h = 0; h < whole.hexes.size(); ++h)
    for (int n : whole.hexes[h]) owner[n] = std::min(owner[n], rank_of_hex[h]);
  std::vector<long long> number(owner.size());
  long long next = 0;
  std::vector<bool> met(owner.size());
  for (int r = 0; r < m.comm.size(); ++r) {
    const auto meet = [&](int n) {
      if (owner[n] == r && !met[n]) number[n] = next++, met[n] = true;
    };
    for (std::size_t region = 0; region < whole.region_names.size(); ++region)
      for (std::size_t h = 0; h < whole.hexes.size(); ++h)
        if (rank_of_hex[h] == r && whole.region[h] == static_cast<int>(region))
          std::ranges::for_each(whole.hexes[h], meet);
    for (std::size_t n = 0; n < owner.size(); ++n) meet(static_cast<int>(n));
  }
  EXPECT_EQ(m.all_nodes, next);
  for (int n = 0; n < m.nodes(); ++n) {
    ASSERT_EQ(m.number[n], number[m.input_node[n]]);
    ASSERT_EQ(n < m.owned, owner[m.input_node[n]] == m.comm.rank());
    for (int c = 0; c < 3; ++c) ASSERT_EQ(m.X[3 * n + c], whole.points[m.input_node[n]][c]);
  }
}

TEST(Refinement, OfPartsIsThatOfTheWhole) {
  const Comm comm;
  const Mesh base = eye(4);
  const auto rank = partition(base, comm.size());
  const auto levels = distribute_levels(base, 2, comm, shared);
  const RefinedMesh once = refine(base), twice = refine(once.mesh);
  const Mesh* whole[] = {&base, &once.mesh, &twice.mesh};
  std::vector<LocalMesh> wanted;
  for (int i = 0; i < 3; ++i) wanted.push_back(distribute(*whole[i], inherited(rank, i), comm, shared));
  for (int i = 0; i < 3; ++i) {
    SCOPED_TRACE(i);
    expect_equal(*levels[i].mesh, wanted[i]);
    expect_numbered(*levels[i].mesh, *whole[i], inherited(rank, i));
    EXPECT_EQ(levels[i].mesh->refinements, i);
  }
  for (int i = 1; i < 3; ++i) {
    const std::vector<double> stiffness(wanted[i - 1].hexes.size(), 1);
    const Prolongation expected(i == 1 ? once : twice, wanted[i - 1], wanted[i]);
    expect_equal(levels[i].prolongation->at(wanted[i - 1].X, wanted[i].X, stiffness),
                 expected.at(wanted[i - 1].X, wanted[i].X, stiffness), wanted[i].nodes());
  }
}

TEST(Refinement, HoldsLittleMoreThanTheRanksShare) {
  const Comm comm;
  const Mesh base = generate(BlockShape{.nx = 8, .ny = 8, .nz = 8});
  const Labels whole = labels_of(base, partition(base, comm.size()));
  const MeshPart part = part_of(base, whole, comm.rank(), {});
  const RefinedMesh once = refine(part.mesh);
  const double all = 33 * 33 * 33, share = all / comm.size();
  const Labels labels = labels_of(once.mesh, inherited(part.whole.rank, 1));
  const double held = comm.max(
      static_cast<double>(refine(part_of(once.mesh, labels, comm.rank(), {}).mesh).mesh.points.size()));
  const double layers =
      2 * 35 * 35 * 3;  // around a share: no more than two layers of fine hexahedra on three sides
  EXPECT_LE(held, comm.size() == 1 ? all : share * 1.1 + layers);
  if (comm.rank() == 0)
    std::printf("%.0f nodes of %.0f held by the rank that holds most of %d\n", held, all, comm.size());
}

TEST(Refinement, QualityIsThatOfTheWhole) {
  const Mesh base = eye(4), fine = refine(base).mesh;
  const auto levels = distribute_levels(base, 1, Comm(), {});
  const auto found = quality(*levels[1].mesh), wanted = quality(fine);
  ASSERT_EQ(found.size(), wanted.size());
  for (std::size_t r = 0; r < wanted.size(); ++r) {
    EXPECT_EQ(found[r].region, wanted[r].region);
    EXPECT_EQ(found[r].count, wanted[r].count);
    EXPECT_EQ(found[r].least, wanted[r].least);
    EXPECT_EQ(found[r].five_percent, wanted[r].five_percent);
    EXPECT_NEAR(found[r].mean, wanted[r].mean, 1e-12);
    EXPECT_NEAR(found[r].volume, wanted[r].volume, 1e-12 * wanted[r].volume);
  }
}

TEST(Refinement, EveryRankNamesTheInvertedCells) {
  Mesh mesh = generate(BlockShape{.nx = 4, .ny = 4, .nz = 4});
  for (int h : {9, 60}) std::swap(mesh.hexes[h][0], mesh.hexes[h][6]);
  const auto message = [](const auto& m) -> std::string {
    try {
      refuse_inverted(m);
    } catch (const InputError& e) {
      return e.what();
    }
    return "accepted";
  };
  const std::string wanted = message(mesh);
  EXPECT_NE(wanted.find("hexahedron 10 "), std::string::npos) << wanted;
  EXPECT_EQ(message(distribute(mesh, partition(mesh, Comm().size()), Comm())), wanted);
}

TEST(Refinement, RunningSumsAreThoseOfAllRanks) {
  const Comm comm;
  const auto count = [](int key) { return key % 4; };
  std::vector<int> keys, counts, asked;
  for (int k = 0; k < 50; ++k) {
    if (k % comm.size() == comm.rank()) keys.push_back(k), counts.push_back(count(k));
    if (k % 3 != 1) asked.push_back(49 - k);
  }
  const RunningSums sums(keys, counts, 50, comm);
  const auto before = sums.before(asked);
  for (std::size_t i = 0; i < asked.size(); ++i) {
    long long wanted = 0;
    for (int k = 0; k < asked[i]; ++k) wanted += count(k);
    EXPECT_EQ(before[i], wanted);
  }
  EXPECT_EQ(sums.total(), 73);
}

/// A shell with a tire sewn onto it.
Scene sewn_shell() {
  Scene s{generate(ShellShape{.inner = 10, .outer = 12, .n = 3, .layers = 2, .part = "half"}), {}};
  Model& m = s.model;
  m.regions["shell"] = neo_hooke(.08);
  m.symmetry = {"x"};
  m.fix.push_back({"inner", {"x", "y", "z"}});
  m.rigid_bodies["tire"].tire =
      TireShape{.width = 4, .crown = 2, .edge_radius = .5, .arc = {.from = 0, .to = 30}};
  m.contacts = {{.name = "tire", .slave = "outer", .master = "tire", .start = "resolve"}};
  m.sutures["string"] = {
      .body = "tire", .surface = "outer", .pair = SutureSpec::Pair{.azimuth = 0, .spacing = 8}};
  m.steps = {step("sew")};
  m.steps[0].sew["string"] = .05;
  return s;
}

// Sum over all nodes of what the suture does, told apart by the nodes' places.
std::array<double, 2> figures(Problem& problem, const Interactions& interactions) {
  const State state = problem.initial_state();
  problem.begin_step(0, state);
  problem.set_progress(1, const_cast<State&>(state));
  std::vector<double> force(state.x.size()), reference_force(problem.mesh().nodes());
  interactions.suture("string", "").add_residual(state, force, reference_force);
  problem.mesh().halo.accumulate_ghosts(force);
  std::array<double, 2> sums{};
  for (int n = 0; n < problem.mesh().owned; ++n)
    for (int c = 0; c < 3; ++c) {
      sums[0] += force[3 * n + c] * state.x[3 * n + c];
      sums[1] += force[3 * n + c] * std::sin(7 * state.x[3 * n] + 11 * state.x[3 * n + 1] + c);
    }
  problem.comm().sum(sums);
  return sums;
}

TEST(Refinement, OperationsAreThoseOnTheWholeMesh) {
  const Scene scene = sewn_shell();
  Problem parts(refined(scene.mesh, 1), scene.model, Comm());
  const Mesh fine = refine(scene.mesh).mesh;
  Problem whole(fine, scene.model, Comm(MPI_COMM_SELF));
  const auto found = Interactions::attach(parts, scene.mesh), wanted = Interactions::attach(whole, fine);
  EXPECT_EQ(found->contacts()[0].thickness, wanted->contacts()[0].thickness);
  EXPECT_EQ(found->contacts()[0].penalty, wanted->contacts()[0].penalty);
  EXPECT_EQ(found->contacts()[0].farthest, wanted->contacts()[0].farthest);
  const auto a = figures(parts, *found), b = figures(whole, *wanted);
  for (int i = 0; i < 2; ++i) {
    EXPECT_NE(b[i], 0);
    EXPECT_NEAR(a[i], b[i], 1e-12);
  }
}

TEST(Refinement, ARehearsedProblemIsAsNew) {
  const Scene scene = sewn_shell();
  const auto figures_of = [&](bool rehearsed) {
    Problem problem(refined(scene.mesh, 1), scene.model, Comm());
    if (rehearsed) {
      const auto interactions = Interactions::attach(problem, scene.mesh);
      problem.rehearse(1);
      EXPECT_TRUE(problem.added().empty());
      EXPECT_EQ(problem.progress(), 0);
    }
    const auto interactions = Interactions::attach(problem, scene.mesh);
    return figures(problem, *interactions);
  };
  EXPECT_EQ(figures_of(true), figures_of(false));
}

}  // namespace
}  // namespace bulbus
