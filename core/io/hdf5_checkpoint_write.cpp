#include <algorithm>
#include <set>

#include "core/io/checkpoint.hpp"
#include "core/io/checkpoint_sum.hpp"
#include "core/io/hdf5_file.hpp"

namespace bulbus::inline io {
namespace {

using hdf5::Handle;

class Writer final : public Archive {
 public:
  Writer(hid_t file, const LocalMesh& mesh) : Archive(mesh), comm_(mesh.comm), file_(file) {}

  bool reading() const override { return false; }
  bool knows(const std::string&) const override { return true; }
  void numbers(const std::string& name, std::vector<double>& values) override {
    write_first(path_of(name), std::span<const double>(values));
  }
  void text(const std::string& name, std::string& value) override {
    write_first(path_of(name), std::span(reinterpret_cast<const unsigned char*>(value.data()), value.size()));
  }
  void rows(const std::string& name, const Keys& keys, int width, std::vector<double>& values) override {
    write_keys(path_of(name) + "/key", keys);
    write(path_of(name) + "/value", std::span<const double>(of_mine(keys, width, values)), width);
  }
  void mesh_table(const std::string& name, const std::string& of, const Keys& keys, int width,
                  std::vector<double>& values) override {
    if (kept_.insert(of).second) write_keys(of, keys);
    write(path_of(name), std::span<const double>(of_mine(keys, width, values)), width);
  }
  // What makes the file complete.
  void finish() {
    const long long sum = comm_.sum(sum_.value()) & static_cast<long long>(CheckpointSum::bits);
    write_first("sum", std::span(&sum, 1));
  }

 private:
  static std::vector<double> of_mine(const Keys& keys, int width, const std::vector<double>& values) {
    std::vector<double> mine;
    for (std::size_t i = 0; i < keys.keys.size(); ++i)
      if (keys.mine[i]) mine.insert(mine.end(), values.begin() + width * i, values.begin() + width * (i + 1));
    return mine;
  }
  void write_keys(const std::string& name, const Keys& keys) {
    std::vector<long long> mine;
    for (std::size_t i = 0; i < keys.keys.size(); ++i)
      if (keys.mine[i]) mine.push_back(keys.keys[i]);
    write(name, std::span<const long long>(mine), 0);
  }
  template <class T>
  void write_first(const std::string& name, std::span<const T> values) {
    write(name, comm_.rank() == 0 ? values : std::span<const T>{}, 0);
  }
  template <class T>
  void write(const std::string& name, std::span<const T> values, int columns) {
    for (auto slash = name.find('/'); slash != std::string::npos; slash = name.find('/', slash + 1))
      if (groups_.insert(name.substr(0, slash)).second)
        Handle(H5Gcreate2(file_, name.substr(0, slash).c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
               H5Gclose, name);
    sum_.add(name, comm_.offset(static_cast<long long>(values.size())), values);
    hdf5::write_rows(file_, name, values, columns, comm_);
  }

  Comm comm_;
  hid_t file_;
  CheckpointSum sum_;
  std::set<std::string> kept_, groups_;
};

/// Keeps nothing, but adds up the bytes of this rank.
class Measure final : public Archive {
 public:
  explicit Measure(const LocalMesh& mesh) : Archive(mesh) {}
  bool reading() const override { return false; }
  bool knows(const std::string&) const override { return true; }
  void numbers(const std::string&, std::vector<double>& values) override {
    add(values.size() * sizeof(double));
  }
  void text(const std::string&, std::string& value) override { add(value.size()); }
  void rows(const std::string&, const Keys& keys, int width, std::vector<double>&) override {
    add_rows(keys, width);
  }
  void mesh_table(const std::string&, const std::string&, const Keys& keys, int width,
                  std::vector<double>&) override {
    add_rows(keys, width);
  }
  double bytes() const { return bytes_; }

 private:
  static constexpr double header = 4096;  // of a dataset and the groups around it
  void add_rows(const Keys& keys, int width) {
    add(static_cast<double>(std::ranges::count(keys.mine, 1)) * (width + 1) * sizeof(double));
  }
  void add(double bytes) { bytes_ += bytes + header; }

  double bytes_ = 0;
};

}  // namespace

void write_checkpoint(const std::string& path, const LocalMesh& mesh,
                      const std::function<void(Archive&)>& serialize) {
  Measure measure(mesh);
  serialize(measure);
  hdf5::write_whole(path, mesh.comm, mesh.comm.sum(measure.bytes()), [&](hid_t file) {
    Writer writer(file, mesh);
    serialize(writer);
    writer.finish();
  });
}

}  // namespace bulbus::inline io
