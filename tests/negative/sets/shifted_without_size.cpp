// SPDX-License-Identifier: MIT
// expect: has_size
// max-lines-gcc: 25
// max-lines-clang: 30
//
// A set of run-time dimension minus its size.
#include <slant/sets/shifted.hpp>

struct nonnegative {
  slant::index n;
#ifdef SLANT_COMPLETE
  slant::index size() const { return n; }
#endif
  void project(auto const& x, auto& y) const { y = x.cwiseMax(0.0); }
  bool contains(auto const& x) const { return (x.array() >= 0.0).all(); }
};

auto const moved = slant::shifted(nonnegative{2}, Eigen::VectorXd(Eigen::Vector2d(1, 2)));
