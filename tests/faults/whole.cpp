// Exit status 0 if every result file that is named can be read from end to end.
#include <cmath>
#include <exception>
#include <iostream>

#include "core/io/hdf5_read.hpp"

namespace {

// Throws if the file is not whole.
void read(const std::string& path) {
  const auto points = bulbus::read_dataset(path, "VTKHDF/Points");
  const auto corners = bulbus::read_dataset(path, "VTKHDF/Connectivity");
  const auto displacement = bulbus::read_dataset(path, "VTKHDF/PointData/displacement");
  const auto mises = bulbus::read_dataset(path, "VTKHDF/CellData/mises");
  if (points.empty() || displacement.size() != points.size() || 8 * mises.size() != corners.size())
    throw std::runtime_error(path + ": sizes that do not fit each other");
  double sum = 0;
  for (double c : corners) sum += c;
  for (double m : mises)
    if (!std::isfinite(m) || m < 0) throw std::runtime_error(path + ": a stress that cannot be");
  if (sum == 0) throw std::runtime_error(path + ": a hole where the mesh should be");
}

}  // namespace

int main(int argc, char** argv) {
  try {
    for (int i = 1; i < argc; ++i) read(argv[i]);
  } catch (const std::exception& fault) {
    std::cerr << fault.what() << std::endl;
    return 1;
  }
}
