// SPDX-License-Identifier: MIT
//
// Archetypes: the least that is a model of each concept.
#pragma once

#include <slant/concepts/capabilities.hpp>
#include <slant/concepts/convex_set.hpp>
#include <slant/concepts/face.hpp>
#include <slant/concepts/factorization.hpp>
#include <slant/concepts/iterative_method.hpp>
#include <slant/concepts/scalar.hpp>
#include <slant/concepts/slanting_function.hpp>
#include <slant/concepts/vector.hpp>
#include <slant/iteration/stopping.hpp>

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <iosfwd>
#include <limits>
#include <string>
#include <utility>

namespace slant::testing::archetype {

// --- vector --------------------------------------------------------------------------------------
//
// The least that is a vector: not an Eigen object, no element access, no arithmetic of its own.
// What compiles with it uses nothing but slant::local, inner_product, norm and like, and will run
// on vectors distributed over processes.

template <class S>
class basic_vector {
 public:
  using storage = Eigen::Matrix<S, Eigen::Dynamic, 1>;

  explicit basic_vector(storage entries) : entries_(std::move(entries)) {}

  [[nodiscard]] storage& local() noexcept { return entries_; }
  [[nodiscard]] storage const& local() const noexcept { return entries_; }
  [[nodiscard]] S inner_product(basic_vector const& y) const { return entries_.dot(y.entries_); }
  [[nodiscard]] basic_vector like(index n) const { return basic_vector(storage(n)); }

 private:
  storage entries_;
};

using vector = basic_vector<double>;

static_assert(slant::vector<vector>);

// --- scalar --------------------------------------------------------------------------------------
//
// The least that is a scalar: a double that converts from other numbers only where the code says
// so, and to none. What compiles with it mixes no number types silently: an `int` or `double` that
// slips into an expression of scalars is an error, as it would be a loss with a multiprecision
// scalar.

class scalar {
 public:
  constexpr scalar() = default;
  constexpr explicit scalar(int value) : value_(value) {}
  constexpr explicit scalar(index value) : value_(static_cast<double>(value)) {}
  constexpr explicit scalar(double value) : value_(value) {}
  scalar(bool) = delete;
  /// For tests to compare.
  [[nodiscard]] constexpr double value() const { return value_; }

  friend constexpr scalar operator+(scalar a, scalar b) { return scalar(a.value_ + b.value_); }
  friend constexpr scalar operator-(scalar a, scalar b) { return scalar(a.value_ - b.value_); }
  friend constexpr scalar operator*(scalar a, scalar b) { return scalar(a.value_ * b.value_); }
  friend constexpr scalar operator/(scalar a, scalar b) { return scalar(a.value_ / b.value_); }
  friend constexpr scalar operator-(scalar a) { return scalar(-a.value_); }
  constexpr scalar& operator+=(scalar b) { return *this = *this + b; }
  constexpr scalar& operator-=(scalar b) { return *this = *this - b; }
  constexpr scalar& operator*=(scalar b) { return *this = *this * b; }
  constexpr scalar& operator/=(scalar b) { return *this = *this / b; }
  friend constexpr bool operator==(scalar a, scalar b) { return a.value_ == b.value_; }
  friend constexpr auto operator<=>(scalar a, scalar b) { return a.value_ <=> b.value_; }

  friend scalar abs(scalar a) { return scalar(std::fabs(a.value_)); }
  friend scalar sqrt(scalar a) { return scalar(std::sqrt(a.value_)); }
  friend scalar ldexp(scalar a, int exponent) { return scalar(std::ldexp(a.value_, exponent)); }
  friend scalar frexp(scalar a, int* exponent) { return scalar(std::frexp(a.value_, exponent)); }
  template <class Char, class Traits>
  friend auto& operator<<(std::basic_ostream<Char, Traits>& out, scalar a) {
    return out << a.value_;
  }

 private:
  double value_ = 0;
};

}  // namespace slant::testing::archetype

template <>
class std::numeric_limits<slant::testing::archetype::scalar> {
  using scalar = slant::testing::archetype::scalar;
  using base = std::numeric_limits<double>;

 public:
  static constexpr bool is_specialized = true;
  static constexpr int digits = base::digits;
  static constexpr int max_exponent = base::max_exponent;
  static constexpr scalar epsilon() { return scalar(base::epsilon()); }
  static constexpr scalar min() { return scalar(base::min()); }
  static constexpr scalar max() { return scalar(base::max()); }
  static constexpr scalar denorm_min() { return scalar(base::denorm_min()); }
  static constexpr scalar infinity() { return scalar(base::infinity()); }
  static constexpr scalar quiet_NaN() { return scalar(base::quiet_NaN()); }
};

