#include "core/solve/krylov_vectors.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <variant>

#include "core/base/inner_product.hpp"

namespace bulbus::inline solve {
namespace {

constexpr std::size_t block = 2048;  // rows that are combined at a time: they stay in the nearest cache

// use(first row, rows) block by block
template <class Use>
void for_each_block(std::size_t rows, Use use) {
  for (std::size_t first = 0; first < rows; first += block) use(first, std::min(block, rows - first));
}

}  // namespace

class KrylovVectors::Column {
 public:
  Column(std::shared_ptr<KrylovSpace> space, Precision precision)
      : space_(std::move(space)), precision_(precision) {}
  Column(std::shared_ptr<KrylovSpace> space, std::span<double> borrowed)
      : space_(std::move(space)), precision_(Precision::full), numbers_(borrowed.data()) {}
  Column(const Column&) = delete;
  Column& operator=(const Column&) = delete;
  ~Column() { space_->bytes -= full_.size() * sizeof(double) + single_.size() * sizeof(float); }

  /// use(pointer to the numbers), double* or float*; they are zero until they are written.
  template <class Use>
  auto with(Use use) {
    if (std::holds_alternative<double*>(numbers_) && !std::get<double*>(numbers_)) allocate();
    return std::visit(use, numbers_);
  }

 private:
  void allocate() {
    if (precision_ == Precision::full) {
      full_.resize(space_->rows);
      numbers_ = full_.data();
    } else {
      single_.resize(space_->rows);
      numbers_ = single_.data();
    }
    space_->bytes += full_.size() * sizeof(double) + single_.size() * sizeof(float);
    space_->peak = std::max(space_->peak, space_->bytes);
  }

