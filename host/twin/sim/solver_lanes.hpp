#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>

/// The loops of solver.hpp; the including file inlines them once per instruction set. A robot's
/// rows begin with zeros. Only products with +0 are skipped, which change no bit of a sum that
/// began at +0 (non-finite numbers aside).
namespace verp::sim::lanes {

using Index = std::size_t;

#define VERP_INLINE inline __attribute__((always_inline))
// A local array stays in registers only if no loop indexes it.
#if defined(__clang__)
#define VERP_UNROLL _Pragma("unroll")
#else
#define VERP_UNROLL _Pragma("GCC unroll 8")
#endif

using Two = double __attribute__((vector_size(16)));
using Four = double __attribute__((vector_size(32)));
using FourBits = std::uint64_t __attribute__((vector_size(32)));

// By reference: the ABI of a returned vector depends on the instruction set.
VERP_INLINE void load(Two& out, const double* from) {
  std::memcpy(&out, from, sizeof out);
}
VERP_INLINE void load(Four& out, const double* from) {
  std::memcpy(&out, from, sizeof out);
}

/// Common run of +0 at the start of kRows rows; a multiple of four.
template <int kRows>
VERP_INLINE Index leading_zeros(const double* row, Index count, Index skip) {
  Index k = 0;
  for (; k + 4 <= count; k += 4) {
    FourBits any = {};
    VERP_UNROLL
    for (Index r = 0; r < kRows; ++r) {
      FourBits bits;
      std::memcpy(&bits, row + r * skip + k, sizeof bits);
      any |= bits;
    }
    if ((any[0] | any[1] | any[2] | any[3]) != 0) break;
  }
  return k;
}

/// z[g] += rows 4 g to 4 g + 3 of l, times b: columns in order.
template <int kGroups>
VERP_INLINE void add_columns(Four* z, const double* l, const double* b, Index skip) {
  VERP_UNROLL
  for (int g = 0; g < kGroups; ++g, l += 4 * skip) {
    VERP_UNROLL
    for (Index k = 0; k < 4; k += 2) {
      Two row[4];
      VERP_UNROLL
      for (Index r = 0; r < 4; ++r) load(row[r], l + r * skip + k);
      const Four even = __builtin_shufflevector(row[0], row[2], 0, 1, 2, 3);
      const Four odd = __builtin_shufflevector(row[1], row[3], 0, 1, 2, 3);
      z[g] += __builtin_shufflevector(even, odd, 0, 4, 2, 6) * b[k];
      z[g] += __builtin_shufflevector(even, odd, 1, 5, 3, 7) * b[k + 1];
    }
  }
}

/// Solves for the four unknowns at l; z holds all earlier columns' sums.
VERP_INLINE void finish_lower(const double* l, double* b, const Four& z, Index skip) {
  const double *l1 = l + skip, *l2 = l1 + skip, *l3 = l2 + skip;
  b[0] = b[0] - z[0];
  b[1] = b[1] - z[1] - l1[0] * b[0];
  b[2] = b[2] - z[2] - l2[0] * b[0] - l2[1] * b[1];
  b[3] = b[3] - z[3] - l3[0] * b[0] - l3[1] * b[1] - l3[2] * b[2];
}

template <int kGroups>
VERP_INLINE void lower_rows(const double* l, double* b, Index from, Index skip) {
  Four z[kGroups] = {};
  for (Index k = 0; k < from; k += 4) add_columns<kGroups>(z, l + from * skip + k, b + k, skip);
  VERP_UNROLL
  for (int g = 0; g < kGroups; ++g) {
    const Index row = from + 4 * static_cast<Index>(g);
    for (Index k = from; k < row; k += 4) add_columns<1>(z + g, l + row * skip + k, b + k, skip);
    finish_lower(l + row * skip + row, b + row, z[g], skip);
  }
}

VERP_INLINE void solve_lower(const double* l, double* b, Index n, Index skip) {
  // Where b begins with zeros, so does x.
  const Index zeros = leading_zeros<1>(b, n, 0);
  l += zeros * (skip + 1), b += zeros, n -= zeros;
  Index row = 0;
  for (; row + 16 <= n; row += 16) lower_rows<4>(l, b, row, skip);
  for (; row + 4 <= n; row += 4) lower_rows<1>(l, b, row, skip);
  // The remaining rows; even and odd columns apart.
  for (; row < n; ++row) {
    Two z = {};
    const double* of = l + row * skip;
    Index k = 0;
    for (; k + 2 <= row; k += 2) {
      Two p, q;
      load(p, of + k);
      load(q, b + k);
      z += p * q;
    }
    if (k < row) z[0] += of[k] * b[k];
    b[row] = b[row] - (z[0] + z[1]);
  }
}

/// Solves for the four unknowns from b on; z holds the sums of all rows below.
VERP_INLINE void finish_upper(const double* l, double* b, const Four& z, Index skip) {
  const double *l1 = l + skip, *l2 = l1 + skip, *l3 = l2 + skip;
  b[3] = b[3] - z[3];
  b[2] = b[2] - z[2] - l3[2] * b[3];
  b[1] = b[1] - z[1] - l3[1] * b[3] - l2[1] * b[2];
  b[0] = b[0] - z[0] - l3[0] * b[3] - l2[0] * b[2] - l1[0] * b[1];
}

/// z += kRows rows of l, last first, each times its b. From the first column that is not zero in
/// all of them up to `columns`.
template <int kRows>
VERP_INLINE void add_rows(double* z, const double* l, const double* b, Index columns, Index skip) {
  for (Index k = leading_zeros<kRows>(l, columns, skip); k < columns; k += 4) {
    Four sum;
    load(sum, z + k);
    VERP_UNROLL
    for (Index r = 0; r < kRows; ++r) {
      Four p;
      load(p, l + (kRows - 1 - r) * skip + k);
      sum += p * b[kRows - 1 - r];
    }
    std::memcpy(z + k, &sum, sizeof sum);
  }
}

VERP_INLINE void solve_upper(const double* l, double* b, Index n, Index skip, double* z) {
  Index end = n - n % 4;
  std::memset(z, 0, end * sizeof *z);
  for (Index row = n; row-- > end;) {
    for (Index below = n; --below > row;) b[row] = b[row] - l[below * skip + row] * b[below];
    add_rows<1>(z, l + row * skip, b + row, end, skip);
  }
  for (; end > 0; end -= 4) {
    const Index row = end - 4;
    Four sums;
    load(sums, z + row);
    finish_upper(l + row * skip + row, b + row, sums, skip);
    add_rows<4>(z, l + row * skip, b + row, row, skip);
  }
}

/// A block of A's rows, stored by columns: x[k] is column k before scaling by 1 / D.
template <int kGroups>
struct Panel {
  static constexpr Index kLanes = 4 * kGroups;
  double* a;
  double* d;
  Index first, rows, skip;
  double* x;

