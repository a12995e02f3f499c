#include "contact/coarse_slaves.hpp"

#include <fmt/format.h>

#include "core/base/tensor.hpp"
#include "core/mesh/geometry.hpp"

namespace bulbus::inline contact {
namespace {

// Of a slave's face over a master's. Blocks of 2 and 3 faces a side, squeezed by a sixth, lose 2 % of the
// force with the finer one as the slave and 11 % with the coarser.
constexpr double coarse = 1.5;

// mm²
double mean_face(const Mesh& mesh, const std::vector<Quad>& faces) {
  double sum = 0;
  for (const Quad& q : faces) {
    const auto x = corners(mesh, q);
    sum += norm(cross(x[2] - x[0], x[3] - x[1])) / 2;
  }
  return sum / static_cast<double>(faces.size());
}

}  // namespace

std::vector<std::string> coarse_slaves(const Mesh& mesh, const Model& model) {
  std::vector<std::string> sentences;
  for (const ContactSpec& c : model.contacts) {
    const auto slave = mesh.surfaces.find(c.slave), master = mesh.surfaces.find(c.master);
    if (c.two_way || c.divisions > 0 || slave == mesh.surfaces.end() || master == mesh.surfaces.end())
      continue;
    if (slave->second.empty() || master->second.empty()) continue;
    const double ratio = mean_face(mesh, slave->second) / mean_face(mesh, master->second);
    if (ratio > coarse)
      sentences.push_back(fmt::format(
          "the faces of '{}', the slave of contact '{}', are {:.2g} times as large as those of its master "
          "'{}', "
          "whose nodes come in between the slave's: the force is too small. Exchange the two, or give the "
          "contact `two_way: true`",
          c.slave, c.name, ratio, c.master));
  }
  return sentences;
}

}  // namespace bulbus::inline contact
