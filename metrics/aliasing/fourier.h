// The discrete Fourier transform of small blocks. Radix 2 in double precision, one order of operations: the same bytes whatever the number
// of threads.
#pragma once

#include <complex>
#include <span>
#include <vector>

namespace fernlicht {

/// In place: X[k] = sum over n of x[n] exp(-2 pi i k n / N) (Cooley and Tukey 1965). Throws std::invalid_argument unless N is a power of 2.
void fourier_transform(std::span<std::complex<double>> values);

/// The same along rows and columns of a square block, row after row. Throws std::invalid_argument unless the block is side x side.
void fourier_transform(std::vector<std::complex<double>>& block, std::size_t side);

/// Cycles per sample of bin k of N, -0.5 <= f < 0.5.
double bin_frequency(std::size_t k, std::size_t count);

} // namespace fernlicht
