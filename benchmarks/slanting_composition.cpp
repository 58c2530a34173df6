// SPDX-License-Identifier: MIT
//
// What composing slanting functions costs: an application of F°(y) that followed by the chain rule,
// against the loop over the hand-derived formula.
//
//     slanting_composition CASE REPETITIONS
//
//     wire      F° of [T (2.13)], the wire with 2048 unknowns: A has three entries a row, so that
//               everything else counts as much as it ever can
//     brick     G° of [K] below (53), the steel brick with k = 4
//
// applies one version of one case that often and prints the sum of the result, so that the versions
// can be seen to agree. benchmarks/slanting_composition.sh counts the instructions of an
// application as the difference of two runs, in which the set-up cancels.

#include <slant/contact/primal_dual.hpp>
#include <slant/sets/cartesian.hpp>
#include <slant/sets/contact_sets.hpp>
#include <slant/slanting/kkt_function.hpp>

#include <fem/steel_brick.hpp>
#include <fem/string_1d.hpp>

#include <Eigen/SparseCore>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

namespace {

using sparse = Eigen::SparseMatrix<double>;
using vector = Eigen::VectorXd;

/// Some point with blocks of all kinds.
vector point(Eigen::Index n) {
  vector y(n);
  for (Eigen::Index i = 0; i < n; ++i) y[i] = std::sin(1.0 + 0.7 * static_cast<double>(i));
  return y;
}

/// In a function of its own: what surrounds it has no part in how it is compiled.
template <class Apply>
[[gnu::noinline]] void once(Apply const& apply, vector const& x, vector& y) {
  apply(x, y);
}

/// Applies y = apply(x) that often.
template <class Apply>
double repeated(Eigen::Index n, long repetitions, Apply const& apply) {
  vector x = vector::LinSpaced(n, -1.0, 1.0);
  vector y(n);
  for (long k = 0; k < repetitions; ++k) {
    once(apply, x, y);
    x[0] += 1e-3 * y[0];
  }
  return y.sum();
}

template <class F>
double composed(F const& f, vector const& at, long repetitions) {
  auto const g = f.slant(at);
  auto w = slant::workspace(g, at);
  return repeated(at.size(), repetitions,
                  [&](vector const& x, vector& y) { slant::apply(g, x, y, w); });
}

struct wire_case {
  static constexpr double ρ = 1;
  fem::wire<> wire = fem::make_wire(512);
  double l = -0.1, g = 0.8;
  vector at = point(6 * 512);

  double by_composition(long repetitions) const {
    auto const m = wire.m;
    auto const set =
        slant::cartesian(slant::half_lines(vector::Constant(m, l).eval()),
                         slant::discs(vector::Constant(m, g).eval()), slant::free_components(m));
    return composed(slant::kkt(wire.A, wire.b, set, ρ), at, repetitions);
  }
  double by_hand(long repetitions) const {
    auto const m = wire.m, n = 4 * m;
    sparse const& A = wire.A;
    vector const pairs = at.segment(m, 2 * m), μ = at.tail(m);
    std::vector<char> bound(static_cast<std::size_t>(m)), circle(static_cast<std::size_t>(m));
    for (Eigen::Index i = 0; i < m; ++i) {
      auto const k = static_cast<std::size_t>(i);
      bound[k] = at[n + i] + ρ * (l - at[i]) > 0;
      circle[k] = μ[i] + ρ * (pairs.segment<2>(2 * i).squaredNorm() - g * g) > 0;
    }
    return repeated(n + 2 * m, repetitions, [&](vector const& x, vector& y) {
      y.head(n).noalias() = A * x.head(n);
      for (Eigen::Index i = 0; i < m; ++i) y[i] -= x[n + i];
      for (Eigen::Index i = 0; i < m; ++i) {
        auto const two = m + 2 * i, row = n + m + i;
        y[two] += 2 * (μ[i] * x[two] + pairs[2 * i] * x[row]);
        y[two + 1] += 2 * (μ[i] * x[two + 1] + pairs[2 * i + 1] * x[row]);
      }
      for (Eigen::Index i = 0; i < m; ++i) {
        y[n + i] = bound[static_cast<std::size_t>(i)] ? ρ * x[i] : x[n + i];
      }
      for (Eigen::Index i = 0; i < m; ++i) {
        auto const two = m + 2 * i, row = n + m + i;
        y[row] = circle[static_cast<std::size_t>(i)]
                     ? -2 * ρ * (pairs[2 * i] * x[two] + pairs[2 * i + 1] * x[two + 1])
                     : x[row];
      }
    });
  }
};

struct brick_case {
  static constexpr double ρ = 1e4;
  fem::contact_scene<3> scene = fem::make_steel_brick({.k = 4, .load = fem::brick_load::pull});
  slant::contact::data<double> data{scene.N, scene.T, scene.f, scene.d, scene.g};
  vector at;