/// What Eigen asks for.
template <>
struct Eigen::NumTraits<slant::testing::archetype::scalar> : Eigen::GenericNumTraits<double> {
  using Real = slant::testing::archetype::scalar;
  using NonInteger = Real;
  using Literal = Real;
  using Nested = Real;
  static constexpr Real epsilon() { return std::numeric_limits<Real>::epsilon(); }
  static constexpr Real dummy_precision() { return Real(1e-12); }
  static constexpr Real highest() { return std::numeric_limits<Real>::max(); }
  static constexpr Real lowest() { return -std::numeric_limits<Real>::max(); }
  static constexpr Real infinity() { return std::numeric_limits<Real>::infinity(); }
  static constexpr Real quiet_NaN() { return std::numeric_limits<Real>::quiet_NaN(); }
};

namespace slant::testing::archetype {

static_assert(slant::scalar<scalar>);
static_assert(!std::convertible_to<double, scalar> && !std::convertible_to<int, scalar> &&
              !std::constructible_from<double, scalar>);

// --- linear operator -----------------------------------------------------------------------------
//
// The least that is a linear operator: two sizes and one function, with a concrete signature on
// archetype vectors. Not a template, no workspace, no capability. An algorithm that compiles with
// it asks for nothing more; the ones below add the laws that algorithms ask for.

/// y = M x, and promises nothing.
class linear_operator {
 public:
  explicit linear_operator(Eigen::MatrixXd m) : m_(std::move(m)) {}

  [[nodiscard]] index rows() const { return m_.rows(); }
  [[nodiscard]] index cols() const { return m_.cols(); }
  void apply(vector const& x, vector& y) const { y.local().noalias() = m_ * x.local(); }

 private:
  Eigen::MatrixXd m_;
};

/// The same for a matrix that the caller knows to have the laws L.
template <law... L>
class lawful_operator : public linear_operator {
 public:
  static constexpr law_set laws = slant::laws<L...>;
  using linear_operator::linear_operator;
};
using self_adjoint_operator = lawful_operator<law::self_adjoint>;
using psd_operator = lawful_operator<law::self_adjoint, law::positive_semidefinite>;
using spd_operator = lawful_operator<law::self_adjoint, law::positive_definite>;

/// linear_operator and its adjoint.
class operator_with_adjoint : public linear_operator {
 public:
  explicit operator_with_adjoint(Eigen::MatrixXd const& m)
      : linear_operator(m), transpose_(m.transpose()) {}
  void apply_adjoint(vector const& x, vector& y) const { transpose_.apply(x, y); }

 private:
  linear_operator transpose_;
};

static_assert(slant::linear_operator<linear_operator, vector>);
static_assert(!slant::has_adjoint<linear_operator, vector>);
static_assert(slant::spd_operator<spd_operator, vector>);
static_assert(slant::has_adjoint<operator_with_adjoint, vector>);

// --- factorization -------------------------------------------------------------------------------
//
// The least that is a factorisation: a number of rows and a solve, with a concrete signature on
// archetype vectors. It promises no laws.

class factorization {
 public:
  /// Of an invertible matrix.
  explicit factorization(Eigen::MatrixXd const& m) : lu_(m) {}

  [[nodiscard]] index rows() const { return lu_.rows(); }
  void solve(vector const& b, vector& x) const { x.local() = lu_.solve(b.local()); }

 private:
  Eigen::PartialPivLU<Eigen::MatrixXd> lu_;
};

/// The same for a symmetric positive definite matrix.
class spd_factorization : public factorization {
 public:
  static constexpr law_set laws = slant::laws<law::self_adjoint, law::positive_definite>;
  using factorization::factorization;
};

static_assert(slant::factorization<factorization, vector>);

// --- convex set ----------------------------------------------------------------------------------
//
// The least that is a convex set: a size, a projection in place and a test of membership, for one
// type of vector. No block structure, no static dimension, no capability. Its points are the
// vectors without negative entries.

template <class V>
class basic_convex_set {
 public:
  explicit basic_convex_set(index n) : size_(n) {}

  [[nodiscard]] index size() const { return size_; }
  void project(V const& x, V& y) const {
    slant::local(y) = slant::local(x).cwiseMax(scalar_t<V>(0));
  }
  [[nodiscard]] bool contains(V const& x) const {
    return (slant::local(x).array() >= scalar_t<V>(0)).all();
  }

 private:
  index size_;
};

/// The same with states: what an active-set method asks for, with one block.
template <class V>
class basic_separable_set : public basic_convex_set<V> {
 public:
  using basic_convex_set<V>::basic_convex_set;

  [[nodiscard]] block_state state(V const& x) const {
    auto const positive = (slant::local(x).array() > scalar_t<V>(0)).count();
    return positive == this->size() ? block_state::free
           : positive > 0           ? block_state::sliding
                                    : block_state::fixed;
  }
};

/// The same with steps to the boundary: what KPRGP asks for.
template <class V>
class basic_active_set_set : public basic_separable_set<V> {
 public:
  using basic_separable_set<V>::basic_separable_set;

