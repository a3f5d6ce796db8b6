#pragma once

#include <cstdint>
#include <string>

/// @file
/// Numbers as the tables of the benchmarks show them.
namespace vitrel::bench {

/// "·" for 0, else the number.
std::string count_text(std::uint64_t count);
/// "213 ns", "12.3 µs", "1.23 ms".
std::string time_text(double nanoseconds);
/// "3.1e-14"; "–" if it is not a number.
std::string error_text(double error);
/// Three digits, more for large ones: "0.0255", "41.6", "1412".
std::string ratio_text(double ratio);
}  // namespace vitrel::bench
