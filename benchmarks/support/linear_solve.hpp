// SPDX-License-Identifier: MIT
//
// What every other time is compared with: one sparse factorisation of K and one solve, by CHOLMOD
// called directly, without the checks of our own factorisation. CHOLMOD's own choice of an ordering
// and METIS are both tried; the faster one counts. Without CHOLMOD: Eigen's LDLᵀ.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#if defined(SLANT_HAS_CHOLMOD) && SLANT_HAS_CHOLMOD
#include <slant/factorizations/cholmod.hpp>
#endif

#include "cpu_clock.hpp"
#include "peak_memory.hpp"

namespace benchmarks {

struct linear_solve_result {
  double seconds;
  double memory_mib;
};

#if defined(SLANT_HAS_CHOLMOD) && SLANT_HAS_CHOLMOD

inline constexpr char const* linear_solver_name = "CHOLMOD";

namespace detail {

/// Analysis, factorisation, solve. Throws std::runtime_error if CHOLMOD fails.
inline void cholmod_once(Eigen::SparseMatrix<double> const& K, Eigen::VectorXd const& f,
                         bool metis) {
  slant::detail::cholmod_state state;
  cholmod_sparse view = slant::detail::cholmod_view(K);
  if (metis) {
    state.get()->nmethods = 1;
    state.get()->method[0].ordering = CHOLMOD_METIS;
    state.get()->postorder = 1;
  }
  cholmod_factor* L = cholmod_analyze(&view, state.get());
  bool good = L != nullptr && cholmod_factorize(&view, L, state.get()) != 0 &&
              L->minor == static_cast<std::size_t>(K.rows());
  cholmod_dense b{};
  b.nrow = b.d = b.nzmax = static_cast<std::size_t>(f.size());
  b.ncol = 1;
  b.x = const_cast<double*>(f.data());  // CHOLMOD does not write to its input
  b.xtype = CHOLMOD_REAL;
  b.dtype = CHOLMOD_DOUBLE;
  cholmod_dense* x = good ? cholmod_solve(CHOLMOD_A, L, &b, state.get()) : nullptr;
  good = x != nullptr;
  cholmod_free_dense(&x, state.get());
  cholmod_free_factor(&L, state.get());
  if (!good) throw std::runtime_error("linear solve: CHOLMOD failed");
}

}  // namespace detail

/// Seconds of the faster ordering, and the peak memory after the first one, which is CHOLMOD's
/// choice.
[[nodiscard]] inline linear_solve_result linear_solve(Eigen::SparseMatrix<double> const& K,
                                                      Eigen::VectorXd const& f, int repeats) {
  require_fine_clock();
  double memory = 0;
  double seconds = 0;
  for (bool const metis : {false, true}) {
    double const now = median_seconds(repeats, 2, [&] { detail::cholmod_once(K, f, metis); });
    if (!metis) memory = peak_memory_mib();
    seconds = metis ? std::min(seconds, now) : now;
  }
  return {seconds, memory};
}

#else

inline constexpr char const* linear_solver_name = "Eigen";

/// Seconds and peak memory.
[[nodiscard]] inline linear_solve_result linear_solve(Eigen::SparseMatrix<double> const& K,
                                                      Eigen::VectorXd const& f, int repeats) {
  double const seconds = median_seconds(repeats, 2, [&] {
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> const factor(K);
    Eigen::VectorXd const x = factor.solve(f);
    if (!x.allFinite()) throw std::runtime_error("linear solve: Eigen failed");
  });
  return {seconds, peak_memory_mib()};
}

#endif

}  // namespace benchmarks
