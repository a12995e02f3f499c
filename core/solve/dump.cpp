#include "core/solve/dump.hpp"

#include <hdf5.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <numeric>
#include <stdexcept>

#include "core/base/error.hpp"
#include "core/io/hdf5_file.hpp"
#include "core/io/output.hpp"

namespace bulbus::inline solve {
namespace {

/// An HDF5 identifier with its closing function.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }
  bool ok() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

hid_t type_of(int) { return H5T_NATIVE_INT; }
hid_t type_of(double) { return H5T_NATIVE_DOUBLE; }
hid_t type_of(UnknownKind) { return H5T_NATIVE_UCHAR; }

void need(bool ok, const std::string& path, const std::string& what) {
  if (!ok) throw input_error(path, 0, what, "is the folder there, and is it a file of a linear system?");
}

/// HDF5 shall not print what becomes an exception.
void silence() { H5Eset_auto(H5E_DEFAULT, nullptr, nullptr); }

/// The ranks' parts one after another into a dataset that has their length.
template <class T>
bool fill(const Handle& set, const Handle& space, std::span<const T> part, const Comm& comm) {
  const hsize_t count = part.size(), first = comm.offset(static_cast<long long>(part.size()));
  Handle memory(H5Screate_simple(1, &count, nullptr), H5Sclose);
  if (count > 0)
    H5Sselect_hyperslab(space, H5S_SELECT_SET, &first, nullptr, &count, nullptr);
  else
    H5Sselect_none(space), H5Sselect_none(memory);
  Handle collective(H5Pcreate(H5P_DATASET_XFER), H5Pclose);
  H5Pset_dxpl_mpio(collective, H5FD_MPIO_COLLECTIVE);
  return comm.all(H5Dwrite(set, type_of(T{}), memory, space, collective, part.data()) >= 0);
}

template <class T>
bool write(hid_t file, const char* name, const std::vector<T>& part, const Comm& comm) {
  const hsize_t total = comm.sum(static_cast<long long>(part.size()));
  Handle space(H5Screate_simple(1, &total, nullptr), H5Sclose);
  Handle set(H5Dcreate(file, name, type_of(T{}), space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose);
  if (!set.ok() || total == 0) return set.ok();
  return fill(set, space, std::span<const T>(part), comm);
}

/// The same in rows of so many numbers.
void write_table(hid_t file, const char* name, const std::vector<double>& part, int columns,
                 const Comm& comm) {
  hdf5::write_rows(file, name, std::span<const double>(part), columns, comm);
}

/// Over what the file holds.
bool overwrite(hid_t file, const char* name, std::span<const double> part, const Comm& comm) {
  Handle set(H5Dopen(file, name, H5P_DEFAULT), H5Dclose);
  if (!comm.all(set.ok())) return false;
  Handle space(H5Dget_space(set), H5Sclose);
  return fill(set, space, part, comm);
}

template <class T>
std::vector<T> read(hid_t file, const char* name, const std::string& path) {
  Handle set(H5Dopen(file, name, H5P_DEFAULT), H5Dclose);
  need(set.ok(), path, std::string("no dataset ") + name);
  Handle space(H5Dget_space(set), H5Sclose);
  std::vector<T> all(H5Sget_simple_extent_npoints(space));
  bool ok = all.empty() || H5Dread(set, type_of(T{}), H5S_ALL, H5S_ALL, H5P_DEFAULT, all.data()) >= 0;
  need(ok, path, std::string("cannot read ") + name);
  return all;
}

/// Nothing where a file does not have it.
std::vector<double> read_if_there(hid_t file, const char* name, const std::string& path) {
  return H5Lexists(file, name, H5P_DEFAULT) > 0 ? read<double>(file, name, path) : std::vector<double>();
}

/// All ranks must write the same: the first one's.
std::map<std::string, double> agreed(const std::map<std::string, double>& mine, const Comm& comm) {
  std::string names;
  std::vector<double> values;
  for (const auto& [name, value] : mine) names += name + '\n', values.push_back(value);
  int lengths[2] = {static_cast<int>(names.size()), static_cast<int>(values.size())};
  MPI_Bcast(lengths, 2, MPI_INT, 0, comm.raw());
  names.resize(lengths[0]), values.resize(lengths[1]);
  MPI_Bcast(names.data(), lengths[0], MPI_CHAR, 0, comm.raw());
  comm.broadcast(values);
  std::map<std::string, double> result;
  std::size_t at = 0;
  for (double value : values) {
    std::size_t end = names.find('\n', at);
    result[names.substr(at, end - at)] = value;
    at = end + 1;
  }
  return result;
}

bool write_attribute(hid_t file, const std::string& name, double value) {
  Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  Handle attribute(H5Acreate(file, name.c_str(), H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT),
                   H5Aclose);
  return attribute.ok() && H5Awrite(attribute, H5T_NATIVE_DOUBLE, &value) >= 0;
}

bool overwrite_attribute(hid_t file, const std::string& name, double value) {
  Handle attribute(H5Aopen(file, name.c_str(), H5P_DEFAULT), H5Aclose);
  return attribute.ok() && H5Awrite(attribute, H5T_NATIVE_DOUBLE, &value) >= 0;
}

herr_t read_attribute(hid_t file, const char* name, const H5A_info_t*, void* into) {
  Handle attribute(H5Aopen(file, name, H5P_DEFAULT), H5Aclose);
  double value = 0;
  if (!attribute.ok() || H5Aread(attribute, H5T_NATIVE_DOUBLE, &value) < 0) return -1;
  (*static_cast<std::map<std::string, double>*>(into))[name] = value;
  return 0;
}

/// A part that may be left out: so many numbers per unknown on every rank, or none on any.
bool all_or_none(const std::vector<double>& part, std::size_t numbers, const Comm& comm) {
  return comm.all(part.size() == numbers) || comm.all(part.empty());
}

void check(const SystemDump& d, const Comm& comm) {
  const std::size_t n = d.rhs.size();
  const bool fits = d.matrix.row.size() == d.matrix.col.size() &&
                    d.matrix.row.size() == d.matrix.value.size() && d.kind.size() == n;
  const bool optional = all_or_none(d.scaling, n, comm) & all_or_none(d.coordinates, 3 * n, comm) &
                        all_or_none(d.near_null_space, 6 * n, comm) & all_or_none(d.solution, n, comm);
  if (comm.any(!fits || !optional))
    throw std::invalid_argument("write_system: the parts of the system differ in length");
}

std::unique_ptr<std::FILE, int (*)(std::FILE*)> open_text(const std::string& path) {
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "w"), std::fclose);
  need(file != nullptr, path, "cannot be written");
  return file;
}

/// Refuses a file that is not whole, as on a full disk.
void close_text(std::unique_ptr<std::FILE, int (*)(std::FILE*)> file, const std::string& path) {
  const bool whole = std::ferror(file.get()) == 0;
  need((std::fclose(file.release()) == 0) & whole, path, "cannot be written to its end");
}

/// `system_rhs.mtx` of `system.mtx`.
std::string named(const std::string& path, const std::string& what) {
  std::filesystem::path p(path);
  return p.replace_filename(p.stem().string() + "_" + what + p.extension().string()).string();
}

/// Sorted by column and row, duplicates added.
Triplets compressed(const Triplets& t) {
  std::vector<std::size_t> order(t.row.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  auto key = [&](std::size_t k) { return std::pair(t.col[k], t.row[k]); };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  Triplets r;
  for (std::size_t k : order)
    if (!r.row.empty() && key(k) == std::pair(r.col.back(), r.row.back()))
      r.value.back() += t.value[k];
    else
      r.row.push_back(t.row[k]), r.col.push_back(t.col[k]), r.value.push_back(t.value[k]);
  return r;
}

}  // namespace

void write_system(const std::string& path, const SystemDump& part, const Comm& comm) {
  check(part, comm);
  const double bytes = 16. * part.matrix.row.size() + (17 + 8. * (3 + 6 + 1)) * part.rhs.size();
  hdf5::write_whole(path, comm, comm.sum(bytes), [&](hid_t file) {
    bool ok = write(file, "row", part.matrix.row, comm) & write(file, "col", part.matrix.col, comm) &
              write(file, "value", part.matrix.value, comm) & write(file, "rhs", part.rhs, comm) &
              write(file, "kind", part.kind, comm) & write(file, "scaling", part.scaling, comm);
    write_table(file, "coordinates", part.coordinates, 3, comm);
    write_table(file, "near_null_space", part.near_null_space, 6, comm);
    write_table(file, "solution", part.solution, 0, comm);
    for (const auto& [name, value] : agreed(part.attributes, comm)) ok &= write_attribute(file, name, value);
    if (!comm.all(ok)) throw std::runtime_error(path + ": cannot be written");
  });
}

void write_solution(const std::string& path, std::span<const double> part,
                    const std::map<std::string, double>& attributes, const Comm& comm) {
  const hdf5::Quiet quiet;
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_mpio(access, comm.raw(), MPI_INFO_NULL);
  bool ok = false;
  {
    Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, access), H5Fclose);
    if (comm.all(file.ok())) {
      ok = overwrite(file, "solution", part, comm);
      for (const auto& [name, value] : agreed(attributes, comm)) ok &= overwrite_attribute(file, name, value);
    }
  }
  if (!comm.all(ok)) throw OutputError(path + ": the solution cannot be written");
}

