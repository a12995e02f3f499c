#pragma once
#include <BelosMultiVec.hpp>
#include <memory>
#include <span>
#include <vector>

#include "core/base/parallel.hpp"
#include "core/solve/linear_operator.hpp"

namespace bulbus::inline solve {

/// What all vectors of one solve share.
struct KrylovSpace {
  Comm comm;
  std::size_t rows;       ///< of this rank
  Precision basis;        ///< in which a basis (several columns cloned at once) is kept
  std::size_t bytes = 0;  ///< held now
  std::size_t peak = 0;   ///< the most that were held at a time
};

/// Distributed vectors for Belos. The basis may be kept in single precision and is computed with in double: a
/// method restarted after a reduction by 1e-5 or so loses nothing (Aliaga, Anzt et al., Compressed basis
/// GMRES, 2023). A column has no memory before it is written.
class KrylovVectors final : public Belos::MultiVec<double> {
 public:
  using Base = Belos::MultiVec<double>;
  using Matrix = Teuchos::SerialDenseMatrix<int, double>;

  /// One column on the caller's memory.
  KrylovVectors(std::shared_ptr<KrylovSpace> space, std::span<double> values);

  Base* Clone(int count) const override;
  Base* CloneCopy() const override;
  Base* CloneCopy(const std::vector<int>& index) const override;
  Base* CloneViewNonConst(const std::vector<int>& index) override;
  const Base* CloneView(const std::vector<int>& index) const override;
  ptrdiff_t GetGlobalLength() const override;
  int GetNumberVecs() const override { return static_cast<int>(columns_.size()); }
  /// this = α A B + β this
  void MvTimesMatAddMv(double alpha, const Base& A, const Matrix& B, double beta) override;
  /// this = α A + β B
  void MvAddMv(double alpha, const Base& A, double beta, const Base& B) override;
  void MvScale(double alpha) override;
  void MvScale(const std::vector<double>& alpha) override;
  /// B = α Aᵀ this. Collective, as are the next two.
  void MvTransMv(double alpha, const Base& A, Matrix& B) const override;
  void MvDot(const Base& A, std::vector<double>& products) const override;
  void MvNorm(std::vector<double>& norms, Belos::NormType type = Belos::TwoNorm) const override;
  void SetBlock(const Base& A, const std::vector<int>& index) override;
  void MvRandom() override;
  void MvInit(double value) override;
  void MvPrint(std::ostream&) const override {}

  /// The numbers of a column in double precision: its own, or `copy`.
  std::span<const double> read(int column, std::vector<double>& copy) const;
  void write(int column, std::span<const double> values);

 private:
  class Column;
  explicit KrylovVectors(std::shared_ptr<KrylovSpace> space) : space_(std::move(space)) {}
  KrylovVectors* view(const std::vector<int>& index) const;
  static const KrylovVectors& of(const Base& v) { return dynamic_cast<const KrylovVectors&>(v); }

  std::shared_ptr<KrylovSpace> space_;
  std::vector<std::shared_ptr<Column>> columns_;
};

}  // namespace bulbus::inline solve
