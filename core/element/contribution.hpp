#pragma once
#include <functional>
#include <span>

namespace bulbus::inline element {

/// A small dense part of a tangent: k local nodes and the (3k)×(3k) matrix between them, by rows.
using ContributionVisitor = std::function<void(std::span<const int> nodes, std::span<const double> matrix)>;

}  // namespace bulbus::inline element