  brick_case() : at(point(scene.f.size() + 3 * scene.d.size())) {
    at.head(scene.f.size()) *= 1e-5;
    at.tail(3 * scene.d.size()) *= 0.05;
  }
  double by_composition(long repetitions) const {
    slant::contact::primal_dual const problem(slant::contact::friction_disc{}, scene.K, data);
    return composed(problem.function(ρ), at, repetitions);
  }
  double by_hand(long repetitions) const {
    auto const n = scene.f.size(), m = scene.d.size();
    sparse B(3 * m, n);
    std::vector<Eigen::Triplet<double>> entries;
    for (int j = 0; j < scene.N.outerSize(); ++j) {
      for (sparse::InnerIterator e(scene.N, j); e; ++e)
        entries.emplace_back(int(e.row()), j, e.value());
      for (sparse::InnerIterator e(scene.T, j); e; ++e) {
        entries.emplace_back(m + e.row(), j, e.value());
      }
    }
    B.setFromTriplets(entries.begin(), entries.end());
    vector const u = at.head(n);
    vector trial = B * u;
    trial.head(m) -= scene.d;
    trial = at.tail(3 * m) + ρ * trial;
    std::vector<Eigen::Matrix2d> ψ(static_cast<std::size_t>(m));
    std::vector<char> active(static_cast<std::size_t>(m));
    for (Eigen::Index i = 0; i < m; ++i) {
      auto const k = static_cast<std::size_t>(i);
      active[k] = trial[i] >= 0;
      Eigen::Vector2d const z = trial.segment<2>(m + 2 * i), e = z.normalized();
      ψ[k] = Eigen::Matrix2d::Identity();
      if (z.norm() > scene.g[i]) ψ[k] = scene.g[i] / z.norm() * (ψ[k] - e * e.transpose());
    }
    vector t(3 * m);
    return repeated(n + 3 * m, repetitions, [&](vector const& x, vector& y) {
      y.head(n).noalias() = scene.K * x.head(n);
      y.head(n).noalias() += B.transpose() * x.tail(3 * m);
      t.noalias() = B * x.head(n);
      for (Eigen::Index i = 0; i < m; ++i) {
        y[n + i] = active[static_cast<std::size_t>(i)] ? -ρ * t[i] : x[n + i];
      }
      for (Eigen::Index i = m; i < 3 * m; i += 2) {
        Eigen::Vector2d const λ = x.segment<2>(n + i);
        Eigen::Vector2d const z = λ + ρ * t.segment<2>(i);
        y.segment<2>(n + i) = λ - ψ[static_cast<std::size_t>((i - m) / 2)] * z;
      }
    });
  }
};

}  // namespace

int main(int argc, char** argv) {
  std::string const name = argc == 3 ? argv[1] : "";
  long const repetitions = argc == 3 ? std::atol(argv[2]) : 0;
  double total = 0;
  if (name == "wire-hand") {
    total = wire_case().by_hand(repetitions);
  } else if (name == "wire-slant") {
    total = wire_case().by_composition(repetitions);
  } else if (name == "brick-hand") {
    total = brick_case().by_hand(repetitions);
  } else if (name == "brick-slant") {
    total = brick_case().by_composition(repetitions);
  } else {
    std::cerr << "usage: slanting_composition wire-hand|wire-slant|brick-hand|brick-slant N\n";
    return 2;
  }
  std::printf("%.17g\n", total);
  return 0;
}