  [[nodiscard]] scalar_t<V> step_to_boundary(V const& x, V const& d) const {
    auto step = std::numeric_limits<scalar_t<V>>::infinity();
    for (index i = 0; i < this->size(); ++i) {
      auto const& from = slant::local(x);
      auto const& along = slant::local(d);
      if (along(i) < scalar_t<V>(0)) step = std::min(step, -from(i) / along(i));
    }
    return step;
  }
};

using convex_set = basic_convex_set<vector>;
using separable_set = basic_separable_set<vector>;
using active_set_set = basic_active_set_set<vector>;

static_assert(slant::convex_set<convex_set, vector>);
static_assert(!slant::separable_set<convex_set, vector>);
static_assert(slant::separable_set<separable_set, vector>);
static_assert(!has_slant<separable_set, vector> && !has_visit<separable_set>);
static_assert(!has_step_to_boundary<separable_set, vector>);
static_assert(has_step_to_boundary<active_set_set, vector>);

// --- face ----------------------------------------------------------------------------------------
//
// The least that is a face: one block for each entry, free if the entry is positive.

class face {
 public:
  face() = default;

  template <class C, class X>
  void assign(C const&, X const& x) {
    free_ = x.array() > 0;
  }
  [[nodiscard]] index size() const { return free_.size(); }
  [[nodiscard]] block_state state(index i) const {
    return free_(i) ? block_state::free : block_state::fixed;
  }
  void keep(vector const& x, vector& y) const { y.local() = free_.select(x.local().array(), 0.0); }
  void keep_complement(vector const& x, vector& y) const {
    y.local() = free_.select(0.0, x.local().array());
  }

 private:
  Eigen::Array<bool, Eigen::Dynamic, 1> free_;
};

static_assert(block_partition<face, vector>);

// --- slanting function ---------------------------------------------------------------------------
//
// The least that is a slanting function: two sizes, a value and a slanting operator, with concrete
// signatures on archetype vectors. No workspace, no renewal in place, no base class.

/// F(y)_i = |y_i| + y_i/2 on n unknowns; F°(y)_ii = 3/2 for y_i >= 0, else −1/2.
class slanting_function {
 public:
  explicit slanting_function(index n) : n_(n) {}

  [[nodiscard]] index rows() const { return n_; }
  [[nodiscard]] index cols() const { return n_; }
  void value(vector const& y, vector& f) const { f.local() = y.local().cwiseAbs() + y.local() / 2; }
  [[nodiscard]] linear_operator slant(vector const& y) const {
    Eigen::VectorXd const slopes =
        y.local().unaryExpr([](double y_i) { return y_i >= 0 ? 1.5 : -0.5; });
    return linear_operator(Eigen::MatrixXd(slopes.asDiagonal()));
  }

 private:
  index n_;
};

static_assert(slant::slanting_function<slanting_function, vector>);
static_assert(!slant::has_slant_update<slanting_function, vector>);

// --- iterative method ----------------------------------------------------------------------------
//
// The least that is an iterative method, a stopping rule and an observer. The driver, the range of
// iterates and the algebra of rules compile with these, so they ask for nothing more.

/// Counts down from its start to 0 and rests there. Its iterate is no vector; its state can be
/// moved but not copied.
class iterative_method {
 public:
  class state {
   public:
    explicit state(int from) : x(from) {}
    state(state&&) = default;
    state& operator=(state&&) = default;

    int x;
    index iteration = 0;
    slant::status status = slant::status::running;
  };

  [[nodiscard]] state start(int const& x0) const { return state(x0); }
  void step(state& s) const {
    if (s.x == 0) {
      s.status = slant::status::converged;
    } else {
      --s.x;
      ++s.iteration;
    }
  }
};

/// Stops when the iterate is below a bound.
class stopping_rule : public rule {
 public:
  explicit stopping_rule(int bound) : bound_(bound) {}
  [[nodiscard]] status operator()(iterative_method::state const& s) const {
    return s.x < bound_ ? status::interrupted : status::running;
  }
  [[nodiscard]] std::string reason(iterative_method::state const&) const { return "below"; }

 private:
  int bound_;
};

/// Counts the states it is shown.
class observer {
 public:
  observer() = default;
  observer(observer const&) = delete;
  observer& operator=(observer const&) = delete;
  void operator()(iterative_method::state const&) { ++seen_; }
  [[nodiscard]] int seen() const { return seen_; }

 private:
  int seen_ = 0;
};

static_assert(slant::iterative_method<iterative_method, int>);
static_assert(slant::stopping_rule<stopping_rule, iterative_method::state>);
static_assert(slant::observer<observer, iterative_method::state>);
static_assert(!std::copyable<iterative_method::state>);

}  // namespace slant::testing::archetype
