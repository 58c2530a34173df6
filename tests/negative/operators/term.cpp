// SPDX-License-Identifier: MIT
// case USE=sum WITHOUT_COLS: a term or factor must be an operator.*'has_cols['<]
// case USE=product MISSPELT_APPLY: a term or factor must be an operator.*has_apply_member
// case USE=product MISSPELT_APPLY, clang: a term or factor must be an operator.*'has_apply_member['<]
// max-lines-gcc: 25
// max-lines-clang: 30
//
// A term minus the number of its columns, the right factor of a product minus apply: noticed where the
// composition is made.
#include <slant/slant.hpp>

struct twice {
  Eigen::Index rows() const { return 2; }
#ifndef WITHOUT_COLS
  Eigen::Index cols() const { return 2; }
#endif
#ifdef MISSPELT_APPLY
  void aply(auto const& x, auto& y) const { y = 2 * x; }
#else
  void apply(auto const& x, auto& y) const { y = 2 * x; }
#endif
};

auto const a = slant::USE(slant::identity_operator(2), twice{});
