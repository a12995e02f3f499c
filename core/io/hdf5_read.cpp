#include "core/io/hdf5_read.hpp"

#include "core/io/hdf5_file.hpp"

namespace bulbus::inline io {

std::vector<double> read_dataset(const std::string& path, const std::string& dataset) {
  using hdf5::Handle;
  const hdf5::Quiet quiet;
  const std::string fault = path + ": the dataset " + dataset + " cannot be read";
  Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, path + ": cannot be read");
  Handle set(H5Dopen2(file, dataset.c_str(), H5P_DEFAULT), H5Dclose, fault);
  Handle space(H5Dget_space(set), H5Sclose, fault);
  std::vector<double> values(H5Sget_simple_extent_npoints(space));
  hdf5::check(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), fault);
  return values;
}

}  // namespace bulbus::inline io