SystemDump read_system(const std::string& path) {
  silence();
  Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  need(file.ok(), path, "cannot be read");
  SystemDump d;
  d.matrix = {read<int>(file, "row", path), read<int>(file, "col", path), read<double>(file, "value", path)};
  d.rhs = read<double>(file, "rhs", path);
  d.kind = read<UnknownKind>(file, "kind", path);
  d.scaling = read<double>(file, "scaling", path);
  d.coordinates = read_if_there(file, "coordinates", path);
  d.near_null_space = read_if_there(file, "near_null_space", path);
  d.solution = read_if_there(file, "solution", path);
  bool ok = H5Aiterate(file, H5_INDEX_NAME, H5_ITER_INC, nullptr, read_attribute, &d.attributes) >= 0;
  need(ok, path, "cannot read the attributes");
  return d;
}

std::vector<std::string> write_matrix_market(const std::string& path, const SystemDump& whole) {
  Triplets m = compressed(whole.matrix);
  std::size_t n = whole.rhs.size();
  std::vector<std::string> written{path};
  auto matrix = open_text(path);
  std::fprintf(matrix.get(), "%%%%MatrixMarket matrix coordinate real general\n");
  for (const auto& [attribute, value] : whole.attributes)
    std::fprintf(matrix.get(), "%% %s %.17g\n", attribute.c_str(), value);
  std::fprintf(matrix.get(), "%zu %zu %zu\n", n, n, m.row.size());
  for (std::size_t k = 0; k < m.row.size(); ++k)
    std::fprintf(matrix.get(), "%d %d %.17g\n", m.row[k] + 1, m.col[k] + 1, m.value[k]);
  close_text(std::move(matrix), path);
  // `columns` numbers per unknown; the format wants column by column.
  const auto write_array = [&](const std::string& what, const auto& values, std::size_t columns) {
    if (values.empty()) return;
    const std::string& name = written.emplace_back(named(path, what));
    auto file = open_text(name);
    std::fprintf(file.get(), "%%%%MatrixMarket matrix array real general\n%zu %zu\n", n, columns);
    for (std::size_t c = 0; c < columns; ++c)
      for (std::size_t i = 0; i < n; ++i)
        std::fprintf(file.get(), "%.17g\n", static_cast<double>(values[columns * i + c]));
    close_text(std::move(file), name);
  };
  write_array("rhs", whole.rhs, 1);
  write_array("solution", whole.solution, 1);
  write_array("scaling", whole.scaling, 1);
  write_array("kind", whole.kind, 1);
  write_array("coordinates", whole.coordinates, 3);
  write_array("near_null_space", whole.near_null_space, 6);
  return written;
}

}  // namespace bulbus::inline solve
