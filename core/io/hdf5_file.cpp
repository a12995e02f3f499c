#include "core/io/hdf5_file.hpp"

#include <array>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include "core/io/disk_file.hpp"
#include "core/io/output.hpp"
#include "core/io/text_file.hpp"

namespace bulbus::inline io::hdf5 {

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
  const herr_t written = H5Dwrite(set, type, memory_space, file_space, transfer, data);
  if (comm.any(written < 0)) throw std::runtime_error(fault + " (a full disk?)");
}

namespace {

bool any_left_open = false;

// What HDF5 writes besides the data: headers, groups and their names.
constexpr long long overhead = 1 << 16;

// To be closed with H5Pclose.
hid_t access_of(MPI_Comm comm) {
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_fapl_mpio(access, comm, MPI_INFO_NULL);
  return access;
}

// HDF5 cannot get rid of a file that it cannot write: so there has to be room for all of it before the first
// byte.
void reserve(const std::string& path, long long bytes, DiskFile::Start start, const Comm& comm) {
  write_together(comm, [&] {
    if (comm.rank() == 0) DiskFile(path, start).reserve(bytes);
  });
}

void prove_readable(const std::string& path) {
  const Handle access(access_of(MPI_COMM_SELF), H5Pclose, path);  // which needs no lock of the file
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, access);
  if (file < 0 || H5Fclose(file) < 0)
    throw std::runtime_error(path + ": what was written cannot be read again");
}

// A file that could not be written stays open: to close it, ranks would wait for each other.
void write_and_close(const std::string& path, const Comm& comm, long long bytes,
                     const std::function<void(hid_t)>& write) {
  const Handle access(access_of(comm.raw()), H5Pclose, path);
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
  any_left_open = file >= 0;
  if (comm.any(file < 0)) throw OutputError(path + ": cannot be created");
  reserve(path, bytes, DiskFile::Start::end, comm);
  write_together(comm, [&] { write(file); });
  if (comm.any(H5Fclose(file) < 0)) throw OutputError(path + ": cannot be written to its end (a full disk?)");
  any_left_open = false;
}

// MPI's locks of this temporary file, which processes that were killed as they wrote it have left behind.
void remove_stale_locks(const std::filesystem::path& temporary) {
  std::error_code ignored;
  const std::string start = temporary.filename().string() + "-";
  std::vector<std::filesystem::path> stale;
  for (const auto& entry : std::filesystem::directory_iterator(temporary.parent_path(), ignored))
    if (entry.path().extension() == ".lock" && entry.path().filename().string().starts_with(start))
      stale.push_back(entry.path());
  for (const auto& lock : stale) std::filesystem::remove(lock, ignored);
}

}  // namespace

void write_whole(const std::string& path, const Comm& comm, double bytes,
                 const std::function<void(hid_t)>& write) {
  const Quiet quiet;
  const std::string temporary = path + ".tmp";
  const long long room = static_cast<long long>(bytes) + overhead;
  if (comm.rank() == 0) remove_stale_locks(temporary);
  try {
    reserve(temporary, room, DiskFile::Start::empty, comm);
    write_and_close(temporary, comm, room, write);
    write_together(comm, [&] {
      if (comm.rank() != 0) return;
      prove_readable(temporary);
      settle(temporary, path);
    });
  } catch (const OutputError&) {
    if (comm.rank() == 0) std::remove(temporary.c_str());
    throw;
  }
}

}  // namespace bulbus::inline io::hdf5

bool bulbus::files_left_open() { return hdf5::any_left_open; }
