// SPDX-License-Identifier: MIT
#include "contact/spring_scenes.hpp"

#include <array>
#include <fem/box_mesh.hpp>
#include <fem/contact_scene.hpp>
#include <fem/elasticity.hpp>

namespace test {

template <int D>
spring_scene spring_block(int k, double spring, double push) {
  using vector = Eigen::Matrix<double, D, 1>;
  std::array<int, D> cells{};
  vector size = vector::Ones(), origin = vector::Zero();
  for (int a = 0; a < D; ++a) cells[std::size_t(a)] = a == 0 ? 2 * k : k;
  size[0] = 2;
  auto const mesh = fem::make_box_mesh<D>(cells, size, origin);
  auto const unknowns = fem::number_unknowns<D>(mesh, [](Eigen::Index) { return false; });
  spring_scene s;
  s.K = fem::stiffness<D>(mesh, unknowns, fem::lame(1, 0.3));
  double const stiff = spring * s.K.diagonal().maxCoeff() / double(s.K.rows());
  for (Eigen::Index i = 0; i < s.K.rows(); ++i) s.K.coeffRef(i, i) += stiff;
  s.contact.f = Eigen::VectorXd::Zero(s.K.rows());
  vector traction = vector::Zero();
  traction[D - 1] = -0.01;
  traction[0] = 0.01 * push;
  Eigen::Matrix<double, D, D> gradient = Eigen::Matrix<double, D, D>::Zero();
  gradient(D - 1, 0) = -0.002;
  fem::add_tractions<D>(mesh, unknowns, {{{D - 1, true}, traction, gradient}}, s.contact.f);
  auto const nodes = mesh.nodes_on({D - 1, false});
  auto const m = static_cast<Eigen::Index>(nodes.size());
  s.contact.N.resize(m, s.K.rows());
  s.contact.T.resize((D - 1) * m, s.K.rows());
  for (Eigen::Index i = 0; i < m; ++i) {
    int const first = unknowns.first[nodes[std::size_t(i)]];
    s.contact.N.insert(i, first + D - 1) = -1;
    for (int a = 0; a + 1 < D; ++a) s.contact.T.insert((D - 1) * i + a, first + a) = 1;
  }
  s.contact.N.makeCompressed();
  s.contact.T.makeCompressed();
  s.contact.d = Eigen::VectorXd::Zero(m);
  s.contact.g = Eigen::VectorXd::Zero(m);
  return s;
}

template spring_scene spring_block<2>(int, double, double);
template spring_scene spring_block<3>(int, double, double);

}  // namespace test
