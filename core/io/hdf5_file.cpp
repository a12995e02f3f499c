#include "core/io/hdf5_file.hpp"

#include <array>
#include <stdexcept>

namespace bulbus::hdf5 {

Handle::Handle(hid_t id, herr_t (*close)(hid_t), const std::string& what) : id_(id), close_(close) {
  if (id < 0) throw std::runtime_error(what);
}

Quiet::Quiet() {
  H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}
Quiet::~Quiet() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }

void check(herr_t status, const std::string& what) {
  if (status < 0) throw std::runtime_error(what);
}

void write_rows(hid_t group, const std::string& name, hid_t type, const void* data, long long rows,
                int columns, const Comm& comm) {
  using Size = std::array<hsize_t, 2>;
  const auto width = static_cast<hsize_t>(columns ? columns : 1);
  const Size whole{static_cast<hsize_t>(comm.sum(rows)), width};
  const Size start{static_cast<hsize_t>(comm.offset(rows)), 0}, count{static_cast<hsize_t>(rows), width};
  const int rank = columns ? 2 : 1;
  const std::string fault = "dataset " + name + " cannot be written";

  Handle file_space(H5Screate_simple(rank, whole.data(), nullptr), H5Sclose, fault);
  Handle set(H5Dcreate2(group, name.c_str(), type, file_space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
             H5Dclose, fault);
  if (whole[0] == 0) return;
  Handle memory_space(H5Screate_simple(rank, count.data(), nullptr), H5Sclose, fault);
  if (rows > 0)
    check(H5Sselect_hyperslab(file_space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr),
          fault);
  else  // an empty hyperslab is no selection that HDF5 accepts
    check(H5Sselect_none(file_space) | H5Sselect_none(memory_space), fault);
  Handle transfer(H5Pcreate(H5P_DATASET_XFER), H5Pclose, fault);
  check(H5Pset_dxpl_mpio(transfer, H5FD_MPIO_COLLECTIVE), fault);
  check(H5Dwrite(set, type, memory_space, file_space, transfer, data), fault);
}

hid_t create(const std::string& path, const Comm& comm) {
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, not_created);
  check(H5Pset_fapl_mpio(access, comm.raw(), MPI_INFO_NULL), not_created);
  return H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
}

void write_whole(const std::string& path, const Comm& comm, const std::function<void(const std::string&)>& write,
                 void (*place)(const std::string&, const std::string&)) {
  const Quiet quiet;
  const std::string temporary = path + ".tmp";
  std::string fault;
  try {
    write(temporary);
  } catch (const std::runtime_error& e) {
    fault = e.what();
  }
  const bool failed = comm.any(!fault.empty());
  try {
    if (comm.rank() == 0 && failed) std::remove(temporary.c_str());
    if (comm.rank() == 0 && !failed) place(temporary, path);
  } catch (const std::runtime_error& e) {
    fault = e.what();
  }
  if (comm.any(!fault.empty())) throw std::runtime_error(path + ": " + (fault.empty() ? "not written" : fault));
}

}  // namespace bulbus::hdf5
