#pragma once
#include <memory>

#include "core/solve/coupled_system.hpp"
#include "core/solve/linear_operator.hpp"

namespace bulbus::inline precond {

class LineJacobi;

/// An approximate inverse of the augmented displacement block, on primal vectors.
class DisplacementPreconditioner : public Preconditioner {
 public:
  /// The lines' part that it smooths with; null where it has none.
  virtual std::shared_ptr<const LineJacobi> lines() const { return nullptr; }
  /// Are the factors of its coarsest matrix those of an earlier linearisation?
  virtual bool keeps_factors() const { return false; }
  /// Does it approximate a coarsest matrix that MUMPS could factorise?
  virtual bool could_be_factorised() const { return false; }
  /// What it applies on the fly is the tangent of this linearisation from now on, all else stays. Returns by
  /// how much the largest eigenvalue that it damps has grown since it was made; 1 where it damps none.
  /// Collective.
  virtual double refresh(SharedSystem /*system*/) { return 1; }
  /// Gives up the linearisation that it was made for; of no use until it is refreshed.
  virtual void release() {}
};

}  // namespace bulbus::inline precond
