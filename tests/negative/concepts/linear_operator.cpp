// SPDX-License-Identifier: MIT
// case WITHOUT_ROWS: 'has_rows['<]
// case WITHOUT_COLS: 'has_cols['<]
// case MISSPELT_APPLY: has_plain_apply
// case MISSPELT_APPLY, clang: 'has_plain_apply['<]
// case WRITING_APPLY: has_plain_apply
// case WRITING_APPLY, clang: 'has_plain_apply['<]
// case ROOM=room WITHOUT_COPY: has_copyable_workspace
// max-lines-gcc: 25
// max-lines-clang: 30
//
// An operator minus its sizes, with a misspelt apply, or not const while it is applied: two threads
// could not share it; minus the copy of its workspace: no state of a method could be saved.
#include <slant/slant.hpp>

struct room {
  room() = default;
#ifdef WITHOUT_COPY
  room(room const&) = delete;
#else
  room(room const&) = default;
#endif
  room& operator=(room const&) = default;
};

struct twice {
#ifndef WITHOUT_ROWS
  Eigen::Index rows() const { return 2; }
#endif
#ifndef WITHOUT_COLS
  Eigen::Index cols() const { return 2; }
#endif
#if defined(ROOM)
  ROOM workspace(auto const&) const { return {}; }
  void apply(auto const& x, auto& y, ROOM&) const { y = 2 * x; }
#elif defined(MISSPELT_APPLY)
  void aply(auto const& x, auto& y) const { y = 2 * x; }
#elif defined(WRITING_APPLY)
  void apply(auto const& x, auto& y) {
    ++applications;
    y = 2 * x;
  }
#else
  void apply(auto const& x, auto& y) const { y = 2 * x; }
#endif
  int applications = 0;
};

static_assert(slant::linear_operator<twice, Eigen::VectorXd>);
