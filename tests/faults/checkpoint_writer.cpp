// Writes one checkpoint after the other to the file that is named, until it is killed: every place holds the
// number of the checkpoint.
#include "core/base/parallel.hpp"
#include "core/io/checkpoint.hpp"
#include "core/mesh/distributed/partition.hpp"
#include "core/mesh/generate/generate.hpp"

using namespace bulbus;

int main(int argc, char** argv) {
  const Session session(argc, argv);
  if (argc != 2) return 2;
  const Mesh block = generate(BlockShape{.nx = 24, .ny = 24, .nz = 24});
  const LocalMesh mesh = distribute(block, partition(block, 1), Comm(MPI_COMM_SELF));
  for (double k = 1;; ++k) {
    std::vector<double> x(mesh.X.size(), k);
    write_checkpoint(argv[1], mesh, [&](Archive& archive) {
      archive.scalars("number", k);
      archive.nodes("x", x);
    });
  }
}
