#pragma once
#include <chrono>
#include <map>
#include <string>

namespace bulbus {

/// Seconds spent in each named part of the program, on this rank.
class Clock {
 public:
  /// Adds its lifetime to a part.
  class Scope {
   public:
    Scope(Clock& clock, std::string part) : clock_(clock), part_(std::move(part)), start_(now()) {}
    ~Scope() { clock_.seconds_[part_] += now() - start_; }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    Clock& clock_;
    std::string part_;
    double start_;
  };

  Scope measure(std::string part) { return Scope(*this, std::move(part)); }
  const std::map<std::string, double>& seconds() const { return seconds_; }
  /// Monotonic wall time in seconds.
  static double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }

 private:
  std::map<std::string, double> seconds_;
};

}  // namespace bulbus
