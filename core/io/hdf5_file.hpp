#pragma once
#include <hdf5.h>

#include <functional>
#include <span>
#include <string>

#include "core/base/parallel.hpp"

/// A thin layer over parallel HDF5; included by the writers of this folder only. Everything is collective and
/// throws std::runtime_error.
namespace bulbus::inline io::hdf5 {

/// An identifier that closes itself.
class Handle {
 public:
  /// Throws, naming `what`, if HDF5 gave no identifier.
  Handle(hid_t id, herr_t (*close)(hid_t), const std::string& what);
  ~Handle() { close_(id_); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// Keeps HDF5 from printing its error stack while it lives.
class Quiet {
 public:
  Quiet();
  ~Quiet();
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

void check(herr_t status, const std::string& what);

/// Writes a new file on all ranks that is whole or not there: `write` fills it under a temporary name, with
/// at most `bytes` of all ranks' data, for which room is taken before. Throws OutputError on every rank.
void write_whole(const std::string& path, const Comm& comm, double bytes,
                 const std::function<void(hid_t)>& write);

template <class T>
hid_t type_of();
template <>
inline hid_t type_of<double>() {
  return H5T_NATIVE_DOUBLE;
}
template <>
inline hid_t type_of<float>() {
  return H5T_NATIVE_FLOAT;
}
template <>
inline hid_t type_of<long long>() {
  return H5T_NATIVE_LLONG;
}
template <>
inline hid_t type_of<unsigned char>() {
  return H5T_NATIVE_UCHAR;
}

/// A dataset of rows, the ranks' rows one below the other; with `columns` 0 it has one dimension.
void write_rows(hid_t group, const std::string& name, hid_t type, const void* data, long long rows,
                int columns, const Comm& comm);

template <class T>
void write_rows(hid_t group, const std::string& name, std::span<const T> values, int columns,
                const Comm& comm) {
  const long long rows = static_cast<long long>(values.size()) / (columns ? columns : 1);
  write_rows(group, name, type_of<T>(), values.data(), rows, columns, comm);
}

}  // namespace bulbus::inline io::hdf5
