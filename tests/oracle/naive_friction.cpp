// SPDX-License-Identifier: MIT
#include "oracle/naive_friction.hpp"

namespace oracle {

friction_vector nearest_in_cone(friction_vector const& x, friction_real slope) {
  friction_real const t = x.tail(x.size() - 1).norm();
  if (std::isinf(slope)) {
    friction_vector y = x;
    y[0] = std::max(x[0], 0.0L);
    return y;
  }
  if (t <= slope * x[0]) return x;
  friction_vector edge = friction_vector::Zero(x.size());  // the unit vector of the boundary
  edge[0] = 1;
  if (t > 0) edge.tail(x.size() - 1) = slope / t * x.tail(x.size() - 1);
  edge /= edge.norm();
  friction_vector const on_edge = std::max(0.0L, edge.dot(x)) * edge;
  return on_edge;
}

std::vector<naive_contact> naive_friction(friction_matrix const& W, friction_vector const& q,
                                          friction_vector const& mu, friction_vector const& r) {
  std::vector<naive_contact> all;
  Eigen::Index const d = q.size() / mu.size();
  friction_vector const u = W * r + q;
  for (Eigen::Index i = 0; i < mu.size(); ++i) {
    friction_vector const ri = r.segment(i * d, d), ui = u.segment(i * d, d);
    friction_vector v = ui;
    v[0] += mu[i] * ui.tail(d - 1).norm();
    friction_real const dual =
        mu[i] > 0 ? 1 / mu[i] : std::numeric_limits<friction_real>::infinity();
    all.push_back({.natural_map = (ri - nearest_in_cone(ri - v, mu[i])).norm(),
                   .outside_cone = (ri - nearest_in_cone(ri, mu[i])).norm(),
                   .outside_dual = (v - nearest_in_cone(v, dual)).norm(),
                   .penetration = std::max(0.0L, -ui[0]),
                   .complementarity = std::abs(v.dot(ri)),
                   .dissipation = -ui.tail(d - 1).dot(ri.tail(d - 1))});
  }
  return all;
}

}  // namespace oracle
