#include <algorithm>
#include <numeric>
#include <type_traits>

#include "core/base/error.hpp"
#include "core/io/checkpoint.hpp"
#include "core/io/checkpoint_sum.hpp"
#include "core/io/hdf5_file.hpp"

namespace bulbus::inline io {
namespace {

using hdf5::Handle;

constexpr hsize_t block = 1 << 16;  // rows read at once: no rank holds the whole of a large table

InputError damaged(const std::string& path) {
  return input_error(path + ": no whole checkpoint: damaged, or another kind of file",
                     "Restart from another, or run without --restart.");
}

/// A dataset that is read in runs of rows.
class Table {
 public:
  Table(hid_t file, const std::string& name)
      : set_(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose, name),
        space_(H5Dget_space(set_), H5Sclose, name) {
    hsize_t size[2] = {1, 1};  // a list is a table of one column
    if (H5Sget_simple_extent_ndims(space_) > 2) throw std::runtime_error(name);
    H5Sget_simple_extent_dims(space_, size, nullptr);
    rows_ = size[0], width_ = size[1];
    refuse_claim(name);
  }
  hsize_t rows() const { return rows_; }
  hsize_t width() const { return width_; }
  template <class T>
  std::vector<T> read(hsize_t first, hsize_t count) const {
    const hsize_t start[2] = {first, 0}, size[2] = {count, width_};
    std::vector<T> values(count * width_);
    if (values.empty()) return values;
    hdf5::check(H5Sselect_hyperslab(space_, H5S_SELECT_SET, start, nullptr, size, nullptr), "selection");
    Handle memory(H5Screate_simple(H5Sget_simple_extent_ndims(space_), size, nullptr), H5Sclose, "selection");
    hdf5::check(H5Dread(set_, hdf5::type_of<T>(), memory, space_, H5P_DEFAULT, values.data()),
                "rows cannot be read");
    return values;
  }
  template <class T>
  std::vector<T> all() const {
    return read<T>(0, rows_);
  }
  template <class T, class Visit>
  void in_blocks(Visit visit) const {
    for (hsize_t first = 0; first < rows_; first += block)
      visit(first, read<T>(first, std::min(block, rows_ - first)));
  }
  H5T_class_t kind() const { return H5Tget_class(Handle(H5Dget_type(set_), H5Tclose, "type")); }
  std::size_t bytes() const { return H5Tget_size(Handle(H5Dget_type(set_), H5Tclose, "type")); }

 private:
  // Tables are stored as they are: damaged ones may claim more numbers than a file can hold.
  void refuse_claim(const std::string& name) const {
    hsize_t held = 0;
    hdf5::check(H5Fget_filesize(Handle(H5Iget_file_id(set_), H5Fclose, name), &held), name);
    const double rows = static_cast<double>(rows_), most = static_cast<double>(held);
    if (rows > most || rows * static_cast<double>(width_) * static_cast<double>(bytes()) > most)
      throw std::runtime_error(name);
  }

  Handle set_, space_;
  hsize_t rows_ = 0, width_ = 0;
};

template <class T>
void add_to(CheckpointSum& sum, const std::string& name, const Table& table) {
  table.in_blocks<T>([&](hsize_t first, const std::vector<T>& values) {
    sum.add(name, static_cast<long long>(first * table.width()), std::span<const T>(values));
  });
}

std::vector<std::string> datasets(hid_t file) {
  std::vector<std::string> names;
  const auto see = [](hid_t, const char* name, const H5O_info_t* info, void* all) -> herr_t {
    if (info->type == H5O_TYPE_DATASET) static_cast<std::vector<std::string>*>(all)->emplace_back(name);
    return 0;
  };
  hdf5::check(H5Ovisit(file, H5_INDEX_NAME, H5_ITER_NATIVE, see, &names), "datasets cannot be listed");
  return names;
}

void prove_whole(hid_t file) {
  CheckpointSum sum;
  for (const std::string& name : datasets(file)) {
    if (name == "sum") continue;
    const Table table(file, name);
    if (table.kind() == H5T_FLOAT)
      add_to<double>(sum, name, table);
    else if (table.bytes() == 1)
      add_to<unsigned char>(sum, name, table);
    else
      add_to<long long>(sum, name, table);
  }
  if (Table(file, "sum").all<long long>().at(0) != sum.value())
    throw std::runtime_error("the check sum differs");
}

class Reader final : public Archive {
 public:
  Reader(const std::string& path, const LocalMesh& mesh)
      : Archive(mesh),
        path_(path),
        file_(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, path) {
    if (mesh.comm.rank() == 0) prove_whole(file_);
  }

  bool reading() const override { return true; }
  bool knows(const std::string& name) const override {
    return H5Lexists(file_, path_of(name).c_str(), H5P_DEFAULT) > 0;
  }
  void numbers(const std::string& name, std::vector<double>& values) override {
    values = whole([&] { return Table(file_, path_of(name)).all<double>(); });
  }
  void text(const std::string& name, std::string& value) override {
    const auto letters = whole([&] { return Table(file_, path_of(name)).all<unsigned char>(); });
    value.assign(letters.begin(), letters.end());
  }
  void rows(const std::string& name, const Keys& keys, int width, std::vector<double>& values) override {
    if (knows(name))
      whole([&] { return fill(path_of(name) + "/key", path_of(name) + "/value", keys, width, values); });
  }
  void mesh_table(const std::string& name, const std::string& of, const Keys& keys, int width,
                  std::vector<double>& values) override {
    if (whole([&] { return fill(of, path_of(name), keys, width, values); }) != keys.keys.size())
      throw input_error(path_ + ": it is of another mesh", "Restart with the scene that wrote it.");
  }

 private:
  // What the sum does not show: a table that is none any more.
  template <class Read>
  std::invoke_result_t<Read> whole(Read read) const {
    const hdf5::Quiet quiet;
    try {
      return read();
    } catch (const InputError&) {
      throw;
    } catch (const std::exception&) {
      throw damaged(path_);
    }
  }
  // The number of keys that were found.
  std::size_t fill(const std::string& key, const std::string& value, const Keys& keys, int width,
                   std::vector<double>& values) {
    const Table all_keys(file_, key), table(file_, value);
    if (table.width() != static_cast<hsize_t>(width) || table.rows() != all_keys.rows()) throw damaged(path_);
    values.resize(keys.keys.size() * width);
    std::vector<int> order(keys.keys.size());
    std::iota(order.begin(), order.end(), 0);
    const auto key_at = [&](int i) { return keys.keys[i]; };
    std::ranges::sort(order, {}, key_at);
    std::size_t found = 0;
    table.in_blocks<double>([&](hsize_t first, const std::vector<double>& rows) {
      const auto its_keys = all_keys.read<long long>(first, rows.size() / width);
      for (std::size_t r = 0; r < its_keys.size(); ++r) {
        const auto at = std::ranges::lower_bound(order, its_keys[r], {}, key_at);
        if (at == order.end() || keys.keys[*at] != its_keys[r]) continue;
        std::copy_n(rows.begin() + r * width, width, values.begin() + static_cast<std::size_t>(*at) * width);
        ++found;
      }
    });
    return found;
  }

  std::string path_;
  Handle file_;
};

}  // namespace

std::unique_ptr<Archive> open_checkpoint(const std::string& path, const LocalMesh& mesh) {
  std::unique_ptr<Archive> reader;
  mesh.comm.together([&] {
    const hdf5::Quiet quiet;
    try {
      reader = std::make_unique<Reader>(path, mesh);
    } catch (const std::exception&) {
      throw damaged(path);
    }
  });
  return reader;
}

}  // namespace bulbus::inline io
