#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "core/io/hdf5_read.hpp"
#include "core/io/vtkhdf.hpp"

namespace {

using namespace bulbus;
namespace fs = std::filesystem;

struct Cube {
  std::vector<Point> points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                            {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  std::vector<Hex> hexes{{0, 1, 2, 3, 4, 5, 6, 7}};
  Piece piece() const {
    return {points,
            hexes,
            {{"u", 3, std::vector<double>(24, .5)}},
            {{"p", 1, {2}}, {"s", 6, {1, 2, 3, 4, 5, 6}}}};
  }
};

fs::path fresh_folder(const std::string& name) {
  const fs::path folder = fs::temp_directory_path() / ("bulbus_" + name);
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

TEST(Vtkhdf, HoldsWhatThePieceHeld) {
  const Cube cube;
  const fs::path file = fresh_folder("vtkhdf_one") / "a.vtkhdf";
  write_vtkhdf(file, cube.piece(), Comm(MPI_COMM_SELF));
  const auto held = [&](const std::string& name) { return read_dataset(file, "VTKHDF/" + name); };
  EXPECT_EQ(held("NumberOfPoints"), std::vector<double>{8});
  EXPECT_EQ(held("NumberOfCells"), std::vector<double>{1});
  EXPECT_EQ(held("NumberOfConnectivityIds"), std::vector<double>{8});
  EXPECT_EQ(held("Offsets"), (std::vector<double>{0, 8}));
  EXPECT_EQ(held("Types"), std::vector<double>{12});
  EXPECT_EQ(held("Connectivity"), (std::vector<double>{0, 1, 2, 3, 4, 5, 6, 7}));
  EXPECT_EQ(held("Points")[3], 1);
  EXPECT_EQ(held("PointData/u"), std::vector<double>(24, .5));
  EXPECT_EQ(held("CellData/s"), (std::vector<double>{1, 2, 3, 4, 5, 6}));
  EXPECT_FALSE(fs::exists(file.string() + ".tmp"));
  EXPECT_THROW(held("PointData/none"), std::runtime_error);
}

// Also under mpirun: every rank adds a cube at its own height.
TEST(Vtkhdf, PutsThePiecesOfTheRanksOneBelowTheOther) {
  const Comm world;
  const std::string file = fs::temp_directory_path() / "bulbus_pieces.vtkhdf";  // the same on every rank
  Cube cube;
  for (Point& p : cube.points) p[2] += world.rank();
  Piece piece = cube.piece();
  piece.cell_fields[0].values = {static_cast<double>(world.rank())};
  write_vtkhdf(file, piece, world);
  const auto ranks = static_cast<std::size_t>(world.size());
  EXPECT_EQ(read_dataset(file, "VTKHDF/NumberOfPoints"), std::vector<double>(ranks, 8));
  EXPECT_EQ(read_dataset(file, "VTKHDF/Offsets").size(), 2 * ranks);
  const std::vector<double> points = read_dataset(file, "VTKHDF/Points"),
                            p = read_dataset(file, "VTKHDF/CellData/p");
  for (std::size_t r = 0; r < ranks; ++r) {
    EXPECT_EQ(points[24 * r + 2], static_cast<double>(r));
    EXPECT_EQ(p[r], static_cast<double>(r));
  }
}

TEST(Vtkhdf, PiecesOfRanksMayBeEmpty) {
  const Comm world;
  const std::string file = fs::temp_directory_path() / "bulbus_pieces_empty.vtkhdf";
  const Cube cube;
  const Piece empty{{}, {}, {{"u", 3, {}}}, {{"p", 1, {}}, {"s", 6, {}}}};
  const int holder = world.size() - 1;  // the last rank alone has a cell
  write_vtkhdf(file, world.rank() == holder ? cube.piece() : empty, world);
  EXPECT_EQ(read_dataset(file, "VTKHDF/PointData/u"), std::vector<double>(24, .5));
  EXPECT_EQ(read_dataset(file, "VTKHDF/Offsets").size(), static_cast<std::size_t>(world.size()) + 1);
}

TEST(Vtkhdf, PiecesFaultyOnOneRankAreRefusedOnEveryRank) {
  const Comm world;
  const std::string file = fs::temp_directory_path() / "bulbus_pieces_refused.vtkhdf";
  const Cube cube;
  Piece piece = cube.piece();
  if (world.rank() == 0) piece.cell_fields[0].values[0] = std::nan("");
  EXPECT_THROW(write_vtkhdf(file, piece, world), std::runtime_error);
  piece = cube.piece();
  if (world.rank() == 0) piece.cell_fields[0].name = "q";
  if (world.size() > 1) {
    EXPECT_THROW(write_vtkhdf(file, piece, world), std::runtime_error);
  }
  EXPECT_THROW(write_vtkhdf("/no/such/folder/a.vtkhdf", cube.piece(), world), std::runtime_error);
}

void expect_refusal(const Piece& piece, const std::string& words) {
  const fs::path folder = fresh_folder("vtkhdf_refused");
  try {
    write_vtkhdf(folder / "a.vtkhdf", piece, Comm(MPI_COMM_SELF));
    FAIL() << "written";
  } catch (const std::runtime_error& fault) {
    EXPECT_NE(std::string(fault.what()).find(words), std::string::npos) << fault.what();
  }
  EXPECT_TRUE(fs::is_empty(folder));
}

TEST(Vtkhdf, RefusesWhatIsNotFiniteBeforeWriting) {
  Cube cube;
  Piece piece = cube.piece();
  piece.cell_fields[1].values[4] = std::nan("");
  expect_refusal(piece, "'s' is not finite at item 0");
  piece = cube.piece();
  piece.point_fields[0].values[23] = 1e200;  // beyond single precision
  expect_refusal(piece, "'u' is not finite at item 7");
  cube.points[2][1] = std::numeric_limits<double>::infinity();
  expect_refusal(cube.piece(), "a point is not finite");
}

TEST(Vtkhdf, KeepsNanWhereASparseFieldHasNoValue) {
  const fs::path file = fresh_folder("vtkhdf_sparse") / "a.hdf";
  const Cube cube;
  Piece piece = cube.piece();
  piece.cell_fields[1].sparse = true;
  piece.cell_fields[1].values[4] = std::nan("");
  write_vtkhdf(file, piece, Comm(MPI_COMM_SELF));
  EXPECT_TRUE(std::isnan(read_dataset(file, "VTKHDF/CellData/s")[4]));
  piece.cell_fields[1].values[4] = std::numeric_limits<double>::infinity();
  expect_refusal(piece, "'s' is not finite at item 0");
}

// Also under mpirun: all ranks have the same labels, the file has them once.
TEST(Vtkhdf, HasLabelsAndUnits) {
  const Comm world;
  const std::string file = fs::temp_directory_path() / "bulbus_labels.hdf";
  const Cube cube;
  Piece piece = cube.piece();
  piece.cell_fields[0].unit = "MPa";
  piece.labels = {{"region_lens", 0}, {"region_wall", 1}};
  write_vtkhdf(file, piece, world);
  EXPECT_EQ(read_dataset(file, "VTKHDF/FieldData/region_wall"), std::vector<double>{1});
  EXPECT_EQ(read_dataset(file, "VTKHDF/FieldData/region_lens"), std::vector<double>{0});
  EXPECT_EQ(safe_name("a/b <c>"), "a_b _c_");
}

TEST(Vtkhdf, RefusesAFieldOfTheWrongLength) {
  const Cube cube;
  Piece piece = cube.piece();
  piece.point_fields[0].values.pop_back();
  expect_refusal(piece, "'u' has 23 values for 8 items of 3 components");
}

TEST(Vtkhdf, NamesAFileThatCannotBeCreated) {
  try {
    write_vtkhdf("/no/such/folder/a.vtkhdf", Cube().piece(), Comm(MPI_COMM_SELF));
    FAIL() << "written";
  } catch (const std::runtime_error& fault) {
    EXPECT_NE(std::string(fault.what())
                  .find("/no/such/folder/a.vtkhdf: cannot be written: No such file or directory"),
              std::string::npos);
  }
}

TEST(Vtkhdf, AcceptsAnEmptyPiece) {
  const fs::path file = fresh_folder("vtkhdf_empty") / "a.vtkhdf";
  write_vtkhdf(file, {{}, {}, {{"u", 3, {}}}, {{"p", 1, {}}}}, Comm(MPI_COMM_SELF));
  EXPECT_TRUE(fs::exists(file));
}

}  // namespace