  std::shared_ptr<KrylovSpace> space_;
  Precision precision_;
  std::variant<double*, float*> numbers_ = static_cast<double*>(nullptr);
  std::vector<double> full_;
  std::vector<float> single_;
};

KrylovVectors::KrylovVectors(std::shared_ptr<KrylovSpace> space, std::span<double> values)
    : space_(std::move(space)) {
  columns_.push_back(std::make_shared<Column>(space_, values));
}

KrylovVectors::Base* KrylovVectors::Clone(int count) const {
  auto* v = new KrylovVectors(space_);
  for (int i = 0; i < count; ++i)
    v->columns_.push_back(std::make_shared<Column>(space_, count > 1 ? space_->basis : Precision::full));
  return v;
}

KrylovVectors::Base* KrylovVectors::CloneCopy() const {
  Base* v = Clone(GetNumberVecs());
  v->MvAddMv(1, *this, 0, *this);
  return v;
}

KrylovVectors::Base* KrylovVectors::CloneCopy(const std::vector<int>& index) const {
  const std::unique_ptr<KrylovVectors> chosen(view(index));
  return chosen->CloneCopy();
}

KrylovVectors* KrylovVectors::view(const std::vector<int>& index) const {
  auto* v = new KrylovVectors(space_);
  for (int i : index) v->columns_.push_back(columns_[i]);
  return v;
}

KrylovVectors::Base* KrylovVectors::CloneViewNonConst(const std::vector<int>& index) { return view(index); }
const KrylovVectors::Base* KrylovVectors::CloneView(const std::vector<int>& index) const {
  return view(index);
}

ptrdiff_t KrylovVectors::GetGlobalLength() const {
  return space_->comm.sum(static_cast<long long>(space_->rows));
}

void KrylovVectors::MvTimesMatAddMv(double alpha, const Base& a, const Matrix& B, double beta) {
  const KrylovVectors& A = of(a);
  for (int j = 0; j < GetNumberVecs(); ++j)
    for_each_block(space_->rows, [&](std::size_t first, std::size_t rows) {
      double sum[block];
      columns_[j]->with([&](auto* own) {
        for (std::size_t i = 0; i < rows; ++i) sum[i] = beta == 0 ? 0 : beta * own[first + i];
      });
      for (int k = 0; k < A.GetNumberVecs(); ++k) {
        const double factor = alpha * B(k, j);
        A.columns_[k]->with([&](const auto* other) {
          for (std::size_t i = 0; i < rows; ++i) sum[i] += factor * other[first + i];
        });
      }
      columns_[j]->with([&](auto* own) { std::copy_n(sum, rows, own + first); });
    });
}

void KrylovVectors::MvAddMv(double alpha, const Base& a, double beta, const Base& b) {
  const KrylovVectors &A = of(a), &B = of(b);
  const std::size_t n = space_->rows;
  for (int j = 0; j < GetNumberVecs(); ++j)
    columns_[j]->with([&](auto* own) {
      using Number = std::remove_pointer_t<decltype(own)>;
      A.columns_[j]->with([&](const auto* x) {
        if (beta == 0)
          return (void)std::transform(x, x + n, own, [&](auto v) { return static_cast<Number>(alpha * v); });
        B.columns_[j]->with([&](const auto* y) {
          for (std::size_t i = 0; i < n; ++i)
            own[i] = static_cast<Number>((alpha == 0 ? 0 : alpha * x[i]) + beta * y[i]);
        });
      });
    });
}

void KrylovVectors::MvScale(double alpha) { MvScale(std::vector<double>(columns_.size(), alpha)); }

void KrylovVectors::MvScale(const std::vector<double>& alpha) {
  for (std::size_t j = 0; j < columns_.size(); ++j)
    columns_[j]->with([&](auto* own) {
      for (std::size_t i = 0; i < space_->rows; ++i) own[i] *= alpha[j];
    });
}

void KrylovVectors::MvTransMv(double alpha, const Base& a, Matrix& B) const {
  const KrylovVectors& A = of(a);
  const int rows = A.GetNumberVecs(), columns = GetNumberVecs();
  std::vector<double> products(static_cast<std::size_t>(rows) * columns);
  for_each_block(space_->rows, [&](std::size_t first, std::size_t count) {
    for (int j = 0; j < columns; ++j)
      columns_[j]->with([&](const auto* y) {
        for (int i = 0; i < rows; ++i)
          A.columns_[i]->with([&](const auto* x) {
            products[i + j * rows] += local_inner_product(x + first, y + first, count);
          });
      });
  });
  space_->comm.sum(products);
  for (int j = 0; j < columns; ++j)
    for (int i = 0; i < rows; ++i) B(i, j) = alpha * products[i + j * rows];
}

void KrylovVectors::MvDot(const Base& a, std::vector<double>& products) const {
  const KrylovVectors& A = of(a);
  std::vector<double> sums;
  for (std::size_t j = 0; j < columns_.size(); ++j)
    columns_[j]->with([&](const auto* y) {
      A.columns_[j]->with([&](const auto* x) { sums.push_back(local_inner_product(x, y, space_->rows)); });
    });
  space_->comm.sum(sums);
  std::ranges::copy(sums, products.begin());
}

void KrylovVectors::MvNorm(std::vector<double>& norms, Belos::NormType type) const {
  if (type != Belos::TwoNorm) throw std::logic_error("KrylovVectors has the Euclidean norm only");
  MvDot(*this, norms);
  for (std::size_t j = 0; j < columns_.size(); ++j) norms[j] = std::sqrt(norms[j]);
}

void KrylovVectors::SetBlock(const Base& A, const std::vector<int>& index) {
  const std::unique_ptr<KrylovVectors> target(view(index));
  target->MvAddMv(1, A, 0, A);
}

void KrylovVectors::MvRandom() {
  std::mt19937 random(1 + space_->comm.rank());
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const auto& column : columns_)
    column->with([&](auto* own) { std::generate_n(own, space_->rows, [&] { return uniform(random); }); });
}

void KrylovVectors::MvInit(double value) {
  for (const auto& column : columns_) column->with([&](auto* own) { std::fill_n(own, space_->rows, value); });
}

std::span<const double> KrylovVectors::read(int column, std::vector<double>& copy) const {
  const std::size_t n = space_->rows;
  return columns_[column]->with([&](const auto* own) -> std::span<const double> {
    if constexpr (std::is_same_v<decltype(own), const double*>) return {own, n};
    copy.assign(own, own + n);
    return copy;
  });
}

void KrylovVectors::write(int column, std::span<const double> values) {
  columns_[column]->with([&](auto* own) { std::ranges::copy(values, own); });
}

}  // namespace bulbus::inline solve