  VERP_INLINE double* row(Index r) const { return a + r * skip; }
  VERP_INLINE double& at(Index k, Index r) const { return x[k * kLanes + (r - first)]; }

  VERP_INLINE void gather() const {
    for (Index k = 0; k < first + rows; ++k) {
      VERP_UNROLL
      for (Index lane = 0; lane < kLanes; ++lane)
        x[k * kLanes + lane] = lane < rows ? a[(first + lane) * skip + k] : 0;
    }
  }

  /// Columns j to j + kColumns - 1, an even number. Earlier columns are done, and zero up to
  /// `from`.
  template <int kColumns>
  VERP_INLINE void solve(Index j, Index from) const {
    Four z[kColumns][kGroups] = {};
    for (Index k = from; k < j; ++k) add<kColumns>(z, 0, j, k);
    VERP_UNROLL
    for (int c = 0; c < kColumns; c += 2) {
      // ODE subtracts the terms within the pair separately.
      for (Index k = j; k < j + static_cast<Index>(c); ++k) add<2>(z + c, c, j, k);
      const Index column = j + static_cast<Index>(c);
      const double within = row(column + 1)[column];
      VERP_UNROLL
      for (int g = 0; g < kGroups; ++g) {
        Four y0, y1;
        double* to = x + column * kLanes + 4 * g;
        load(y0, to);
        load(y1, to + kLanes);
        y0 = y0 - z[c][g];
        y1 = y1 - z[c + 1][g] - within * y0;
        std::memcpy(to, &y0, sizeof y0);
        std::memcpy(to + kLanes, &y1, sizeof y1);
      }
    }
  }

