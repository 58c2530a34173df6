// SPDX-License-Identifier: MIT
//
// <slant/slant.hpp> comes precompiled.

int main() {
  Eigen::VectorXd const x = slant::project(slant::half_lines(2), Eigen::VectorXd{{-1.0, 2.0}});
  return x[0] == 0 && x[1] == 2 ? 0 : 1;
}
