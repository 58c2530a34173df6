// SPDX-License-Identifier: MIT
//
// Levels of multigrid and contact on them, which no law of friction changes.
#include <slant/contact/parts/iterated_run.hpp>

static_assert(SLANT_USES_COMPILED, "SLANT_COMPILED is not the alignment of Eigen with these flags");

namespace slant {

template class multigrid<double, float>;

namespace contact::detail {

template free_motions<double> floating_bodies<double>(Eigen::SparseMatrix<double> const&,
                                                      node_layout<double> const&, double const&);
template class primal_run<double>;

}  // namespace contact::detail
}  // namespace slant
