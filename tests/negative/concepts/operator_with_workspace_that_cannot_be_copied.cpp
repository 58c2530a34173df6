// SPDX-License-Identifier: MIT
// expect: has_copyable_workspace
// max-lines-gcc: 50
// max-lines-clang: 50
//
// An operator minus the copy of its workspace: no state of a method could be saved.
#include <slant/concepts/linear_operator.hpp>

#include <Eigen/Core>

struct twice {
  struct room {
    Eigen::VectorXd sum;
#ifdef SLANT_COMPLETE
    room(room const&) = default;
#else
    room(room const&) = delete;
#endif
    explicit room(Eigen::Index n) : sum(n) {}
    room& operator=(room const&) = default;
  };
  Eigen::Index rows() const { return 2; }
  Eigen::Index cols() const { return 2; }
  room workspace(auto const&) const { return room(2); }
  void apply(auto const& x, auto& y, room& w) const {
    w.sum = x + x;
    y = w.sum;
  }
};

static_assert(slant::linear_operator<twice, Eigen::VectorXd>);
