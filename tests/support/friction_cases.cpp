// SPDX-License-Identifier: MIT
#include "support/friction_cases.hpp"

namespace test {

Eigen::VectorXd numbers(std::initializer_list<double> values) {
  Eigen::VectorXd x(static_cast<Eigen::Index>(values.size()));
  Eigen::Index i = 0;
  for (double const v : values) x[i++] = v;
  return x;
}

friction_problem make_friction_problem(Eigen::MatrixXd const& W, Eigen::VectorXd q,
                                       Eigen::VectorXd mu) {
  return {.W = W.sparseView(), .q = std::move(q), .mu = std::move(mu)};
}

friction_problem plane_contact(double a, double c, double b, double qn, double qt, double mu) {
  Eigen::Matrix2d W;
  W << a, c, c, b;
  return make_friction_problem(W, numbers({qn, qt}), numbers({mu}));
}

friction_problem space_contact(Eigen::Vector3d const& r, Eigen::Vector3d const& u, double mu) {
  Eigen::Matrix3d W;
  W << 4, 1, 0, 1, 3, 1, 0, 1, 5;
  return make_friction_problem(W, u - W * r, numbers({mu}));
}

std::vector<friction_case> single_solution_cases() {
  std::vector<friction_case> cases;
  // W definite and q_n >= 0.
  cases.push_back({"plane, open", plane_contact(2, 0.5, 1, 1, -3, 0.5), {numbers({0, 0})}});
  // r = −W⁻¹ q inside of the cone: 2·2 + 0.5·0.5 = 4.25, 0.5·2 + 0.5 = 1.5.
  cases.push_back(
      {"plane, stick", plane_contact(2, 0.5, 1, -4.25, -1.5, 0.5), {numbers({2, 0.5})}});
  // r_t = −μ r_n sign(u_t), here u = (0, 3) and u = (0, −3).
  cases.push_back(
      {"plane, slip forward", plane_contact(2, 0.5, 1, -3.5, 3, 0.5), {numbers({2, -1})}});
  cases.push_back(
      {"plane, slip backward", plane_contact(2, 0.5, 1, -4.5, -5, 0.5), {numbers({2, 1})}});
  cases.push_back({"plane, no friction", plane_contact(2, 0.5, 1, -4, 3, 0), {numbers({2, 0})}});

  using v3 = Eigen::Vector3d;
  cases.push_back(
      {"space, open", space_contact(v3::Zero(), v3(1, -2, 3), 0.5), {numbers({0, 0, 0})}});
  cases.push_back(
      {"space, stick", space_contact(v3(4, 1, -1), v3::Zero(), 0.5), {numbers({4, 1, -1})}});
  // u_t = 5 (3, 4)/5 against r_t = −½ · 10 (3, 4)/5.
  cases.push_back(
      {"space, slip", space_contact(v3(10, -3, -4), v3(0, 3, 4), 0.5), {numbers({10, -3, -4})}});
  cases.push_back(
      {"space, no friction", space_contact(v3(4, 0, 0), v3(0, 3, -4), 0), {numbers({4, 0, 0})}});
  return cases;
}

friction_case no_solution_case(slant::index dimension) {
  double const k = 2, mu = 1;
  Eigen::VectorXd h = Eigen::VectorXd::Zero(dimension), q = h;
  h[0] = 1;
  h[1] = -k;
  q[0] = -1;
  return {"no solution", make_friction_problem(h * h.transpose(), q, numbers({mu})), {}};
}

friction_case three_solutions_case() {
  return {"three solutions",
          plane_contact(1, -1.5, 4, 1, -4, 2),
          {numbers({0, 0}), numbers({0.5, 1}), numbers({8. / 7, 10. / 7})}};
}

friction_case redundant_case() {
  Eigen::MatrixXd twice(4, 2);
  twice << Eigen::Matrix2d::Identity(), Eigen::Matrix2d::Identity();
  Eigen::Matrix2d W;
  W << 2, 0.5, 0.5, 1;
  return {
      .name = "redundant",
      .problem = make_friction_problem(twice * W * twice.transpose(),
                                       numbers({-4.25, -1.5, -4.25, -1.5}), numbers({0.5, 0.5})),
      .r = {numbers({1, 0.25, 1, 0.25}), numbers({2, 0.5, 0, 0}), numbers({1, 0.5, 1, 0})},
      .infinitely_many = true};
}

std::vector<friction_case> solvable_cases() {
  auto cases = single_solution_cases();
  cases.push_back(three_solutions_case());
  cases.push_back(redundant_case());
  return cases;
}

}  // namespace test
