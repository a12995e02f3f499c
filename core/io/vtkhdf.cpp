#include "core/io/vtkhdf.hpp"

#include <cmath>
#include <functional>
#include <stdexcept>

#include "core/io/hdf5_file.hpp"

namespace bulbus::inline io {
namespace {

using hdf5::Handle;

constexpr unsigned char vtk_hexahedron = 12;

bool all_finite(const Piece& piece) {
  for (const Point& p : piece.points)
    for (double x : p)
      if (!std::isfinite(x)) return false;
  return true;
}

// The first fault of a field, in words; empty if there is none.
std::string fault_of(const Field& field, std::size_t items) {
  if (field.components < 1 || field.values.size() != items * static_cast<std::size_t>(field.components))
    return "the field '" + field.name + "' has " + std::to_string(field.values.size()) + " values for " +
           std::to_string(items) + " items of " + std::to_string(field.components) + " components";
  const auto allowed = [&](float v) { return std::isfinite(v) || (field.sparse && std::isnan(v)); };
  for (std::size_t i = 0; i < field.values.size(); ++i)
    if (!allowed(static_cast<float>(field.values[i])))
      return "the field '" + field.name + "' is not finite at item " + std::to_string(i / field.components);
  return "";
}

std::string fault_of(const Piece& piece) {
  if (!all_finite(piece)) return "a point is not finite";
  for (const Field& f : piece.point_fields)
    if (std::string fault = fault_of(f, piece.points.size()); !fault.empty()) return fault;
  for (const Field& f : piece.cell_fields)
    if (std::string fault = fault_of(f, piece.hexes.size()); !fault.empty()) return fault;
  return "";
}

// Ranks that disagree on the fields would wait for each other for ever.
bool same_fields(const Piece& piece, const Comm& comm) {
  std::string names;
  for (const auto* fields : {&piece.point_fields, &piece.cell_fields}) {
    for (const Field& f : *fields) names += f.name + ":" + std::to_string(f.components) + "\n";
    names += "\n";
  }
  const auto hash = static_cast<double>(std::hash<std::string>{}(names));
  return comm.max(hash) == comm.min(hash);
}

void refuse_faults(const std::string& path, const Piece& piece, const Comm& comm) {
  const std::string fault = fault_of(piece);
  if (comm.any(!fault.empty()))
    throw std::runtime_error(path +
                             ": not written: " + (fault.empty() ? "another rank's piece is faulty" : fault));
  if (!same_fields(piece, comm)) throw std::runtime_error(path + ": not written: the ranks' fields differ");
}

void write_text_attribute(hid_t object, const std::string& name, const std::string& words) {
  const std::string fault = "the attribute " + name + " cannot be written";
  Handle text(H5Tcopy(H5T_C_S1), H5Tclose, fault);
  hdf5::check(H5Tset_size(text, words.size()), fault);
  hdf5::check(H5Tset_strpad(text, H5T_STR_NULLPAD), fault);
  Handle scalar(H5Screate(H5S_SCALAR), H5Sclose, fault);
  Handle attribute(H5Acreate2(object, name.c_str(), text, scalar, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, fault);
  hdf5::check(H5Awrite(attribute, text, words.data()), fault);
}

void write_attributes(hid_t root) {
  const std::string fault = "the version of VTKHDF cannot be written";
  const hsize_t two = 2;
  const int version[2] = {1, 0};
  Handle pair(H5Screate_simple(1, &two, nullptr), H5Sclose, fault);
  Handle number(H5Acreate2(root, "Version", H5T_NATIVE_INT, pair, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, fault);
  hdf5::check(H5Awrite(number, H5T_NATIVE_INT, version), fault);
  write_text_attribute(root, "Type", "UnstructuredGrid");
}

void write_count(hid_t root, const std::string& name, std::size_t count, const Comm& comm) {
  const auto n = static_cast<long long>(count);
  hdf5::write_rows(root, name, std::span(&n, 1), 0, comm);
}

void write_mesh(hid_t root, const Piece& piece, const Comm& comm) {
  const std::size_t cells = piece.hexes.size();
  write_count(root, "NumberOfPoints", piece.points.size(), comm);
  write_count(root, "NumberOfCells", cells, comm);
  write_count(root, "NumberOfConnectivityIds", 8 * cells, comm);
  const double* coordinates = piece.points.empty() ? nullptr : piece.points[0].data();
  hdf5::write_rows(root, "Points", std::span(coordinates, 3 * piece.points.size()), 3, comm);

  std::vector<long long> connectivity, offsets{0};
  for (const Hex& hex : piece.hexes) {
    connectivity.insert(connectivity.end(), hex.begin(), hex.end());
    offsets.push_back(static_cast<long long>(connectivity.size()));
  }
  const std::vector<unsigned char> types(cells, vtk_hexahedron);
  hdf5::write_rows(root, "Connectivity", std::span<const long long>(connectivity), 0, comm);
  hdf5::write_rows(root, "Offsets", std::span<const long long>(offsets), 0, comm);
  hdf5::write_rows(root, "Types", std::span<const unsigned char>(types), 0, comm);
}

void write_fields(hid_t root, const std::string& name, const std::vector<Field>& fields, const Comm& comm) {
  Handle group(H5Gcreate2(root, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, name);
  for (const Field& f : fields) {
    const std::vector<float> values(f.values.begin(), f.values.end());
    hdf5::write_rows(group, f.name, std::span<const float>(values), f.components == 1 ? 0 : f.components,
                     comm);
    if (f.unit.empty()) continue;
    Handle set(H5Dopen2(group, f.name.c_str(), H5P_DEFAULT), H5Dclose, f.name);
    write_text_attribute(set, "unit", f.unit);
  }
}

void write_labels(hid_t root, const std::vector<Label>& labels, const Comm& comm) {
  Handle group(H5Gcreate2(root, "FieldData", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, "FieldData");
  for (const Label& label : labels) {
    const long long value = label.value;
    hdf5::write_rows(group, label.name, std::span(&value, comm.rank() == 0 ? 1 : 0), 0, comm);
  }
}

// Of the numbers of a piece as they are written; a label is hardly more than the name of its dataset.
double bytes_of(const Piece& piece) {
  constexpr double label = 1024;
  constexpr double point = 3 * sizeof(double), hexahedron = 9 * sizeof(long long) + 1;
  double bytes = point * piece.points.size() + hexahedron * piece.hexes.size() + 4 * sizeof(long long) +
                 label * piece.labels.size();
  for (const auto* fields : {&piece.point_fields, &piece.cell_fields})
    for (const Field& f : *fields) bytes += sizeof(float) * f.values.size();
  return bytes;
}

void write_content(hid_t file, const Piece& piece, const Comm& comm) {
  Handle root(H5Gcreate2(file, "VTKHDF", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose,
              "the group VTKHDF cannot be made");
  write_attributes(root);
  write_mesh(root, piece, comm);
  write_fields(root, "PointData", piece.point_fields, comm);
  write_fields(root, "CellData", piece.cell_fields, comm);
  write_labels(root, piece.labels, comm);
}

}  // namespace

std::string safe_name(std::string name) {
  for (char& c : name)
    if (std::string("/<>&\"'").find(c) != std::string::npos) c = '_';
  return name;
}

void write_vtkhdf(const std::string& path, const Piece& piece, const Comm& comm) {
  refuse_faults(path, piece, comm);
  hdf5::write_whole(path, comm, comm.sum(bytes_of(piece)),
                    [&](hid_t file) { write_content(file, piece, comm); });
}

}  // namespace bulbus::inline io
