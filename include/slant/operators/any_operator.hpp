// SPDX-License-Identifier: MIT
//
// An operator whose type is forgotten, for containers and interfaces that cannot be templates.
// Each application costs three virtual calls, two of them for its sizes; no other operator has any.
// What is not forgotten: the type of the vectors, the laws, which methods ask for, and the diagonal
// where there is one.
//
//     using spd = slant::any_operator<Eigen::VectorXd,
//                                     slant::laws<slant::self_adjoint, slant::positive_definite>>;
#pragma once

#include <slant/operators/matrix.hpp>

#include <any>
#include <memory>
#include <utility>

namespace slant {

/// The workspace of an any_operator. A copy has a content of its own.
class any_workspace {
 public:
  explicit any_workspace(std::in_place_t, auto w) : content_(std::move(w)) {}

  /// The content, which has the type W.
  template <class W>
  [[nodiscard]] W& get() noexcept {
    return *std::any_cast<W>(&content_);
  }

 private:
  std::any content_;
};

/// Any operator on vectors of type V that declares at least the laws L. Copies share the operator.
/// A workspace belongs to the operator that made it.
template <slant::vector V, law_set L = law_set{}>
class any_operator {
 public:
  static constexpr bool forgets_types = true;
  static constexpr law_set laws = L;

  /// Keeps `a` like every composition: an lvalue is referenced, an rvalue owned.
  template <operand A>
    requires(!std::same_as<std::remove_cvref_t<A>, any_operator> &&
             linear_operator<std::remove_cvref_t<part_t<A>>, V> && laws_of<part_t<A>>.contains(L))
  any_operator(A&& a)  // NOLINT(google-explicit-constructor): forgetting a type is safe
      : model_(std::make_shared<model<part_t<A>>>(slant::as_operator(std::forward<A>(a)))) {}

  [[nodiscard]] index rows() const { return model_->rows(); }
  [[nodiscard]] index cols() const { return model_->cols(); }
  [[nodiscard]] any_workspace workspace(V const& x) const { return model_->workspace(x); }
  void apply(V const& x, V& y, any_workspace& w) const { model_->apply(x, y, w); }
  /// d = diag(A), if the operator gives it; whether it does.
  [[nodiscard]] bool diagonal_if_known(V& d) const { return model_->diagonal_if_known(d); }

 private:
  struct interface {
    interface() = default;
    interface(interface const&) = delete;
    interface& operator=(interface const&) = delete;
    virtual ~interface() = default;
    [[nodiscard]] virtual index rows() const = 0;
    [[nodiscard]] virtual index cols() const = 0;
    [[nodiscard]] virtual any_workspace workspace(V const& x) const = 0;
    virtual void apply(V const& x, V& y, any_workspace& w) const = 0;
    [[nodiscard]] virtual bool diagonal_if_known(V& d) const = 0;
  };
  template <class A>
  struct model final : interface {
    explicit model(held<A> part) : a(std::move(part)) {}
    [[nodiscard]] index rows() const override { return a.get().rows(); }
    [[nodiscard]] index cols() const override { return a.get().cols(); }
    [[nodiscard]] any_workspace workspace(V const& x) const override {
      return any_workspace(std::in_place, slant::workspace(a.get(), x));
    }
    void apply(V const& x, V& y, any_workspace& w) const override {
      using inner = workspace_t<std::remove_cvref_t<A>, V>;
      slant::apply(a.get(), x, y, w.template get<inner>());
    }
    [[nodiscard]] bool diagonal_if_known(V& d) const override {
      return slant::diagonal_if_known(a.get(), d);
    }
    held<A> a;
  };

  std::shared_ptr<interface const> model_;
};

}  // namespace slant
