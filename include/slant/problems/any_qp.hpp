// SPDX-License-Identifier: MIT
//
// A quadratic program whose operator and set are forgotten by its type: what is written for it is
// compiled once, whatever A and Λ are.
//
//     slant::separable_qp const given{A, b, Λ};
//     auto const run = slant::solve(slant::kprgp{slant::erased(given)}, x0, stop);
//
// An application of A costs three virtual calls more, a visit of all blocks one question for each
// run of blocks of one kind. Steps, counts and bits are the same, unless A has a twin of lower
// precision (concepts/capabilities.hpp), which is forgotten: then inner iterations take twice the
// time.
//
// A program says that it wants types forgotten; nothing else, and not what is linked, does so. With
// slant::compiled kprgp{erased(qp)}, symmetric_newton{erased(qp)}, interior_point{erased(qp)}, and the
// latter two beside erased(M), are instances that exist already.
#pragma once

#include <slant/operators/any_operator.hpp>
#include <slant/problems/separable_qp.hpp>
#include <slant/sets/any_set.hpp>

#include <concepts>
#include <memory>
#include <type_traits>
#include <utility>

namespace slant {

/// The laws of an any_qp: whether A is definite, and that it is self-adjoint and semidefinite.
inline constexpr law_set semidefinite_laws =
    slant::laws<slant::self_adjoint, slant::positive_semidefinite>;
inline constexpr law_set definite_laws = slant::laws<slant::self_adjoint, slant::positive_definite>;

/// minimise ½ xᵀA x − bᵀx over x ∈ Λ with A of the laws L, Λ of blocks of the kinds Runs. Refers to
/// a program that it is made of as an lvalue, owns an rvalue; copies share it. Made by `erased`.
template <scalar S = double, law_set L = semidefinite_laws, class Runs = usual_runs<S>>
class any_qp {
 public:
  static constexpr bool forgets_types = true;
  using scalar = S;
  using vector_type = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  using operator_type = any_operator<vector_type, L>;
  using set_type = any_set<S, Runs>;

  /// The same program as qp.
  template <class QP>
    requires(!std::same_as<std::remove_cvref_t<QP>, any_qp> &&
             std::same_as<typename std::remove_cvref_t<QP>::vector_type, vector_type> &&
             std::constructible_from<set_type, typename std::remove_cvref_t<QP>::set_type const&> &&
             laws_of<typename std::remove_cvref_t<QP>::operator_type>.contains(L))
  any_qp(QP&& qp)  // NOLINT(google-explicit-constructor): forgetting a type is safe
      : parts_(parts_of(std::forward<QP>(qp))) {}

  [[nodiscard]] operator_type const& a() const { return parts_->a; }
  [[nodiscard]] vector_type const& b() const { return *parts_->b; }
  [[nodiscard]] set_type const& set() const { return parts_->set; }
  [[nodiscard]] index size() const { return b().size(); }

 private:
  struct parts {
    std::shared_ptr<void const> program;  // if it is owned
    operator_type a;
    set_type set;
    vector_type const* b;
  };

  template <class QP>
  static std::shared_ptr<parts const> parts_of(QP&& qp) {
    if constexpr (std::is_lvalue_reference_v<QP>) {
      return parts_of(nullptr, qp);
    } else {
      auto const owned = std::make_shared<std::remove_cvref_t<QP> const>(std::forward<QP>(qp));
      return parts_of(owned, *owned);
    }
  }
  template <class QP>
  static std::shared_ptr<parts const> parts_of(std::shared_ptr<void const> owner, QP const& qp) {
    return std::make_shared<parts const>(
        parts{std::move(owner), operator_type(qp.a()), set_type(qp.set()), &qp.b()});
  }

  std::shared_ptr<parts const> parts_;
};

namespace detail {

/// What any_qp asks of a program besides its laws.
template <class QP, class Runs>
concept forgettable_problem = requires {
  typename QP::operator_type;
  typename QP::set_type;
  typename QP::scalar;
  requires std::same_as<typename QP::vector_type,
                        Eigen::Matrix<typename QP::scalar, Eigen::Dynamic, 1>>;
  requires std::constructible_from<any_set<typename QP::scalar, Runs>,
                                   typename QP::set_type const&>;
};

template <class QP, class Runs>
using erased_t = any_qp<typename QP::scalar,
                        declares_positive_definite<typename QP::operator_type> ? definite_laws
                                                                               : semidefinite_laws,
                        Runs>;

}  // namespace detail

/// The same program with its types forgotten, as definite as A declares to be. Runs: the kinds of
/// blocks that it can have, usual_runs<S> unless said.
template <class Runs = void, class QP>
  requires(!psd_operator<std::remove_cvref_t<QP>, Eigen::VectorXd>)
[[nodiscard]] auto erased(QP&& qp) {
  using problem = std::remove_cvref_t<QP>;
  using runs = std::conditional_t<std::is_void_v<Runs>, usual_runs<set_scalar_t<QP>>, Runs>;
  constexpr bool fits = detail::forgettable_problem<problem, runs>;
  static_assert(
      fits,
      "erased: expected a program on Eigen vectors, with a set of blocks of the kinds that "
      "an any_set can have");
  if constexpr (fits) {
    constexpr bool has_laws = laws_of<typename problem::operator_type>.contains(semidefinite_laws);
    static_assert(has_laws,
                  "erased: A must declare that it is self-adjoint and positive semidefinite");
    if constexpr (has_laws) {
      return detail::erased_t<problem, runs>(std::forward<QP>(qp));
    } else {
      return detail::refused{};
    }
  } else {
    return detail::refused{};
  }
}

/// The same preconditioner with its type forgotten; what it has for faces and in lower precision is
/// forgotten, too.
template <class M>
  requires psd_operator<std::remove_cvref_t<M>, Eigen::VectorXd>
[[nodiscard]] any_operator<Eigen::VectorXd, semidefinite_laws> erased(M&& m) {
  return std::forward<M>(m);
}

}  // namespace slant
