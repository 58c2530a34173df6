// SPDX-License-Identifier: MIT
//
// Any bytes as the data of a contact scene: they are refused by bad_input, or the dual problem can
// be set up, evaluated and given another load step, without friction, in the plane and in space.
// And as contacts in local coordinates, whose law is evaluated at any forces, or they are refused.
#include "bytes.hpp"

#include <slant/contact/dual.hpp>
#include <slant/contact/friction/verify.hpp>
#include <slant/factorizations/dense_ldlt.hpp>

namespace {

using data = slant::contact::data<double>;
using vector = Eigen::VectorXd;

vector any_vector(fuzz::bytes& in, slant::index size) {
  vector x(size);
  for (double& entry : x) entry = in.any();
  return x;
}

/// Sometimes one more or less: sizes that do not fit.
slant::index nearly(fuzz::bytes& in, slant::index size) {
  int const choice = in.below(64);
  return choice == 0 ? size + 1 : choice == 1 && size > 0 ? size - 1 : size;
}

Eigen::SparseMatrix<double> any_matrix(fuzz::bytes& in, slant::index rows, slant::index cols) {
  Eigen::SparseMatrix<double> A(rows, cols);
  if (rows == 0 || cols == 0) return A;
  for (int k = in.below(12); k > 0; --k) {
    int const row = in.below(static_cast<int>(rows)), col = in.below(static_cast<int>(cols));
    A.coeffRef(row, col) += in.any();
  }
  return A;
}

/// What a naive look finds wrong; only what no right data have.
bool has_defect(data const& c, slant::index tangents) {
  auto const m = c.N.rows(), n = c.f.size();
  if (m < 1 || c.N.cols() != n || c.d.size() != m || !c.f.allFinite()) return true;
  for (double const gap : c.d)
    if (!(gap >= std::numeric_limits<double>::lowest())) return true;
  if (c.T.rows() != tangents * m) return true;
  if (tangents > 0 && (c.T.cols() != n || c.g.size() != m)) return true;
  if (tangents == 0 && c.g.size() != 0) return true;
  for (double const bound : c.g)
    if (!(bound >= 0)) return true;
  return !Eigen::MatrixXd(c.N).allFinite() || !Eigen::MatrixXd(c.T).allFinite();
}

template <class Problem>
void demand_usable(Problem const& problem) {
  // A right-hand side that overflowed is refused here; what is not refused has a meaning.
  [[maybe_unused]] auto const qp = problem.qp();
  fuzz::demand(problem.b().allFinite(), "a linear term of finite numbers");
  fuzz::demand(slant::dimension_of(problem.set()) == problem.b().size(), "a set of the size of b");
  vector λ = vector::Constant(problem.b().size(), 1.0), p(λ.size());
  slant::project(problem.set(), λ, p);
  fuzz::demand(p.allFinite() && problem.set().contains(p), "1 has a projection onto the set");
  fuzz::demand(problem.displacement(problem.zero()).allFinite(), "λ = 0 has a displacement");
}

template <class Friction>
void set_up(Friction friction, slant::index tangents, data const& c, fuzz::bytes in) {
  auto const n = std::max<slant::index>(c.f.size(), 1);
  vector diagonal(nearly(in, n));
  double const unit = std::ldexp(1.0, 4 * (in.below(256) - 128));
  for (double& entry : diagonal) entry = unit * (4.5 + in.quarter());
  try {
    slant::dense_ldlt<> const K(diagonal.asDiagonal().toDenseMatrix());
    slant::contact::dual problem(friction, K, c);
    fuzz::demand(!has_defect(c, tangents), "data with a defect are refused");
    demand_usable(problem);
    vector const before = problem.b();
    slant::contact::load_step<> step;
    int const kinds = in.below(16);
    if (kinds & 1) step.f = any_vector(in, nearly(in, c.f.size()));
    if (kinds & 2) step.d = any_vector(in, nearly(in, c.d.size()));
    if (kinds & 4) step.g = any_vector(in, nearly(in, c.g.size()));
    if (kinds & 8) step.w = any_vector(in, nearly(in, c.T.rows()));
    try {
      problem.update(step);
    } catch (slant::bad_input const& refusal) {
      fuzz::demand_message(refusal.what());
      fuzz::demand(problem.b() == before, "a step that is refused changes nothing");
    }
    demand_usable(problem);
  } catch (slant::bad_input const& refusal) {
    fuzz::demand_message(refusal.what());
  }
}

void evaluate_contacts(fuzz::bytes in) {
  if (in.below(8) == 0) return;
  slant::index const contacts = in.below(4), d = 2 + in.below(2);
  slant::contact::friction_problem<double> p;
  p.W = any_matrix(in, nearly(in, contacts * d), nearly(in, contacts * d));
  p.q = any_vector(in, nearly(in, contacts * d));
  p.mu = any_vector(in, nearly(in, contacts));
  vector const r = any_vector(in, nearly(in, p.q.size()));
  try {
    auto const found = slant::contact::verify(p, r);
    fuzz::demand(found.open + found.stick + found.slip == p.contacts(), "each contact has a state");
    fuzz::demand(p.q.allFinite() && p.mu.allFinite() && (p.mu.array() >= 0).all() &&
                     Eigen::MatrixXd(p.W).allFinite(),
                 "numbers that are none are refused");
    fuzz::demand(r.allFinite() || !(found.unit_free_map == 0), "what is no force is no solution");
  } catch (slant::bad_input const& refusal) {
    fuzz::demand_message(refusal.what());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* bytes, std::size_t size) {
  fuzz::bytes in(bytes, size);
  slant::index const tangents = in.below(3);
  slant::index const m = in.below(4), n = in.below(6);
  data c;
  c.N = any_matrix(in, m, n);
  c.T = any_matrix(in, tangents * nearly(in, m), nearly(in, n));
  c.f = any_vector(in, nearly(in, n));
  c.d = any_vector(in, nearly(in, m));
  c.g = any_vector(in, nearly(in, tangents == 0 ? 0 : m));
  evaluate_contacts(in);
  if (tangents == 0) set_up(slant::contact::frictionless{}, 0, c, in);
  if (tangents == 1) set_up(slant::contact::friction_line{}, 1, c, in);
  if (tangents == 2) set_up(slant::contact::friction_disc{}, 2, c, in);
  return 0;
}
