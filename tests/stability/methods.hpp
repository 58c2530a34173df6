// SPDX-License-Identifier: MIT
//
// The methods under test, each in a form that all share: a program as the library sees it and a
// request go in, an outcome comes out. A new method is one line in the table of its file; how the
// runs are stopped is a matter of stopping.hpp alone.
#pragma once

#include <slant/contact/dual.hpp>
#include <slant/slant.hpp>

#include <limits>
#include <optional>
#include <span>
#include <stability/program.hpp>
#include <string>
#include <string_view>

namespace stability {

/// Where runs begin.
enum class start_point { zero, far, extreme, boundary };

struct request {
  double tolerance = 1e-8;
  start_point start = start_point::zero;
  slant::index steps = 3000;  ///< limits of a run
  slant::index applications = 10000;
};

struct outcome {
  slant::status status = slant::status::running;
  bool refused = false;  ///< slant::bad_input, whose text is the reason
  bool crashed = false;  ///< any other exception
  std::string reason{};
  slant::index iterations = 0;
  slant::index applications = 0;
  Eigen::VectorXd x{};  ///< last iterate in Λ, or its projection; λ in contact
  Eigen::Matrix<long double, Eigen::Dynamic, 1> fine_x{};  ///< x with all its digits, where those
                                                           ///< of a double are not all
  Eigen::VectorXd u{};  ///< displacements, of a method that finds these and λ from them
  /// What the method says of its own relative energy error, if it does.
  double claimed = std::numeric_limits<double>::quiet_NaN();
};

/// A of a program: a dense matrix, or B K⁻¹Bᵀ by the operator of contact::dual. One type for all,
/// so that each method is compiled once.
class program_operator {
 public:
  using scalar = double;
  static constexpr slant::law_set laws =
      slant::laws<slant::self_adjoint, slant::positive_semidefinite>;
  using dual_type =
      slant::contact::dual<slant::contact::friction_disc, slant::ldlt<double>, double>;

  program_operator(Eigen::MatrixXd const* a, dual_type const* dual) : a_(a), dual_(dual) {}
  [[nodiscard]] slant::index rows() const { return dual_ ? dual_->b().size() : a_->rows(); }
  [[nodiscard]] slant::index cols() const { return rows(); }
  void apply(Eigen::VectorXd const& x, Eigen::VectorXd& y) const;

 private:
  Eigen::MatrixXd const* a_;
  dual_type const* dual_;
};

using program_set =
    decltype(slant::cartesian(slant::half_lines(std::declval<Eigen::VectorXd const&>()),
                              slant::intervals(std::declval<Eigen::VectorXd const&>(),
                                               std::declval<Eigen::VectorXd const&>()),
                              slant::discs(std::declval<Eigen::VectorXd const&>())));

/// A program as the library sees it. Refers to p.
class prepared {
 public:
  explicit prepared(program const& p);
  prepared(prepared const&) = delete;
  prepared& operator=(prepared const&) = delete;

  [[nodiscard]] program const& source() const { return p_; }
  [[nodiscard]] slant::contact::data<double> const& contact() const { return data_; }
  [[nodiscard]] program_operator a() const { return {&p_.A, dual_ ? &*dual_ : nullptr}; }
  [[nodiscard]] Eigen::VectorXd const& b() const { return dual_ ? dual_->b() : p_.b; }
  [[nodiscard]] program_set const& set() const { return set_; }
  [[nodiscard]] auto qp() const { return slant::separable_qp{a(), b(), set()}; }
  /// A with entries, column by column from the operator, symmetric to the last bit.
  [[nodiscard]] Eigen::MatrixXd const& dense() const { return dense_; }
  /// An approximation of A⁻¹: the lumped one in contact, else diag(A)⁻¹.
  [[nodiscard]] Eigen::SparseMatrix<double> const& approximate_inverse() const { return inverse_; }
  [[nodiscard]] Eigen::VectorXd start(start_point from) const;
  /// u of λ, or x itself.
  [[nodiscard]] Eigen::VectorXd answer(Eigen::VectorXd const& x) const;
  /// What a certificate says of the energy error of P_Λ(x): contact::certificate in contact, else
  /// energy_certificate with conjugate gradients. goal: the relative error that is asked for.
  [[nodiscard]] slant::energy_error<double> error_of(Eigen::VectorXd const& x, double goal) const;
  /// The relative residual of the optimality conditions, in plain double: check_optimality in
  /// contact, else the natural residual.
  [[nodiscard]] double kkt(Eigen::VectorXd const& x) const;

 private:
  program const& p_;
  slant::contact::data<double> data_{};
  std::optional<slant::ldlt<double>> factor_{};
  std::optional<program_operator::dual_type> dual_{};
  program_set set_;
  Eigen::MatrixXd dense_{};
  Eigen::SparseMatrix<double> inverse_{};
};

/// Which programs a method is made for.
enum class scope { all, contact, dense, rounded };  ///< rounded: dense, data that a float holds

struct method {
  std::string_view name;
  outcome (*run)(prepared const&, request const&);
  scope programs = scope::all;
  double epsilon = std::numeric_limits<double>::epsilon();  ///< of its scalar
  /// Does it say `converged` only beside a certificate? Then no test lets it be wrong.
  bool certified = true;
};

[[nodiscard]] std::span<method const> newton_methods();      ///< newton_methods.cpp
[[nodiscard]] std::span<method const> active_set_methods();  ///< active_set_methods.cpp
[[nodiscard]] std::span<method const> natural_methods();     ///< natural_methods.cpp
[[nodiscard]] std::span<method const> scalar_methods();      ///< scalar_methods.cpp

/// f(method) for all.
template <class F>
void for_each_method(F const& f) {
  for (auto const methods :
       {newton_methods(), active_set_methods(), natural_methods(), scalar_methods()})
    for (auto const& m : methods) f(m);
}

/// Is a program for a method? One in contact is for no other scalar than double.
[[nodiscard]] inline bool takes(method const& m, program const& p) {
  return m.programs == scope::all || (m.programs == scope::contact) == p.contact();
}

/// The run of a method, with exceptions caught.
[[nodiscard]] outcome run(method const& m, prepared const& p, request const& r);

}  // namespace stability
