#pragma once

namespace bulbus::bench {

/// Bytes per second of a_i = b_i + s c_i over arrays of `megabytes` each (24 bytes counted per entry): the
/// median of `repetitions`.
double triad_bandwidth(int megabytes, int repetitions);

/// Floating-point operations per second of independent fused multiply-adds in registers (2 per lane): the
/// best of `repetitions`.
double fma_peak(int repetitions);

}  // namespace bulbus::bench