  template <int kColumns>
  VERP_INLINE void add(Four (*z)[kGroups], int c, Index j, Index k) const {
    const double* l = row(j + static_cast<Index>(c)) + k;
    VERP_UNROLL
    for (int g = 0; g < kGroups; ++g) {
      Four of;
      load(of, x + k * kLanes + 4 * g);
      VERP_UNROLL
      for (int column = 0; column < kColumns; ++column)
        z[column][g] += l[static_cast<Index>(column) * skip] * of;
    }
  }

  /// Scales column k. own: sums of squares. cross: a pair's second row times its first, in the
  /// second's lane.
  VERP_INLINE void scale(Index k, Four* own, Four* cross) const {
    VERP_UNROLL
    for (int g = 0; g < kGroups; ++g) {
      Four p;
      load(p, x + k * kLanes + 4 * g);
      const Four q = p * d[k];
      own[g] += p * q;
      cross[g] += p * __builtin_shufflevector(q, q, 0, 0, 2, 2);
      VERP_UNROLL
      for (Index lane = 0; lane < 4; ++lane) {
        if (4 * static_cast<Index>(g) + lane < rows)
          row(first + 4 * static_cast<Index>(g) + lane)[k] = q[lane];
      }
    }
  }

  /// The pair's own block, after the earlier columns are summed.
  VERP_INLINE void finish(Index r, double z11, double z21, double z22) const {
    for (Index k = first; k < r; ++k) {
      const double p1 = at(k, r), p2 = at(k, r + 1);
      const double q1 = p1 * d[k], q2 = p2 * d[k];
      row(r)[k] = q1;
      row(r + 1)[k] = q2;
      z11 += p1 * q1;
      z21 += p2 * q1;
      z22 += p2 * q2;
    }
    const double y11 = at(r, r) - z11;
    const double y21 = at(r, r + 1) - z21;
    const double y22 = at(r + 1, r + 1) - z22;
    d[r] = 1.0 / y11;
    const double q2 = y21 * d[r];
    row(r + 1)[r] = q2;
    d[r + 1] = 1.0 / (y22 - y21 * q2);
  }

  VERP_INLINE void factor() const {
    gather();
    Index zeros = first;
    for (Index r = first; r < first + rows; ++r) zeros = leading_zeros<1>(row(r), zeros, skip);
    Index j = zeros;
    for (; j + 4 <= first; j += 4)
      solve<4>(j, zeros + leading_zeros<4>(row(j) + zeros, j - zeros, skip));
    for (; j < first; j += 2) solve<2>(j, zeros);
    Four own[kGroups] = {}, cross[kGroups] = {};
    for (Index k = 0; k < first; ++k) scale(k, own, cross);
    for (Index lane = 0; lane < rows; lane += 2) {
      const Index g = lane / 4, in = lane % 4;
      if (lane > 0) solve<2>(first + lane - 2, zeros);
      finish(first + lane, own[g][in], cross[g][in + 1], own[g][in + 1]);
    }
  }
};

/// An odd matrix's last row.
VERP_INLINE void factor_last(double* a, double* d, Index r, Index skip) {
  double* row = a + r * skip;
  for (Index j = 0; j < r; j += 2) {
    const double *l0 = a + j * skip, *l1 = l0 + skip;
    double z0 = 0, z1 = 0;
    for (Index k = 0; k < j; ++k) {
      z0 += l0[k] * row[k];
      z1 += l1[k] * row[k];
    }
    row[j] = row[j] - z0;
    row[j + 1] = row[j + 1] - z1 - l1[j] * row[j];
  }
  double even = 0, odd = 0;
  for (Index k = 0; k < r; k += 2) {
    const double p0 = row[k], p1 = row[k + 1];
    row[k] = p0 * d[k];
    row[k + 1] = p1 * d[k + 1];
    even += p0 * row[k];
    odd += p1 * row[k + 1];
  }
  d[r] = 1.0 / (row[r] - (even + odd));
}

VERP_INLINE void factor(double* a, double* d, Index n, Index skip, double* room) {
  const Index pairs = n - n % 2;
  Index r = 0;
  for (; r + 8 <= pairs; r += 8) Panel<2>{a, d, r, 8, skip, room}.factor();
  for (; r < pairs; r += 4) Panel<1>{a, d, r, pairs - r < 4 ? 2u : 4u, skip, room}.factor();
  if (n > pairs) factor_last(a, d, pairs, skip);
}

}  // namespace verp::sim::lanes
