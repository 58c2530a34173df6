// SPDX-License-Identifier: MIT
// case WITHOUT_LOCAL: 'has_local['<]
// case LOCAL_BY_VALUE: 'local_is_lvalue['<]
// case LOCAL_BY_VALUE, max-lines-gcc: 20
// case LOCAL_BY_VALUE, max-lines-clang: 20
// case WITHOUT_LIKE: 'has_like['<]
// case SOLVER=cg WITHOUT_LIKE: b must be a slant::vector.*'has_like['<]
// case SOLVER=cg WITHOUT_LIKE, max-lines-gcc: 20
// case WITHOUT_INNER_PRODUCT: 'has_inner_product['<]
// case INNER_PRODUCT_OF_TEXT: has_inner_product.*does not satisfy return-type-requirement
// case INNER_PRODUCT_OF_TEXT, clang: 'has_inner_product['<].*'std::convertible_to<std::basic_string
// max-lines-gcc: 25
// max-lines-clang: 30
//
// A vector of its own kind minus the part of it on which Eigen works, the way to make another one,
// or its inner product; one that makes a new view of that part at each call instead of keeping one;
// one whose inner product is no number. Of the operator of conjugate gradients nothing is said
// then.
#include <slant/slant.hpp>

struct distributed {
  Eigen::VectorXd entries;
#if defined(LOCAL_BY_VALUE)
  Eigen::Map<Eigen::VectorXd> local() { return {entries.data(), entries.size()}; }
  Eigen::Map<Eigen::VectorXd const> local() const { return {entries.data(), entries.size()}; }
#elif !defined(WITHOUT_LOCAL)
  Eigen::VectorXd& local() { return entries; }
  Eigen::VectorXd const& local() const { return entries; }
#endif
#if defined(INNER_PRODUCT_OF_TEXT)
  std::string inner_product(distributed const&) const { return "large"; }
#elif !defined(WITHOUT_INNER_PRODUCT)
  double inner_product(distributed const& y) const { return entries.dot(y.entries); }
#endif
#ifndef WITHOUT_LIKE
  distributed like(slant::index n) const { return {Eigen::VectorXd(n)}; }
#endif
};

#ifdef SOLVER
struct twice {
  static constexpr auto laws = slant::laws<slant::self_adjoint, slant::positive_definite>;
  Eigen::Index rows() const { return 2; }
  Eigen::Index cols() const { return 2; }
  void apply(distributed const& x, distributed& y) const { y.entries = 2 * x.entries; }
};

auto method(distributed const& b) {
  return slant::SOLVER{twice{}, b};
}
#else
static_assert(slant::vector<distributed>);
#endif
